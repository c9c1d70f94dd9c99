//! Cuts: at a tick, everything of an axis above a rank is taken off, with all that it bears (topping, a heading cut, a
//! breakage).
//!
//! The nodes of the axis up to the rank stay; rank 0 takes the whole axis off its bearer. The apex of the axis ends
//! with the cut, if it still lived, and so do the apices of all axes that are taken. The result does not depend on the
//! order in which cuts are made: the earliest cut below a node takes it. [`crate::shed`] computes the deaths and falls
//! of branches and organs, as for any death of buds. Growth from below a cut is the model's. A plant without cuts keeps
//! an empty list.

use super::Plant;
use super::axis::ApexFate;
use super::event::EventKind;
use super::handle::AxisId;
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
}

/// The cuts of a plant.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Cuts {
    /// Sorted by axis, rank and tick.
    cuts: Vec<Cut>,
    /// For each axis the tick at which it was taken as a whole, by its own cut or with its bearer; [`NEVER`] otherwise,
    /// and for axes past its end. Empty without cuts.
    off: Vec<Tick>,
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

    /// The tick at which a cut took the node of a rank of an axis; [`NEVER`] where none did.
    #[inline]
    pub(super) fn of(&self, axis: AxisId, rank: u32) -> Tick {
        if self.cuts.is_empty() {
            return NEVER;
        }
        let own = self.on(axis).iter().filter(|cut| cut.rank < rank).map(|cut| cut.tick).min();
        own.unwrap_or(NEVER).min(self.off(axis))
    }

    /// The tick at which a cut took an axis as a whole; [`NEVER`] where none did.
    #[inline]
    pub(crate) fn off(&self, axis: AxisId) -> Tick {
        self.off.get(axis.index()).copied().unwrap_or(NEVER)
    }

    /// The highest rank of an axis that no cut has taken by `age`.
    pub(super) fn highest(&self, axis: AxisId, age: Tick) -> u32 {
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
    /// more. To be called before the plant grows past that tick; a model then finds the apices of the cut axes ended
    /// ([`ApexFate::Pruned`]). Not to be called on a fragment, which has no nodes below its axes. Cost: one scan of the
    /// axes.
    pub fn cut(&mut self, axis: AxisId, rank: u32, tick: Tick) {
        let cut = Cut { axis, rank, tick };
        if let Err(place) = self.cuts.cuts.binary_search(&cut) {
            self.cuts.cuts.insert(place, cut);
            if self.axes.apex_end[axis.index()] <= tick {
                self.note(tick, axis, EventKind::Pruned, 1);
            }
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
                .map_or(NEVER, |node| self.cuts.of(self.nodes.axis[node.index()], self.nodes.rank[node.index()]));
            let own = self.cuts.on(axis);
            let whole = own.iter().filter(|cut| cut.rank == 0).map(|cut| cut.tick).min().unwrap_or(NEVER);
            let apex = own.iter().map(|cut| cut.tick).min().unwrap_or(NEVER).min(with_bearer);
            self.cuts.off.push(with_bearer.min(whole));
            if apex < self.axes.apex_end[axis.index()] {
                self.axes.end_apex(axis, apex, ApexFate::Pruned);
                self.note(apex, axis, EventKind::Pruned, 1);
            }
            let spent = &mut self.axes.spent[axis.index()];
            *spent = apex.min(*spent);
        }
    }
}
