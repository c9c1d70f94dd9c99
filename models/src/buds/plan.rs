//! What axes have decided on at their clock steps and have yet to make: the nodes of growth units, and the events of
//! their buds between them.
//!
//! Nothing that a bud decides at a step depends on its nodes, as long as it meets nothing; so an axis first goes
//! through its steps and then makes all nodes at once (`columns`). Axes of one order that follow one another are
//! planned together: many are short. A plan holds a block of nodes at most. Absent: the steps (`grow`).

use super::bud::ApicalBud;
use super::compile::{Piece, Ranks};
use phytomer_sim::plant::{Event, LineageKey};
use std::ops::Range;

/// The nodes that axes have yet to make.
#[derive(Debug, Default)]
pub(super) struct Plan {
    /// Neighbouring nodes of one growth unit each.
    pub pieces: Vec<Piece>,
    /// The axes of the nodes, in the order in which they grow.
    pub shoots: Vec<Shoot>,
    /// The ranks of the zones of growth units that have drawn them.
    pub zones: Vec<Ranks>,
    /// The ranks from which the trends of axes hold, where they draw them, with the places of the trends.
    pub trends: Vec<(u32, u8)>,
    /// The events of the buds meanwhile, each with the number of nodes planned before it.
    pub events: Vec<(u32, Event)>,
    /// The number of nodes planned.
    pub nodes: u32,
}

/// The planned nodes of one axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Shoot {
    /// The bud before it makes them.
    pub bud: ApicalBud,
    /// The lineage key of the axis.
    pub key: LineageKey,
    /// The place of the first among the nodes of the block, and of the first behind the last.
    pub nodes: (u32, u32),
    /// The same of the axis's ranks among those of the trends.
    pub trends: (u32, u32),
    /// The place of its bud among the living buds, where the bud has grown on to its age meanwhile.
    pub living: Option<usize>,
}

impl Shoot {
    /// The rank along the axis of the node at a place of the block.
    #[inline]
    pub fn rank(&self, node: usize) -> u32 {
        self.bud.rank + 1 + node as u32 - self.nodes.0
    }

    /// The places of its nodes in the block.
    #[inline]
    pub fn places(&self) -> Range<usize> {
        self.nodes.0 as usize..self.nodes.1 as usize
    }
}

impl Plan {
    /// Whether nothing is planned.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.nodes == 0
    }

    /// Forgets everything and keeps the memory.
    pub fn clear(&mut self) {
        self.pieces.clear();
        self.shoots.clear();
        self.zones.clear();
        self.trends.clear();
        self.events.clear();
        self.nodes = 0;
    }
}
