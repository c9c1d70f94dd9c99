//! The components of a plant that stand at an age: the one definition that pose, mechanics, meshes and tables share.
//!
//! An internode stands from its birth until its branch falls or a cut takes it, an organ from its birth until its own
//! fall or that of its branch, a bud until its apex ends. Pose and mechanics walk along the standing internodes as runs
//! of one axis: forward a parent comes before its child, backward a child before its parent. Births and deaths
//! themselves are columns, written by models and by [`crate::shed`].

use super::{AxisId, Cause, NodeId, Nodes, OrganId, Plant, Stretch};
use crate::clock::{NEVER, Tick};
use std::borrow::Cow;
use std::ops::Range;

/// Internodes that follow one another on one axis, in the order of the nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Run {
    /// The axis.
    pub axis: AxisId,
    /// The first internode.
    pub start: u32,
    /// One past the last internode that stands.
    pub end: u32,
    /// Whether the first internode is the first of its axis.
    pub begins: bool,
}

impl Run {
    /// The internodes as places in the columns.
    #[inline]
    pub fn nodes(&self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// Every run that stands at an age.
#[derive(Debug, Clone, Default)]
pub(crate) struct Standing {
    pub runs: Vec<Run>,
}

impl Standing {
    /// Finds the runs of the internodes of `plant` that appeared by `age` and have neither been shed nor cut off.
    /// Linear in the stretches that have appeared.
    pub fn find(&mut self, plant: &Plant, age: Tick) {
        self.runs.clear();
        plant.each_standing(age, |stretch| {
            let Range { start, end } = stretch.nodes();
            let begins = begins_axis(&plant.nodes, start);
            self.runs.push(Run { axis: stretch.axis, start: start as u32, end: end as u32, begins });
        });
    }
}

/// Whether a node is the first of its axis: its parent is not on it.
#[inline]
pub(crate) fn begins_axis(nodes: &Nodes, node: usize) -> bool {
    nodes.parent[node].some().is_none_or(|parent| nodes.axis[parent.index()] != nodes.axis[node])
}

impl Plant {
    /// The internodes that have appeared by `age`, along their axes, whether they stand or have fallen.
    pub fn stretches(&self, age: Tick) -> Cow<'_, [Stretch]> {
        self.appeared.read(age, &self.nodes)
    }

    /// Calls `show` for each stretch of internodes that stands at `age`, along their axes.
    #[inline]
    pub fn each_standing(&self, age: Tick, mut show: impl FnMut(Stretch)) {
        let fallen = self.fallen_by(age);
        for &stretch in self.stretches(age).iter() {
            if self.axes.shed[stretch.axis.index()] <= fallen {
                continue;
            }
            if self.cuts.is_empty() {
                show(stretch);
            } else if let Some(left) = self.left_of(stretch, fallen) {
                show(left);
            }
        }
    }

    /// The part of a stretch that cuts have left.
    fn left_of(&self, stretch: Stretch, age: Tick) -> Option<Stretch> {
        let first = self.nodes.rank[stretch.nodes().start];
        let highest = self.cuts.highest(stretch.axis, age);
        stretch.first((highest.saturating_add(1).saturating_sub(first)) as usize)
    }

    /// The tick at which an internode died: with its axis, or cut off.
    #[inline]
    pub fn death_of(&self, node: NodeId) -> Tick {
        let death = self.axes.death[self.nodes.axis[node.index()].index()];
        if self.cuts.is_empty() { death } else { death.min(self.cut_of(node)) }
    }

    /// The tick at which an internode left the plant: with its axis, or cut off.
    #[inline]
    pub fn shed_of(&self, node: NodeId) -> Tick {
        let shed = self.axes.shed[self.nodes.axis[node.index()].index()];
        if self.cuts.is_empty() { shed } else { shed.min(self.cut_of(node)) }
    }

    /// Why an internode, with its organs, dies: with its branch, or because it is cut off or harvested.
    #[inline]
    pub fn cause_of_death(&self, node: NodeId) -> Cause {
        let cut = self.cut_of(node);
        if cut == NEVER || cut > self.death_of(node) {
            return Cause::Branch;
        }
        self.cuts.cause_of(self.nodes.axis[node.index()], self.nodes.rank[node.index()])
    }

    /// The tick at which a cut took an internode; mostly [`NEVER`].
    fn cut_of(&self, node: NodeId) -> Tick {
        self.cuts.of(self.nodes.axis[node.index()], self.nodes.rank[node.index()])
    }

    /// Whether an internode is on the plant at `age`, living or dead.
    #[inline]
    pub fn stands(&self, node: NodeId, age: Tick) -> bool {
        self.nodes.birth[node.index()] <= age && self.fallen_by(age) < self.shed_of(node)
    }

    /// Whether an internode was on the plant at the end of the tick before `tick`, and no cut takes it at `tick`: what
    /// it bears can then still be picked, even where it dies or falls at `tick` by itself.
    pub(crate) fn is_in_reach(&self, node: NodeId, tick: Tick) -> bool {
        let fall = self.axes.shed[self.nodes.axis[node.index()].index()];
        self.nodes.birth[node.index()] < tick && fall >= tick && (self.cuts.is_empty() || self.cut_of(node) > tick)
    }

    /// Whether an organ is on the plant at `age`; valid after [`crate::shed`].
    #[inline]
    pub fn organ_stands(&self, organ: OrganId, age: Tick) -> bool {
        self.organs.birth[organ.index()] <= age && self.fallen_by(age) < self.organs.death[organ.index()]
    }

    /// The tick at which an organ is gone: at its own fall or that of its branch, whichever comes first.
    #[inline]
    pub fn organ_end(&self, organ: OrganId) -> Tick {
        self.organs.death[organ.index()].min(self.shed_of(self.organs.node[organ.index()]))
    }

    /// Whether an apical bud lives at `age`: it has appeared and its axis has not come to its end.
    pub fn bud_lives(&self, axis: AxisId, age: Tick) -> bool {
        self.axes.appearance[axis.index()] <= age && age < self.bud_end(axis)
    }

    /// The tick at which an apical bud is gone: when its apex ends, whatever the apex becomes, or when it falls with
    /// its branch.
    #[inline]
    pub fn bud_end(&self, axis: AxisId) -> Tick {
        self.axes.apex_end[axis.index()].min(self.axes.shed[axis.index()])
    }

    /// Whether the plant lives at `age`, which is so while any of its components lives: a bud, or an internode on whose
    /// branch an apex that has become a flower or has completed its growth is not yet spent. A plant may live on
    /// without a bud.
    #[inline]
    pub fn lives(&self, age: Tick) -> bool {
        age < self.death
    }
}
