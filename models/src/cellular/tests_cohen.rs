//! Cohen's model: a lone tip goes straight, two tips part symmetrically, what is crowded stops, and the contract.
//!
//! Absent: the field of density by itself (`density`).

use super::{Cohen, CohenModel};
use crate::contract;
use crate::fault::Path;
use phytomer_sim::plant::{AxisId, NodeId, Plant};
use phytomer_sim::pose::{node_frame, pose};

fn cohen(more: serde_json::Value) -> Cohen {
    let mut text = serde_json::json!({"segment_m": 0.1, "reach_m": 0.35, "avoidance": 0.2});
    for (key, value) in more.as_object().into_iter().flatten() {
        text[key] = value.clone();
    }
    serde_json::from_value(text).expect("parameters")
}

fn compiled(cohen: &Cohen) -> CohenModel {
    cohen.compile(200, &Path::root()).expect("sound parameters")
}

fn grown(cohen: &Cohen, age: u32) -> Plant {
    let mut plant = contract::grown(&compiled(cohen), age, &contract::seed_of(2, 0));
    pose(&mut plant, age);
    plant
}

#[test]
fn a_lone_tip_goes_straight() {
    let plant = grown(&cohen(serde_json::json!({})), 40);
    assert_eq!(plant.nodes.len(), 40);
    for node in (0..40).map(NodeId) {
        let at = node_frame(&plant, node).base;
        let height = 0.1 * (node.0 + 1) as f32;
        assert!(at[0].abs() < 1e-5 && at[1].abs() < 1e-5 && (at[2] - height).abs() < 1e-4, "{node:?}: {at:?}");
    }
    // A tropism bends it, the more the longer it grows.
    let bent = grown(&cohen(serde_json::json!({"tropism": [0.1, 0, 0]})), 40);
    let headings: Vec<f32> = bent.frames.heading.iter().map(|heading| heading[0]).collect();
    assert!(headings.windows(2).all(|pair| pair[0] < pair[1]) && headings[39] > 0.9, "{headings:?}");
}

/// A tip divides into two at its second step, and the arms part: at each age their ends are mirror images in the
/// upright axis, and they turn ever farther from one another.
#[test]
fn two_tips_part_symmetrically() {
    let parted = |avoidance: f64| {
        let once = cohen(serde_json::json!({
            "branching": 1, "branching_deg": 8, "avoidance": avoidance, "crowding": 1000, "reach_m": 1,
        }));
        let plant = grown(&once, 2);
        assert_eq!(plant.axes.len(), 2, "it has divided");
        // From here on neither arm divides.
        let on = Cohen { branching: 0.0.into(), ..once.clone() };
        let (first, then) = (compiled(&once), compiled(&on));
        let mut plot = contract::sown(&first, &contract::seed_of(2, 0));
        assert_eq!(plot.grow_to(2), Ok(()));
        plot.species = vec![&then];
        assert_eq!(plot.grow_to(12), Ok(()));
        let mut plant = plot.plants.remove(0);
        pose(&mut plant, 12);
        let ends = [AxisId(0), AxisId(1)].map(|axis| {
            let own = (0..plant.nodes.len() as u32).map(NodeId).filter(|node| plant.nodes.axis[node.index()] == axis);
            let after = own.filter(|node| plant.nodes.birth[node.index()] >= 2);
            after.map(|node| node_frame(&plant, node).base).collect::<Vec<_>>()
        });
        assert_eq!([ends[0].len(), ends[1].len()], [11, 11]);
        for (one, other) in ends[0].iter().zip(&ends[1]) {
            let mirrored = [one[0] + other[0], one[1] + other[1], one[2] - other[2]];
            assert!(mirrored.iter().all(|x| x.abs() < 1e-5), "{one:?} and {other:?}");
        }
        ends[0].iter().map(|at| (at[0] * at[0] + at[1] * at[1]).sqrt()).collect::<Vec<f32>>()
    };
    let (straight, apart) = (parted(0.0), parted(0.2));
    assert!(apart.windows(2).all(|pair| pair[0] < pair[1]), "{apart:?}");
    assert!(apart[10] > 1.5 * straight[10], "they turn away: {apart:?}, not {straight:?}");
}

/// Lengths and divisions fall with density: a crowded plant has far fewer segments than one with room everywhere, and
/// most of them are short.
#[test]
fn what_is_crowded_grows_less() {
    let crowded = |crowding: f64| {
        cohen(serde_json::json!({"branching": 0.5, "crowding": crowding, "reach_m": 0.2, "avoidance": 0.3}))
    };
    let plant = grown(&crowded(3.0), 16);
    let free = grown(&crowded(1e4), 16);
    let (few, many) = (plant.nodes.len(), free.nodes.len());
    assert!(few > 50 && many > 3 * few, "{few} and {many}");
    let short = plant.nodes.length.iter().filter(|length| **length < 0.09).count();
    assert!(2 * short > few, "{short} of {few}");
    assert!(plant.nodes.length.iter().all(|length| *length > 0.001 - 1e-6 && *length < 0.1 + 1e-6));
    assert!(free.nodes.length.iter().all(|length| *length > 0.099), "with room everywhere all are of full length");
}

#[test]
fn it_keeps_the_contract_of_growth_models() {
    contract::check(&compiled(&cohen(serde_json::json!({"branching": 0.4, "tropism": [0, 0, 0.3]}))), 10, 3);
}

#[test]
fn what_has_no_meaning_is_told() {
    let wrong = Cohen { inertia: (-1.0).into(), crowding: 0.0.into(), ..cohen(serde_json::json!({})) };
    let faults = wrong.compile(70_000, &Path::root()).err().unwrap_or_default();
    let told: Vec<String> = faults.iter().map(|fault| fault.path.to_string()).collect();
    assert_eq!(told, ["", "inertia", "crowding"]);
    let far = Cohen { reach_m: 20.0.into(), ..cohen(serde_json::json!({})) };
    let faults = far.compile(9, &Path::root()).err().unwrap_or_default();
    assert_eq!(faults.first().map(|fault| fault.path.to_string()).as_deref(), Some("reach_m"));
}
