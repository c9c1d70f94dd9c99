//! A small plant that is written by hand, for the tests of all that shows a life.
//!
//! Crates above this one include the file by its path. Absent: what is expected of it.

#![allow(dead_code, reason = "each crate uses a part of it")]

use phytomer_sim::Tick;
use phytomer_sim::plant::{Cause, Form, Habit, Kind, NewAxis, NewNode, NewOrgan, NodeId, Plant, Seed, Trend};
use phytomer_sim::pose::pose;
use std::sync::Arc;

/// The number of its internodes, and the age at which it has them all.
pub const TALL: Tick = 6;

/// A trunk of an internode of 0.1 m a tick, with a leaf from the age 2 to the age 5 at its first node.
pub fn plant() -> Plant {
    let mut plant = unposed();
    pose(&mut plant, TALL);
    plant
}

/// The same before it has a pose, so that it can be added to.
pub fn unposed() -> Plant {
    let seed = Seed { plant: 3, draws: 3, run_seed: 1, component_limit: 100, keep_events: false };
    let habit = Habit { trends: vec![Trend::STRAIGHT; 2], ..Habit::default() };
    let mut plant = Plant::new(&seed, Arc::new(habit));
    let axis = plant.add_axis(NewAxis::OF_THE_SEED);
    let mut parent = NodeId::NONE;
    for rank in 1..=TALL {
        let node = NewNode { parent, axis, birth: rank, rank, length: 0.1, diameter: 0.01, ..NewNode::OF_THE_TRUNK };
        parent = plant.add_node(node);
    }
    plant.add_organ(NewOrgan {
        node: NodeId(0),
        kind: Kind::Leaf,
        position: 0,
        birth: 2,
        death: 5,
        cause: Cause::LifeLength,
        form: Form::default(),
        length: 0.1,
        width: 0.04,
        area: 0.002,
        azimuth: 0.0,
        insertion: 1.0,
    });
    plant
}
