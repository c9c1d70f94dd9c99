//! The internodes that have appeared by an age, as stretches of one axis: computed once for an age and read by every
//! pass along the internodes.
//!
//! A large plant has many axes, and when it is young most of them have not appeared: a pass over all axes would spend
//! most of its time on axes without internodes.

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

    /// Its first `count` internodes; `None` where `count` is 0.
    pub(super) fn first(self, count: usize) -> Option<Self> {
        let count = count.min(self.nodes().len());
        (count > 0).then(|| Self { end: self.start + count as u32, ..self })
    }
}

/// The stretches of one plant at the last age for which they were computed.
#[derive(Debug, Clone, Default)]
pub struct Appeared {
    /// The age, and the number of nodes at the time.
    of: Option<(Tick, usize)>,
    stretches: Vec<Stretch>,
}

impl Appeared {
    /// The stretches of the internodes among `nodes` that have appeared by `age`. Computed in time linear in the runs
    /// of nodes and kept until the age changes or a node is added.
    pub fn by(&mut self, age: Tick, nodes: &Nodes) -> &[Stretch] {
        if !self.knows(age, nodes) {
            self.of = Some((age, nodes.len()));
            self.stretches.clear();
            self.stretches.extend(stretches(age, nodes));
        }
        &self.stretches
    }

    /// The stretches of [`Appeared::by`] where the plant cannot be changed: borrowed if they are kept, else computed
    /// anew.
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

/// The part of each run of nodes that has appeared: the older nodes of a run come first.
fn stretches(age: Tick, nodes: &Nodes) -> impl Iterator<Item = Stretch> {
    let part = move |run: usize| {
        let Range { start, end } = nodes.run(run);
        let whole = nodes.birth[end - 1] <= age;
        let born = if whole { end - start } else { nodes.birth[start..end].partition_point(|&birth| birth <= age) };
        (born > 0).then(|| Stretch { axis: nodes.axis[start], start: start as u32, end: (start + born) as u32 })
    };
    (0..nodes.runs.len()).filter_map(part)
}
