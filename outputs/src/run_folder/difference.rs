//! The differences between the run in a folder and the run that is to resume it, key by key, with both values.
//!
//! The scenario and its species are compared as resolved, so that a changed default or ancestor shows too. Keys that
//! follow from them, such as the list of recorded ages, are reported only where scenario and species are equal. Absent:
//! the advice what to do, which is in the error.

use super::identity::{identity, stated};
use super::share::{SHARE, Share};
use crate::tables::RunPlan;
use serde_json::{Map, Value};
use std::fmt;

/// A key whose values differ.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Difference {
    /// The path of the key: `scenario.seed`, `species.order 2.pause`, `inputs.coffee.toml`.
    pub key: String,
    /// The value in the folder; `None` where it has no such key.
    pub run: Option<String>,
    /// The value of the resuming run; `None` where it has no such key.
    pub now: Option<String>,
}

/// All differences, in the order of the keys in the files.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Differences(pub Vec<Difference>);

/// The most differences that a message shows.
const SHOWN: usize = 12;

/// The most characters of a value that a message shows.
const LONGEST: usize = 60;

/// Keys of the identity that do not follow from the resolved scenario.
const OWN: [&str; 6] = ["format_version", "schema_version", "version", "git_hash", "treatments", "inputs"];

impl Differences {
    /// The differences between a `run.json` and a plan.
    pub fn between(run: &Value, plan: &RunPlan) -> Self {
        Self::of(run, &plan.provenance.resolved, identity(plan))
    }

    /// The differences between two `run.json`.
    pub fn between_runs(run: &Value, now: &Value) -> Self {
        Self::of(run, &now["resolved_scenario"], stated(now))
    }

    fn of(run: &Value, resolved: &Value, identity: Map<String, Value>) -> Self {
        let mut found = Vec::new();
        compare(String::new(), run.get("resolved_scenario"), Some(resolved), &mut found);
        let same_scenario = found.is_empty();
        for (key, now) in identity {
            let told = if same_scenario { key != "scenario_sha256" } else { OWN.contains(&key.as_str()) };
            if !told {
                continue;
            }
            if key == "inputs" {
                let run = run.get("inputs").map(by_path);
                compare(key, run.as_ref(), Some(&by_path(&now)), &mut found);
            } else {
                compare(key.clone(), run.get(&key), Some(&now), &mut found);
            }
        }
        Self(found)
    }

    /// Adds the difference between the share of the run in the folder and that of the resuming run.
    pub fn compare_shares(&mut self, run: Option<Share>, now: Option<Share>) {
        if run != now {
            let [run, now] = [run, now].map(|share| Some(share.map_or("the whole run".to_owned(), |s| s.to_string())));
            self.0.push(Difference { key: SHARE.to_owned(), run, now });
        }
    }
}

impl fmt::Display for Differences {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let none = || "nothing".to_owned();
        for (line, Difference { key, run, now }) in self.0.iter().take(SHOWN).enumerate() {
            let (run, now) = (run.clone().unwrap_or_else(none), now.clone().unwrap_or_else(none));
            let end = if line == 0 { "" } else { "\n" };
            write!(f, "{end}  {key}: {run} in the run, {now} now")?;
        }
        match self.0.len().saturating_sub(SHOWN) {
            0 => Ok(()),
            more => write!(f, "\n  and {more} more"),
        }
    }
}

/// A list of inputs as a table of hashes by path.
fn by_path(inputs: &Value) -> Value {
    let pair = |input: &Value| Some((input["path"].as_str()?.to_owned(), input["sha256"].clone()));
    Value::Object(inputs.as_array().into_iter().flatten().filter_map(pair).collect())
}

/// Walks two trees side by side. Their depth is that of a checked scenario.
fn compare(key: String, run: Option<&Value>, now: Option<&Value>, found: &mut Vec<Difference>) {
    match (run, now) {
        (run, now) if run == now => {}
        (Some(Value::Object(run)), Some(Value::Object(now))) => {
            for name in names(run, now) {
                let longer = if key.is_empty() { name.clone() } else { format!("{key}.{name}") };
                compare(longer, run.get(name), now.get(name), found);
            }
        }
        (Some(Value::Array(run)), Some(Value::Array(now))) if run.iter().chain(now).any(Value::is_object) => {
            for at in 0..run.len().max(now.len()) {
                compare(format!("{key} {}", at + 1), run.get(at), now.get(at), found);
            }
        }
        (run, now) => found.push(Difference { key, run: run.map(shown), now: now.map(shown) }),
    }
}

/// The keys of both tables: first the keys of the run, then the keys that only the new run has.
fn names<'a>(run: &'a Map<String, Value>, now: &'a Map<String, Value>) -> impl Iterator<Item = &'a String> {
    run.keys().chain(now.keys().filter(|name| !run.contains_key(*name)))
}

fn shown(value: &Value) -> String {
    let text = value.to_string();
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::specimen::plan;
    use serde_json::json;

    fn between(change: impl FnOnce(&mut RunPlan)) -> Vec<String> {
        let before = plan(4, 2);
        let mut run = Value::Object(identity(&before));
        run["resolved_scenario"] = before.provenance.resolved.clone();
        let mut now = before;
        change(&mut now);
        Differences::between(&run, &now).to_string().lines().map(|line| line.trim().to_owned()).collect()
    }

    #[test]
    fn each_differing_key_is_told_with_both_values() {
        assert!(between(|_| {}).is_empty());
        assert_eq!(between(|now| now.provenance.seed = 43), ["seed: 42 in the run, 43 now"]);
        assert_eq!(
            between(|now| now.provenance.resolved = json!({"species": "birch", "orders": [{"pause": 1}], "until": 9})),
            [
                "species: \"sapling\" in the run, \"birch\" now",
                "share: 0.1 in the run, nothing now",
                "orders: nothing in the run, [{\"pause\":1}] now",
                "until: nothing in the run, 9 now"
            ]
        );
        let input = |sha256: &str| crate::Input { path: "a.toml".to_owned(), sha256: sha256.to_owned() };
        assert_eq!(
            between(|now| now.provenance.inputs = vec![input("12")]),
            ["inputs.a.toml: nothing in the run, \"12\" now"]
        );
    }

    #[test]
    fn what_follows_from_the_scenario_is_not_told_twice_and_long_lists_end() {
        let told = between(|now| {
            now.provenance.seed = 43;
            now.provenance.resolved["share"] = json!(0.2);
            now.provenance.version = "9".to_owned();
        });
        assert_eq!(told, ["share: 0.1 in the run, 0.2 now", "version: \"0.0.0\" in the run, \"9\" now"]);
        let many: Map<String, Value> = (0..40).map(|key| (format!("key {key}"), json!(key))).collect();
        let told = between(|now| now.provenance.resolved = Value::Object(many));
        assert_eq!((told.len(), told[12].as_str()), (13, "and 30 more"));
        let told = between(|now| now.provenance.resolved["species"] = json!("é".repeat(100)));
        assert!(told[0].contains("é…") && told[0].chars().count() < 110, "{}", told[0]);
    }
}
