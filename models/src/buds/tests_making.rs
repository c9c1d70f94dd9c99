//! What internodes tell of the bud that made them, held to the events of that bud and to the exact clock: growth unit,
//! cycle, axillary buds; and the state that events tell.
//!
//! Absent: what tables make of them (`outputs::tables`).

use super::tests::chimera;
use crate::contract;
use crate::fault::Path;
use phytomer_sim::clock::Speed;
use phytomer_sim::plant::{AxisId, Event, EventKind, NO_STATE, Plant};

const UNTIL: u32 = 14;

/// Some plants of a species with several growth units a step, units without nodes, pauses, speeds and states.
fn plants() -> Vec<Plant> {
    let model = chimera().compile(UNTIL, &Path::root()).unwrap();
    (0..20).map(|number| contract::grown(&model, UNTIL, &contract::seed_of(6, number))).collect()
}

/// The events of the buds of an axis, as they came one after another.
fn events_of(plant: &Plant, axis: AxisId) -> Vec<Event> {
    plant.events.iter().flatten().filter(|event| event.axis == axis).copied().collect()
}

/// The k-th event `grew` of an axis is that of its growth unit k, and has as many nodes as name that unit.
#[test]
fn the_number_of_a_growth_unit_counts_the_events_of_its_bud() {
    let (mut units, mut empty) = (0, 0);
    for plant in plants() {
        for axis in (0..plant.axes.len() as u32).map(AxisId) {
            let grew = events_of(&plant, axis).into_iter().filter(|event| event.kind == EventKind::Grew);
            for (event, number) in grew.zip(1_u16..) {
                let nodes = 0..plant.nodes.len();
                let made = nodes.filter(|i| plant.nodes.axis[*i] == axis && plant.nodes.growth_unit[*i] == number);
                let made: Vec<usize> = made.collect();
                assert_eq!(made.len(), event.count as usize, "unit {number} of {axis:?}");
                assert!(made.iter().all(|i| plant.nodes.birth[*i] == event.tick));
                units += 1;
                empty += u32::from(made.is_empty());
            }
        }
    }
    assert!(units > 200 && empty > 10, "{units} units, {empty} without nodes, are no test");
}

/// An axis m ticks old makes the steps ⌊(m − 1) · speed⌋ + 1 to ⌊m · speed⌋ at that tick.
#[test]
fn the_cycle_is_a_step_that_was_due_at_the_birth_of_the_node() {
    let speeds = [Speed::ONE, Speed::new(3, 2).unwrap()];
    let mut several = 0;
    for plant in plants() {
        for i in 0..plant.nodes.len() {
            let axis = plant.nodes.axis[i].index();
            let speed = speeds[usize::from(plant.axes.order[axis] > 1)];
            let age = plant.nodes.birth[i] - plant.axes.birth[axis];
            let due = speed.steps_by(age - 1) + 1..=speed.steps_by(age);
            assert!(due.contains(&u32::from(plant.nodes.cycle[i])), "node {i}: {} of {due:?}", plant.nodes.cycle[i]);
            several += u32::from(due.count() > 1);
        }
    }
    assert!(several > 20, "{several} nodes of ticks with two steps are no test");
}

/// The trunk of the species has two axillary buds at each node, its branches have none.
#[test]
fn the_axillary_buds_of_a_node_are_told_dormant_or_not() {
    let mut dormant = 0;
    for plant in plants() {
        for i in 0..plant.nodes.len() {
            let expected = if plant.axes.order[plant.nodes.axis[i].index()] == 1 { 2 } else { 0 };
            assert_eq!(plant.nodes.axillary_buds[i], expected, "node {i}");
            let became = (0..plant.axes.len()).filter(|axis| plant.axes.bearer[*axis].index() == i).count();
            dormant += u32::from(expected == 2 && became == 0);
        }
    }
    assert!(dormant > 50, "{dormant} nodes whose buds all lie dormant are no test");
}

/// A juvenile bud becomes adult and stays so; an axis begins in the state that its first event tells.
#[test]
fn events_tell_the_state_of_the_bud_when_they_happened() {
    let mut passed = 0;
    for plant in plants() {
        for axis in (0..plant.axes.len() as u32).map(AxisId) {
            let begun = plant.axes.state[axis.index()];
            let own = events_of(&plant, axis);
            let states: Vec<u8> = own.iter().map(|event| event.state).filter(|state| *state != NO_STATE).collect();
            let is_new = |event: &&Event| [EventKind::Branched, EventKind::Relayed].contains(&event.kind);
            assert!(own.iter().filter(is_new).all(|event| event.state == begun));
            assert!(states.is_sorted() && states.first().is_none_or(|first| *first == begun), "{axis:?}: {states:?}");
            passed += u32::from(states.last().is_some_and(|last| *last != begun));
            let falls = own.iter().filter(|event| event.kind == EventKind::Shed);
            assert!(falls.into_iter().all(|event| event.state == NO_STATE));
        }
    }
    assert!(passed > 10, "{passed} axes that passed into another state are no test");
}
