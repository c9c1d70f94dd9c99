//! What became of buds and branches, tick by tick.
//!
//! The log is kept only where a run wants it; growth, death and fall are in the columns anyway. Absent: the falls of
//! organs, which their own columns tell.

use super::handle::AxisId;
use crate::clock::Tick;

/// The fate of a bud at a tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum EventKind {
    /// It grew; `count` is the number of nodes.
    Grew = 0,
    /// It made a pause.
    Paused = 1,
    /// It died by the mortality test.
    Died = 2,
    /// It became a flower.
    Flowered = 3,
    /// It had made all its growth units; `count` of them.
    Completed = 4,
    /// An axillary axis of the next order appeared.
    Branched = 5,
    /// An axis of the same order took the place of an apex that had ended, or passed into another state.
    Relayed = 6,
    /// A reiteration began, traumatic or adaptive.
    Reiterated = 7,
    /// Something from outside killed it.
    Killed = 8,
    /// It was cut off.
    Pruned = 9,
    /// A dead branch fell, with everything that it bore.
    Shed = 10,
    /// Its axis, or one that it bears, did not hold what it carried: the nearest to the seed, noted when it
    /// changes.
    Buckled = 11,
    /// The bending of the plant found no equilibrium; `count` is the number of steps tried.
    Unsettled = 12,
    /// An apex divided, and this axis is one of the equal ones of its order that it became.
    Forked = 13,
}

impl EventKind {
    /// Every kind, in the order of their numbers.
    pub const ALL: [Self; 14] = [
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
        }
    }
}

/// One event of one bud.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Event {
    /// When.
    pub tick: Tick,
    /// The axis whose bud it was; for `Branched`, `Relayed`, `Reiterated` and `Forked` the new axis.
    pub axis: AxisId,
    /// What.
    pub kind: EventKind,
    /// How many, where the kind says of what; else 1.
    pub count: u32,
}
