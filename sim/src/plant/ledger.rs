//! The ledger of a plant: what a model that rewrites has taken out of its columns, as it last stood.
//!
//! A plant that is extended keeps its dead components in the columns, with the tick of their death. A model that
//! rewrites makes the columns anew, so a module that its rules replace by nothing would leave no trace: here it keeps
//! its number, its identity and its birth, and gets its death. Numbers in the ledger are never given again. The ledger
//! stays empty, and costs nothing, in plants of other models. Absent: axes and organs, which no model takes out yet.

use super::axis::Origin;
use super::handle::{AxisId, NodeId};
use super::kind::{Cause, Kind};
use super::{LineageKey, Plant, Trend};
use crate::clock::Tick;

/// An internode that has left the columns. Other components are stated by their component numbers, since handles
/// change when the columns are made anew.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Departed {
    /// Its component number.
    pub component: u32,
    /// Its lineage key.
    pub key: LineageKey,
    /// The component that bore it; `None` for the first of the plant.
    pub parent: Option<u32>,
    /// The apical bud of its axis.
    pub axis: u32,
    /// The apical bud of the axis that bears its axis.
    pub bearing_axis: Option<u32>,
    /// The order of its axis.
    pub order: u8,
    /// How its axis came to be.
    pub origin: Origin,
    /// The state in which its axis started.
    pub state: u8,
    /// Its kind.
    pub kind: Kind,
    /// Its rank on its axis at the end, from 1.
    pub rank: u32,
    /// Its rank in its growth unit.
    pub unit_rank: u16,
    /// Whether it was neoformed.
    pub neoformed: bool,
    /// Its trend.
    pub trend: Option<Trend>,
    /// The tick at which it appeared.
    pub birth: Tick,
    /// The tick at which it appeared, counted from the birth of its axis.
    pub birth_dimension: Tick,
    /// Its length, metres.
    pub length: f32,
    /// Its diameter at birth, metres.
    pub birth_diameter: f32,
    /// The first tick at which it does not stand any more.
    pub death: Tick,
    /// Why it ended.
    pub cause: Cause,
}

impl Plant {
    /// Enters an internode into the ledger as it stands in the columns, gone at `tick` because the rules of its model
    /// replace it by nothing. To be called before [`Plant::begin_rewriting`] empties the columns. O(1).
    pub fn depart(&mut self, node: NodeId, tick: Tick) {
        let i = node.index();
        let axis = self.nodes.axis[i];
        let bearer = self.axes.bearer[axis.index()].some();
        let bud = |axis: AxisId| self.axes.component[axis.index()];
        let departed = Departed {
            component: self.nodes.component[i],
            key: self.node_key(node),
            parent: self.nodes.parent[i].some().map(|parent| self.nodes.component[parent.index()]),
            axis: bud(axis),
            bearing_axis: bearer.map(|bearer| bud(self.nodes.axis[bearer.index()])),
            order: self.axes.order[axis.index()],
            origin: self.axes.origin[axis.index()],
            state: self.axes.state[axis.index()],
            kind: self.kind_of(node),
            rank: self.nodes.rank[i],
            unit_rank: self.nodes.unit_rank[i],
            neoformed: self.nodes.formation[i].is_neoformed(),
            trend: self.trends_of(axis).get(usize::from(self.nodes.trend[i])).copied(),
            birth: self.nodes.birth[i],
            birth_dimension: self.nodes.birth[i].saturating_sub(self.axes.birth[axis.index()]),
            length: self.nodes.length[i],
            birth_diameter: self.nodes.primary_diameter[i],
            death: tick,
            cause: Cause::Rewritten,
        };
        self.ledger.push(departed);
    }
}
