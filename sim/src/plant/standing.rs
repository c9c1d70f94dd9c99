//! The internodes that stand at an age, as runs of one axis: what pose and mechanics walk along.
//!
//! An axis grown at once is one run; one that grew by the clock, between others, is several. Within a run the node before
//! is the parent. Runs forward meet a parent before its child, runs backward a child before its parent.

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
        self.runs.clear();
        let nodes = &plant.nodes;
        let mut start = 0;
        while start < nodes.len() {
            let end = end_of_run(nodes, start);
            let axis = nodes.axis[start];
            let born = if plant.axes.shed[axis.index()] <= age { 0 } else { born_by(nodes, start..end, age) };
            if born > 0 {
                let begins = begins_axis(nodes, start);
                self.runs.push(Run { axis, start: start as u32, end: (start + born) as u32, begins });
            }
            start = end;
        }
    }
}

/// How many nodes of a run appeared by `age`: the older ones come first.
fn born_by(nodes: &Nodes, run: Range<usize>, age: Tick) -> usize {
    nodes.birth[run].partition_point(|&birth| birth <= age)
}

/// The first node after `node` that is not the next of the same axis.
#[inline]
pub(crate) fn end_of_run(nodes: &Nodes, node: usize) -> usize {
    let axis = nodes.axis[node];
    node + nodes.axis[node..].iter().take_while(|&&other| other == axis).count()
}

/// Whether a node is the first of its axis: its parent is not on it.
#[inline]
pub(crate) fn begins_axis(nodes: &Nodes, node: usize) -> bool {
    nodes.parent[node].some().is_none_or(|parent| nodes.axis[parent.index()] != nodes.axis[node])
}
