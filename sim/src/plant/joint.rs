//! How the handles and component numbers of a fragment of a plant become those of the whole plant.
//!
//! Absent: fragments (`fragment`).

use super::handle::{AxisId, NodeId};
use std::ops::Range;

/// How the handles of a fragment become those of the whole.
#[derive(Debug, Clone)]
pub struct Joint {
    /// The axes of the whole that the fragment starts with.
    pub(super) taken: Range<usize>,
    /// The axes, nodes and components that the whole has when the fragment is joined to it.
    pub(super) axes: usize,
    pub(super) nodes: usize,
    pub(super) components: u32,
}

impl Joint {
    fn is_taken(&self, axis: AxisId) -> bool {
        axis.index() < self.taken.len()
    }

    /// An axis of the fragment, as the whole plant numbers it.
    pub fn axis(&self, axis: AxisId) -> AxisId {
        let start = if self.is_taken(axis) { self.taken.start } else { self.axes - self.taken.len() };
        AxisId((start + axis.index()) as u32)
    }

    pub(super) fn node(&self, node: NodeId) -> NodeId {
        node.some().map_or(node, |node| NodeId((self.nodes + node.index()) as u32))
    }

    /// The node on which an axis goes on when it has made so many: the bearers of the axes that were taken are the
    /// whole's.
    pub fn below(&self, node: NodeId, axis: AxisId, made: u32) -> NodeId {
        if made == 0 && self.is_taken(axis) { node } else { self.node(node) }
    }

    pub(super) fn component(&self, component: u32) -> u32 {
        self.components + component
    }
}
