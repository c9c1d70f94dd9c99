//! Internodes, each with the node at its tip: the phytomers without their organs.
//!
//! A node stands at the tip of its internode and bears leaves and buds; its rank counts along the axis from 1. Absent:
//! the curvature that mechanics will write.

use super::handle::{AxisId, NodeId};
use super::joint::Joint;
use crate::clock::Tick;
use std::ops::Range;

/// What a new internode starts from.
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
    /// The trend that it follows, as a place in the habit's.
    pub trend: u8,
    /// Length, metres.
    pub length: f32,
    /// Diameter at birth, metres.
    pub diameter: f32,
    /// Of its first leaf around the axis, radians from the axis's reference direction.
    pub azimuth: f32,
}

/// The columns of the nodes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Nodes {
    /// The node at the base of the internode.
    pub parent: Vec<NodeId>,
    /// The axis.
    pub axis: Vec<AxisId>,
    /// The component number.
    pub component: Vec<u32>,
    /// The tick of appearance.
    pub birth: Vec<Tick>,
    /// The rank along the axis, from 1.
    pub rank: Vec<u32>,
    /// The rank in the growth unit, from 1.
    pub unit_rank: Vec<u16>,
    /// Short type and neoformation, one bit each.
    pub formation: Vec<Formation>,
    /// The trend, as a place in the habit's.
    pub trend: Vec<u8>,
    /// Length, metres.
    pub length: Vec<f32>,
    /// Diameter at birth, metres.
    pub primary_diameter: Vec<f32>,
    /// Diameter at the base at the recorded age, metres; written by the model's `thicken`.
    pub diameter: Vec<f32>,
    /// Diameter at the tip at the recorded age, metres; written by the model's `thicken`.
    pub diameter_tip: Vec<f32>,
    /// Azimuth of the first leaf, radians.
    pub azimuth: Vec<f32>,
    /// The first node of each run: of nodes that follow one another on one axis. An axis grown at once is one run, one
    /// that grew by the clock, between others, is several. Within a run the node before is the parent.
    pub runs: Vec<NodeId>,
}

/// How an internode was formed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Formation(u8);

impl Formation {
    /// Of a growth unit of the short type?
    pub fn is_short(self) -> bool {
        self.0 & 1 != 0
    }

    /// Made after bud break?
    pub fn is_neoformed(self) -> bool {
        self.0 & 2 != 0
    }
}

impl Nodes {
    /// How many nodes there are.
    #[inline]
    pub fn len(&self) -> usize {
        self.parent.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.parent.is_empty()
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
        self.parent.push(node.parent);
        self.axis.push(node.axis);
        self.component.push(component);
        self.birth.push(node.birth);
        self.rank.push(node.rank);
        self.unit_rank.push(node.unit_rank);
        self.formation.push(Formation(u8::from(node.short) | u8::from(node.neoformed) << 1));
        self.trend.push(node.trend);
        self.length.push(node.length);
        self.primary_diameter.push(node.diameter);
        self.diameter.push(node.diameter);
        self.diameter_tip.push(node.diameter);
        self.azimuth.push(node.azimuth);
        id
    }

    /// Adds the nodes of a fragment, half of the columns on another thread where one is free.
    pub(super) fn join(&mut self, more: &Self, joint: &Joint) {
        let Self { parent, axis, component, birth, rank, runs, .. } = self;
        let Self { unit_rank, formation, trend, length, primary_diameter, diameter, diameter_tip, azimuth, .. } = self;
        let topology = || {
            let below =
                |(place, &parent): (usize, &NodeId)| joint.below(parent, more.axis[place], more.rank[place] - 1);
            runs.extend(more.runs.iter().map(|&first| joint.node(first)));
            parent.extend(more.parent.iter().enumerate().map(below));
            axis.extend(more.axis.iter().map(|&axis| joint.axis(axis)));
            component.extend(more.component.iter().map(|&component| joint.component(component)));
            birth.extend_from_slice(&more.birth);
            rank.extend_from_slice(&more.rank);
        };
        let measures = || {
            unit_rank.extend_from_slice(&more.unit_rank);
            formation.extend_from_slice(&more.formation);
            trend.extend_from_slice(&more.trend);
            length.extend_from_slice(&more.length);
            primary_diameter.extend_from_slice(&more.primary_diameter);
            diameter.extend_from_slice(&more.diameter);
            diameter_tip.extend_from_slice(&more.diameter_tip);
            azimuth.extend_from_slice(&more.azimuth);
        };
        rayon::join(topology, measures);
    }

    pub(super) fn clear(&mut self) {
        self.parent.clear();
        self.axis.clear();
        self.component.clear();
        self.birth.clear();
        self.rank.clear();
        self.unit_rank.clear();
        self.formation.clear();
        self.trend.clear();
        self.length.clear();
        self.primary_diameter.clear();
        self.diameter.clear();
        self.diameter_tip.clear();
        self.azimuth.clear();
        self.runs.clear();
    }
}
