//! From the keys of a checked event to what is done.
//!
//! Absent: its times, and the faults of its keys.

use super::{Event, Plane, Work};
use phytomer_models::shapes::ShapeOrName;
use phytomer_sim::NEVER;
use phytomer_sim::management::{Act, Kept, Region, Support, Training};
use phytomer_sim::shape::Shape;
use std::sync::Arc;

/// The share of its life on the plant from which a fruit is ripe, where a harvest states none.
pub(super) const RIPE: f64 = 0.9;

impl Event {
    /// What a checked event does, on plants whose rows run in a direction, degrees from north. A hedge that states a
    /// shape clears what is outside it.
    pub(super) fn act(&self, shape: Option<Arc<Shape>>, row_direction: f64) -> Act {
        let above = |height: Option<f64>| Region::Above(height.unwrap_or(f64::MAX));
        match self.operation {
            Work::Heading => Act::Head(match (self.keep_nodes, self.keep_share, self.keep_length_m) {
                (Some(nodes), _, _) => Kept::Nodes(nodes),
                (_, Some(share), _) => Kept::Share(share),
                (.., length) => Kept::Length(length.unwrap_or(f64::MAX)),
            }),
            Work::Thinning => Act::Thin,
            Work::Topping => Act::Clear(above(self.height_m), u8::MAX),
            Work::Hedging => Act::Clear(shape.map_or_else(|| self.hedged(), Region::Outside), u8::MAX),
            Work::Stumping => match self.keep_nodes {
                Some(nodes) => Act::Stump(nodes),
                None => Act::Clear(above(self.height_m), 1),
            },
            Work::Removal => Act::Remove,
            Work::Replanting => Act::Replant,
            Work::FruitThinning => Act::ThinFruits,
            Work::Harvest => match self.harvest_cut_height {
                Some(height) => Act::Mow(height / 100.0),
                None => Act::Harvest(self.ripe_share.unwrap_or(RIPE)),
            },
            Work::Bending | Work::Staking | Work::Tying => {
                Act::Train(Training { support: self.support(row_direction), stays: self.stays.unwrap_or(NEVER) })
            }
        }
    }

    /// The parts of the shape that it states without a name, of what it does.
    pub(super) fn own_parts(&self, act: &Act) -> usize {
        match (&self.shape, act) {
            (Some(ShapeOrName::Shape(_)), Act::Clear(Region::Outside(shape), _)) => shape.parts(),
            _ => 0,
        }
    }

    /// What wood that is trained is held by.
    fn support(&self, row_direction: f64) -> Support {
        let azimuth = self.azimuth_deg.map(f64::to_radians);
        match self.operation {
            Work::Staking => Support::Stake(self.height_m.unwrap_or(0.0)),
            Work::Tying => {
                let azimuth = azimuth.unwrap_or(row_direction.to_radians());
                Support::Wires { heights: self.wires_m.clone(), azimuth }
            }
            _ => Support::Spreader { inclination: self.angle_deg.map(f64::to_radians), azimuth },
        }
    }

    /// What a hedge without a shape of its own clears.
    fn hedged(&self) -> Region {
        let planes = || Region::Outside(Arc::new(Plane::before_all(&self.planes)));
        self.box_m.map_or_else(planes, Region::outside_box)
    }
}
