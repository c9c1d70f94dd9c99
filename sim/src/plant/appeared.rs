//! The internodes that have appeared by an age, as stretches of one axis: found once an age for every pass along them.
//!
//! A large plant has many axes, and when it is young most of them have not appeared: a pass that looked at each axis
//! again would spend most of its time on those.

use super::{AxisId, Nodes};
use crate::clock::Tick;
use std::borrow::Cow;
use std::ops::Range;

/// Internodes that follow one another on one axis, in the order of the nodes; at least one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stretch {
    /// The axis.
    pub axis: AxisId,
    start: u32,
    end: u32,
}

impl Stretch {
    /// The internodes as places in the columns.
    #[inline]
    pub fn nodes(&self) -> Range<usize> {
        self.start as usize..self.end as usize
    }

    /// Its first internodes, at most so many; `None` of none.
    pub(super) fn first(self, count: usize) -> Option<Self> {
        let count = count.min(self.nodes().len());
        (count > 0).then(|| Self { end: self.start + count as u32, ..self })
    }
}

/// The stretches of one plant at the age at which they were last asked for.
#[derive(Debug, Clone, Default)]
pub struct Appeared {
    /// The age, and the nodes that there were.
    of: Option<(Tick, usize)>,
    stretches: Vec<Stretch>,
}

impl Appeared {
    /// The stretches of the internodes among `nodes` that have appeared by `age`; kept until another age is asked for,
    /// or a node is added.
    pub fn by(&mut self, age: Tick, nodes: &Nodes) -> &[Stretch] {
        if !self.knows(age, nodes) {
            self.of = Some((age, nodes.len()));
            self.stretches.clear();
            self.stretches.extend(stretches(age, nodes));
        }
        &self.stretches
    }

    /// The stretches of a plant that cannot be changed: those of the last call of [`Appeared::by`] where they are of
    /// this age, else found anew.
    pub(super) fn read(&self, age: Tick, nodes: &Nodes) -> Cow<'_, [Stretch]> {
        if self.knows(age, nodes) {
            Cow::Borrowed(&self.stretches)
        } else {
            Cow::Owned(stretches(age, nodes).collect())
        }
    }

    fn knows(&self, age: Tick, nodes: &Nodes) -> bool {
        self.of == Some((age, nodes.len()))
    }

    pub(super) fn clear(&mut self) {
        self.of = None;
        self.stretches.clear();
    }
}

/// The part of each run that has appeared: its older nodes come first.
fn stretches(age: Tick, nodes: &Nodes) -> impl Iterator<Item = Stretch> {
    let part = move |run: usize| {
        let Range { start, end } = nodes.run(run);
        let whole = nodes.birth[end - 1] <= age;
        let born = if whole { end - start } else { nodes.birth[start..end].partition_point(|&birth| birth <= age) };
        (born > 0).then(|| Stretch { axis: nodes.axis[start], start: start as u32, end: (start + born) as u32 })
    };
    (0..nodes.runs.len()).filter_map(part)
}
