//! A living apical bud: the values with which its axis grows on. The living buds are all that a plant of this model
//! keeps between ticks beside its columns.
//!
//! Buds of axes in a fragment of a plant name axes and nodes by the fragment's handles; [`ApicalBud::joined`] turns
//! them into handles of the plant.

use phytomer_sim::clock::Tick;
use phytomer_sim::plant::{AxisId, Joint, NodeId};

/// The living apical buds of one plant, in the order of their axes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LivingBuds(pub Vec<ApicalBud>);

/// A living apical bud: the values with which its axis grows on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ApicalBud {
    /// Its axis.
    pub axis: AxisId,
    /// The age up to which it has grown.
    pub age: Tick,
    /// The clock steps of its axis so far.
    pub cycle: u32,
    /// The growth units that the bud has made.
    pub units: u32,
    /// The tick at which the bud came to be: that of the last growth unit, or the birth of its axis.
    pub birth: Tick,
    /// The passages into other states that have made relays since the last node of its axis.
    pub passages: u32,
    /// The nodes that the bud has made.
    pub rank: u32,
    /// The node at its base: the last of its axis, or the bearing node.
    pub last_node: NodeId,
    /// The azimuth of the next node's first leaf, radians.
    pub azimuth: f32,
    /// Its state.
    pub state: u8,
    /// The axillary buds of the last node that did not ramify and lie dormant, one bit a position.
    pub dormant: u32,
    /// The angle between two neighbouring positions around the last node, radians.
    pub bud_spacing: f32,
}

impl ApicalBud {
    /// The bud with the handles of the plant to which its fragment has been joined.
    pub(super) fn joined(self, joint: &Joint) -> Self {
        let last_node = joint.below(self.last_node, self.axis, self.rank);
        Self { axis: joint.axis(self.axis), last_node, ..self }
    }

    /// The bud behind nodes that have been made since: `made` is the bud that planned them, as they left it.
    pub(super) fn behind(self, made: &Self) -> Self {
        let Self { passages, rank, last_node, azimuth, dormant, bud_spacing, .. } = *made;
        Self { passages, rank, last_node, azimuth, dormant, bud_spacing, ..self }
    }
}
