//! The death and the fall of branches (de Reffye 1988 §5, "pruning"): when all the buds of a branch are dead the branch
//! is dead, and falls some time later with everything that it bears.
//!
//! A branch is an axis with all that it bears. An apex that has become a flower counts as a living bud until its flower
//! and its fruit have fallen; an axillary bud that lies dormant does not count. Leaves, flowers and fruits end with
//! their branch if their own life is longer.

use crate::clock::{NEVER, Tick};
use crate::plant::{ApexFate, AxisId, Cause, Event, EventKind, Plant};

/// Writes the death and the fall of every branch of `plant` whose buds are all dead, and of what it bears.
pub fn shed(plant: &mut Plant) {
    kill_branches(plant);
    drop_branches(plant);
    for organ in 0..plant.organs.len() {
        let death = plant.death_of(plant.organs.node[organ]);
        if death < plant.organs.death[organ] {
            plant.organs.death[organ] = death;
            plant.organs.cause[organ] = Cause::Branch;
        }
    }
    plant.death = plant.axes.death.first().copied().unwrap_or(NEVER);
}

/// One reverse scan: a branch dies with the last of its buds. An axis comes after the one that bears it.
fn kill_branches(plant: &mut Plant) {
    let Plant { axes, nodes, .. } = plant;
    axes.death.copy_from_slice(&axes.spent);
    for axis in (0..axes.len()).rev() {
        if let Some(bearer) = axes.bearer[axis].some() {
            let bearing = nodes.axis[bearer.index()].index();
            axes.death[bearing] = axes.death[bearing].max(axes.death[axis]);
        }
    }
}

/// One forward scan: a branch falls its own delay after its death, or with the branch that bears it.
fn drop_branches(plant: &mut Plant) {
    for axis in 0..plant.axes.len() {
        let bearing = plant.axes.bearer[axis].some().map(|bearer| plant.nodes.axis[bearer.index()].index());
        let with_bearer = bearing.map_or(NEVER, |bearing| plant.axes.shed[bearing]);
        let own = fall(plant.axes.death[axis], plant.axes.shed_after[axis]);
        plant.axes.shed[axis] = own.min(with_bearer);
    }
}

/// Notes the falls up to `age` among the plant's events, once it is grown: a branch that falls with the one that bears
/// it is part of that one's fall, and a bud that never made a node does not fall.
pub fn note_falls(plant: &mut Plant, age: Tick) {
    let Some(mut events) = plant.events.take() else {
        return;
    };
    for axis in (0..plant.axes.len()).filter(|&axis| plant.axes.last_node[axis].some().is_some()) {
        let bearing = plant.axes.bearer[axis].some().map(|bearer| plant.nodes.axis[bearer.index()].index());
        let with_bearer = bearing.map_or(NEVER, |bearing| plant.axes.shed[bearing]);
        let tick = plant.axes.shed[axis];
        if tick <= age && tick < with_bearer {
            events.push(Event { tick, axis: AxisId(axis as u32), kind: EventKind::Shed, count: 1 });
        }
    }
    plant.events = Some(events);
}

fn fall(death: Tick, after: Tick) -> Tick {
    if death == NEVER { NEVER } else { death.saturating_add(after) }
}

/// Why an apex ended, as a cause of death.
pub fn cause_of(fate: ApexFate) -> Cause {
    match fate {
        ApexFate::Alive => Cause::None,
        ApexFate::Died => Cause::Mortality,
        ApexFate::Flowered => Cause::Flowered,
        ApexFate::Completed => Cause::Completed,
        ApexFate::Killed => Cause::Killed,
        ApexFate::Pruned => Cause::Pruned,
    }
}
