//! How organs turn with their age, compiled: a share for each tick of an organ's life.
//!
//! A trend is a law of the organ's own age, not of the plant's. Absent: the turning itself, which is the pose's.

use super::compiler::Compiler;
use crate::buds::params::{Facing, Order, OrganTrend as Stated};
use crate::law::ValueRange;
use phytomer_sim::plant::{OrganTrend, OrganTrends};

const INCLINATION: ValueRange = ValueRange { min: 0.0, max: 180.0, what: "an angle to the vertical in degrees" };

/// How the organs of an order turn.
pub fn trends(order: &Order, compiler: &mut Compiler) -> OrganTrends {
    let mut of = |stated: &Option<Stated>, keys| stated.as_ref().map(|stated| trend(stated, keys, compiler));
    OrganTrends {
        leaf: of(&order.leaf.trend, "leaf.trend"),
        flower: of(&order.flower.trend, "flower.trend"),
        fruit: of(&order.fruit.trend, "fruit.trend"),
        leaves_face_the_sky: order.leaf.facing == Facing::Sky,
    }
}

fn trend(stated: &Stated, keys: &str, compiler: &mut Compiler) -> OrganTrend {
    let inclination = compiler.constant(&stated.inclination_deg, &format!("{keys}.inclination_deg"), INCLINATION);
    OrganTrend {
        inclination: inclination.to_radians(),
        shares: compiler.share_by_own_age(&stated.share, &format!("{keys}.share")),
    }
}
