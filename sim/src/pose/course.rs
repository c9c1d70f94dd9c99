//! The course of one axis towards its trend: our reading of de Reffye 1988 §4, Fig. 15, which shows the smoothed axis
//! and prints no formula.
//!
//! With q the share of an internode and θ the angle of its heading to the upward vertical, θ' = ι + (1 − q)(θ − ι) for
//! the inclination ι that the axis tends to: after n internodes (1 − q)ⁿ of the first angle is left, whatever the
//! angle. The axis turns in the vertical plane of its heading, so it has one plane: its heading is cos θ · Z + sin θ ·
//! e with a fixed horizontal e, and `up`, carried along by parallel transport, keeps its two components in the plane
//! and across it. An axis that stands upright or hangs has no horizontal direction of its own and turns towards that of
//! its `up`.

use crate::math::{half_turn_of, sincos_half_turn};
use crate::plant::Trend;
use crate::plant::frames::{Frame, Plane, Slope};
use crate::vector::Vector;

/// Below this sine of the angle to the vertical a heading has no horizontal direction of its own; that of `up` is used.
pub(super) const VERTICAL: f64 = 1e-6;

/// `frame`, turned once towards a trend.
pub(super) fn turned(frame: Frame, trend: &Trend) -> Frame {
    let (plane, slope) = Plane::of(&frame);
    let slope = slope.turned(trend);
    Frame { base: frame.base, heading: plane.heading(slope).single(), up: plane.up(slope).single() }
}

/// `frame`, twisted about its heading until its upper side faces the sky; a vertical frame stays as it is.
pub(super) fn facing_the_sky(frame: Frame) -> Frame {
    const UPRIGHT: f32 = 1e-3;
    let [x, y, z] = frame.heading;
    let level = (x * x + y * y).sqrt();
    if level < UPRIGHT {
        return frame;
    }
    Frame { up: [-z * x / level, -z * y / level, level], ..frame }
}

impl Plane {
    /// The plane and the first slope of an axis that starts in `frame`, whose directions need only be nearly unit.
    #[inline]
    pub fn of(frame: &Frame) -> (Self, Slope) {
        Self::through(Vector::from(frame.heading), Vector::from(frame.up))
    }

    /// The plane and the first slope of an axis with these directions in double precision.
    pub fn through(heading: Vector, up: Vector) -> (Self, Slope) {
        let level = (heading.x * heading.x + heading.y * heading.y).sqrt();
        let slope = Slope { z: heading.z, r: level, angle: f64::NAN };
        let (e, slope) = if slope.r > VERTICAL {
            ([heading.x / slope.r, heading.y / slope.r], slope.normalized())
        } else {
            (horizontal(up), Slope { z: if heading.z < 0.0 { -1.0 } else { 1.0 }, ..Slope::UPRIGHT })
        };
        let across = up.y * e[0] - up.x * e[1];
        let within = slope.z * (up.x * e[0] + up.y * e[1]) - slope.r * up.z;
        let length = (across * across + within * within).sqrt();
        (Self { e, across: across / length, within: within / length }, slope)
    }

    /// The heading at `slope`.
    #[inline]
    pub fn heading(&self, slope: Slope) -> Vector {
        Vector::new(slope.r * self.e[0], slope.r * self.e[1], slope.z)
    }

    /// The reference direction at `slope`.
    #[inline]
    pub fn up(&self, slope: Slope) -> Vector {
        let level = self.within * slope.z;
        Vector::new(
            level * self.e[0] - self.across * self.e[1],
            level * self.e[1] + self.across * self.e[0],
            -self.within * slope.r,
        )
    }
}

impl Slope {
    const UPRIGHT: Self = Self { z: 1.0, r: 0.0, angle: f64::NAN };

    /// The slope of the next internode, which turns its share of the angle to the trend.
    #[inline(always)]
    pub fn turned(self, trend: &Trend) -> Self {
        let from = if self.angle.is_nan() { half_turn_of(self.r, self.z) } else { self.angle };
        Self::at(trend.inclination + (1.0 - trend.share) * (from - trend.inclination))
    }

    #[inline(always)]
    fn at(angle: f64) -> Self {
        let (r, z) = sincos_half_turn(angle);
        Self { z, r, angle }
    }

    /// The slope as a unit vector; upright where its length is 0.
    #[inline]
    fn normalized(self) -> Self {
        let square = self.z * self.z + self.r * self.r;
        if square > 1e-100 {
            let length = square.sqrt();
            Self { z: self.z / length, r: self.r / length, angle: f64::NAN }
        } else {
            Self::UPRIGHT
        }
    }
}

impl Default for Slope {
    fn default() -> Self {
        Self::UPRIGHT
    }
}

/// The horizontal direction of a vector that is not vertical.
fn horizontal(vector: Vector) -> [f64; 2] {
    let length = (vector.x * vector.x + vector.y * vector.y).sqrt();
    [vector.x / length, vector.y / length]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{atan2, pow};
    use std::f64::consts::{FRAC_PI_2, PI};

    fn angle(slope: Slope) -> f64 {
        atan2(slope.r, slope.z)
    }

    /// Whatever the angle, small or half a turn, and whichever the direction.
    #[test]
    fn what_is_left_of_the_first_angle_shrinks_by_one_minus_the_share_an_internode() {
        for (start, inclination) in [(0.0, PI), (PI, 0.0), (1e-3, 0.0), (2.5, 0.3), (0.1, FRAC_PI_2), (3.0, 0.7)] {
            for share in [0.0, 0.002, 0.1, 0.3, 0.5, 0.51, 0.9, 1.0] {
                let (mut slope, trend) = (Slope::at(start), Trend { inclination, share });
                slope.angle = f64::NAN;
                for step in 1..=40 {
                    slope = slope.turned(&trend);
                    let expected = inclination + (start - inclination) * pow(1.0 - share, f64::from(step));
                    let found = angle(slope);
                    assert!((found - expected).abs() < 1e-10, "{start} {inclination} {share}, {step}: {found}");
                }
            }
        }
    }
}
