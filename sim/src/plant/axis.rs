//! Axes, each the work of one apical bud (de Reffye 1988 §2).
//!
//! Orders count from the trunk, 1. Monopodial and sympodial growth are told apart by the origin of an axis. Absent: the
//! laws by which apices end, what a model remembers of a living bud, and the pose of axes.

use super::handle::{AxisId, NodeId};
use super::joint::Joint;
use crate::clock::{NEVER, Tick};
use crate::key::LineageKey;
use std::ops::Range;

/// How an axis came to be; monopodial and sympodial growth are told apart by this, never by looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Origin {
    /// Out of the seed.
    Seed = 0,
    /// Out of an axillary bud, one order above its bearing axis.
    Axillary = 1,
    /// In the place of an ended apex, of the same order: sympodial growth.
    Relay = 2,
    /// Out of a dormant bud released by the loss of an apex, of the bearing axis's order.
    Traumatic = 3,
    /// Out of a reiteration bud: a young tree on the old one.
    Adaptive = 4,
    /// Out of an apex that divided into equal axes of its order.
    Fork = 5,
}

impl Origin {
    /// Every origin, in the order of their numbers.
    pub const ALL: [Self; 6] = [Self::Seed, Self::Axillary, Self::Relay, Self::Traumatic, Self::Adaptive, Self::Fork];

    /// The origin as it stands in tables.
    pub const fn tag(self) -> &'static str {
        match self {
            Self::Seed => "seed",
            Self::Axillary => "axillary",
            Self::Relay => "relay",
            Self::Traumatic => "traumatic_reiteration",
            Self::Adaptive => "adaptive_reiteration",
            Self::Fork => "fork",
        }
    }
}

/// What became of an apical bud.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum ApexFate {
    /// It lives.
    Alive = 0,
    /// It died by the mortality test.
    Died = 1,
    /// It became a flower.
    Flowered = 2,
    /// It had made all its growth units.
    Completed = 3,
    /// Something from outside killed it.
    Killed = 4,
    /// It was cut off.
    Pruned = 5,
}

/// What a new axis starts from.
#[derive(Debug, Clone, Copy)]
pub struct NewAxis {
    /// The node that bears it; `None` for the axis of the seed.
    pub bearer: Option<NodeId>,
    /// The hash of its path from the seed.
    pub key: LineageKey,
    /// Its order, from 1.
    pub order: u8,
    /// How it came to be.
    pub origin: Origin,
    /// Its position among the buds of its node, from 0.
    pub position: u16,
    /// Whether it came as one of a set of relays or forks of which another was the first.
    pub follows: bool,
    /// The named state in which it starts, as the model numbers them.
    pub state: u8,
    /// The tick at which its bud appeared.
    pub appearance: Tick,
    /// The tick at which its own life began: the appearance and the delay of a proleptic bud. Dimension counts from it.
    pub birth: Tick,
    /// Around the bearing axis, in radians from the bearing node's reference direction.
    pub azimuth: f32,
    /// Between the bearing axis and this one, in radians.
    pub insertion: f32,
    /// The ticks from the death of its branch to the fall; [`NEVER`] where dead wood stays.
    pub shed_after: Tick,
}

impl NewAxis {
    /// The axis that grows out of the seed, straight up; its wood stays.
    pub const OF_THE_SEED: Self = Self {
        bearer: None,
        key: LineageKey::SEED,
        order: 1,
        origin: Origin::Seed,
        position: 0,
        follows: false,
        state: 0,
        appearance: 0,
        birth: 0,
        azimuth: 0.0,
        insertion: 0.0,
        shed_after: NEVER,
    };
}

/// The columns of the axes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Axes {
    /// The bearing node; [`NodeId::NONE`] for the axis of the seed.
    pub bearer: Vec<NodeId>,
    /// The component number of the apical bud.
    pub component: Vec<u32>,
    /// The lineage key.
    pub key: Vec<LineageKey>,
    /// The order, from 1.
    pub order: Vec<u8>,
    /// How the axis came to be.
    pub origin: Vec<Origin>,
    /// The position among the buds of the bearing node.
    pub position: Vec<u16>,
    /// Whether the axis came as one of a set of relays or forks of which another was the first: it does not lead its
    /// set.
    pub follows: Vec<bool>,
    /// The state in which the axis started.
    pub state: Vec<u8>,
    /// The tick at which the bud appeared.
    pub appearance: Vec<Tick>,
    /// The tick from which dimension counts.
    pub birth: Vec<Tick>,
    /// Azimuth around the bearing axis, radians.
    pub azimuth: Vec<f32>,
    /// Insertion angle, radians.
    pub insertion: Vec<f32>,
    /// The ticks from the death of the branch to its fall; [`NEVER`] where dead wood stays.
    pub shed_after: Vec<Tick>,
    /// The last node so far; [`NodeId::NONE`] before the first.
    pub last_node: Vec<NodeId>,
    /// The tick at which the apex ended; [`NEVER`] while it lives.
    pub apex_end: Vec<Tick>,
    /// How the apex ended.
    pub apex_fate: Vec<ApexFate>,
    /// The tick at which what the apex became is past: the end of the apex, or the fall of its terminal flower and
    /// fruit.
    pub spent: Vec<Tick>,
    /// The tick at which every bud of the branch is dead; written by [`crate::shed`].
    pub death: Vec<Tick>,
    /// The tick at which the branch leaves the plant; written by [`crate::shed`].
    pub shed: Vec<Tick>,
}

impl Axes {
    /// How many axes there are.
    #[inline]
    pub fn len(&self) -> usize {
        self.bearer.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.bearer.is_empty()
    }

    /// The last tick of an apex, with what became of it.
    pub fn end_apex(&mut self, axis: AxisId, tick: Tick, fate: ApexFate) {
        self.apex_end[axis.index()] = tick;
        self.apex_fate[axis.index()] = fate;
        self.spent[axis.index()] = tick;
    }

    pub(super) fn push(&mut self, axis: NewAxis, component: u32) -> AxisId {
        let id = AxisId(self.len() as u32);
        self.bearer.push(axis.bearer.unwrap_or(NodeId::NONE));
        self.component.push(component);
        self.key.push(axis.key);
        self.order.push(axis.order);
        self.origin.push(axis.origin);
        self.position.push(axis.position);
        self.follows.push(axis.follows);
        self.state.push(axis.state);
        self.appearance.push(axis.appearance);
        self.birth.push(axis.birth);
        self.azimuth.push(axis.azimuth);
        self.insertion.push(axis.insertion);
        self.shed_after.push(axis.shed_after);
        self.last_node.push(NodeId::NONE);
        self.apex_end.push(NEVER);
        self.apex_fate.push(ApexFate::Alive);
        self.spent.push(NEVER);
        self.death.push(NEVER);
        self.shed.push(NEVER);
        id
    }

    #[inline]
    pub(super) fn grown(&mut self, axis: AxisId, node: NodeId) {
        self.last_node[axis.index()] = node;
    }

    /// Copies of some of the axes.
    pub(super) fn copied(&self, taken: Range<usize>) -> Self {
        Self {
            bearer: self.bearer[taken.clone()].to_vec(),
            component: self.component[taken.clone()].to_vec(),
            key: self.key[taken.clone()].to_vec(),
            order: self.order[taken.clone()].to_vec(),
            origin: self.origin[taken.clone()].to_vec(),
            position: self.position[taken.clone()].to_vec(),
            follows: self.follows[taken.clone()].to_vec(),
            state: self.state[taken.clone()].to_vec(),
            appearance: self.appearance[taken.clone()].to_vec(),
            birth: self.birth[taken.clone()].to_vec(),
            azimuth: self.azimuth[taken.clone()].to_vec(),
            insertion: self.insertion[taken.clone()].to_vec(),
            shed_after: self.shed_after[taken.clone()].to_vec(),
            last_node: self.last_node[taken.clone()].to_vec(),
            apex_end: self.apex_end[taken.clone()].to_vec(),
            apex_fate: self.apex_fate[taken.clone()].to_vec(),
            spent: self.spent[taken.clone()].to_vec(),
            death: self.death[taken.clone()].to_vec(),
            shed: self.shed[taken].to_vec(),
        }
    }

    /// Takes from a fragment what has become of the axes that it was given, and adds those that arose in it.
    pub(super) fn join(&mut self, more: &Self, taken: Range<usize>, joint: &Joint) {
        let new = taken.len()..more.len();
        for (axis, grown) in taken.zip(0..) {
            self.last_node[axis] = joint.node(more.last_node[grown]);
            self.apex_end[axis] = more.apex_end[grown];
            self.apex_fate[axis] = more.apex_fate[grown];
            self.spent[axis] = more.spent[grown];
        }
        self.bearer.extend(more.bearer[new.clone()].iter().map(|&node| joint.node(node)));
        self.component.extend(more.component[new.clone()].iter().map(|&component| joint.component(component)));
        self.key.extend_from_slice(&more.key[new.clone()]);
        self.order.extend_from_slice(&more.order[new.clone()]);
        self.origin.extend_from_slice(&more.origin[new.clone()]);
        self.position.extend_from_slice(&more.position[new.clone()]);
        self.follows.extend_from_slice(&more.follows[new.clone()]);
        self.state.extend_from_slice(&more.state[new.clone()]);
        self.appearance.extend_from_slice(&more.appearance[new.clone()]);
        self.birth.extend_from_slice(&more.birth[new.clone()]);
        self.azimuth.extend_from_slice(&more.azimuth[new.clone()]);
        self.insertion.extend_from_slice(&more.insertion[new.clone()]);
        self.shed_after.extend_from_slice(&more.shed_after[new.clone()]);
        self.last_node.extend(more.last_node[new.clone()].iter().map(|&node| joint.node(node)));
        self.apex_end.extend_from_slice(&more.apex_end[new.clone()]);
        self.apex_fate.extend_from_slice(&more.apex_fate[new.clone()]);
        self.spent.extend_from_slice(&more.spent[new.clone()]);
        self.death.extend_from_slice(&more.death[new.clone()]);
        self.shed.extend_from_slice(&more.shed[new]);
    }

    pub(super) fn clear(&mut self) {
        let Self { bearer, component, key, order, origin, position, state, appearance, birth, .. } = self;
        bearer.clear();
        component.clear();
        key.clear();
        order.clear();
        origin.clear();
        position.clear();
        state.clear();
        appearance.clear();
        birth.clear();
        self.follows.clear();
        self.azimuth.clear();
        self.insertion.clear();
        self.shed_after.clear();
        self.last_node.clear();
        self.apex_end.clear();
        self.apex_fate.clear();
        self.spent.clear();
        self.death.clear();
        self.shed.clear();
    }
}
