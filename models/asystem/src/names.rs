//! The names of a script, statement by statement: what exists, what is new, and what belongs to what.
//!
//! Names are checked before anything is drawn, and again as statements are typed. A tree is in at most one cluster, as
//! the paper's `SEGMENT` has one class. What is glued or merged is part of what comes of it, and its name is free
//! again. Absent: what trees look like.

use super::commands::COMMANDS;
use super::fault::Fault;
use super::operands::MOST_LEVELS;
use super::statement::{Device, Name, Statement, TreeType};
use std::collections::{BTreeMap, BTreeSet};

/// A tree, as far as names go.
#[derive(Debug, Clone, Copy)]
struct Known {
    tree_type: TreeType,
    level: u32,
}

/// All names at a place of a script.
#[derive(Debug, Clone, Default)]
pub struct Names {
    trees: BTreeMap<String, Known>,
    clusters: BTreeMap<String, BTreeSet<String>>,
    workstations: BTreeMap<String, BTreeSet<Device>>,
    /// The names that workstations have had, by their small letters.
    spelled: BTreeMap<String, String>,
    ended: bool,
}

/// What a name means.
#[derive(Debug, Clone, Copy)]
enum What {
    Tree,
    Cluster,
    Workstation,
}

impl What {
    fn word(self) -> &'static str {
        match self {
            Self::Tree => "tree",
            Self::Cluster => "cluster",
            Self::Workstation => "workstation",
        }
    }

    fn made_by(self) -> &'static str {
        match self {
            Self::Tree => "create",
            Self::Cluster => "cluster",
            Self::Workstation => "open",
        }
    }
}

impl Names {
    /// Takes a statement: tells what is wrong with its names, and goes on as if the rest were right.
    pub fn take(&mut self, statement: &Statement, place: super::fault::Place) -> Vec<Fault> {
        let mut faults = Vec::new();
        if self.ended {
            faults.push(Fault::new(place, "this stands after `exit` or `local`", "nothing after it"));
            self.ended = false;
        }
        self.of_trees(statement, &mut faults);
        self.of_clusters(statement, &mut faults);
        self.of_workstations(statement, &mut faults);
        if let Statement::Help { command: Some(name) } = statement
            && super::commands::command_of(&name.text).is_none()
        {
            let words = COMMANDS.iter().map(|command| command.word);
            let problem = format!("`{}` is no command", name.text);
            faults.push(Fault::spelling(name.place, problem, (&name.text, words), "a command"));
        }
        self.ended = matches!(statement, Statement::Exit | Statement::Local);
        faults
    }

    /// Whether the script has ended.
    pub fn have_ended(&self) -> bool {
        self.ended
    }

    /// Goes on after `local`, with what is typed.
    pub fn go_on(&mut self) {
        self.ended = false;
    }

    fn of_trees(&mut self, statement: &Statement, faults: &mut Vec<Fault>) {
        match statement {
            Statement::Create { tree_type, tree, level, .. } => {
                self.make(tree, Known { tree_type: *tree_type, level: *level }, faults);
            }
            Statement::Combine { tree, level, parts } => {
                let tree_type = parts.first().map_or(TreeType::Gmt1, |part| part.tree_type);
                self.make(tree, Known { tree_type, level: *level }, faults);
            }
            Statement::Copy { from, to } => {
                if let Some(known) = self.tree(from, faults) {
                    self.make(to, known, faults);
                }
            }
            Statement::Delete { tree } => {
                self.tree(tree, faults);
                self.forget(tree);
            }
            Statement::Glue { trees, to } => {
                let known = trees.each_ref().map(|tree| self.tree(tree, faults));
                if trees[0].text == trees[1].text {
                    let problem = format!("`{}` cannot be glued to itself", trees[0].text);
                    faults.push(Fault::new(trees[1].place, problem, "another tree, such as a copy of it"));
                }
                trees.iter().for_each(|tree| self.forget(tree));
                if let [Some(first), Some(second)] = known {
                    let level = first.level.max(second.level);
                    self.make(to, Known { level, ..first }, faults);
                }
            }
            Statement::Translate { tree, .. }
            | Statement::Zoom { tree, .. }
            | Statement::Rotate { tree, .. }
            | Statement::Release { tree }
            | Statement::Inform { tree }
            | Statement::Compose { tree, .. }
            | Statement::Appear { tree, .. }
            | Statement::Color { tree: Some(tree), .. }
            | Statement::Girth { tree: Some(tree), .. } => {
                self.tree(tree, faults);
            }
            Statement::Deform { tree, deformation } => {
                let level = self.tree(tree, faults).map_or(MOST_LEVELS, |known| known.level);
                let beyond = deformation.controllers.iter().flatten().find(|controller| controller.levels[1] > level);
                if let Some(controller) = beyond {
                    let problem = format!("a controller acts up to growth level {}", controller.levels[1]);
                    faults.push(Fault::new(tree.place, problem, format!("at most {level}, that of the tree")));
                }
            }
            Statement::Animate { tree_type, tree, .. } | Statement::Shadow { tree_type, tree, .. } => {
                self.typed(tree, *tree_type, faults);
            }
            Statement::Leaf { tree_type, tree, level, .. } => {
                let most = self.typed(tree, *tree_type, faults).map_or(MOST_LEVELS, |known| known.level);
                if *level > most {
                    let problem = format!("leaves begin at growth level {level}");
                    faults.push(Fault::new(tree.place, problem, format!("at most {most}, that of the tree")));
                }
            }
            _ => {}
        }
    }

    fn of_clusters(&mut self, statement: &Statement, faults: &mut Vec<Fault>) {
        match statement {
            Statement::Cluster { cluster, trees } => {
                self.make_cluster(cluster, faults);
                trees.iter().for_each(|tree| self.join(cluster, tree, faults));
            }
            Statement::Append { cluster, tree } => {
                self.cluster(cluster, faults);
                self.join(cluster, tree, faults);
            }
            Statement::Expel { cluster, tree } => {
                self.tree(tree, faults);
                if self.cluster(cluster, faults)
                    && !self.clusters.get_mut(&cluster.text).is_some_and(|trees| trees.remove(&tree.text))
                {
                    let members = self.clusters[&cluster.text].iter().map(String::as_str);
                    let problem = format!("`{}` is not in the cluster `{}`", tree.text, cluster.text);
                    faults.push(Fault::spelling(tree.place, problem, (&tree.text, members), "a tree of the cluster"));
                }
            }
            Statement::Remove { cluster } => {
                self.cluster(cluster, faults);
                self.clusters.remove(&cluster.text);
            }
            Statement::Merge { clusters, to } => {
                clusters.iter().for_each(|cluster| {
                    self.cluster(cluster, faults);
                });
                if clusters[0].text == clusters[1].text {
                    let problem = format!("`{}` cannot be merged with itself", clusters[0].text);
                    faults.push(Fault::new(clusters[1].place, problem, "another cluster"));
                }
                let all = clusters.iter().filter_map(|cluster| self.clusters.remove(&cluster.text)).flatten().collect();
                self.make_cluster(to, faults);
                self.clusters.insert(to.text.clone(), all);
            }
            Statement::Flush { cluster, .. }
            | Statement::Inquire { cluster }
            | Statement::View { cluster, .. }
            | Statement::Visible { cluster, .. } => {
                self.cluster(cluster, faults);
            }
            _ => {}
        }
    }

    fn of_workstations(&mut self, statement: &Statement, faults: &mut Vec<Fault>) {
        match statement {
            Statement::Open { workstation, .. } => self.open(workstation, faults),
            Statement::Close { workstation } => {
                self.workstation(workstation, faults);
                self.workstations.remove(&workstation.text);
            }
            Statement::Port { workstation, .. }
            | Statement::Window { workstation, .. }
            | Statement::Clear { workstation } => {
                self.workstation(workstation, faults);
            }
            Statement::Activate { workstation, device } => {
                if let Some(devices) = self.workstation(workstation, faults)
                    && !devices.insert(*device)
                {
                    let problem = format!("this device of `{}` is active", workstation.text);
                    faults.push(Fault::new(workstation.place, problem, "a device that is not active"));
                }
            }
            Statement::Deactivate { workstation, device } => {
                if let Some(devices) = self.workstation(workstation, faults)
                    && !devices.remove(device)
                {
                    let problem = format!("this device of `{}` is not active", workstation.text);
                    faults.push(Fault::new(workstation.place, problem, "a device that `activate` has named"));
                }
            }
            _ => {}
        }
    }

    fn tree(&self, name: &Name, faults: &mut Vec<Fault>) -> Option<Known> {
        let known = self.trees.get(&name.text).copied();
        if known.is_none() {
            faults.push(unknown(name, What::Tree, self.trees.keys()));
        }
        known
    }

    fn typed(&self, name: &Name, tree_type: TreeType, faults: &mut Vec<Fault>) -> Option<Known> {
        let known = self.tree(name, faults)?;
        if known.tree_type != tree_type {
            let problem = format!("`{}` is a tree of another type", name.text);
            faults.push(Fault::new(name.place, problem, format!("the type {:?}", known.tree_type).to_lowercase()));
        }
        Some(known)
    }

    fn cluster(&self, name: &Name, faults: &mut Vec<Fault>) -> bool {
        let known = self.clusters.contains_key(&name.text);
        if !known {
            faults.push(unknown(name, What::Cluster, self.clusters.keys()));
        }
        known
    }

    fn workstation(&mut self, name: &Name, faults: &mut Vec<Fault>) -> Option<&mut BTreeSet<Device>> {
        if !self.workstations.contains_key(&name.text) {
            faults.push(unknown(name, What::Workstation, self.workstations.keys()));
        }
        self.workstations.get_mut(&name.text)
    }

    fn open(&mut self, name: &Name, faults: &mut Vec<Fault>) {
        if self.workstations.insert(name.text.clone(), BTreeSet::new()).is_some() {
            let problem = format!("the workstation `{}` is open", name.text);
            faults.push(Fault::new(name.place, problem, "another name, or `close` before"));
        }
        // Many disks do not tell capitals from small letters: one file would take the place of the other.
        let known = self.spelled.entry(name.text.to_lowercase()).or_insert_with(|| name.text.clone());
        if *known != name.text {
            let problem = format!("the workstations `{}` and `{known}` differ in capitals alone", name.text);
            faults.push(Fault::new(name.place, problem, "a name that differs in its letters: it is that of a file"));
        }
    }

    fn make(&mut self, name: &Name, known: Known, faults: &mut Vec<Fault>) {
        if self.trees.insert(name.text.clone(), known).is_some() {
            faults.push(twice(name, What::Tree, "another name, or `delete` before"));
        }
    }

    fn make_cluster(&mut self, name: &Name, faults: &mut Vec<Fault>) {
        if self.clusters.insert(name.text.clone(), BTreeSet::new()).is_some() {
            faults.push(twice(name, What::Cluster, "another name, or `remove` before"));
        }
    }

    fn join(&mut self, cluster: &Name, tree: &Name, faults: &mut Vec<Fault>) {
        if self.tree(tree, faults).is_none() {
            return;
        }
        if let Some((other, _)) = self.clusters.iter().find(|(_, trees)| trees.contains(&tree.text)) {
            let problem = format!("`{}` is in the cluster `{other}`", tree.text);
            faults.push(Fault::new(
                tree.place,
                problem,
                format!("a tree in no cluster: `expel {other} {};` before", tree.text),
            ));
        } else if let Some(trees) = self.clusters.get_mut(&cluster.text) {
            trees.insert(tree.text.clone());
        }
    }

    fn forget(&mut self, name: &Name) {
        self.trees.remove(&name.text);
        self.clusters.values_mut().for_each(|trees| {
            trees.remove(&name.text);
        });
    }
}

fn unknown<'a>(name: &Name, what: What, known: impl Iterator<Item = &'a String>) -> Fault {
    let problem = format!("no {} is named `{}` here", what.word(), name.text);
    let expected = format!("a {} that `{}` has made", what.word(), what.made_by());
    Fault::spelling(name.place, problem, (&name.text, known.map(String::as_str)), &expected)
}

fn twice(name: &Name, what: What, expected: &str) -> Fault {
    Fault::new(name.place, format!("the {} `{}` exists", what.word(), name.text), expected)
}
