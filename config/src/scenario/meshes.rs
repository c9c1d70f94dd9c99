//! The meshes of a run: which plants, at which ages, in which files.
//!
//! Absent: the shapes and colours of meshes, and their file format (`phytomer_meshes`).

use super::{All, Scenario, list_some};
use phytomer_law::fault::{Fault, Path};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// The meshes that are written.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Meshes {
    /// The ages: `"last"`, `"all"` recorded ages, or a list of ages. The last age if not given.
    #[serde(default)]
    pub ages: MeshAges,
    /// The plants: `"all"`, a number of plants from plant 0, or a list of plant numbers from 0. Plant 0 if not given.
    #[serde(default)]
    pub plants: MeshPlants,
    /// The number of sides of the tube that an internode is drawn as.
    #[serde(default = "default_sides")]
    #[schemars(range(min = 3, max = 64))]
    pub sides: u32,
    /// The content of one file: a plant at an age, a plant at all its ages, or all plants at an age.
    #[serde(default)]
    pub per: MeshFile,
}

/// The ages of the meshes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum MeshAges {
    /// The last age, or all recorded ages.
    Word(MeshAgesWord),
    /// The ages of the list.
    List(#[schemars(length(min = 1))] BTreeSet<u32>),
}

/// The words for ages of meshes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MeshAgesWord {
    /// The last age.
    Last,
    /// Every recorded age.
    All,
}

impl Default for MeshAges {
    fn default() -> Self {
        Self::Word(MeshAgesWord::Last)
    }
}

/// The plants of the meshes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum MeshPlants {
    /// All plants, by the word `all`.
    All(All),
    /// This number of plants, from plant 0.
    First(#[schemars(range(min = 1))] u32),
    /// The plants of the list, numbered from 0.
    List(#[schemars(length(min = 1))] BTreeSet<u32>),
}

impl Default for MeshPlants {
    fn default() -> Self {
        Self::First(1)
    }
}

/// The content of one mesh file.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MeshFile {
    /// One plant at one age.
    #[default]
    PlantAge,
    /// One plant at all ages of `ages`.
    Plant,
    /// All plants of `plants` at one age.
    Age,
}

fn default_sides() -> u32 {
    8
}

impl Scenario {
    /// The ages at which meshes are written, rising; empty where the scenario has no meshes.
    pub fn mesh_ages(&self) -> Vec<u32> {
        match self.meshes.as_ref().map(|meshes| &meshes.ages) {
            None => Vec::new(),
            Some(MeshAges::Word(MeshAgesWord::Last)) => vec![self.ages.until],
            Some(MeshAges::Word(MeshAgesWord::All)) => self.ages.recorded(),
            Some(MeshAges::List(ages)) => ages.iter().copied().collect(),
        }
    }

    /// Whether a mesh of the plant with the number `plant` is written.
    pub fn draws(&self, plant: u32) -> bool {
        match self.meshes.as_ref().map(|meshes| &meshes.plants) {
            None => false,
            Some(MeshPlants::All(_)) => true,
            Some(MeshPlants::First(count)) => plant < *count,
            Some(MeshPlants::List(plants)) => plants.contains(&plant),
        }
    }

    /// Leaves out the meshes of all but the first `plants` plants of the run. Returns the number of plants whose meshes
    /// are left out; 0 where the scenario has meshes of all plants.
    pub fn draw_only(&mut self, plants: u32) -> u32 {
        let Some(meshes) = &mut self.meshes else { return 0 };
        let left_out = match &mut meshes.plants {
            MeshPlants::All(_) => 0,
            MeshPlants::First(count) => {
                let left_out = count.saturating_sub(plants);
                *count -= left_out;
                left_out
            }
            MeshPlants::List(list) => list.split_off(&plants).len() as u32,
        };
        if matches!(&meshes.plants, MeshPlants::List(list) if list.is_empty()) {
            self.meshes = None;
        }
        left_out
    }

    /// Adds the faults of the plants of which meshes are asked for, in a run of so many plants.
    pub(super) fn check_mesh_plants(&self, plants: u32, path: &Path, faults: &mut Vec<Fault>) {
        match self.meshes.as_ref().map(|m| &m.plants) {
            Some(MeshPlants::First(count)) if *count > plants && *count > 1 => {
                let problem = format!("meshes of {count} plants are asked for, but only {plants} grow");
                faults.push(Fault::new(path, problem, format!("at most {plants}, or \"all\"")));
            }
            Some(MeshPlants::List(list)) => {
                let outside: Vec<String> = list.iter().filter(|p| **p >= plants).map(u32::to_string).collect();
                if !outside.is_empty() {
                    let problem = format!("no plant has the number {}: they are numbered from 0", list_some(&outside));
                    faults.push(Fault::new(path, problem, format!("numbers in [0, {}]", plants.saturating_sub(1))));
                }
            }
            _ => {}
        }
    }
}
