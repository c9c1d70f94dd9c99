//! A stage on which a script runs: its trees, the workstations that show them, and the frames that are written.
//!
//! Trees are grown when they are shown, and their plants kept until they change. A frame is written for every open
//! display and plotter, in the view of the last frame, so that nothing jumps. Absent: what is typed (the verb's).

use super::cast::Cast;
use super::files::{Grown, StageError, drawing_of, write, write_sheet, write_times};
use super::grown::plant_of;
use super::recorded::species_of;
use super::stations::{Content, Station};
use super::trees::Tree;
use phytomer_asystem::{COMMANDS, Command, Device, Statement, Step, WorkstationType, command_of};
use phytomer_sim::Tick;
use phytomer_sim::plant::Plant;
use phytomer_strokes::{Drawing, Sheet};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The time between frames where neither the statement nor `defer` states one, seconds.
const LAG: f64 = 0.2;
/// The background where the script states none.
const WHITE: [u8; 3] = [255; 3];

/// What came of a statement.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Written {
    /// The files.
    pub files: Vec<PathBuf>,
    /// What is to be told.
    pub told: String,
}

/// A stage.
#[derive(Debug)]
pub struct Stage {
    folder: PathBuf,
    /// Its trees and clusters.
    pub cast: Cast,
    stations: BTreeMap<String, Station>,
    lag: f64,
    plants: BTreeMap<String, (Tree, Plant, Tick)>,
}

impl Stage {
    /// An empty stage, whose files go into a folder.
    pub fn new(folder: &Path) -> Self {
        let (cast, stations, plants) = (Cast::default(), BTreeMap::new(), BTreeMap::new());
        Self { folder: folder.to_owned(), cast, stations, lag: LAG, plants }
    }

    /// Runs a statement of a checked script.
    ///
    /// # Errors
    /// Those of growth and of files.
    pub fn take(&mut self, step: &Step) -> Result<Written, StageError> {
        self.cast.take(&step.statement);
        self.show(&step.statement);
        let mut written = Written::default();
        match &step.statement {
            Statement::Animate { tree, level, lag, .. } => self.animate(&tree.text, *level, *lag, &mut written)?,
            Statement::Flush { cluster, lag } => self.flush(&cluster.text, *lag, &mut written)?,
            Statement::Close { workstation } => {
                self.write(&workstation.text, &mut written)?;
                self.stations.remove(&workstation.text);
            }
            Statement::Exit => self.end(&mut written)?,
            Statement::Inform { tree } => written.told = species_of(&self.cast, &tree.text),
            Statement::Inquire { cluster } => written.told = self.told_of(&cluster.text),
            Statement::Help { command } => {
                let one = command.as_ref().and_then(|name| command_of(&name.text));
                written.told = one.map_or_else(|| COMMANDS.iter().map(help).collect(), help);
            }
            _ => {}
        }
        Ok(written)
    }

    /// Writes what is open: at `exit`, and at the end of a script.
    ///
    /// # Errors
    /// Those of growth and of files.
    pub fn end(&mut self, written: &mut Written) -> Result<(), StageError> {
        let names: Vec<String> = self.stations.keys().cloned().collect();
        for name in names {
            self.write(&name, written)?;
            self.stations.remove(&name);
        }
        Ok(())
    }

    /// What workstations show, and what frames wait for.
    fn show(&mut self, statement: &Statement) {
        match statement {
            Statement::Open { workstation, kind } => {
                self.stations.insert(workstation.text.clone(), Station::open(*kind));
            }
            Statement::Port { workstation, view, frame } => {
                self.station(&workstation.text, |station| station.add_port(*view, *frame));
            }
            Statement::Window { workstation, frame } => {
                self.station(&workstation.text, |station| station.set_window(*frame));
            }
            Statement::Clear { workstation } => self.station(&workstation.text, Station::clear),
            Statement::Activate { workstation, device: Device::Valuator } => {
                self.station(&workstation.text, |station| station.controllers = true);
            }
            Statement::Deactivate { workstation, device: Device::Valuator } => {
                self.station(&workstation.text, |station| station.controllers = false);
            }
            Statement::Compose { tree, viewing } => {
                let content = Content::Tree(tree.text.clone());
                self.stations.values_mut().for_each(|station| station.show(content.clone(), *viewing));
            }
            Statement::View { cluster, viewing } => {
                let content = Content::Cluster(cluster.text.clone());
                self.stations.values_mut().for_each(|station| station.show(content.clone(), *viewing));
            }
            Statement::Defer { lag } => self.lag = *lag,
            _ => {}
        }
    }

    fn station(&mut self, name: &str, change: impl FnOnce(&mut Station)) {
        if let Some(station) = self.stations.get_mut(name) {
            change(station);
        }
    }

    /// The names of the trees that a workstation shows, in their order.
    fn seen(&self, content: &Content) -> Vec<String> {
        let appears = |(name, tree): (&String, &Tree)| tree.appears.then(|| name.clone());
        match content {
            Content::All => self.cast.trees.iter().filter_map(appears).collect(),
            Content::Tree(name) => self.cast.trees.get_key_value(name).into_iter().filter_map(appears).collect(),
            Content::Cluster(name) => self.cast.members(name).filter_map(appears).collect(),
            Content::Nothing => Vec::new(),
        }
    }

    /// Grows the trees of these names that have changed since they were grown.
    fn grow(&mut self, names: &[String]) -> Result<(), StageError> {
        for name in names {
            let Some(tree) = self.cast.trees.get(name) else { continue };
            if self.plants.get(name).is_none_or(|(known, ..)| known != tree) {
                let (plant, age) = grown(name, tree, 1, Tick::MAX)?;
                self.plants.insert(name.clone(), (tree.clone(), plant, age));
            }
        }
        Ok(())
    }

    fn all<'s>(&'s self, names: &'s [String]) -> Vec<Grown<'s>> {
        let one = |name: &'s String| {
            let (tree, plant, age) = self.plants.get(name)?;
            Some(Grown { name, tree, plant, age: *age })
        };
        names.iter().filter_map(one).collect()
    }

    /// Writes the file of a workstation, and the times of its frames.
    fn write(&mut self, name: &str, written: &mut Written) -> Result<(), StageError> {
        let Some(station) = self.stations.get(name).cloned() else { return Ok(()) };
        let names = self.seen(&station.content);
        self.grow(&names)?;
        let path = self.folder.join(format!("{name}.{}", station.ending()));
        write(&station, self.cast.background.unwrap_or(WHITE), &self.all(&names), &path)?;
        written.files.push(path);
        if !station.frames.is_empty() {
            let frames: Vec<String> =
                (0..station.frames.len()).map(|frame| frame_name(name, &station, frame)).collect();
            let path = self.folder.join(format!("{name}-frames.txt"));
            write_times(&frames, &station.frames, &path)?;
            written.files.push(path);
        }
        Ok(())
    }

    /// Writes a frame of each growth level of a tree, and of each step of it.
    fn animate(&mut self, name: &str, level: u32, lag: Option<f64>, written: &mut Written) -> Result<(), StageError> {
        let Some(tree) = self.cast.trees.get(name).cloned() else { return Ok(()) };
        let steps = tree.steps;
        let last = level.min(tree.level()).saturating_mul(steps) + if steps > 1 { steps } else { 1 };
        let (plant, age) = grown(name, &tree, steps, last)?;
        let full = drawing_of(&[Grown { name, tree: &tree, plant: &plant, age }]);
        for tick in 1..=age {
            let (plant, age) = grown(name, &tree, steps, tick)?;
            let drawing = drawing_of(&[Grown { name, tree: &tree, plant: &plant, age }]);
            self.frame(&drawing, &full, lag, written)?;
        }
        Ok(())
    }

    /// Writes frames in which the trees of a cluster appear one after another.
    fn flush(&mut self, cluster: &str, lag: Option<f64>, written: &mut Written) -> Result<(), StageError> {
        let names = self.seen(&Content::Cluster(cluster.to_owned()));
        self.grow(&names)?;
        let full = drawing_of(&self.all(&names));
        for count in 1..=names.len() {
            let drawing = drawing_of(&self.all(&names[..count]));
            self.frame(&drawing, &full, lag, written)?;
        }
        Ok(())
    }

    /// Writes a frame on every display and plotter, as a part of a drawing that is seen whole.
    fn frame(
        &mut self,
        drawing: &Drawing,
        full: &Drawing,
        lag: Option<f64>,
        written: &mut Written,
    ) -> Result<(), StageError> {
        let background = self.cast.background.unwrap_or(WHITE);
        for (name, station) in &mut self.stations {
            if station.kind == WorkstationType::Model {
                continue;
            }
            let sheet: Sheet = station.sheet(background, full).framed(full);
            let path = self.folder.join(frame_name(name, station, station.frames.len()));
            write_sheet(station.kind, &sheet, drawing, &path)?;
            station.frames.push(lag.unwrap_or(self.lag));
            written.files.push(path);
        }
        Ok(())
    }

    fn told_of(&self, cluster: &str) -> String {
        let one = |(name, tree): (&String, &Tree)| {
            let [x, y, z] = tree.stands_at();
            let seen = if tree.appears { "" } else { ", hidden" };
            format!("{name}: {}, growth level {}, at {x} {y} {z}{seen}\n", tree.tree_type().word(), tree.level())
        };
        self.cast.members(cluster).map(one).collect()
    }
}

fn grown(name: &str, tree: &Tree, steps: u32, tick: Tick) -> Result<(Plant, Tick), StageError> {
    plant_of(tree, steps, tick).map_err(|problem| StageError::Tree(name.to_owned(), problem))
}

/// The name of a frame, from 0. No workstation has a hyphen in its name, so that no other file has this name.
fn frame_name(name: &str, station: &Station, frame: usize) -> String {
    format!("{name}-{frame:04}.{}", station.ending())
}

fn help(command: &Command) -> String {
    format!("{} {};  {}\n", command.word, command.operands, command.about)
}
