//! Each key of a species is compiled once, so that each fault is reported once and no duplicates need to be hidden.
//!
//! A key that is compiled in several domains, such as the insertion angle of an order, has one report for each kind of
//! fault. Absent: the faults themselves, which are tested with laws and parameters.

use super::Buds;
use super::tests::{chimera, hydra};
use crate::fault::{Fault, Path};
use serde_json::{Value, json};

fn faults(species: Value) -> Vec<Fault> {
    let Ok(buds) = serde_json::from_value::<Buds>(species) else { return Vec::new() };
    buds.compile(12, &Path::root()).err().unwrap_or_default()
}

fn in_json(buds: &Buds) -> Value {
    serde_json::to_value(buds).expect("parameters in JSON")
}

#[track_caller]
fn assert_told_once(faults: &[Fault], what: &str) {
    for (place, fault) in faults.iter().enumerate() {
        assert!(!faults[..place].contains(fault), "{what}: told twice: {fault}");
    }
}

/// JSON pointers of every number below a value.
fn numbers(value: &Value, pointer: &str, found: &mut Vec<String>) {
    match value {
        Value::Number(_) => found.push(pointer.to_owned()),
        Value::Array(items) => {
            items.iter().enumerate().for_each(|(place, item)| numbers(item, &format!("{pointer}/{place}"), found));
        }
        Value::Object(keys) => keys.iter().for_each(|(key, item)| numbers(item, &format!("{pointer}/{key}"), found)),
        _ => {}
    }
}

#[test]
fn buds_that_four_laws_ask_for_are_told_once() {
    let zones = json!({"zones": [{"from": "tip", "first": 1}]});
    let order = json!({
        "axillary": {"buds": 33, "ramification": 1, "pattern": zones},
        "traumatic": {"probability": 0.5},
        "phyllotaxis": "whorled",
        "leaf": {"per_node": 65},
        "flower": {"lateral": 2, "insertion_deg": 1000},
        "relay": {"on": ["death"]},
        "insertion_deg": 1000,
    });
    let faults = faults(json!({"order": [order]}));
    let told: Vec<String> = faults.iter().map(|fault| fault.path.to_string()).collect();
    let keys = ["axillary.buds", "flower.insertion_deg", "flower.lateral", "insertion_deg", "leaf.per_node"];
    assert_eq!(told, keys.map(|key| format!("order[0].{key}")), "{faults:#?}");
}

#[test]
fn a_number_out_of_range_is_told_once_wherever_it_stands() {
    for (name, buds) in [("chimera", chimera()), ("hydra", hydra())] {
        let species = in_json(&buds);
        assert_eq!(faults(species.clone()), [], "{name} is sound");
        let mut pointers = Vec::new();
        numbers(&species, "", &mut pointers);
        let mut refused = 0;
        for pointer in &pointers {
            for wrong in [json!(1e7), json!(-1e7), json!(99), json!(-1)] {
                let mut changed = species.clone();
                *changed.pointer_mut(pointer).expect("a number") = wrong.clone();
                let faults = faults(changed);
                refused += usize::from(!faults.is_empty());
                assert_told_once(&faults, &format!("{name}{pointer} = {wrong}"));
            }
        }
        assert!(refused > pointers.len(), "{name}: {refused} changes of {} numbers were refused", pointers.len());
    }
}

#[test]
fn more_trends_than_can_be_numbered_are_told_once_an_order() {
    let phase = |rank: u32, share: f64| json!({"from_rank": rank, "inclination_deg": rank, "share": share});
    let order = |share: f64| json!({"trend": (1..=64).map(|rank| phase(rank, share)).collect::<Vec<_>>()});
    // 64 trends an order, all of them different: the fifth order finds no place left.
    let changed = json!({"order": ([0.1, 0.2, 0.3, 0.4, 0.5].map(order))});
    let faults = faults(changed);
    assert_eq!(faults.iter().map(|fault| fault.path.to_string()).collect::<Vec<_>>(), ["order[4].trend"]);
}
