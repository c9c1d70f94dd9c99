//! The simplest internode and the simplest organ: the default values of a new internode and a new leaf.
//!
//! As [`NewAxis::OF_THE_SEED`](super::NewAxis::OF_THE_SEED) does for axes, they let a plant that is made by hand state
//! only the values that differ. Absent: growth models, which state every value.

use super::{AxisId, Cause, Form, Kind, NewNode, NewOrgan, NodeId};
use crate::clock::NEVER;

impl NewNode {
    /// The first internode of the trunk, born at tick 1 as a growth unit of its own; it has no length and no diameter.
    pub const OF_THE_TRUNK: Self = Self {
        parent: NodeId::NONE,
        axis: AxisId::TRUNK,
        birth: 1,
        rank: 1,
        unit_rank: 1,
        short: false,
        neoformed: false,
        trend: 0,
        length: 0.0,
        diameter: 0.0,
        azimuth: 0.0,
    };
}

impl NewOrgan {
    /// A leaf of the first internode of the trunk, born with it at tick 1, which stays as long as its branch; it lies
    /// along its axis and has no size.
    pub const LEAF: Self = Self {
        node: NodeId(0),
        kind: Kind::Leaf,
        position: 0,
        birth: 1,
        death: NEVER,
        cause: Cause::None,
        form: Form(0),
        length: 0.0,
        width: 0.0,
        area: 0.0,
        azimuth: 0.0,
        insertion: 0.0,
    };
}
