//! Regions of space in which no wood is left: above a height, beyond planes, outside a box.
//!
//! Places are metres from the seed of each plant, eastward, northward and upward. Wood is cut at nodes: an internode of
//! which the tip lies in the region is taken whole. Absent: which axes are cut.

use crate::site::Plane;

/// Where no wood is left.
#[derive(Debug, Clone, PartialEq)]
pub enum Region {
    /// Above a height.
    Above(f64),
    /// On the far side of any of these planes.
    Beyond(Vec<Plane>),
    /// Outside a box that stands on the ground around the seed: its extents eastward, northward and upward.
    Outside([f64; 3]),
}

impl Region {
    /// Whether a point, metres from the seed, lies in it. A point on the border does not.
    pub fn holds(&self, point: [f32; 3]) -> bool {
        let point = point.map(f64::from);
        match self {
            Self::Above(height) => point[2] > *height,
            Self::Beyond(planes) => planes.iter().any(|plane| plane.is_passed_by(point)),
            Self::Outside([east, north, up]) => {
                point[0].abs() > east / 2.0 || point[1].abs() > north / 2.0 || point[2] > *up
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_belong_to_what_is_left() {
        let plane = Plane { point: [0.0, 0.5, 0.0], normal: [0.0, 2.0, 0.0] };
        let regions = [Region::Above(2.0), Region::Beyond(vec![plane]), Region::Outside([1.0, 3.0, 2.0])];
        let inside = |point| regions.clone().map(|region| region.holds(point));
        assert_eq!(inside([0.5, 0.5, 2.0]), [false; 3]);
        assert_eq!(inside([0.51, 0.5, 2.0]), [false, false, true]);
        assert_eq!(inside([0.0, 0.6, 2.1]), [true; 3]);
        assert_eq!(inside([0.0, -1.6, 0.0]), [false, false, true]);
    }
}
