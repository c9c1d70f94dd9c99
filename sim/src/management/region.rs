//! Regions of space in which no wood is left: above a height, outside a shape.
//!
//! Places are metres from the seed of each plant, eastward, northward and upward. Wood is cut at nodes: an internode of
//! which the tip lies in the region is taken whole. What is beyond planes is outside the intersection of their half
//! spaces. Absent: which axes are cut.

use crate::shape::{Cuboid, Shape};
use std::sync::Arc;

/// Where no wood is left.
#[derive(Debug, Clone, PartialEq)]
pub enum Region {
    /// Above a height.
    Above(f64),
    /// Outside a shape.
    Outside(Arc<Shape>),
}

impl Region {
    /// What is outside a box that stands on the ground around the seed: its extents eastward, northward and upward.
    /// What is below the ground is left.
    pub fn outside_box([east, north, up]: [f64; 3]) -> Self {
        let (x, y) = (east / 2.0, north / 2.0);
        let kept = Cuboid { low: [-x, -y, f64::NEG_INFINITY], high: [x, y, up] };
        Self::Outside(Arc::new(Shape::Cuboid(kept)))
    }

    /// Whether a point, metres from the seed, lies in it. A point on the border does not.
    pub fn holds(&self, point: [f32; 3]) -> bool {
        let point = point.map(f64::from);
        match self {
            Self::Above(height) => point[2] > *height,
            Self::Outside(shape) => !shape.inside(point),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::HalfSpace;

    #[test]
    fn borders_belong_to_what_is_left() {
        let plane = HalfSpace { point: [0.0, 0.5, 0.0], normal: [0.0, 2.0, 0.0] };
        let beyond = Region::Outside(Arc::new(Shape::HalfSpace(plane)));
        let regions = [Region::Above(2.0), beyond, Region::outside_box([1.0, 3.0, 2.0])];
        let inside = |point| regions.clone().map(|region| region.holds(point));
        assert_eq!(inside([0.5, 0.5, 2.0]), [false; 3]);
        assert_eq!(inside([0.51, 0.5, 2.0]), [false, false, true]);
        assert_eq!(inside([0.0, 0.6, 2.1]), [true; 3]);
        assert_eq!(inside([0.0, -1.6, 0.0]), [false, false, true]);
    }
}
