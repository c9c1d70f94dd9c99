//! The death and the fall of branches (de Reffye 1988 §5, "pruning"): when all the buds of a branch are dead the branch
//! is dead, and falls some time later with everything that it bears.
//!
//! A branch is an axis with all that it bears. An apex that has become a flower counts as a living bud until its flower
//! and its fruit have fallen; an axillary bud that lies dormant does not count. Leaves, flowers and fruits end with
//! their branch if their own life is longer. What is cut off ([`Plant::cut`]) dies and leaves the plant at that tick;
//! the stump lives as long as a bud of what it still bears.

use crate::clock::{NEVER, Tick};
use crate::plant::{AxisId, Cause, Event, EventKind, NO_STATE, Plant};

/// Writes the death and the fall of every branch of `plant` whose buds are all dead, and of what it bears.
pub fn shed(plant: &mut Plant) {
    plant.end_cut_apices();
    let changed = kill_branches(plant);
    drop_branches(plant);
    // An organ appears while the bud lives that makes its node: where no death has become another, each has its end.
    if !changed && plant.cuts.is_empty() {
        return;
    }
    for organ in 0..plant.organs.len() {
        let node = plant.organs.node[organ];
        let death = plant.death_of(node);
        let (planned, cause) = (plant.organs.death[organ], plant.organs.cause[organ]);
        // Where a cut is told after the branch was found dead at the same tick, the cut is the cause.
        if death < planned || (death == planned && cause == Cause::Branch) {
            plant.organs.death[organ] = death;
            plant.organs.cause[organ] = plant.cause_of_death(node);
        }
    }
}

/// One reverse scan: a branch dies with the last of its buds. An axis comes after the one that bears it. Whether the
/// death of some branch has become another.
fn kill_branches(plant: &mut Plant) -> bool {
    let Plant { axes, nodes, cuts, .. } = plant;
    let before = axes.death.clone();
    axes.death.copy_from_slice(&axes.spent);
    let mut last = None;
    for axis in (0..axes.len()).rev() {
        let death = axes.death[axis].min(cuts.off(AxisId(axis as u32)));
        axes.death[axis] = death;
        match axes.bearer[axis].some() {
            Some(bearer) => {
                let bearing = nodes.axis[bearer.index()].index();
                axes.death[bearing] = axes.death[bearing].max(death);
            }
            None => last = last.max(Some(death)),
        }
    }
    let changed = axes.death != before;
    plant.death = last.unwrap_or(NEVER);
    changed
}

/// One forward scan: a branch falls its own delay after its death, or with the branch that bears it.
fn drop_branches(plant: &mut Plant) {
    for axis in 0..plant.axes.len() {
        let with_bearer = plant.axes.bearer[axis].some().map_or(NEVER, |bearer| plant.shed_of(bearer));
        let own = fall(plant.axes.death[axis], plant.axes.shed_after[axis]);
        plant.axes.shed[axis] = own.min(with_bearer).min(plant.cuts.off(AxisId(axis as u32)));
    }
}

/// Notes the falls up to `age` among the plant's events, once it is grown: a branch that falls with the one that bears
/// it is part of the fall of the latter, what is cut off does not fall, and a bud that never made a node neither.
pub fn note_falls(plant: &mut Plant, age: Tick) {
    let Some(mut events) = plant.events.take() else {
        return;
    };
    for axis in (0..plant.axes.len()).filter(|&axis| plant.axes.last_node[axis].some().is_some()) {
        let with_bearer = plant.axes.bearer[axis].some().map_or(NEVER, |bearer| plant.shed_of(bearer));
        let tick = plant.axes.shed[axis];
        if tick <= age && tick < with_bearer.min(plant.cuts.off(AxisId(axis as u32))) {
            events.push(Event { tick, axis: AxisId(axis as u32), kind: EventKind::Shed, count: 1, state: NO_STATE });
        }
    }
    plant.events = Some(events);
}

fn fall(death: Tick, after: Tick) -> Tick {
    if death == NEVER { NEVER } else { death.saturating_add(after) }
}
