//! Axes, each the work of one apical bud (de Reffye 1988 §2).
//!
//! Orders count from the trunk, 1. Monopodial and sympodial growth differ in the origin of an axis. Absent: the laws by
//! which apices end, a model's own data on living buds, and the pose of axes.

use super::columns::columns;
use super::handle::{AxisId, NodeId};
use super::joint::Joint;
use super::kind::Cause;
use crate::clock::{NEVER, Tick};
use crate::key::LineageKey;

/// How an axis came to be. Monopodial and sympodial growth differ in this, not in their looks.
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

/// The fate of an apical bud.
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
    /// A cause outside the plant killed it.
    Killed = 4,
    /// It was cut off.
    Pruned = 5,
    /// It was harvested.
    Harvested = 6,
    /// A pest killed it.
    Attacked = 7,
    /// The rules of its model replaced it by something else, or by nothing.
    Rewritten = 8,
    /// It met an obstacle, and its species gives up there.
    Obstructed = 9,
    /// It died for want of light.
    Shaded = 10,
}

impl ApexFate {
    /// Why the apex ended, as a cause of death.
    pub const fn cause(self) -> Cause {
        match self {
            Self::Alive => Cause::None,
            Self::Died => Cause::Mortality,
            Self::Flowered => Cause::Flowered,
            Self::Completed => Cause::Completed,
            Self::Killed => Cause::Killed,
            Self::Pruned => Cause::Pruned,
            Self::Harvested => Cause::Harvested,
            Self::Attacked => Cause::Attacked,
            Self::Rewritten => Cause::Rewritten,
            Self::Obstructed => Cause::Obstructed,
            Self::Shaded => Cause::Shaded,
        }
    }
}

/// The values of a new axis.
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
    /// Whether the axis follows another axis of its set of relays or forks: it does not lead the set.
    pub follows: bool,
    /// The named state in which it starts, as the model numbers them.
    pub state: u8,
    /// The tick at which its bud appeared.
    pub appearance: Tick,
    /// The tick at which its own life began: the appearance plus the delay of a proleptic bud. Dimension counts from
    /// here.
    pub birth: Tick,
    /// The azimuth around the bearing axis, radians from the bearing node's reference direction.
    pub azimuth: f32,
    /// The angle between the bearing axis and this axis, radians.
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

columns! {
    /// The columns of the axes.
    pub struct Axes of axis: NewAxis, numbered component, joined by joint from more at place {
        /// The bearing node; [`NodeId::NONE`] for the axis of the seed.
        bearer: NodeId = axis.bearer.unwrap_or(NodeId::NONE) => joint.node(more.bearer[place]),
        /// The component number of the apical bud.
        component: u32 = component => joint.component(more.component[place]),
        /// The lineage key.
        key: LineageKey = axis.key,
        /// The order, from 1.
        order: u8 = axis.order,
        /// How the axis came to be.
        origin: Origin = axis.origin,
        /// The position among the buds of the bearing node.
        position: u16 = axis.position,
        /// Whether the axis follows another axis of its set of relays or forks: it does not lead the set.
        follows: bool = axis.follows,
        /// The state in which the axis started.
        state: u8 = axis.state,
        /// The tick at which the bud appeared.
        appearance: Tick = axis.appearance,
        /// The tick from which dimension counts.
        birth: Tick = axis.birth,
        /// Azimuth around the bearing axis, radians.
        azimuth: f32 = axis.azimuth,
        /// Insertion angle, radians.
        insertion: f32 = axis.insertion,
        /// The ticks from the death of the branch to its fall; [`NEVER`] where dead wood stays.
        shed_after: Tick = axis.shed_after,
        /// The last node so far; [`NodeId::NONE`] before the first.
        last_node: NodeId = NodeId::NONE => joint.node(more.last_node[place]),
        /// The tick at which the apex ended; [`NEVER`] while it lives.
        apex_end: Tick = NEVER,
        /// How the apex ended.
        apex_fate: ApexFate = ApexFate::Alive,
        /// The tick from which nothing of the apex lives: the end of the apex, or the fall of its terminal flower and
        /// fruit.
        spent: Tick = NEVER,
        /// The tick at which every bud of the branch is dead; written by [`crate::shed`].
        death: Tick = NEVER,
        /// The tick at which the branch leaves the plant; written by [`crate::shed`].
        shed: Tick = NEVER,
    }
}

impl Axes {
    /// Ends an apex at its last tick, with its fate.
    pub fn end_apex(&mut self, axis: AxisId, tick: Tick, fate: ApexFate) {
        self.apex_end[axis.index()] = tick;
        self.apex_fate[axis.index()] = fate;
        self.spent[axis.index()] = tick;
    }

    #[inline]
    pub(super) fn push(&mut self, axis: NewAxis, component: u32) -> AxisId {
        let id = AxisId(self.len() as u32);
        self.push_columns(axis, component);
        id
    }

    #[inline]
    pub(super) fn grown(&mut self, axis: AxisId, node: NodeId) {
        self.last_node[axis.index()] = node;
    }

    /// Copies from a fragment the fates of the axes that were given to it.
    pub(super) fn take_back(&mut self, grown: &Self, joint: &Joint) {
        for (axis, own) in joint.taken.clone().zip(0..) {
            self.last_node[axis] = joint.node(grown.last_node[own]);
            self.apex_end[axis] = grown.apex_end[own];
            self.apex_fate[axis] = grown.apex_fate[own];
            self.spent[axis] = grown.spent[own];
        }
    }
}
