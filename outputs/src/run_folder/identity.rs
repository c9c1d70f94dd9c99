//! The identity of a run: everything that the bytes of its tables depend on. A run is resumed only under an equal
//! identity.
//!
//! The identity is in `run.json`, and its fingerprint is in each line of the journal. Limits and threads are not part
//! of it.

use super::seal::check_of;
use crate::storage::durable::sha256_of;
use crate::tables::RunPlan;
use crate::tables::columns::SCHEMA_VERSION;
use serde_json::{Map, Value, json};

/// The format version of the run folder's own files. Version 2 has checks in `run.json` and in each line of the
/// journal.
pub const FORMAT_VERSION: u32 = 2;

/// The identity as JSON, key by key; the resolved scenario is replaced by its hash.
pub fn identity(plan: &RunPlan) -> Map<String, Value> {
    let provenance = &plan.provenance;
    let identity = json!({
        "format_version": FORMAT_VERSION,
        "schema_version": SCHEMA_VERSION,
        "version": provenance.version,
        "git_hash": provenance.git_hash,
        "scenario": provenance.scenario,
        "scenario_sha256": sha256_of(provenance.resolved.to_string().as_bytes()),
        "treatments": provenance.treatments,
        "species": provenance.species,
        "seed": provenance.seed,
        "inputs": provenance.inputs,
        "tables": plan.tables,
        "recorded_ages": plan.recorded,
        "until": plan.until,
        "plots": plan.plots,
        "plots_per_part": plan.plots_per_part,
        "compression": { "codec": "zstd", "level": plan.compression_level },
        "precision_m": plan.precision_m,
    });
    let Value::Object(mut identity) = identity else { return Map::new() };
    if plan.mechanics {
        identity.insert("mechanics".to_owned(), json!(true));
    }
    if plan.light {
        identity.insert("light".to_owned(), json!(true));
    }
    identity.extend(plan.sample.map(|sample| ("sample".to_owned(), json!(sample.stated()))));
    identity
}

/// The fingerprint of the identity: a short hash, by which each line of the journal names its run.
pub fn fingerprint(plan: &RunPlan) -> String {
    check_of(Value::Object(identity(plan)).to_string().as_bytes())
}

/// What a `run.json` holds beside the identity of its run.
const OTHERS: [&str; 15] = [
    "format",
    "status",
    "shard",
    "fingerprint",
    "resolved_scenario",
    "timings_s",
    "living",
    "dead",
    "components",
    "rows",
    "bytes",
    "files",
    "overgrown",
    "documents",
    "check",
];

/// The identity that a `run.json` states.
pub fn stated(run: &Value) -> Map<String, Value> {
    let keys = run.as_object().into_iter().flatten();
    keys.filter(|(key, _)| !OTHERS.contains(&key.as_str())).map(|(key, value)| (key.clone(), value.clone())).collect()
}
