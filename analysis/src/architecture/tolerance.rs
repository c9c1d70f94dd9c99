//! How far a plant may differ from the drawing of its model and still qualify.
//!
//! Buds die by chance, crowns fill up, and a young plant does not yet show its whole model. The qualifiers (`models`)
//! and the characters (`characters`, `relays`, `lie`) take every tolerance from here.

/// An axis whose trend is more than this many degrees from the vertical is plagiotropic, any other orthotropic. Half
/// way.
pub const PLAGIOTROPIC_DEG: f32 = 45.0;

/// The least share of axes for a character that all axes must have: epicormic shoots and missing relays are few.
pub const NEARLY_ALL: f64 = 0.9;

/// The largest share of axes for a character that no axis should have.
pub const HARDLY_ANY: f64 = 0.1;

/// The least share of a trunk's branches in the outer halves of its growth units for the trunk to have tiers. Branches
/// on every node, or on random nodes, give one half.
pub const TIER_SHARE: f64 = 0.7;

/// The least share of finished modules that are relayed, where a model relays every module. A relay may die as a bud,
/// and the last modules of a crown that fills up have none.
pub const RELAYED: f64 = 0.5;

/// The number of generations of modules, from the first, in which a module must have several relays. Later generations
/// have fewer, as the crown fills up.
pub const FIRST_GENERATIONS: u32 = 3;

/// The least share of modules of the first generations with several relays, where a model has several on each module.
/// By chance all relay buds of a module but one may die.
pub const SEVERAL: f64 = 0.6;

/// The largest distance, in nodes, between the relay of a mixed axis and the node at which the axis turns plagiotropic.
pub const NODES_FROM_TURN: u32 = 2;

/// Where axes bend over by their weight: the least share of relayed axes whose tips hang, and the least share of relays
/// near the summit of an arch or before it.
pub const BENT_OVER: f64 = 0.5;

/// The least vertical part of the direction (a unit vector) of an internode that is erect.
pub const ERECT: f32 = 0.8;
/// The least rise of the vertical part of the direction of an internode that was erected.
pub const RISEN: f32 = 0.3;

/// The least number of internodes of a measured axis that shows whether it turns up.
pub const LEAST_COURSE: usize = 5;
/// The inclination, degrees from the vertical, up to which the ends of measured axes are upright whether they turn or
/// not.
pub const STEEP_DEG: f64 = 30.0;
/// The least part of their first inclination by which measured axes turn up that are orthotropic. Those of grown plants
/// of Rauh's and Attims's models turn up by 0.17 to 0.54 of it, those of Massart's and Roux's by less than nothing, the
/// branches of a measured coffee tree by 0.10.
pub const TURNS_UP: f64 = 0.125;
