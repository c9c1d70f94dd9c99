//! The course of one axis towards its trend: our reading of de Reffye 1988 §4, Fig. 15, which shows the smoothed axis
//! and prints no formula.
//!
//! With q the share of an internode, its heading is h' = (1 − q) h + q t, made a unit vector, where the trend t is
//! cos ι · Z + sin ι · (the horizontal direction of h) for the inclination ι from the vertical: a geometric relaxation,
//! in which a small angle to the trend shrinks by 1 − q an internode. h' lies in the vertical plane of h, so an axis has
//! one plane: its heading is z · Z + r · e with a fixed horizontal e, and `up`, carried along by parallel transport,
//! keeps its two components in the plane and across it. One square root an internode, no trigonometry.

use super::Frame;
use crate::plant::Trend;
use crate::vector::Vector;

/// Below this sine of the angle to the vertical a heading has no horizontal direction of its own; that of `up` serves.
const VERTICAL: f64 = 1e-6;

/// An axis that points straight away from a vertical trend starts to turn by this sine, towards its own side of the
/// plane: the formula alone leaves it where it is.
const NUDGE: f64 = 1e-3;

/// The vertical plane of an axis, with the components of `up` that do not change along it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    /// The horizontal direction.
    e: [f64; 2],
    /// Of `up` across the plane, along Z × e.
    across: f64,
    /// Of `up` in the plane, along z · e − r · Z.
    within: f64,
}

/// The direction of a heading in its plane: z along the vertical, r along e.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Slope {
    pub z: f64,
    pub r: f64,
}

/// What stands in `frame`, turned once.
pub(super) fn turned(frame: Frame, trend: &Trend) -> Frame {
    let (plane, slope) = Plane::of(&frame);
    let slope = slope.turned(trend);
    Frame { base: frame.base, heading: plane.heading(slope).single(), up: plane.up(slope).single() }
}

/// What stands in `frame`, twisted about its heading until its upper side faces the sky; a vertical one stays.
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
    pub fn of(frame: &Frame) -> (Self, Slope) {
        let heading = Vector::from(frame.heading);
        let up = Vector::from(frame.up);
        let slope = Slope { z: heading.z, r: (heading.x * heading.x + heading.y * heading.y).sqrt() };
        let (e, slope) = if slope.r > VERTICAL {
            ([heading.x / slope.r, heading.y / slope.r], slope.normalized())
        } else {
            (horizontal(up), Slope { z: if heading.z < 0.0 { -1.0 } else { 1.0 }, r: 0.0 })
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
    /// The slope of the next internode, which turns its share of the way to the trend.
    #[inline]
    pub fn turned(self, trend: &Trend) -> Self {
        let share = f64::from(trend.share);
        let (cos, sin) = (f64::from(trend.cos_inclination), f64::from(trend.sin_inclination));
        let from = if self.r < NUDGE { self.nudged(cos, sin) } else { self };
        let keep = 1.0 - share;
        Self { z: keep * from.z + share * cos, r: keep * from.r + share * sin }.normalized_or(self)
    }

    /// Off the vertical, where the trend is the opposite one.
    #[cold]
    fn nudged(self, cos: f64, sin: f64) -> Self {
        if self.z * cos < 0.0 && sin < NUDGE { Self { z: self.z, r: NUDGE } } else { self }
    }

    fn normalized(self) -> Self {
        self.normalized_or(Self { z: 1.0, r: 0.0 })
    }

    /// As a unit vector; `otherwise` where there is no direction.
    #[inline]
    fn normalized_or(self, otherwise: Self) -> Self {
        let square = self.z * self.z + self.r * self.r;
        if square > 1e-100 {
            let length = square.sqrt();
            Self { z: self.z / length, r: self.r / length }
        } else {
            otherwise
        }
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
    use crate::math::{atan2, cos, pow, sin};

    fn trend(inclination: f64, share: f32) -> Trend {
        Trend { cos_inclination: cos(inclination) as f32, sin_inclination: sin(inclination) as f32, share }
    }

    fn at(angle: f64) -> Slope {
        Slope { z: cos(angle), r: sin(angle) }
    }

    fn angle(slope: Slope) -> f64 {
        atan2(slope.r, slope.z)
    }

    #[test]
    fn a_small_angle_shrinks_by_one_minus_the_share() {
        let (start, share) = (1e-3, 0.25);
        let mut slope = at(start);
        for step in 1..=40 {
            slope = slope.turned(&trend(0.0, share));
            let expected = start * pow(0.75, f64::from(step));
            assert!((angle(slope) - expected).abs() < 1e-6 * expected, "step {step}");
        }
    }

    #[test]
    fn one_step_is_the_printed_formula_at_any_angle() {
        for (start, inclination, share) in [(2.5, 0.3, 0.4), (0.1, 1.5, 0.05), (1.2, 1.5, 0.9), (3.0, 0.7, 0.5)] {
            let (psi, share) = (start - inclination, f64::from(share as f32));
            let expected = atan2((1.0 - share) * sin(psi), (1.0 - share) * cos(psi) + share);
            let turned = angle(at(start).turned(&trend(inclination, share as f32))) - inclination;
            assert!((turned - expected).abs() < 1e-6, "{start} {inclination} {share}: {turned} {expected}");
        }
    }

    #[test]
    fn an_axis_that_points_away_from_its_trend_comes_round() {
        for share in [0.01, 0.3, 0.5, 0.7, 1.0] {
            let mut slope = Slope { z: -1.0, r: 0.0 };
            (0..3000).for_each(|_| slope = slope.turned(&trend(0.0, share)));
            assert!(slope.z > 0.999_999, "share {share}: {slope:?}");
        }
    }

    #[test]
    fn no_direction_is_no_turn() {
        let nowhere = Trend { cos_inclination: f32::NAN, sin_inclination: 0.0, share: 0.5 };
        assert_eq!(at(1.0).turned(&nowhere), at(1.0));
    }
}
