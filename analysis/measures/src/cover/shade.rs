//! Leaves as discs in the plane across a direction: from above, or along the sun.
//!
//! Each leaf is a disc of its own area that faces the direction, as the paper has its leaves (Aono & Kunii 1984, Fig.
//! 8). A leaf that is inclined to it covers less: what is told is the most that leaves of these areas at these places
//! can cover. Absent: where the sun stands.

use super::Disc;
use phytomer_sim::math::{cos, sin};

/// The direction from which discs are seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Direction {
    /// Two directions across it, at right angles.
    across: [[f64; 3]; 2],
}

impl Direction {
    /// From straight above: the axes of the plane are x and y.
    pub const ABOVE: Self = Self { across: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] };

    /// From the sun at an altitude above the horizon and an azimuth from +y over +x (north over east), radians.
    pub fn of_sun(altitude: f64, azimuth: f64) -> Self {
        let (a, z) = (altitude, azimuth);
        // To the right as one looks along the light, and upwards across it.
        Self { across: [[-cos(z), sin(z), 0.0], [-sin(a) * sin(z), -sin(a) * cos(z), cos(a)]] }
    }

    /// A leaf of an area at a place, as a disc across the direction.
    pub fn leaf(self, place: [f64; 3], area: f64) -> Disc {
        let along = |axis: [f64; 3]| axis.iter().zip(place).map(|(a, b)| a * b).sum();
        Disc::of_area(self.across.map(along), area)
    }

    /// A disc of a radius at a place.
    pub fn disc(self, place: [f64; 3], radius: f64) -> Disc {
        Disc { radius, ..self.leaf(place, 0.0) }
    }
}
