//! The axillary buds that lie dormant on the nodes of a plant, remembered where something may release them later: a
//! cut.
//!
//! Most scenarios cut nothing, and then the last node of an axis is the only one whose dormant buds matter, which the
//! model's own bud knows. So the memory is empty unless it is asked for before the plant is sown
//! ([`DormantBuds::keep`]). Models write it; absent: the laws of release, which are theirs.

use super::handle::NodeId;
use super::rare::Rare;

/// The dormant axillary buds of one node.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Dormant {
    /// One bit a position.
    pub buds: u32,
    /// The angle between two neighbouring positions around the node, radians.
    pub spacing: f32,
    /// The state in which the apical bud was when it made the node.
    pub state: u8,
}

/// The dormant axillary buds of a plant, node by node.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DormantBuds {
    kept: bool,
    nodes: Rare<Dormant>,
}

impl DormantBuds {
    /// Remembers them from now on, or not.
    pub fn keep(&mut self, kept: bool) {
        self.kept = kept;
    }

    /// Whether they are remembered.
    #[inline]
    pub fn are_kept(&self) -> bool {
        self.kept
    }

    /// Those of a node; none where they are not remembered.
    pub fn of(&self, node: NodeId) -> Dormant {
        self.nodes.at(node.index())
    }

    /// Writes those of a node, where they are remembered.
    pub fn set(&mut self, node: NodeId, dormant: Dormant) {
        if self.kept {
            self.nodes.set(node.index(), dormant);
        }
    }

    /// A memory without entries that remembers as this one does: for a fragment of the plant.
    pub(super) fn begun(&self) -> Self {
        Self { kept: self.kept, nodes: Rare::default() }
    }

    /// Adds those of a fragment, whose first node becomes `first`.
    pub(super) fn join(&mut self, more: &Self, first: usize) {
        self.nodes.join(&more.nodes, |at| first + at);
    }

    pub(super) fn clear(&mut self) {
        self.nodes.clear();
    }
}
