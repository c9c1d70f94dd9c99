//! The plan of a run: its tables, recorded ticks, part files and provenance, known before the first tick.
//!
//! A table is written under a plan, and a run folder is resumed under a plan equal to its own. Absent: limits and
//! threads, which change no byte.

use super::sample::Sample;
use super::schema::Column;
use super::{Table, columns};
use phytomer_sim::Tick;
use phytomer_sim::site::calendars::Calendars;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::ops::Range;

/// The plan of a run.
#[derive(Debug, Clone)]
pub struct RunPlan {
    /// The tables that are written.
    pub tables: Vec<Table>,
    /// The plants with rows in `components`, `records` and `events`; `None` for all.
    pub sample: Option<Sample>,
    /// The ticks of the plots at which `records` and `summary` have rows, ascending.
    pub recorded: Vec<Tick>,
    /// The last tick of a plot.
    pub until: Tick,
    /// The number of plots of the run; plots are numbered from 0.
    pub plots: u32,
    /// The number of plots in one part file; at least 1.
    pub plots_per_part: u32,
    /// The level of zstd: 1, or 3 for smaller files in more time.
    pub compression_level: i32,
    /// The precision to which positions are rounded, metres; `None` keeps every bit.
    pub precision_m: Option<f64>,
    /// Whether `records` has the columns of mechanics.
    pub mechanics: bool,
    /// Whether `records`, `summary` and `site` have the columns of light; `mechanics` is then true.
    pub light: bool,
    /// Whether the plants were measured and not grown: any column may then be null.
    pub measured: bool,
    /// The calendars of the plots of each treatment, in the order of the treatments.
    pub calendars: Vec<Calendars>,
    /// The species of each model, as an index into [`Provenance::species`]; a species is its own model beyond the list.
    pub species_of_models: Vec<usize>,
    /// What is stated of the members of the plots of each treatment, in the order of the treatments: of each member, or
    /// once where it is the same of all. Nothing is stated for treatments beyond the list.
    pub members: Vec<Vec<OfMember>>,
    /// The origin of the figures.
    pub provenance: Provenance,
}

/// What a scenario states of a member of its plots.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct OfMember {
    /// The ground of the plant, m²; `None` where plants have no neighbours.
    pub ground_area_m2: Option<f64>,
    /// Whether the plant is a guard, which `summary` leaves out.
    pub guard: bool,
}

/// The origin of a run's figures: scenario, species, seed, program and input files.
#[derive(Debug, Clone)]
pub struct Provenance {
    /// The scenario's name.
    pub scenario: String,
    /// The treatments of the run, to which plots refer by index; `control` alone for a run without treatments.
    pub treatments: Vec<String>,
    /// The factors of the experiment, with the level of each treatment; empty for a run without factors.
    pub factors: Vec<Factor>,
    /// The names of the species of the run, each once.
    pub species: Vec<String>,
    /// The names of the states of each species, in the order of their numbers; none for species beyond the list.
    pub states: Vec<Vec<String>>,
    /// The ticks of a year of each species; `None` where it states none, and for species beyond the list.
    pub ticks_per_year: Vec<Option<f64>>,
    /// The seed of all random draws.
    pub seed: u64,
    /// The program's version.
    pub version: String,
    /// The commit that the program was built from; empty where it is unknown.
    pub git_hash: String,
    /// The scenario with its defaults, and its species with inheritance resolved.
    pub resolved: Value,
    /// The files that were read.
    pub inputs: Vec<Input>,
}

/// A factor of the experiment of a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Factor {
    /// The name of the factor, and of its column in `treatments`.
    pub name: String,
    /// The name of the level of each treatment, in the order of [`Provenance::treatments`].
    pub levels: Vec<String>,
}

/// An input file of a run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Input {
    /// Its path as the scenario states it, or the name of a shipped file.
    pub path: String,
    /// Its SHA-256, in hexadecimal.
    pub sha256: String,
}

impl RunPlan {
    /// The number of shards, and so of part files of each table.
    pub fn shards(&self) -> u32 {
        self.plots.div_ceil(self.plots_per_part.max(1))
    }

    /// The numbers of the plots of a shard.
    pub fn plots_of(&self, shard: u32) -> Range<u32> {
        let first = shard.saturating_mul(self.plots_per_part.max(1)).min(self.plots);
        first..first.saturating_add(self.plots_per_part.max(1)).min(self.plots)
    }

    /// The columns of a table in this run.
    pub fn columns(&self, table: Table) -> &'static [Column] {
        if self.measured {
            return table.columns_of_measured();
        }
        let has_guards = || self.members.iter().flatten().any(|member| member.guard);
        if table == Table::Plants && has_guards() {
            return &columns::PLANTS;
        }
        if self.light { table.columns_in_light() } else { table.columns(self.mechanics) }
    }
}

impl Provenance {
    /// The names of the states of all species, each once, in the order of their first mention.
    pub fn state_names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for name in self.states.iter().flatten() {
            if !names.contains(&name.as_str()) {
                names.push(name);
            }
        }
        names
    }

    /// For each species, the places of the names of its states among [`Provenance::state_names`].
    pub fn places_of_states(&self) -> Vec<Vec<i32>> {
        let names = self.state_names();
        let place = |name: &String| names.iter().position(|known| known == name).map_or(-1, |place| place as i32);
        self.states.iter().map(|states| states.iter().map(place).collect()).collect()
    }
}
