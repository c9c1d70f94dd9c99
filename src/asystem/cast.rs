//! The trees and clusters of a script, statement by statement, and the modes that hold for trees that are yet to be
//! made.
//!
//! Names have been checked (`phytomer_asystem`), so a name that is not there changes nothing.

use super::foliage::form_of;
use super::trees::{Modes, Segment, Shade, Tree};
use phytomer_asystem::{Colour, Statement};
use std::collections::BTreeMap;

/// Trees, clusters and modes.
#[derive(Debug, Clone, Default)]
pub struct Cast {
    /// The trees by their names.
    pub trees: BTreeMap<String, Tree>,
    /// The trees of clusters, in the order in which they came.
    pub clusters: BTreeMap<String, Vec<String>>,
    /// The modes.
    pub modes: Modes,
    /// The colour of the background; white if not given.
    pub background: Option<Colour>,
}

impl Cast {
    /// Takes a statement; the name of the tree that it makes or changes, if it does.
    pub fn take(&mut self, statement: &Statement) -> Option<String> {
        self.mode(statement);
        self.cluster(statement);
        self.make(statement).or_else(|| self.change(statement))
    }

    /// The trees of a cluster, in their order.
    pub fn members<'c>(&'c self, cluster: &str) -> impl Iterator<Item = (&'c String, &'c Tree)> {
        let names = self.clusters.get(cluster).map(Vec::as_slice).unwrap_or_default();
        names.iter().filter_map(|name| self.trees.get_key_value(name))
    }

    /// What makes a tree, or takes one away.
    fn make(&mut self, statement: &Statement) -> Option<String> {
        let (name, tree) = match statement {
            Statement::Create { tree_type, tree, level, descriptor } => {
                (tree, Tree::created(*tree_type, *level, descriptor, &self.modes))
            }
            Statement::Combine { tree, level, parts } => (tree, Tree::combined(*level, parts.clone(), &self.modes)),
            Statement::Copy { from, to } => (to, self.trees.get(&from.text)?.clone()),
            Statement::Glue { trees, to } => {
                let [first, second] = trees.each_ref().map(|tree| self.trees.remove(&tree.text));
                trees.iter().for_each(|tree| self.leave(&tree.text));
                (to, Tree::glued(&first?, &second?))
            }
            Statement::Delete { tree } => {
                self.trees.remove(&tree.text);
                self.leave(&tree.text);
                return None;
            }
            _ => return None,
        };
        self.trees.insert(name.text.clone(), tree);
        Some(name.text.clone())
    }

    /// What changes a tree.
    fn change(&mut self, statement: &Statement) -> Option<String> {
        let name = match statement {
            Statement::Translate { tree, .. }
            | Statement::Zoom { tree, .. }
            | Statement::Rotate { tree, .. }
            | Statement::Release { tree }
            | Statement::Color { tree: Some(tree), .. }
            | Statement::Appear { tree, .. }
            | Statement::Girth { tree: Some(tree), .. }
            | Statement::Deform { tree, .. }
            | Statement::Leaf { tree, .. }
            | Statement::Shadow { tree, .. } => &tree.text,
            _ => return None,
        };
        let tree = self.trees.get_mut(name)?;
        let segment = &mut tree.segment;
        match statement {
            Statement::Translate { by, absolute: true, .. } => segment.place = *by,
            Statement::Translate { by, .. } => (0..3).for_each(|k| segment.place[k] += by[k]),
            Statement::Zoom { factor, absolute: true, .. } => segment.zoom = *factor,
            Statement::Zoom { factor, .. } => segment.zoom *= factor,
            Statement::Rotate { degrees, absolute: true, .. } => segment.degrees = *degrees,
            Statement::Rotate { degrees, .. } => segment.degrees += degrees,
            Statement::Release { .. } => *segment = Segment::default(),
            Statement::Color { colour, .. } => tree.colour = Some(*colour),
            Statement::Appear { on, .. } => tree.appears = *on,
            Statement::Girth { on, form, .. } => tree.give_girth(*on, *form),
            Statement::Deform { deformation, .. } => tree.deform(deformation),
            Statement::Leaf { form, level, colour, size, .. } => {
                let form = form_of(&form.text)?;
                tree.bear(form, *level, *colour, *size);
            }
            Statement::Shadow { emitter, colour, merged, .. } => {
                tree.shade = Some(Shade { emitter: *emitter, colour: *colour, merged: *merged });
            }
            _ => {}
        }
        Some(name.clone())
    }

    fn cluster(&mut self, statement: &Statement) {
        match statement {
            Statement::Cluster { cluster, trees } => {
                let names = trees.iter().map(|tree| tree.text.clone()).collect();
                self.clusters.insert(cluster.text.clone(), names);
            }
            Statement::Append { cluster, tree } => {
                self.clusters.entry(cluster.text.clone()).or_default().push(tree.text.clone());
            }
            Statement::Expel { tree, .. } => self.leave(&tree.text),
            Statement::Remove { cluster } => drop(self.clusters.remove(&cluster.text)),
            Statement::Merge { clusters, to } => {
                let all = clusters.iter().filter_map(|cluster| self.clusters.remove(&cluster.text)).flatten().collect();
                self.clusters.insert(to.text.clone(), all);
            }
            Statement::Visible { cluster, on } => {
                for name in self.clusters.get(&cluster.text).into_iter().flatten() {
                    self.trees.entry(name.clone()).and_modify(|tree| tree.appears = *on);
                }
            }
            _ => {}
        }
    }

    fn mode(&mut self, statement: &Statement) {
        match statement {
            Statement::Color { tree: None, colour } => self.modes.colour = Some(*colour),
            Statement::Girth { tree: None, on, form } => self.modes.girth = on.then_some(*form),
            Statement::Cont { on, steps } => self.modes.steps = on.then_some(steps.unwrap_or(CONT_STEPS)),
            Statement::CutAxis { on, level } => self.modes.cut_axis = on.then_some(level.unwrap_or(1)),
            Statement::CutLateral { on, level, until } => {
                self.modes.cut_lateral = on.then(|| (level.unwrap_or(1), until.clone()));
            }
            Statement::Divergence { degrees } => self.modes.divergence = Some(*degrees),
            Statement::BackColor { colour } => self.background = Some(*colour),
            _ => {}
        }
    }

    /// Takes a tree out of its cluster.
    fn leave(&mut self, name: &str) {
        self.clusters.values_mut().for_each(|trees| trees.retain(|tree| tree != name));
    }
}

/// The steps of a growth level where `cont on` states none.
const CONT_STEPS: u32 = 8;
