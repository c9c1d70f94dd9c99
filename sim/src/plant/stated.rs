//! Rest frames that a model, or an event, states: of nodes and axes, instead of insertion, phyllotaxis and trend.
//!
//! A node states how it is turned in the frame of its parent node; the first node of an axis, or its bud before that,
//! in the frame of the bearing node; an axis without a bearer in the frame of the ground, whose heading is the upward
//! vertical and whose upper side faces along X. A frame stands at the tip of its internode; a start elsewhere is an
//! offset in the coordinates of that frame ([`crate::rotation`]). An axis and its first node share one entry. A change
//! holds from its tick on. Nodes without a statement follow insertion and trend, also in a plant in which others state;
//! a plant that states nothing has empty columns. Absent: the pose, which is the work of [`crate::pose`] and
//! [`crate::mechanics`].

use super::Plant;
use super::handle::{AxisId, NodeId};
use super::joint::Joint;
use super::node::Nodes;
use super::paged::Paged;
use super::rare::Rare;
use crate::clock::Tick;
use crate::rotation::Rotation;

/// The statement of the rest frame of a node or of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Rest {
    /// No statement: the frame follows insertion, phyllotaxis and trend.
    #[default]
    Follows,
    /// The rotation in the frame of the bearer.
    Turned(Rotation),
    /// The heading in the frame of the plant. The upper side is that of the bearer, turned no more than the heading is.
    /// A heading of length 0 is that of the bearer.
    Heading([f32; 3]),
}

/// A part of a plant that has a rest frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Part {
    /// An axis, from its bud on: the frame of its first node.
    Axis(AxisId),
    /// A node.
    Node(NodeId),
}

impl From<AxisId> for Part {
    fn from(axis: AxisId) -> Self {
        Self::Axis(axis)
    }
}

impl From<NodeId> for Part {
    fn from(node: NodeId) -> Self {
        Self::Node(node)
    }
}

/// A rest frame from a tick on.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Change {
    part: Part,
    tick: Tick,
    rest: Rest,
}

/// All statements of rest frames of one plant.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StatedFrames {
    axes: Column,
    nodes: Column,
    /// Sorted by part and tick.
    changes: Vec<Change>,
}

/// The statements of axes, or of nodes, that hold from their birth on.
#[derive(Debug, Clone, Default, PartialEq)]
struct Column {
    /// Unit quaternions; all 0 where none is stated.
    turns: Paged<[f64; 4]>,
    /// Directions in the frame of the plant; all 0 where none is stated.
    headings: Rare<[f32; 3]>,
    /// Offsets in the frame of the bearer, metres.
    starts: Rare<[f32; 3]>,
}

impl Column {
    #[inline]
    fn rest(&self, place: usize) -> Rest {
        let turn = self.turns.at(place);
        if turn != [0.0; 4] {
            return Rest::Turned(Rotation::of_parts(turn));
        }
        let heading = self.headings.at(place);
        if heading == [0.0; 3] { Rest::Follows } else { Rest::Heading(heading) }
    }

    #[inline]
    fn state(&mut self, place: usize, rest: Rest) {
        let (turn, heading) = match rest {
            Rest::Follows => ([0.0; 4], [0.0; 3]),
            Rest::Turned(rotation) => (rotation.parts(), [0.0; 3]),
            Rest::Heading(heading) => ([0.0; 4], heading),
        };
        if turn != [0.0; 4] || !self.turns.is_empty() {
            self.turns.set(place, turn);
        }
        if heading != [0.0; 3] || !self.headings.is_empty() {
            self.headings.set(place, heading);
        }
    }

    fn is_empty(&self) -> bool {
        self.turns.is_empty() && self.headings.is_empty() && self.starts.is_empty()
    }

    fn join(&mut self, more: &Self, place: impl Fn(usize) -> usize) {
        self.turns.join(&more.turns, &place);
        self.headings.join(&more.headings, &place);
        self.starts.join(&more.starts, &place);
    }

    fn clear(&mut self) {
        self.turns.clear();
        self.headings.clear();
        self.starts.clear();
    }
}

impl StatedFrames {
    /// Whether nothing is stated.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.axes.is_empty() && self.nodes.is_empty() && self.changes.is_empty()
    }

    /// The statement of an axis, or of a node that is not the first of its axis, at `age`.
    #[inline]
    pub(crate) fn rest(&self, part: Part, age: Tick) -> Rest {
        if let Some(rest) = self.changed(part, age) {
            return rest;
        }
        match part {
            Part::Axis(axis) => self.axes.rest(axis.index()),
            Part::Node(node) => self.nodes.rest(node.index()),
        }
    }

    #[inline]
    fn changed(&self, part: Part, age: Tick) -> Option<Rest> {
        if self.changes.is_empty() {
            return None;
        }
        let after = self.changes.partition_point(|change| (change.part, change.tick) <= (part, age));
        let last = self.changes[..after].last()?;
        (last.part == part).then_some(last.rest)
    }

    /// The start of a part: an offset from the tip of the bearer, in the bearer's frame.
    #[inline]
    pub(crate) fn start(&self, part: Part) -> [f32; 3] {
        match part {
            Part::Axis(axis) => self.axes.starts.at(axis.index()),
            Part::Node(node) => self.nodes.starts.at(node.index()),
        }
    }

    /// Whether any axis begins elsewhere than at the tip of its bearer.
    #[inline]
    pub(crate) fn has_starts_of_axes(&self) -> bool {
        !self.axes.starts.is_empty()
    }

    /// Whether any rest frame differs between the ages `one` and `other`.
    pub(crate) fn differ(&self, one: Tick, other: Tick) -> bool {
        let span = one.min(other) + 1..=one.max(other);
        self.changes.iter().any(|change| span.contains(&change.tick))
    }

    pub(super) fn join(&mut self, more: &Self, joint: &Joint) {
        if more.is_empty() {
            return;
        }
        self.axes.join(&more.axes, |axis| joint.axis(AxisId(axis as u32)).index());
        self.nodes.join(&more.nodes, |node| joint.node(NodeId(node as u32)).index());
        self.changes.extend(more.changes.iter().map(|change| {
            let part = match change.part {
                Part::Axis(axis) => Part::Axis(joint.axis(axis)),
                Part::Node(node) => Part::Node(joint.node(node)),
            };
            Change { part, ..*change }
        }));
        self.changes.sort_by_key(|change| (change.part, change.tick));
    }

    pub(super) fn clear(&mut self) {
        self.axes.clear();
        self.nodes.clear();
        self.changes.clear();
    }
}

/// The part under which statements are kept: for the first node of an axis the axis.
#[inline]
fn one_entry(nodes: &Nodes, part: Part) -> Part {
    match part {
        Part::Node(node) if nodes.rank[node.index()] == 1 => Part::Axis(nodes.axis[node.index()]),
        part => part,
    }
}

impl Plant {
    /// States the rest frame of a node or an axis, for all ages.
    #[inline]
    pub fn state_rest(&mut self, part: impl Into<Part>, rest: Rest) {
        let part = one_entry(&self.nodes, part.into());
        match part {
            Part::Axis(axis) => self.stated.axes.state(axis.index(), rest),
            Part::Node(node) => self.stated.nodes.state(node.index(), rest),
        }
        self.pose_again(part);
    }

    /// Turns a node, or an axis with its first node, further within the frame that it states, for all ages; a part that
    /// states no turn stays as it is.
    pub fn turn_further(&mut self, part: impl Into<Part>, by: Rotation) {
        let part = one_entry(&self.nodes, part.into());
        let (column, place) = match part {
            Part::Axis(axis) => (&mut self.stated.axes, axis.index()),
            Part::Node(node) => (&mut self.stated.nodes, node.index()),
        };
        if let Rest::Turned(turn) = column.rest(place) {
            column.state(place, Rest::Turned(turn.then(by)));
            self.pose_again(part);
        }
    }

    /// States both how a node or an axis is turned in the frame of its bearer and where it begins, as
    /// [`Plant::state_rest`] and [`Plant::state_start`] do.
    #[inline]
    pub fn state_frame(&mut self, part: impl Into<Part>, turn: Rotation, offset: [f32; 3]) {
        let part = one_entry(&self.nodes, part.into());
        let (column, place) = match part {
            Part::Axis(axis) => (&mut self.stated.axes, axis.index()),
            Part::Node(node) => (&mut self.stated.nodes, node.index()),
        };
        column.state(place, Rest::Turned(turn));
        if offset != [0.0; 3] || !column.starts.is_empty() {
            column.starts.set(place, offset);
        }
        self.pose_again(part);
    }

    /// Forgets all frames if the frame of `part` may have been made.
    #[inline]
    fn pose_again(&mut self, part: Part) {
        let appeared = match part {
            Part::Axis(axis) => self.axes.appearance[axis.index()],
            Part::Node(node) => self.nodes.birth[node.index()],
        };
        if appeared < self.frames.posed {
            self.frames.clear();
        }
    }

    /// States where a node or an axis begins, for all ages: an offset from the tip of its bearer, metres, along the
    /// bearer's heading, to its left and to its upper side. A child in the middle of its bearer begins half of the
    /// bearer's length behind its tip.
    pub fn state_start(&mut self, part: impl Into<Part>, offset: [f32; 3]) {
        let part = one_entry(&self.nodes, part.into());
        let (column, place) = match part {
            Part::Axis(axis) => (&mut self.stated.axes.starts, axis.index()),
            Part::Node(node) => (&mut self.stated.nodes.starts, node.index()),
        };
        if offset != [0.0; 3] || !column.is_empty() {
            column.set(place, offset);
        }
        self.pose_again(part);
    }

    /// Changes a rest frame from `tick` on; earlier ages keep theirs. A later call replaces an earlier call for the
    /// same tick.
    pub fn change_rest(&mut self, part: impl Into<Part>, tick: Tick, rest: Rest) {
        let part = one_entry(&self.nodes, part.into());
        let changes = &mut self.stated.changes;
        match changes.binary_search_by_key(&(part, tick), |change| (change.part, change.tick)) {
            Ok(place) => changes[place].rest = rest,
            Err(place) => changes.insert(place, Change { part, tick, rest }),
        }
        self.frames.clear();
    }

    /// Changes many rest frames from `tick` on, each part once, as [`Plant::change_rest`] does one by one. The frames
    /// of the plant stay as they are until it is posed again.
    pub fn change_rests(&mut self, tick: Tick, rests: impl IntoIterator<Item = (Part, Rest)>) {
        let nodes = &self.nodes;
        let change = |(part, rest)| Change { part: one_entry(nodes, part), tick, rest };
        let mut new: Vec<Change> = rests.into_iter().map(change).collect();
        new.sort_by_key(|change| change.part);
        let is_new = |part: &Part| new.binary_search_by_key(part, |change| change.part).is_ok();
        let changes = &mut self.stated.changes;
        changes.retain(|change| change.tick != tick || !is_new(&change.part));
        changes.append(&mut new);
        changes.sort_by_key(|change| (change.part, change.tick));
        self.frames.make_anew();
    }

    /// The statement of the rest frame of a node or an axis at `age`; for the first node of an axis that of the axis.
    pub fn rest_of(&self, part: impl Into<Part>, age: Tick) -> Rest {
        self.stated.rest(one_entry(&self.nodes, part.into()), age)
    }

    /// The start of a node or an axis, as given to [`Plant::state_start`]; zero where none is stated.
    pub fn start_of(&self, part: impl Into<Part>) -> [f32; 3] {
        self.stated.start(one_entry(&self.nodes, part.into()))
    }
}
