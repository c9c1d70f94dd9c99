//! The place of a bud that becomes an axis, and the axis that it becomes.
//!
//! The positions of a node are spread evenly around it. Absent: whether a bud becomes an axis (`node`, `columns`).

use super::compile::Branching;
use crate::law::At;
use phytomer_sim::clock::NEVER;
use phytomer_sim::plant::key::Place;
use phytomer_sim::plant::{LineageKey, NewAxis, NodeId, Origin};

pub(super) const TURN: f32 = 2.0 * std::f32::consts::PI;

/// The angle between two neighbouring positions around a node with this number of places, radians.
#[inline]
pub(super) fn spacing(places: u32) -> f32 {
    TURN / places.max(1) as f32
}

/// The azimuth of the next node, a divergence from that of the node before.
#[inline]
pub(super) fn turned(azimuth: f32, divergence: f32) -> f32 {
    // A divergence is within a turn, so one correction keeps the azimuth in [0, 2π).
    match azimuth + divergence {
        over if over >= TURN => over - TURN,
        under if under < 0.0 => under + TURN,
        within => within,
    }
}

/// The place of a bud that becomes an axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct BudSite {
    pub node: NodeId,
    pub order: u8,
    pub origin: Origin,
    /// The number of the place, for the lineage key.
    pub place: u64,
    /// The number of the bud among the buds of its kind, from 0.
    pub position: u32,
    pub azimuth: f32,
    /// Whether another axis of its set of relays or forks came before it.
    pub follows: bool,
    /// The state that the zone gives the new axis; `None`: the state that the branching states.
    pub state: Option<u8>,
}

/// The axis on which a bud stands, when the bud begins to grow.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bearing {
    pub key: LineageKey,
    pub state: u8,
}

impl BudSite {
    /// An axillary bud of `node`, whose rank along its axis is `rank` and whose first position is at `azimuth`.
    pub fn axillary(node: NodeId, (order, rank): (u8, u32), position: u32, (azimuth, spacing): (f32, f32)) -> Self {
        Self {
            node,
            order,
            origin: Origin::Axillary,
            place: Place::Axillary(position as u16).on(rank),
            position,
            azimuth: azimuth + spacing * position as f32,
            follows: false,
            state: None,
        }
    }

    /// A reiteration bud, as [`BudSite::axillary`].
    pub fn reiteration(node: NodeId, (order, rank): (u8, u32), position: u32, (azimuth, spacing): (f32, f32)) -> Self {
        let place = Place::Reiteration(position as u16).on(rank);
        Self { origin: Origin::Adaptive, place, ..Self::axillary(node, (order, rank), position, (azimuth, spacing)) }
    }

    /// The axis that the bud becomes by `laws`, whose draws stand in the record `words`.
    #[inline]
    pub fn axis(&self, laws: &Branching, words: &[u32], bearing: Bearing, at: At) -> NewAxis {
        NewAxis {
            bearer: Some(self.node),
            key: bearing.key.child(self.place),
            order: self.order,
            origin: self.origin,
            position: self.position as u16,
            follows: self.follows,
            state: self.state.or(laws.state).unwrap_or(bearing.state),
            appearance: at.age,
            birth: at.age.saturating_add(laws.delay.draw(words, self.position, at)),
            azimuth: self.azimuth,
            insertion: laws.insertion.draw(words, self.position, at),
            shed_after: NEVER,
        }
    }
}
