//! The map from the handles and component numbers of a fragment of a plant to those of the whole plant.
//!
//! It is made when the fragment is joined. Absent: fragments (`fragment`).

use super::handle::{AxisId, NodeId};
use std::ops::Range;

/// The map from the handles of a fragment to those of the whole plant.
#[derive(Debug, Clone)]
pub struct Joint {
    /// The axes of the whole that the fragment starts with.
    pub(super) taken: Range<usize>,
    /// The numbers of axes, nodes and components of the whole when the fragment is joined to it.
    pub(super) axes: usize,
    pub(super) nodes: usize,
    pub(super) components: u32,
}

impl Joint {
    fn is_taken(&self, axis: AxisId) -> bool {
        axis.index() < self.taken.len()
    }

    /// The handle, in the whole plant, of an axis of the fragment.
    pub fn axis(&self, axis: AxisId) -> AxisId {
        let start = if self.is_taken(axis) { self.taken.start } else { self.axes - self.taken.len() };
        AxisId((start + axis.index()) as u32)
    }

    pub(super) fn node(&self, node: NodeId) -> NodeId {
        node.some().map_or(node, |node| NodeId((self.nodes + node.index()) as u32))
    }

    /// The handle, in the whole plant, of the node below the next node of an axis that has made `made` nodes. The
    /// bearers of axes that were taken from the whole have its handles already.
    pub fn below(&self, node: NodeId, axis: AxisId, made: u32) -> NodeId {
        if made == 0 && self.is_taken(axis) { node } else { self.node(node) }
    }

    pub(super) fn component(&self, component: u32) -> u32 {
        self.components + component
    }
}
