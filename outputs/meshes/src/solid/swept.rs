//! Sea shells: the circle in a half plane through the axis, swept along its helico-spiral, with a flat disc at either
//! end.
//!
//! Each turn has 48 circles of 24 points, at most [`MOST_CIRCLES`] in all. Absent: shells that cross themselves are
//! drawn as they are swept.

use super::Solid;
use super::turned::{Ring, SIDES};
use phytomer_sim::math::sincos;
use phytomer_sim::shape::Shell;
use std::f64::consts::TAU;

/// The points of a circle.
const CIRCLE: u32 = 24;
/// The most circles: those of twenty turns.
const MOST_CIRCLES: u32 = 20 * SIDES;

pub(super) fn shell(of: &Shell) -> Solid {
    let turns = of.last();
    let steps = ((turns * f64::from(SIDES)).ceil() as u32).clamp(1, MOST_CIRCLES);
    let mut solid = Solid::default();
    let mut before = None;
    for step in 0..=steps {
        let ring = circle(&mut solid, of, turns * f64::from(step) / f64::from(steps));
        match before {
            Some(before) => solid.join(before, ring),
            None => disc(&mut solid, of, 0.0, ring, true),
        }
        before = Some(ring);
    }
    if let Some(last) = before {
        disc(&mut solid, of, turns, last, false);
    }
    solid
}

/// Adds the circle after so many turns.
fn circle(solid: &mut Solid, of: &Shell, turns: f64) -> Ring {
    let ring = Ring::of(solid.points.len() as u32, CIRCLE);
    let [centre, height, radius] = of.circle(turns);
    let (sin, cos) = sincos(TAU * turns);
    // Counterclockwise as seen from where the shell goes on.
    for point in 0..CIRCLE {
        let (down, out) = sincos(TAU * f64::from(point) / f64::from(CIRCLE));
        let across = centre + radius * out;
        solid.points.push([of.foot[0] + across * cos, of.foot[1] + across * sin, of.foot[2] + height - radius * down]);
    }
    ring
}

/// Closes the shell after so many turns; the first disc looks back.
fn disc(solid: &mut Solid, of: &Shell, turns: f64, ring: Ring, looks_back: bool) {
    let [centre, height, _] = of.circle(turns);
    let (sin, cos) = sincos(TAU * turns);
    let middle = Ring::of(solid.points.len() as u32, 1);
    solid.points.push([of.foot[0] + centre * cos, of.foot[1] + centre * sin, of.foot[2] + height]);
    if looks_back { solid.join(middle, ring) } else { solid.join(ring, middle) }
}
