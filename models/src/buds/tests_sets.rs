//! Lineage keys and leaders of species made to provoke collisions: axes that pass from state to state without a node
//! between, several sets of relays at one node and tick, relays below, reiterations of every kind, forks, many organs
//! on a node.
//!
//! Absent: the numbers of places (`sim::plant::key`), and species that were not made for this test (`tests`).

use super::params::{
    Apex, ApexEnd, Axillary, Flower, Fork, GrowthUnit, Leaf, Reiteration, Relay, Sibling, SpeedText, Speeds,
    Transition, Traumatic,
};
use super::{BudModel, Buds, Order};
use crate::contract;
use crate::fault::Path;
use crate::law::{Count, CountForm, Law, LawForm, Poisson};
use phytomer_sim::Growth;
use phytomer_sim::plant::{ApexFate, Origin, Plant};
use std::collections::{BTreeMap, BTreeSet};

fn poisson(mean: f64) -> Count {
    Count::from(CountForm { poisson: Some(Poisson { mean: Law::from(mean) }), ..CountForm::default() })
}

fn empirical(weights: &[f64]) -> Count {
    Count::from(CountForm { empirical: Some(weights.to_vec()), ..CountForm::default() })
}

fn constant(expression: &str) -> Count {
    let law = Law::from(LawForm { expression: Some(expression.to_owned()), ..LawForm::default() });
    Count::from(CountForm { constant: Some(law), ..CountForm::default() })
}

fn by_state(laws: &[(&str, f64)]) -> Law {
    let each = laws.iter().map(|(state, law)| ((*state).to_owned(), Law::from(*law))).collect::<BTreeMap<_, _>>();
    Law::from(LawForm { by_state: Some(each), ..LawForm::default() })
}

fn passage(from: &str, to: &str, probability: f64, sibling: Option<Sibling>) -> Transition {
    let (from, to) = (from.to_owned(), to.to_owned());
    Transition { from, to, probability: Law::from(probability), sibling, relayed: true }
}

fn compiled(states: &[&str], order: Vec<Order>, until: u32) -> BudModel {
    let states = states.iter().map(|state| (*state).to_owned()).collect();
    Buds { states, order, ..Buds::default() }
        .compile(until, &Path::root())
        .unwrap_or_else(|faults| panic!("{faults:?}"))
}

/// Two states that pass into each other with a relay each time, on growth units that are often empty.
fn twins() -> Order {
    Order {
        growth_unit: GrowthUnit { nodes: poisson(0.7), ..GrowthUnit::default() },
        relay: Relay { count: Count::from(1), ..Relay::default() },
        transition: vec![passage("a", "b", 1.0, None), passage("b", "a", 1.0, None)],
        ..Order::default()
    }
}

/// No two components share a key, so that no two different axes draw the same words.
#[test]
fn axes_that_pass_from_state_to_state_without_a_node_between_differ() {
    let model = compiled(&["a", "b"], vec![twins()], 6);
    let (mut components, mut keys) = (0, 0);
    for number in 0..20 {
        let all = contract::components(&contract::grown(&model, 6, &contract::seed_of(1, number)));
        components += all.len();
        keys += all.iter().map(|component| component.key).collect::<BTreeSet<_>>().len();
    }
    assert!(components > 500, "{components}");
    assert_eq!(components, keys, "each component has a key of its own");
    contract::check(&model, 6, 1);
}

/// The key of a relay that came with the first passage at a node does not depend on later passages there.
#[test]
fn the_first_passage_at_a_node_keeps_its_key() {
    use phytomer_sim::plant::key::{LineageKey, Place};
    let nodes = constant("if(cycle == 1, 1, 0)");
    let order = Order { growth_unit: GrowthUnit { nodes, ..GrowthUnit::default() }, ..twins() };
    let model = compiled(&["a", "b"], vec![order], 3);
    let plant = contract::grown(&model, 3, &contract::seed_of(1, 0));
    let of_trunk: Vec<LineageKey> = (1..plant.axes.len())
        .filter(|&axis| plant.nodes.axis[plant.axes.bearer[axis].index()].index() == 0)
        .map(|axis| plant.axes.key[axis])
        .collect();
    assert_eq!(of_trunk[0], LineageKey::SEED.child(1 << 32 | 4 << 16), "as it was before passages were counted");
    assert_eq!(of_trunk, [0, 1, 2].map(|before| LineageKey::SEED.child(Place::Passage(before, 0).on(1))));
}

/// A numbered species: each digit of the number chooses another option of growth.
fn species(number: u32) -> (Vec<Order>, u32) {
    let way = |place: u32, ways: u32| number / 3_u32.pow(place) % ways;
    let speed = ["1", "2", "5/2"][way(0, 3) as usize];
    let nodes = [poisson(0.6), empirical(&[1.0, 1.0]), constant("if(cycle == 1, 1, 0)")][way(1, 3) as usize].clone();
    let below = [Count::from(0), Count::from(1), empirical(&[1.0, 1.0, 1.0])][way(2, 3) as usize].clone();
    let per_step = [Count::from(1), Count::from(2), empirical(&[1.0, 1.0, 1.0])][way(3, 3) as usize].clone();
    let order = Order {
        speed: Speeds::from(SpeedText::Ratio(format!("{speed}{}", if speed.contains('/') { "" } else { "/1" }))),
        death: Law::from(0.15),
        pause: Law::from(0.1),
        growth_unit: GrowthUnit { nodes, per_step, ..GrowthUnit::default() },
        axillary: Axillary { buds: Count::from(3), ramification: Law::from(0.15), ..Axillary::default() },
        reiteration: Reiteration { buds: Count::from(2), probability: Law::from(0.05), ..Reiteration::default() },
        traumatic: Traumatic { probability: Law::from(0.5), ..Traumatic::default() },
        relay: Relay {
            on: vec![ApexEnd::Death, ApexEnd::Completed, ApexEnd::Flower],
            count: Count::from(2),
            probability: Law::from(0.5),
            below,
            ..Relay::default()
        },
        apex: Apex {
            units: Some(Count::from(5)),
            fork: Some(Fork { axes: Count::from(2), insertion_deg: 20.0.into() }),
            ..Apex::default()
        },
        transition: vec![passage("a", "b", 0.5, None), passage("b", "a", 0.5, Some(Sibling::Leader))],
        leaf: Leaf { per_node: Count::from(3), ..Leaf::default() },
        flower: Flower {
            terminal: Law::from(0.05),
            lateral: Law::from(0.7),
            per_node: Count::from(3),
            fruit_set: Law::from(0.5),
            ..Flower::default()
        },
        ..Order::default()
    };
    (vec![order.clone(), order], 4)
}

#[test]
fn species_made_to_break_it_keep_the_contract() {
    for number in 0..81 {
        let (order, until) = species(number);
        let model = compiled(&["a", "b"], order, until);
        for plant in 0..4 {
            let seed = contract::seed_of(u64::from(number), plant);
            contract::structure(&contract::grown(&model, until, &seed), Growth::Extends, until);
            contract::threads_change_nothing(&model, until, &seed);
        }
        contract::ahead_equals_the_clock(&model, until, &contract::seed_of(u64::from(number), 0));
    }
}

/// How many sets of relays or forks an axis of order 1 that bears them has made, how many axes lead one, and how many
/// flowered.
fn sets(plant: &Plant, of: Origin) -> [usize; 2] {
    let axes = &plant.axes;
    let leaders = (1..axes.len()).filter(|&axis| axes.origin[axis] == of && !axes.follows[axis]);
    let flowered =
        (1..axes.len()).filter(|&axis| axes.origin[axis] == of && axes.apex_fate[axis] == ApexFate::Flowered);
    [leaders.count(), flowered.count()]
}

/// With a speed of 2 an axis passes twice a tick, and without a node between both sets of relays stand on one node. Of
/// each set of three one leads: it alone passes into the state in which it flowers.
#[test]
fn each_set_of_relays_has_one_leader_however_many_come_at_one_node_and_tick() {
    let order = Order {
        speed: Speeds::from(SpeedText::Whole(2)),
        growth_unit: GrowthUnit { nodes: constant("if(cycle == 1, 1, 0)"), ..GrowthUnit::default() },
        relay: Relay { count: Count::from(3), state: Some("new".to_owned()), ..Relay::default() },
        transition: vec![
            passage("stem", "stem", 1.0, None),
            Transition { relayed: false, ..passage("new", "leader", 1.0, Some(Sibling::Leader)) },
        ],
        flower: Flower { terminal: by_state(&[("stem", 0.0), ("new", 0.0), ("leader", 1.0)]), ..Flower::default() },
        ..Order::default()
    };
    let model = compiled(&["stem", "new", "leader"], vec![order], 6);
    let plant = contract::grown(&model, 6, &contract::seed_of(3, 0));
    let relays = (0..plant.axes.len()).filter(|&axis| plant.axes.origin[axis] == Origin::Relay).count();
    assert_eq!(relays, 3 * 12, "the stem passes at each of its twelve steps");
    // Axes of the last tick have not taken a step yet.
    assert_eq!(sets(&plant, Origin::Relay), [12, 10]);
    contract::check(&model, 6, 3);
}

/// Two growth units a step, and axes that complete at the same tick on one node: a set of forks has one leader too.
#[test]
fn each_set_of_forks_has_one_leader() {
    let order = Order {
        growth_unit: GrowthUnit { nodes: constant("if(cycle == 1, 1, 0)"), ..GrowthUnit::default() },
        apex: Apex {
            units: Some(Count::from(2)),
            fork: Some(Fork { axes: Count::from(2), insertion_deg: 30.0.into() }),
            ..Apex::default()
        },
        ..Order::default()
    };
    let model = compiled(&[], vec![order], 8);
    let plant = contract::grown(&model, 8, &contract::seed_of(3, 0));
    let forks = (0..plant.axes.len()).filter(|&axis| plant.axes.origin[axis] == Origin::Fork).count();
    assert_eq!((forks, sets(&plant, Origin::Fork)[0]), (2 + 4 + 8 + 16, 1 + 2 + 4 + 8));
    contract::check(&model, 8, 3);
}
