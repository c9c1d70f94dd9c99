//! What a run is to write, known before its first tick; a run is resumed only under an equal plan.
//!
//! The identity of a plan is everything that the bytes of the tables depend on; limits and threads are not in it.

use crate::tables::Table;
use crate::tables::schema::Column;
use phytomer_sim::Tick;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use std::ops::Range;

/// The version of the run folder's own files: 2 has checks in `run.json` and in each line of the journal.
pub const FORMAT_VERSION: u32 = 2;

/// The plan of a run.
#[derive(Debug, Clone)]
pub struct RunPlan {
    /// The tables that are wanted.
    pub tables: Vec<Table>,
    /// The ages of `records` and `summary`, ascending.
    pub recorded: Vec<Tick>,
    /// The last age.
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
    /// The treatment of the run's plots; `control` where it has one.
    pub treatment: String,
    /// The name of the species of the run's plants.
    pub species: String,
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

    /// Everything that the bytes of the tables depend on, key by key; the resolved scenario as its hash.
    pub(super) fn identity(&self) -> Map<String, Value> {
        let provenance = &self.provenance;
        let identity = json!({
            "format_version": FORMAT_VERSION,
            "schema_version": crate::tables::columns::SCHEMA_VERSION,
            "version": provenance.version,
            "git_hash": provenance.git_hash,
            "scenario": provenance.scenario,
            "scenario_sha256": super::durable::sha256_of(provenance.resolved.to_string().as_bytes()),
            "treatment": provenance.treatment,
            "seed": provenance.seed,
            "inputs": provenance.inputs,
            "tables": self.tables,
            "recorded_ages": self.recorded,
            "until": self.until,
            "plots": self.plots,
            "plots_per_part": self.plots_per_part,
            "compression": { "codec": "zstd", "level": self.compression_level },
            "precision_m": self.precision_m,
        });
        let Value::Object(mut identity) = identity else { return Map::new() };
        if self.mechanics {
            identity.insert("mechanics".to_owned(), json!(true));
        }
        identity
    }

    /// A short name of the identity: the lines of the journal say by it which run they belong to.
    pub(super) fn fingerprint(&self) -> String {
        super::seal::check_of(Value::Object(self.identity()).to_string().as_bytes())
    }
}
