//! The internodes that stand at an age, as runs of one axis: what pose and mechanics walk along.
//!
//! Runs forward meet a parent before its child, runs backward a child before its parent.

use super::{AxisId, Nodes, Plant};
use crate::clock::Tick;
use std::ops::Range;

/// Internodes that follow one another on one axis, in the order of the nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Run {
    /// The axis.
    pub axis: AxisId,
    /// The first internode.
    pub start: u32,
    /// One past the last internode that stands.
    pub end: u32,
    /// Whether the first internode is the first of its axis.
    pub begins: bool,
}

impl Run {
    /// The internodes as places in the columns.
    #[inline]
    pub fn nodes(&self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// Every run that stands at an age.
#[derive(Debug, Clone, Default)]
pub(crate) struct Standing {
    pub runs: Vec<Run>,
}

impl Standing {
    /// Finds the runs of the internodes of `plant` that appeared by `age` and have not been shed.
    pub fn find(&mut self, plant: &Plant, age: Tick) {
        let stretches = plant.stretches(age);
        let standing = stretches.iter().filter(|stretch| age < plant.axes.shed[stretch.axis.index()]);
        self.runs.clear();
        self.runs.extend(standing.map(|stretch| {
            let Range { start, end } = stretch.nodes();
            let begins = begins_axis(&plant.nodes, start);
            Run { axis: stretch.axis, start: start as u32, end: end as u32, begins }
        }));
    }
}

/// Whether a node is the first of its axis: its parent is not on it.
#[inline]
pub(crate) fn begins_axis(nodes: &Nodes, node: usize) -> bool {
    nodes.parent[node].some().is_none_or(|parent| nodes.axis[parent.index()] != nodes.axis[node])
}
