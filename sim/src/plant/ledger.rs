//! The ledger of a plant: what a model that rewrites has taken out of its columns, as it last stood.
//!
//! A plant that is extended keeps its dead components in the columns, with the tick of their death. A model that
//! rewrites makes the columns anew, so a module that its rules replace by nothing would leave no trace: here it keeps
//! its number, its identity and its birth, and gets its death. Numbers in the ledger are never given again. The ledger
//! stays empty, and costs nothing, in plants of other models. Absent: numbers (`placed`).

use super::axis::Origin;
use super::handle::{AxisId, NodeId, OrganId};
use super::kind::{Cause, Kind};
use super::{LineageKey, Plant, Trend};
use crate::clock::Tick;

/// A component that has left the columns. Other components are stated by their component numbers, since handles change
/// when the columns are made anew. What a component of its class does not have is `None`, or 0.
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
    /// Its kind; an apical bud stands for its axis.
    pub kind: Kind,
    /// The position of an organ or a bud on its node.
    pub position: Option<u16>,
    /// Its rank on its axis at the end, from 1, or that of the node that bore it.
    pub rank: Option<u32>,
    /// The rank in the growth unit.
    pub unit_rank: Option<u16>,
    /// Whether an internode was neoformed.
    pub neoformed: Option<bool>,
    /// The trend of an internode.
    pub trend: Option<Trend>,
    /// The tick at which it appeared.
    pub birth: Tick,
    /// The tick at which it appeared, counted from the birth of its axis.
    pub birth_dimension: Option<Tick>,
    /// Its length, metres.
    pub length: f32,
    /// The diameter of an internode at birth, or the width of an organ, metres.
    pub birth_diameter: f32,
    /// The area of an organ, square metres.
    pub area: f32,
    /// The first tick at which it does not stand any more; of an apical bud, the end of the bud.
    pub death: Tick,
    /// The tick at which it left the columns; of an apical bud, the end of its axis.
    pub left: Tick,
    /// Why it ended.
    pub cause: Cause,
}

impl Plant {
    /// Enters an internode into the ledger as it stands in the columns, gone at `tick`. To be called before
    /// [`Plant::begin_rewriting`] empties the columns. O(1).
    pub fn depart(&mut self, node: NodeId, tick: Tick, cause: Cause) {
        let i = node.index();
        let axis = self.nodes.axis[i];
        let component = self.nodes.component[i];
        let parent = self.nodes.parent[i].some().map(|parent| self.nodes.component[parent.index()]);
        self.ledger.push(Departed {
            component,
            key: self.node_key(node),
            parent: self.bearer_at_birth(component).unwrap_or(parent),
            kind: self.kind_of(node),
            rank: Some(self.nodes.rank[i]),
            unit_rank: Some(self.nodes.unit_rank[i]),
            neoformed: Some(self.nodes.formation[i].is_neoformed()),
            trend: self.trends_of(axis).get(usize::from(self.nodes.trend[i])).copied(),
            birth: self.nodes.birth[i],
            birth_dimension: Some(self.nodes.birth[i].saturating_sub(self.axes.birth[axis.index()])),
            length: self.nodes.length[i],
            birth_diameter: self.nodes.primary_diameter[i],
            death: tick,
            left: tick,
            cause,
            ..self.departed_on(axis)
        });
    }

    /// As [`Plant::depart`], for an organ.
    pub fn depart_organ(&mut self, organ: OrganId, tick: Tick, cause: Cause) {
        let i = organ.index();
        let node = self.organs.node[i].index();
        let axis = self.nodes.axis[node];
        let component = self.organs.component[i];
        let position = self.organs.position[i];
        self.ledger.push(Departed {
            component,
            key: self.organ_key(organ),
            parent: self.bearer_at_birth(component).unwrap_or(Some(self.nodes.component[node])),
            kind: self.organs.kind[i],
            position: (position != u16::MAX).then_some(position),
            rank: Some(self.nodes.rank[node]),
            unit_rank: Some(self.nodes.unit_rank[node]),
            birth: self.organs.birth[i],
            birth_dimension: Some(self.organs.birth[i].saturating_sub(self.axes.birth[axis.index()])),
            length: self.organs.length[i],
            birth_diameter: self.organs.width[i],
            area: self.organs.area[i],
            death: tick,
            left: tick,
            cause,
            ..self.departed_on(axis)
        });
    }

    /// As [`Plant::depart`], for an axis, which leaves with its apical bud. A bud that ended before keeps its end and
    /// its cause. Events of the axis may go on naming it by [`AxisId::gone`].
    pub fn depart_axis(&mut self, axis: AxisId, tick: Tick, cause: Cause) {
        let i = axis.index();
        let component = self.axes.component[i];
        let bearer = self.axes.bearer[i].some().map(NodeId::index);
        let parent = bearer.map(|node| self.nodes.component[node]);
        let ended = self.axes.apex_end[i] <= tick;
        let (death, cause) =
            if ended { (self.axes.apex_end[i], self.axes.apex_fate[i].cause()) } else { (tick, cause) };
        self.ledger.push(Departed {
            parent: self.bearer_at_birth(component).unwrap_or(parent),
            position: Some(self.axes.position[i]),
            rank: bearer.map(|node| self.nodes.rank[node]),
            unit_rank: bearer.map(|node| self.nodes.unit_rank[node]),
            birth: self.axes.appearance[i],
            death,
            left: tick,
            cause,
            ..self.departed_on(axis)
        });
        self.gone_buds.push(component);
        self.gone_orders.push(self.axes.order[i]);
    }

    /// What all components of an axis have in common, for its bud.
    fn departed_on(&self, axis: AxisId) -> Departed {
        let i = axis.index();
        let bearer = self.axes.bearer[i].some();
        let bud = |axis: AxisId| self.axes.component[axis.index()];
        Departed {
            component: bud(axis),
            key: self.axes.key[i],
            parent: None,
            axis: bud(axis),
            bearing_axis: bearer.map(|bearer| bud(self.nodes.axis[bearer.index()])),
            order: self.axes.order[i],
            origin: self.axes.origin[i],
            state: self.axes.state[i],
            kind: Kind::ApicalBud,
            position: None,
            rank: None,
            unit_rank: None,
            neoformed: None,
            trend: None,
            birth: 0,
            birth_dimension: None,
            length: 0.0,
            birth_diameter: 0.0,
            area: 0.0,
            death: 0,
            left: 0,
            cause: Cause::Rewritten,
        }
    }
}
