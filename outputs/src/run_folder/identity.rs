//! The identity of a run: everything that the bytes of its tables depend on. A run is resumed only under an equal
//! identity.
//!
//! The identity is in `run.json`, and its fingerprint is in each line of the journal. Limits and threads are not part
//! of it.

use super::seal::check_of;
use crate::storage::durable::sha256_of;
use crate::tables::columns::SCHEMA_VERSION;
use crate::tables::{Provenance, RunPlan, Sample, Stated};
use serde::Deserialize;
use serde_json::{Map, Value, json};

/// The format version of the run folder's own files. Version 2 has checks in `run.json` and in each line of the
/// journal.
pub const FORMAT_VERSION: u32 = 2;

/// The key of a run's sample.
const SAMPLE: &str = "sample";

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
    identity.extend(plan.sample.map(|sample| (SAMPLE.to_owned(), json!(sample.stated()))));
    identity
}

/// The fingerprint of the identity: a short hash, by which each line of the journal names its run.
pub fn fingerprint(plan: &RunPlan) -> String {
    check_of(Value::Object(identity(plan)).to_string().as_bytes())
}

/// The plan of the run that a `run.json` describes; `None` where it is not the plan of a run of this program's format,
/// which the fingerprint shows: it is that of the plan only where nothing was lost or read differently.
pub fn plan_of(run: &Value) -> Option<RunPlan> {
    let plan = stated_plan(run)?;
    (run["fingerprint"] == fingerprint(&plan)).then_some(plan)
}

fn stated_plan(run: &Value) -> Option<RunPlan> {
    let seed = stated(&run["seed"])?;
    let sample = stated::<Stated>(&run[SAMPLE]).and_then(|Stated { plants, of }| Sample::of(seed, plants, of));
    Some(RunPlan {
        tables: stated(&run["tables"])?,
        sample,
        recorded: stated(&run["recorded_ages"])?,
        until: stated(&run["until"])?,
        plots: stated(&run["plots"])?,
        plots_per_part: stated(&run["plots_per_part"])?,
        compression_level: stated(&run["compression"]["level"])?,
        precision_m: stated(&run["precision_m"])?,
        mechanics: run["mechanics"] == true,
        provenance: Provenance {
            scenario: stated(&run["scenario"])?,
            treatments: stated(&run["treatments"])?,
            species: stated(&run["species"])?,
            seed,
            version: stated(&run["version"])?,
            git_hash: stated(&run["git_hash"])?,
            resolved: run["resolved_scenario"].clone(),
            inputs: stated(&run["inputs"])?,
        },
    })
}

fn stated<T: for<'a> Deserialize<'a>>(value: &Value) -> Option<T> {
    T::deserialize(value).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::specimen::plan;

    #[test]
    fn a_plan_is_read_back_from_its_identity() {
        let mut before = plan(7, 2);
        (before.precision_m, before.mechanics) = (Some(1e-4), true);
        before.sample = Sample::of(42, 3, 7);
        before.provenance.resolved = json!({"share": 0.1 + 0.2, "least": 5e-324, "most": 1.797_693_134_862_315_7e308});
        let mut run = Value::Object(identity(&before));
        run["fingerprint"] = json!(fingerprint(&before));
        run["resolved_scenario"] = before.provenance.resolved.clone();
        // As text and back, as in a run folder.
        let read: Value = serde_json::from_str(&run.to_string()).unwrap();
        let plan = plan_of(&read).unwrap();
        assert_eq!(identity(&plan), identity(&before));
        assert_eq!(plan.sample, before.sample);
        for (key, value) in [("until", json!(13)), ("schema_version", json!("0")), ("plots", json!("many"))] {
            let mut other = read.clone();
            other[key] = value;
            assert!(key == "schema_version" || plan_of(&other).is_none(), "{key}");
        }
        run["fingerprint"] = json!("that of another schema version");
        assert!(plan_of(&run).is_none());
    }
}
