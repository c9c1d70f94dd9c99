//! The fates of buds and branches, tick by tick.
//!
//! The log is kept only where a run wants it; growth, death and fall are in the columns in any case. Absent: the falls
//! of organs, which are in their own columns.

use super::handle::AxisId;
use crate::clock::Tick;

/// What happened to a bud, or to its branch, at a tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum EventKind {
    /// The bud grew; `count` is the number of nodes.
    Grew = 0,
    /// The bud made a pause.
    Paused = 1,
    /// The bud died by the mortality test.
    Died = 2,
    /// The bud became a flower.
    Flowered = 3,
    /// The bud had made all its growth units; `count` is their number.
    Completed = 4,
    /// An axillary axis of the next order appeared.
    Branched = 5,
    /// An axis of the same order took the place of an apex that had ended, or passed into another state.
    Relayed = 6,
    /// A reiteration began, traumatic or adaptive.
    Reiterated = 7,
    /// A cause outside the plant killed the bud.
    Killed = 8,
    /// The axis was cut off.
    Pruned = 9,
    /// A dead branch fell, with everything that it bore.
    Shed = 10,
    /// The axis, or an axis that it bears, did not hold its load. It is the axis nearest to the seed, and is noted when
    /// it changes.
    Buckled = 11,
    /// The bending of the plant found no equilibrium; `count` is the number of steps tried.
    Unsettled = 12,
    /// An apex divided, and this axis is one of the equal axes of its order into which it divided.
    Forked = 13,
    /// The axis was harvested, or `count` of the fruits that it bears.
    Harvested = 14,
    /// Fruits were picked off the axis so that the others have more; `count` is their number.
    Thinned = 15,
    /// A pest killed the bud.
    Attacked = 16,
    /// The rules of the model replaced internodes of the axis, its bud or organs that it bore by something else, or by
    /// nothing; `count` is their number.
    Rewritten = 17,
    /// The bud died of an obstacle that it met.
    Obstructed = 18,
    /// The bud died for want of light.
    Shaded = 19,
}

impl EventKind {
    /// Every kind, in the order of their numbers.
    pub const ALL: [Self; 20] = [
        Self::Grew,
        Self::Paused,
        Self::Died,
        Self::Flowered,
        Self::Completed,
        Self::Branched,
        Self::Relayed,
        Self::Reiterated,
        Self::Killed,
        Self::Pruned,
        Self::Shed,
        Self::Buckled,
        Self::Unsettled,
        Self::Forked,
        Self::Harvested,
        Self::Thinned,
        Self::Attacked,
        Self::Rewritten,
        Self::Obstructed,
        Self::Shaded,
    ];

    /// The event as it stands in tables.
    pub const fn tag(self) -> &'static str {
        match self {
            Self::Grew => "grew",
            Self::Paused => "paused",
            Self::Died => "died",
            Self::Flowered => "flowered",
            Self::Completed => "completed",
            Self::Branched => "branched",
            Self::Relayed => "relayed",
            Self::Reiterated => "reiterated",
            Self::Killed => "killed",
            Self::Pruned => "pruned",
            Self::Shed => "shed",
            Self::Buckled => "buckled",
            Self::Unsettled => "unsettled",
            Self::Forked => "forked",
            Self::Harvested => "harvested",
            Self::Thinned => "thinned",
            Self::Attacked => "attacked",
            Self::Rewritten => "rewritten",
            Self::Obstructed => "obstructed",
            Self::Shaded => "shaded",
        }
    }
}

/// The state of an event of which none is told.
pub const NO_STATE: u8 = u8::MAX;

/// One event of one bud.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Event {
    /// The tick.
    pub tick: Tick,
    /// The axis whose bud it was; for `Branched`, `Relayed`, `Reiterated` and `Forked` the new axis.
    pub axis: AxisId,
    /// What happened.
    pub kind: EventKind,
    /// The number that the kind of event names; else 1.
    pub count: u32,
    /// The state of the bud when it happened, as the model numbers them: for a new axis the state in which it starts.
    /// [`NO_STATE`] where the model has no states, and of what befalls a branch whole: cuts, harvests and falls.
    pub state: u8,
}
