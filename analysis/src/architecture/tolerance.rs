//! How far a plant may be from the drawing of its model and still qualify: buds die by chance, crowns fill up, and a
//! plant is young before it is old. Every tolerance that a qualifier has stands here.

/// An axis that tends to more than so many degrees from the vertical is plagiotropic, to fewer orthotropic: half way.
pub const PLAGIOTROPIC_DEG: f32 = 45.0;

/// What holds of "all" holds of at least this share: epicormic shoots, and relays that never came, are few.
pub const NEARLY_ALL: f64 = 0.9;

/// What "some at most" have at most this share has.
pub const HARDLY_ANY: f64 = 0.1;

/// The share of a trunk's branches that stand in the outer halves of its growth units where it has tiers. Branches on
/// every node, or on nodes at random, give one half.
pub const TIER_SHARE: f64 = 0.7;

/// The share of the apices that ended as their model has it, at least so many ticks ago, that must have been relayed:
/// the relay of a module may die as a bud, or be the last of a crown that fills up.
pub const RELAYED: f64 = 0.5;

/// The generations of modules of which each is to have several relays: those after them thin out as a crown fills up.
pub const FIRST_GENERATIONS: u32 = 3;

/// The share of the modules of the first generations that have several relays, where a module is to have several: now
/// and then all relay buds but one are lost.
pub const SEVERAL: f64 = 0.6;

/// How many nodes the relay of a mixed axis may stand from the node at which the axis turns.
pub const NODES_FROM_TURN: u32 = 2;

/// The share of old axes that must hang, or nearly so, where axes bend over by their weight.
pub const BENT_OVER: f64 = 0.5;

/// The vertical part of the direction of what is erect, and by how much what is erected has risen.
pub const ERECT: f32 = 0.8;
/// See [`ERECT`].
pub const RISEN: f32 = 0.3;
