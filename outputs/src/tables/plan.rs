//! What a run is to write, known before its first tick: tables, ages, parts, and where the figures come from.
//!
//! A table is written under a plan; a run folder is resumed under a plan equal to its own. Absent: limits and threads,
//! which change no byte.

use super::Table;
use super::schema::Column;
use phytomer_sim::Tick;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::ops::Range;

/// The plan of a run.
#[derive(Debug, Clone)]
pub struct RunPlan {
    /// The tables that are wanted.
    pub tables: Vec<Table>,
    /// The ticks of the plots at which `records` and `summary` have rows, ascending.
    pub recorded: Vec<Tick>,
    /// The last tick of a plot.
    pub until: Tick,
    /// The plots of the run, numbered from 0.
    pub plots: u32,
    /// How many plots share a part file; at least 1.
    pub plots_per_part: u32,
    /// The level of zstd: 1, or 3 where space matters more than time.
    pub compression_level: i32,
    /// To what precision positions are rounded, metres; `None` keeps every bit.
    pub precision_m: Option<f64>,
    /// Whether `records` has the columns of mechanics.
    pub mechanics: bool,
    /// Where it all comes from.
    pub provenance: Provenance,
}

/// Where a run's figures come from.
#[derive(Debug, Clone)]
pub struct Provenance {
    /// The scenario's name.
    pub scenario: String,
    /// The treatments of the run's plots, by the places that the plots name; `control` where there is one.
    pub treatments: Vec<String>,
    /// The names of the species of the run's plants, by their places in the plots' lists.
    pub species: Vec<String>,
    /// The seed of every draw.
    pub seed: u64,
    /// The program's version.
    pub version: String,
    /// The commit that the program was built from; empty where that is not known.
    pub git_hash: String,
    /// The scenario with everything that it inherits and every default.
    pub resolved: Value,
    /// The files that were read.
    pub inputs: Vec<Input>,
}

/// A file that the run was made from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Input {
    /// Its path as the scenario names it, or the name of what the program ships.
    pub path: String,
    /// Its hash, in hexadecimal.
    pub sha256: String,
}

impl RunPlan {
    /// How many part files each table has.
    pub fn shards(&self) -> u32 {
        self.plots.div_ceil(self.plots_per_part.max(1))
    }

    /// The plots of a shard.
    pub fn plots_of(&self, shard: u32) -> Range<u32> {
        let first = shard.saturating_mul(self.plots_per_part.max(1)).min(self.plots);
        first..first.saturating_add(self.plots_per_part.max(1)).min(self.plots)
    }

    /// The columns of a table in this run.
    pub fn columns(&self, table: Table) -> &'static [Column] {
        table.columns(self.mechanics)
    }
}
