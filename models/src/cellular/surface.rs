//! How a tip that grows straight on heeds the obstacles of the site: it turns along the surface that it would enter.
//!
//! A segment is asked at 32 points whether an obstacle is there, so that a wall thinner than a 32nd of a segment may be
//! passed, and an edge be cut by as much. Where the segment would enter, the part of its heading into the surface is
//! taken away: the tip goes on along the surface, the way that is nearest to its own. Where that way is shut as well,
//! as in a corner or a hollow, it is lifted off the surface by 10°, 20° … 90°, and the first that is open holds, if the
//! tip turns by no more than 100°; a tip with none grows no more. A tip that meets a surface head-on goes along it in a
//! drawn direction. The sources print no rule for it, so this one is ours. Absent: voxels, which touch obstacles by
//! themselves (`space`).

use super::around::{Around, unit};
use phytomer_sim::math::sincos;
use phytomer_sim::rotation::Rotation;
use std::f64::consts::{FRAC_PI_2, TAU};

/// The points of a segment that are asked.
const POINTS: u32 = 32;
/// The angles by which a way along a surface is lifted, as so many parts of a right angle.
const LIFTS: u32 = 9;
/// The sine of the angle to the normal below which a tip meets a surface head-on.
const HEAD_ON: f64 = 1e-6;
/// The cosine of the largest turn, 100°: a tip goes along a surface that it meets head-on, and does not go back.
const LARGEST_TURN: f64 = -0.173_648_177_666_930_35;

/// The heading of a segment from a place that keeps out of the obstacles: its own where it is open, else along the
/// surface. `turn` draws a number in (0, 1) for a tip that meets a surface head-on. `None` where no way is open.
pub(super) fn heeded(
    around: &Around<'_>,
    at: [f64; 3],
    heading: [f64; 3],
    length: f64,
    turn: impl FnOnce() -> f64,
) -> Option<[f64; 3]> {
    let Some(contact) = contact(around, at, heading, length) else { return Some(heading) };
    let out = around.opens(contact, 1e-3 * length)?;
    let into = (0..3).map(|k| heading[k] * out[k]).sum::<f64>().min(0.0);
    let beside = [0, 1, 2].map(|k| heading[k] - into * out[k]);
    let across = beside.iter().map(|x| x * x).sum::<f64>().sqrt();
    let along = if across > HEAD_ON { unit(beside)? } else { turned(out, turn()) };
    let lifted = |k: u32| {
        let (sin, cos) = sincos(FRAC_PI_2 * f64::from(k) / f64::from(LIFTS));
        [0, 1, 2].map(|axis| cos * along[axis] + sin * out[axis])
    };
    let turns_little = |new: &[f64; 3]| (0..3).map(|k| new[k] * heading[k]).sum::<f64>() >= LARGEST_TURN;
    let is_open = |new: &[f64; 3]| contact_share(around, at, *new, length).is_none();
    (0..=LIFTS).map(lifted).take_while(turns_little).find(is_open)
}

/// A direction in a surface with this normal, by a share of a full turn.
fn turned(normal: [f64; 3], turn: f64) -> [f64; 3] {
    let (sin, cos) = sincos(TAU * turn);
    Rotation::to(normal, [0.0, 0.0, 1.0]).turned([0.0, cos, sin])
}

/// The share of a segment at the first of its points in an obstacle; `None` where it has none.
fn contact_share(around: &Around<'_>, at: [f64; 3], heading: [f64; 3], length: f64) -> Option<f64> {
    let share = |k: u32| f64::from(k) / f64::from(POINTS);
    let point = |share: f64| [0, 1, 2].map(|k| at[k] + share * length * heading[k]);
    (1..=POINTS).map(share).find(|share| around.is_shut(point(*share)))
}

/// Where a segment enters an obstacle, just within it.
fn contact(around: &Around<'_>, at: [f64; 3], heading: [f64; 3], length: f64) -> Option<[f64; 3]> {
    let point = |share: f64| [0, 1, 2].map(|k| at[k] + share * length * heading[k]);
    let shut = contact_share(around, at, heading, length)?;
    let (mut open, mut shut) = (shut - 1.0 / f64::from(POINTS), shut);
    for _ in 0..16 {
        let middle = 0.5 * (open + shut);
        *(if around.is_shut(point(middle)) { &mut shut } else { &mut open }) = middle;
    }
    Some(point(shut))
}
