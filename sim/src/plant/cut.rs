//! Cuts: at a tick, everything of an axis above a rank is taken off, with all that it bears (topping, a heading cut, a
//! breakage, a harvest).
//!
//! The nodes of the axis up to the rank stay; rank 0 takes the whole axis off its bearer. The apex of the axis ends
//! with the cut, if it still lived, and so do the apices of all axes that are taken. The result does not depend on the
//! order in which cuts are made: the earliest cut below a node takes it. [`crate::shed`] computes the deaths and falls
//! of branches and organs, as for any death of buds. Growth from below a cut is the model's. A plant without cuts keeps
//! an empty list.

use super::Plant;
use super::axis::ApexFate;
use super::event::EventKind;
use super::handle::{AxisId, NodeId};
use super::kind::Cause;
use crate::clock::{NEVER, Tick};

/// One cut: its axis, its height and its tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cut {
    /// The axis.
    pub axis: AxisId,
    /// The rank of the last node that stays; 0: no node stays.
    pub rank: u32,
    /// The first tick at which the part above does not stand any more.
    pub tick: Tick,
    /// What the part above is taken for.
    pub by: Taking,
}

/// What is taken off for. Of two cuts that take a part at one tick, the first in this order is its cause of death.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Taking {
    /// It is a harvest.
    Harvest,
    /// It is not wanted on the plant.
    Pruning,
}

impl Taking {
    /// The cause of death of what is taken.
    pub const fn cause(self) -> Cause {
        match self {
            Self::Harvest => Cause::Harvested,
            Self::Pruning => Cause::Pruned,
        }
    }

    /// The fate of an apex that is taken.
    const fn fate(self) -> ApexFate {
        match self {
            Self::Pruning => ApexFate::Pruned,
            Self::Harvest => ApexFate::Harvested,
        }
    }

    /// The event of an axis that is cut.
    const fn event(self) -> EventKind {
        match self {
            Self::Pruning => EventKind::Pruned,
            Self::Harvest => EventKind::Harvested,
        }
    }
}

/// When a part was taken, and what for.
type Taken = (Tick, Taking);

/// No cut took it.
const LEFT: Taken = (NEVER, Taking::Pruning);

/// The cuts of a plant.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Cuts {
    /// Sorted by axis, rank and tick.
    cuts: Vec<Cut>,
    /// For each axis when it was taken as a whole, by its own cut or with its bearer; [`LEFT`] otherwise, and for axes
    /// past its end. Empty without cuts.
    off: Vec<Taken>,
}

impl Cuts {
    /// Whether nothing was ever cut.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.cuts.is_empty()
    }

    /// Every cut, sorted by axis, rank and tick.
    pub fn all(&self) -> &[Cut] {
        &self.cuts
    }

    fn on(&self, axis: AxisId) -> &[Cut] {
        let start = self.cuts.partition_point(|cut| cut.axis < axis);
        let count = self.cuts[start..].partition_point(|cut| cut.axis == axis);
        &self.cuts[start..start + count]
    }

    /// When and for what a cut took the node of a rank of an axis.
    fn taken(&self, axis: AxisId, rank: u32) -> Taken {
        let own = self.on(axis).iter().filter(|cut| cut.rank < rank).map(|cut| (cut.tick, cut.by)).min();
        own.unwrap_or(LEFT).min(self.whole(axis))
    }

    fn whole(&self, axis: AxisId) -> Taken {
        self.off.get(axis.index()).copied().unwrap_or(LEFT)
    }

    /// The tick at which a cut took the node of a rank of an axis; [`NEVER`] where none did.
    #[inline]
    pub(super) fn of(&self, axis: AxisId, rank: u32) -> Tick {
        if self.cuts.is_empty() { NEVER } else { self.taken(axis, rank).0 }
    }

    /// The cause of death of what the earliest cut below a node took.
    pub(super) fn cause_of(&self, axis: AxisId, rank: u32) -> Cause {
        self.taken(axis, rank).1.cause()
    }

    /// The tick at which a cut took an axis as a whole; [`NEVER`] where none did.
    #[inline]
    pub(crate) fn off(&self, axis: AxisId) -> Tick {
        self.whole(axis).0
    }

    /// The highest rank of an axis that no cut has taken by `age`.
    pub(crate) fn highest(&self, axis: AxisId, age: Tick) -> u32 {
        let own = self.on(axis).iter().filter(|cut| cut.tick <= age).map(|cut| cut.rank).min();
        if self.off(axis) <= age { 0 } else { own.unwrap_or(u32::MAX) }
    }

    pub(super) fn clear(&mut self) {
        self.cuts.clear();
        self.off.clear();
    }
}

impl Plant {
    /// Cuts off everything of an axis above the node of `rank`, with all that it bears: at `tick` it does not stand any
    /// more. As [`Plant::cut_all`] of one pruning cut.
    pub fn cut(&mut self, axis: AxisId, rank: u32, tick: Tick) {
        self.cut_all(&[Cut { axis, rank, tick, by: Taking::Pruning }]);
    }

    /// Makes cuts, each of which takes what is above the node of its rank, with all that it bears: at its tick that
    /// does not stand any more. To be called before the plant grows past these ticks; a model then finds the apices of
    /// the cut axes ended ([`ApexFate::Pruned`], [`ApexFate::Harvested`]). Not to be called on a fragment, which has no
    /// nodes below its axes. Cost: one scan of the axes and a sort of the cuts.
    pub fn cut_all(&mut self, cuts: &[Cut]) {
        let known = self.cuts.cuts.clone();
        for cut in cuts.iter().filter(|cut| known.binary_search(cut).is_err()) {
            if self.axes.apex_end[cut.axis.index()] <= cut.tick {
                self.note(cut.tick, cut.axis, cut.by.event(), 1);
            }
            self.cuts.cuts.push(*cut);
        }
        if self.cuts.cuts.len() > known.len() {
            self.cuts.cuts.sort_unstable();
            self.cuts.cuts.dedup();
            self.end_cut_apices();
        }
    }

    /// Ends the apex of every axis that was cut, or was taken with its bearer.
    pub(crate) fn end_cut_apices(&mut self) {
        if self.cuts.is_empty() {
            return;
        }
        self.cuts.off.clear();
        for axis in (0..self.axes.len() as u32).map(AxisId) {
            let with_bearer = self.axes.bearer[axis.index()]
                .some()
                .map_or(LEFT, |node| self.cuts.taken(self.nodes.axis[node.index()], self.nodes.rank[node.index()]));
            let own = self.cuts.on(axis);
            let at = |cut: &Cut| (cut.tick, cut.by);
            let whole = own.iter().filter(|cut| cut.rank == 0).map(at).min().unwrap_or(LEFT);
            let (apex, by) = own.iter().map(at).min().unwrap_or(LEFT).min(with_bearer);
            self.cuts.off.push(with_bearer.min(whole));
            if apex < self.axes.apex_end[axis.index()] {
                self.axes.end_apex(axis, apex, by.fate());
                self.note(apex, axis, by.event(), 1);
            }
            let spent = &mut self.axes.spent[axis.index()];
            *spent = apex.min(*spent);
        }
    }

    /// The last nodes that cuts of the tick `tick` have left of axes: of each axis that was cut in its course its last
    /// node, and of each that was taken off as a whole the node that bore it, where that is the end of its axis. Where
    /// the axis goes on above the node, its apex keeps ruling the buds below. Nothing grows from wood that is dead, or
    /// below a cut that took nothing. In the order of the axes of the nodes.
    pub fn stumps(&self, tick: Tick) -> Vec<NodeId> {
        let mut stumps = Vec::new();
        for cut in self.cuts.cuts.iter().filter(|cut| cut.tick == tick) {
            let before = self.cuts.on(cut.axis).iter().filter(|other| other.tick < tick).map(|other| other.rank).min();
            if before.is_some_and(|rank| rank <= cut.rank) {
                continue;
            }
            let node = match cut.rank {
                0 => self.axes.bearer[cut.axis.index()].some().filter(|node| self.is_last(*node, tick)),
                rank => self.node_at(cut.axis, rank),
            };
            let Some(node) = node else { continue };
            let (axis, rank) = (self.nodes.axis[node.index()], self.nodes.rank[node.index()]);
            let living = self.axes.death[axis.index()] >= tick && self.stands(node, tick);
            if living && rank <= self.cuts.highest(axis, tick) {
                stumps.push(node);
            }
        }
        stumps.sort_unstable();
        stumps.dedup();
        stumps
    }

    /// Whether nothing of its axis stands, or can grow, above a node at `tick`.
    fn is_last(&self, node: NodeId, tick: Tick) -> bool {
        let axis = self.nodes.axis[node.index()];
        let rank = self.nodes.rank[node.index()];
        let last = self.axes.last_node[axis.index()] == node && self.axes.apex_end[axis.index()] <= tick;
        last || self.cuts.highest(axis, tick) <= rank
    }

    /// The node of a rank of an axis. Linear in the nodes above it.
    fn node_at(&self, axis: AxisId, rank: u32) -> Option<NodeId> {
        let mut node = self.axes.last_node[axis.index()].some()?;
        while self.nodes.axis[node.index()] == axis {
            if self.nodes.rank[node.index()] <= rank {
                return Some(node);
            }
            node = self.nodes.parent[node.index()].some()?;
        }
        None
    }
}
