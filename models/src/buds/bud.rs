//! A living apical bud: what its axis needs in order to grow on, and what a plant of this model remembers between
//! ticks.
//!
//! Buds of axes that wait in a fragment of a plant name its handles; [`ApicalBud::joined`] makes them the plant's.

use phytomer_sim::clock::Tick;
use phytomer_sim::plant::{AxisId, Joint, NodeId};

/// The living apical buds of one plant, in the order of their axes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LivingBuds(pub Vec<ApicalBud>);

/// A living apical bud: what its axis needs in order to grow on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ApicalBud {
    /// Its axis.
    pub axis: AxisId,
    /// The age up to which it has grown.
    pub age: Tick,
    /// The clock steps of its axis so far.
    pub cycle: u32,
    /// The growth units that it has made.
    pub units: u32,
    /// The tick at which the bud came to be: that of the last growth unit, or the birth of its axis.
    pub birth: Tick,
    /// The passages into other states that have made relays since the last node of its axis.
    pub passages: u32,
    /// The nodes that it has made.
    pub rank: u32,
    /// The node at its base: the last of its axis, or the bearing node.
    pub last_node: NodeId,
    /// The azimuth of the next node's first leaf, radians.
    pub azimuth: f32,
    /// Its state.
    pub state: u8,
    /// The axillary buds of the last node that did not ramify and lie dormant, one bit a position.
    pub dormant: u32,
    /// Between two positions around the last node, radians.
    pub bud_spacing: f32,
}

impl ApicalBud {
    /// The same bud, by the handles of the plant to which its fragment is joined.
    pub(super) fn joined(self, joint: &Joint) -> Self {
        let last_node = joint.below(self.last_node, self.axis, self.rank);
        Self { axis: joint.axis(self.axis), last_node, ..self }
    }
}
