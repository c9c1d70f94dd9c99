//! Sea shells: a circle swept on a helico-spiral (Fowler, Meinhardt & Prusinkiewicz 1992, "Modeling seashells", §3).
//!
//! After t turns the circle stands in the half plane through the axis that has turned by 2πt. Its centre lies at the
//! distance r λᵗ from the axis and at the height h (1 − λᵗ), its radius is c λᵗ: so each turn is the one before, λ
//! times as large and drawn together towards the point at the height h (their ξ for r, z and the circle alike). The
//! half planes cut the shell into discs, so a point is inside where one of the discs of its half plane holds it. The
//! distance is measured within the half plane, and to the flat ends, and is exact on the surface alone.

use super::bounds::Bounds;
use super::{Point, Solid, from, length};
use crate::math::{atan2, pow, sin, sincos};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A circle swept on a helico-spiral about an upright axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shell {
    /// The foot of the axis, at the height of the first circle's centre, metres.
    pub foot: Point,
    /// The distance of the first circle's centre from the axis, metres.
    pub spiral: f64,
    /// The height of the point towards which the shell winds, metres above the foot; below it if negative.
    pub height: f64,
    /// The radius of the first circle, metres.
    pub tube: f64,
    /// The size of each turn, of that of the turn before; between 0 and 1.
    pub shrink: f64,
    /// The number of turns.
    pub turns: f64,
}

/// The most turns that are looked at: beyond them a shell that shrinks is nothing.
const MOST_TURNS: f64 = 1000.0;

impl Shell {
    /// The turns that it has: at most a thousand.
    pub fn last(&self) -> f64 {
        self.turns.clamp(0.0, MOST_TURNS)
    }

    /// The circle after t turns: the distance of its centre from the axis, its height and its radius.
    pub fn circle(&self, turns: f64) -> [f64; 3] {
        let size = pow(self.shrink, turns);
        [self.spiral * size, self.height * (1.0 - size), self.tube * size]
    }

    /// The least distance within a half plane, at the angle `at` from the first, to the circles that stand in it.
    /// `across` is the distance from the axis, negative for the half plane on the other side.
    fn within(&self, at: f64, across: f64, z: f64) -> f64 {
        let first = at.rem_euclid(TAU) / TAU;
        let mut least = f64::INFINITY;
        let mut turns = first;
        while turns <= self.last() {
            let [centre, height, radius] = self.circle(turns);
            let mut beyond = ((across - centre) * (across - centre) + (z - height) * (z - height)).sqrt() - radius;
            if beyond.is_nan() {
                break;
            }
            // The flat ends: how deep a point lies behind the plane of the first and of the last circle.
            for behind in [turns * TAU, (self.last() - turns) * TAU] {
                if behind < FRAC_PI_2 {
                    beyond = beyond.max(-(across.abs() * sin(behind)));
                }
            }
            least = least.min(beyond);
            turns += 1.0;
        }
        least
    }

    /// The distance to the flat disc that closes the shell after so many turns.
    fn beyond_disc(&self, turns: f64, at: Point) -> f64 {
        let [centre, height, radius] = self.circle(turns);
        let (sin, cos) = sincos(turns * TAU);
        let out = at[0] * cos + at[1] * sin;
        let aside = at[1] * cos - at[0] * sin;
        let within = ((out - centre) * (out - centre) + (at[2] - height) * (at[2] - height)).sqrt() - radius;
        length([within.max(0.0), aside, 0.0])
    }
}

impl Solid for Shell {
    fn inside(&self, point: Point) -> bool {
        self.distance(point) <= 0.0
    }

    fn distance(&self, point: Point) -> f64 {
        let at = from(self.foot, point);
        let across = (at[0] * at[0] + at[1] * at[1]).sqrt();
        let angle = atan2(at[1], at[0]);
        let own = self.within(angle, across, at[2]);
        // A circle that is larger than its distance from the axis reaches over into the half plane opposite.
        let opposite = if self.tube > self.spiral { self.within(angle + PI, -across, at[2]) } else { f64::INFINITY };
        let body = own.min(opposite);
        if body <= 0.0 { body } else { body.min(self.beyond_disc(0.0, at)).min(self.beyond_disc(self.last(), at)) }
    }

    fn bounds(&self) -> Bounds {
        let out = self.spiral + self.tube;
        let [start, end] = [0.0, self.last()].map(|turns| self.circle(turns));
        let low = (start[1] - start[2]).min(end[1] - end[2]);
        let high = (start[1] + start[2]).max(end[1] + end[2]);
        let [x, y, z] = self.foot;
        Bounds { low: [x - out, y - out, z + low], high: [x + out, y + out, z + high] }
    }
}
