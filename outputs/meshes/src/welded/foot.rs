//! The foot of a limb: where its skin leaves that of its bearer.
//!
//! The axis line of a limb mostly begins on that of its bearer. Its skin begins where the line comes out of the
//! bearer: there the bearer's skin has a hole, whose border is the curve in which two round tubes meet. With the
//! radii R and r and the angle β between the lines, the border is, at the distance x from the plane of both lines, at
//! the angle arcsin (x / R), and ± √(r² − x²) / sin β − (R − √(R² − x²)) cot β along the bearer. Absent: how holes
//! share a ring (`bands`).

use super::course::Course;
use super::outline::Outline;
use glam::DVec3;
use phytomer_sim::math::{asin, atan2, sincos};
use std::f64::consts::{PI, TAU};

/// The least sine of the angle between a limb and its bearer with which borders are computed: 20 degrees.
const LEAST_SINE: f64 = 0.342;
/// The farthest that a border reaches around its bearer on either side, as a sine.
const WIDEST: f64 = 0.96;
/// The part of a limb that its skin leaves out at most, beyond where its line comes out.
const LEFT_OUT: f64 = 0.6;
/// How far from where it comes out a line is looked for in other limbs, in halves of its radius.
const LOOKED_FOR: u32 = 8;
/// The steps in which the place is halved at which a line comes out.
const HALVINGS: usize = 12;

/// Where a limb begins.
#[derive(Debug, Clone)]
pub struct Foot {
    /// The limb.
    pub limb: u32,
    /// The middle of the hole: the length along the bearer and the angle around it.
    pub z: f64,
    /// The angle.
    pub angle: f64,
    /// The border, from its left corner counterclockwise as seen from outside: angles and lengths from the middle.
    pub border: Vec<[f64; 2]>,
    /// The length along the limb at which its own rings begin, metres.
    pub begins: f64,
}

impl Foot {
    /// The place of the right corner in the border; before it is the lower edge, after it the upper.
    pub fn right(&self) -> usize {
        self.border.len() / 2
    }

    /// How far the border reaches from its middle to either side: the farther of its angles.
    pub fn half(&self) -> f64 {
        self.border.iter().fold(0.0, |far: f64, [angle, _]| far.max(angle.abs()))
    }

    /// How far the border reaches below and above its middle, metres.
    pub fn extent(&self) -> [f64; 2] {
        self.border.iter().fold([0.0; 2], |[low, high], [_, along]| [low.min(*along), high.max(*along)])
    }

    /// The foot of a limb on a bearer, out of which its line comes at a length along the limb.
    pub fn of(limb: u32, bearer: &Course, out: Out, own: &Course, outlines: &[Outline]) -> Self {
        let Out { own: out, bearer: z } = out;
        let end = own.ends()[1];
        let (at, way, r) = (own.line(out), own.direction(out), own.radius(out));
        let along = bearer.direction(z);
        let straight: f64 = way.dot(along);
        let sine = (1.0 - straight * straight).max(0.0).sqrt().max(LEAST_SINE);
        let slope = straight / sine;
        let from = at - bearer.line(z);
        let outward = from - along * from.dot(along);
        let beside = if outward.length() > 0.1 * bearer.radius(z) { outward } else { way - along * straight };
        let angle = bearer.angle(z, beside).unwrap_or(0.0);
        let outline = &outlines[bearer.below(z).outline as usize];
        // A bearer without a width at this place would have borders without a number.
        let reach = (bearer.radius(z) * outline.reach(angle)).max(f64::MIN_POSITIVE);
        let below = own.below(out);
        let outline = &outlines[below.outline as usize];
        let corners = outline.corners().len();
        let point = |k: usize| {
            let turned = PI + TAU * k as f64 / corners as f64;
            let (sin, cos) = sincos(turned);
            let r = r * outline.reach(TAU * k as f64 / corners as f64);
            let x: f64 = (r * cos / reach).clamp(-WIDEST, WIDEST);
            [asin(x), r * sin / sine - reach * (1.0 - (1.0 - x * x).sqrt()) * slope]
        };
        let border = (0..corners).map(point).collect();
        // The first ring stands across the limb, so far out that all of it is outside.
        let begins = (out + r * (slope.abs() + 0.2)).min(out + LEFT_OUT * (end - out));
        Self { limb, z, angle, border, begins }
    }

    /// The direction of the left corner as seen from the first ring of the limb.
    pub fn up(&self, bearer: &Course, own: &Course, outlines: &[Outline]) -> DVec3 {
        let [angle, along] = self.border[0];
        let (angle, z) = (self.angle + angle, self.z + along);
        let (sin, cos) = sincos(angle);
        bearer.point(outlines, [angle, z], [cos, sin]) - own.line(self.begins)
    }
}

/// Where the line of a limb comes out of a bearer: lengths along both, metres.
#[derive(Debug, Clone, Copy)]
pub struct Out {
    /// Along the limb.
    pub own: f64,
    /// Along the bearer.
    pub bearer: f64,
}

impl Out {
    /// Where a line comes out of a bearer, from a length along it on; `near` is a length along the bearer near by.
    /// `None` where it stays within.
    pub fn of(bearer: &Course, near: f64, own: &Course, from: f64) -> Option<Self> {
        let mut at = near;
        let mut is_out = |place: DVec3| {
            let beside = bearer.beside(place, at);
            at = beside.z;
            beside.distance >= beside.radius
        };
        let stations = own.stations();
        if is_out(own.line(from)) {
            return Some(Self { own: from, bearer: at });
        }
        let later = stations.partition_point(|station| station.z <= from);
        let first = later + stations[later..].iter().position(|station| is_out(station.at))?;
        let [mut low, mut high] = [stations[first - 1].z.max(from), stations[first].z];
        for _ in 0..HALVINGS {
            let middle = low.midpoint(high);
            if is_out(own.line(middle)) { high = middle } else { low = middle }
        }
        let [_, end] = own.ends();
        is_out(own.line(high));
        (end - high > 0.02 * stations[first].radius + 1e-6).then_some(Self { own: high, bearer: at })
    }

    /// The first length at which more than half of a limb lies in another one, looked for over some radii from where
    /// its line comes out of its bearer. One of which less does so goes through the other on its own: what both fill is
    /// then less than what would be missing, were its skin to begin where it has left the other.
    pub fn within(other: &Course, own: &Course, out: f64) -> Option<f64> {
        let (r, end) = (own.radius(out), own.ends()[1]);
        let mut near = other.ends()[0];
        (0..=LOOKED_FOR).map(|k| out + 0.5 * f64::from(k) * r).take_while(|z| *z < end).find(|z| {
            let beside = other.beside(own.line(*z), near);
            near = beside.z;
            shared(beside.distance, beside.radius, own.radius(*z)) > 0.5
        })
    }
}

/// The share of a disc of the radius `r` that lies in one of the radius `other`, whose middles are so far apart.
fn shared(apart: f64, other: f64, r: f64) -> f64 {
    if apart >= other + r {
        return 0.0;
    }
    if apart <= (other - r).abs() {
        return (other * other / (r * r)).min(1.0);
    }
    // Half of the chord in which both circles cut, and of each the part beyond it.
    let side = |of: f64, to: f64| (apart * apart + of * of - to * to) / (2.0 * apart);
    let [own_side, other_side] = [side(r, other), side(other, r)];
    let chord = (r * r - own_side * own_side).max(0.0).sqrt();
    let part = |of: f64, side: f64| of * of * atan2(chord, side) - side * chord;
    (part(r, own_side) + part(other, other_side)) / (PI * r * r)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Equal discs share half of each where their middles are 0.8079 radii apart; the lens of two that go through each
    /// other's middle has the area 2 π / 3 − √3 / 2.
    #[test]
    fn discs_share_lenses() {
        assert!((shared(0.807_945_5, 1.0, 1.0) - 0.5).abs() < 1e-6, "{}", shared(0.807_945_5, 1.0, 1.0));
        assert!((shared(1.0, 1.0, 1.0) - (2.0 * PI / 3.0 - 0.75_f64.sqrt()) / PI).abs() < 1e-12);
        assert_eq!([shared(3.1, 2.0, 1.0), shared(0.9, 2.0, 1.0)], [0.0, 1.0]);
        // A small disc on the edge of a very large one has half of itself in it; a large one holds little of it.
        assert!((shared(1000.0, 1000.0, 1.0) - 0.5).abs() < 1e-3);
        assert!((shared(0.1, 0.5, 1.0) - 0.25).abs() < 1e-12);
    }
}
