//! What an axis has decided on at its clock steps and has yet to make: the nodes of growth units, and the events of its
//! bud between them.
//!
//! Nothing that a bud decides at a step depends on its nodes, as long as it meets nothing; so an axis first goes
//! through its steps and then makes all nodes at once (`columns`). A plan holds a block of nodes at most. Absent: the
//! steps (`grow`).

use super::compile::{Piece, Ranks};
use phytomer_sim::plant::Event;

/// The nodes that an axis has yet to make.
#[derive(Debug, Default)]
pub(super) struct Plan {
    /// Neighbouring nodes of one growth unit each.
    pub pieces: Vec<Piece>,
    /// The ranks of the zones of growth units that have drawn them.
    pub zones: Vec<Ranks>,
    /// The events of the bud meanwhile, each with the number of nodes planned before it.
    pub events: Vec<(u32, Event)>,
}

impl Plan {
    /// The number of nodes planned.
    #[inline]
    pub fn nodes(&self) -> u32 {
        self.pieces.last().map_or(0, |piece| piece.nodes.1)
    }

    /// Whether nothing is planned.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }

    /// Forgets everything and keeps the memory.
    pub fn clear(&mut self) {
        self.pieces.clear();
        self.zones.clear();
        self.events.clear();
    }
}
