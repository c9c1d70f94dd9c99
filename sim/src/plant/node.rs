//! Internodes, each with the node at its tip: the phytomers without their organs.
//!
//! A node stands at the tip of its internode and bears leaves and buds; its rank counts along the axis from 1. Absent:
//! curvature (`strain`), and frames (`frames`).

use super::columns::columns;
use super::handle::{AxisId, NodeId};
use super::joint::Joint;
use crate::clock::Tick;
use std::ops::Range;

/// The growth unit and the cycle of an internode whose model tells none, or whose number is as great.
pub const NOT_TOLD: u16 = u16::MAX;

/// The axillary buds of a node whose model tells none.
pub const BUDS_NOT_TOLD: u8 = u8::MAX;

/// The values of a new internode.
#[derive(Debug, Clone, Copy)]
pub struct NewNode {
    /// The node at its base; [`NodeId::NONE`] for the first internode of the trunk.
    pub parent: NodeId,
    /// Its axis.
    pub axis: AxisId,
    /// The tick at which it appeared.
    pub birth: Tick,
    /// Its rank along the axis, from 1.
    pub rank: u32,
    /// Its rank in its growth unit, from 1.
    pub unit_rank: u16,
    /// Whether its growth unit is of the short type.
    pub short: bool,
    /// Whether it was made after bud break, not laid down in the resting bud.
    pub neoformed: bool,
    /// Its trend, as a place among the habit's trends, or its axis's own.
    pub trend: u8,
    /// Length, metres.
    pub length: f32,
    /// Diameter at birth, metres.
    pub diameter: f32,
    /// Azimuth of its first leaf around the axis, radians from the axis's reference direction.
    pub azimuth: f32,
}

columns! {
    /// The columns of the nodes.
    pub struct Nodes of node: NewNode, numbered component, joined by joint from more at place {
        /// The node at the base of the internode.
        parent: NodeId = node.parent => joint.below(more.parent[place], more.axis[place], more.rank[place] - 1),
        /// The axis.
        axis: AxisId = node.axis => joint.axis(more.axis[place]),
        /// The component number.
        component: u32 = component => joint.component(more.component[place]),
        /// The tick of appearance.
        birth: Tick = node.birth,
        /// The rank along the axis, from 1.
        rank: u32 = node.rank,
        /// The rank in the growth unit, from 1.
        unit_rank: u16 = node.unit_rank,
        /// The number of the growth unit on its axis, from 1; [`NOT_TOLD`] where the model has no growth units.
        growth_unit: u16 = NOT_TOLD,
        /// The clock step of the axis that made it, from 1; [`NOT_TOLD`] where the model has no clock steps.
        cycle: u16 = NOT_TOLD,
        /// The axillary buds of the node, dormant or not; [`BUDS_NOT_TOLD`] where the model has none.
        axillary_buds: u8 = BUDS_NOT_TOLD,
        /// Short type and neoformation, one bit each.
        formation: Formation = Formation::of(&node),
        /// The trend, as a place among the habit's trends, or the axis's own.
        trend: u8 = node.trend,
        /// Length, metres.
        length: f32 = node.length,
        /// Diameter at birth, metres.
        primary_diameter: f32 = node.diameter,
        /// Diameter at the base at the recorded age, metres; written by the model's `thicken`.
        diameter: f32 = node.diameter,
        /// Diameter at the tip at the recorded age, metres; written by the model's `thicken`.
        diameter_tip: f32 = node.diameter,
        /// Azimuth of the first leaf, radians.
        azimuth: f32 = node.azimuth,
    }
    beside
    /// The first node of each run. A run is a sequence of nodes that follow one another on one axis: an axis grown at
    /// once is one run, an axis that grew by the clock, between others, is several. Within a run the node before is the
    /// parent.
    runs: NodeId
}

/// How an internode was formed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Formation(u8);

impl Formation {
    fn of(node: &NewNode) -> Self {
        Self::new(node.short, node.neoformed)
    }

    #[inline]
    pub(super) fn new(short: bool, neoformed: bool) -> Self {
        Self(u8::from(short) | u8::from(neoformed) << 1)
    }

    /// Whether the growth unit is of the short type.
    pub fn is_short(self) -> bool {
        self.0 & 1 != 0
    }

    /// Whether the internode was made after bud break.
    pub fn is_neoformed(self) -> bool {
        self.0 & 2 != 0
    }
}

/// The number of a growth unit or of a clock step in its column.
#[inline]
pub(super) fn told(number: u32) -> u16 {
    u16::try_from(number).unwrap_or(NOT_TOLD)
}

/// A number of axillary buds in its column.
#[inline]
pub(super) fn buds_told(buds: u32) -> u8 {
    u8::try_from(buds).unwrap_or(BUDS_NOT_TOLD)
}

impl Nodes {
    /// States how a bud made a node: the number of the growth unit and the clock step of the axis, each from 1, and the
    /// axillary buds of the node. Numbers too great for their columns are not told.
    #[inline]
    pub fn state_making(&mut self, node: NodeId, growth_unit: u32, cycle: u32, axillary_buds: u32) {
        self.growth_unit[node.index()] = told(growth_unit);
        self.cycle[node.index()] = told(cycle);
        self.axillary_buds[node.index()] = buds_told(axillary_buds);
    }

    /// The nodes of a run.
    #[inline]
    pub fn run(&self, run: usize) -> Range<usize> {
        self.runs[run].index()..self.runs.get(run + 1).map_or(self.len(), |next| next.index())
    }

    #[inline]
    pub(super) fn push(&mut self, node: NewNode, component: u32) -> NodeId {
        let id = NodeId(self.len() as u32);
        if self.axis.last() != Some(&node.axis) {
            self.runs.push(id);
        }
        self.push_columns(node, component);
        id
    }

    /// Adds the runs of a fragment, with the places of their nodes in the whole plant.
    pub(super) fn join_runs(&mut self, more: &Self, joint: &Joint) {
        self.runs.extend(more.runs.iter().map(|&first| joint.node(first)));
    }
}
