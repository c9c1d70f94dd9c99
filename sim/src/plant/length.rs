//! The lengths of internodes at an age, where internodes go on to grow after they have appeared, or a model has
//! rewritten their length.
//!
//! The length at an age is the last rewritten one, else that of the column `length`, times the share of the internode's
//! look at its own age ([`super::InternodeLook::expansion`]). A plant without either reads its column and stores
//! nothing else. [`Plant::posed_lengths`] has the lengths at the age of the frames; pose, loads, meshes and tables read
//! these, node by node without a branch.

use super::Plant;
use super::handle::NodeId;
use super::joint::Joint;
use crate::clock::Tick;

/// The lengths that a model has rewritten.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Rewritten {
    /// Sorted by node and tick.
    changes: Vec<Change>,
}

/// A length from a tick on.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Change {
    node: NodeId,
    tick: Tick,
    length: f32,
}

impl Rewritten {
    #[inline]
    fn at(&self, node: NodeId, age: Tick) -> Option<f32> {
        if self.changes.is_empty() {
            return None;
        }
        let after = self.changes.partition_point(|change| (change.node, change.tick) <= (node, age));
        let last = self.changes[..after].last()?;
        (last.node == node).then_some(last.length)
    }

    pub(super) fn join(&mut self, more: &Self, joint: &Joint) {
        self.changes.extend(more.changes.iter().map(|change| Change { node: joint.node(change.node), ..*change }));
        self.changes.sort_by_key(|change| (change.node, change.tick));
    }

    pub(super) fn clear(&mut self) {
        self.changes.clear();
    }
}

impl Plant {
    /// The length of an internode at `age`, m. Logarithmic in the number of rewritten lengths.
    pub fn length(&self, node: NodeId, age: Tick) -> f32 {
        let full = self.rewritten.at(node, age).unwrap_or(self.nodes.length[node.index()]);
        full * self.look_of_node(node).share(age.saturating_sub(self.nodes.birth[node.index()]))
    }

    /// Rewrites the full length of an internode from `tick` on, m; at earlier ages it keeps its length. A later call
    /// replaces an earlier call for the same tick.
    pub fn rewrite_length(&mut self, node: NodeId, tick: Tick, length: f32) {
        let changes = &mut self.rewritten.changes;
        match changes.binary_search_by_key(&(node, tick), |change| (change.node, change.tick)) {
            Ok(place) => changes[place].length = length,
            Err(place) => changes.insert(place, Change { node, tick, length }),
        }
        self.frames.clear();
    }

    /// The length of an internode at the age of the frames, m.
    #[inline]
    pub fn posed_length(&self, node: NodeId) -> f32 {
        self.frames.lengths.get(node.index()).copied().unwrap_or(self.nodes.length[node.index()])
    }

    /// The lengths of all internodes at the age of the frames, m.
    #[inline]
    pub fn posed_lengths(&self) -> &[f32] {
        self.frames.lengths(&self.nodes)
    }

    /// Whether an internode may have different lengths at the ages `one` and `other`.
    pub(crate) fn lengths_differ(&self, one: Tick, other: Tick) -> bool {
        let span = one.min(other) + 1..=one.max(other);
        let rewritten = self.rewritten.changes.iter().any(|change| span.contains(&change.tick));
        rewritten || (one != other && self.habit.looks.lengthen())
    }

    /// Whether the length of any internode differs from its column at some age.
    pub(crate) fn lengths_change(&self) -> bool {
        !self.rewritten.changes.is_empty() || self.habit.looks.lengthen()
    }

    /// Stores the lengths at `age` in the frames; none where they are the lengths in the column. Between two ticks they
    /// are there already.
    pub(crate) fn measure(&mut self, age: Tick) {
        if self.partway.is_some() {
            return;
        }
        let mut lengths = std::mem::take(&mut self.frames.lengths);
        lengths.clear();
        if self.lengths_change() {
            lengths.extend_from_slice(&self.nodes.length);
            for stretch in self.stretches(age).iter() {
                // The lengths of a stretch without growth are those of the column.
                if self.own_looks.is_empty() && self.look_of(stretch.axis).expansion.is_empty() {
                    continue;
                }
                stretch.nodes().for_each(|node| lengths[node] = self.length(NodeId(node as u32), age));
            }
            for Change { node, .. } in &self.rewritten.changes {
                if let Some(length) = lengths.get_mut(node.index()) {
                    *length = self.length(*node, age);
                }
            }
        }
        self.frames.lengths = lengths;
    }
}
