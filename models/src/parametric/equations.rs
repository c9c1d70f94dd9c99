//! The equations of Weber & Penn 1995 §4.1 to §4.3, §4.5 and §4.8, each a function of plain numbers. Angles are in
//! degrees, as in the paper, lengths in metres; a `draw` is uniform in (−1, 1), the place of ± in the paper.
//!
//! Where the paper leaves something open, the decision stands at the formula. Absent: radii (`radius`), the envelope
//! (`envelope`), and the order in which all is applied (`path`, `children`).

use super::envelope::shape_8;
use super::numbers::{Envelope, Level};
use phytomer_sim::math;
use std::f64::consts::PI;

/// What a number may fall short of the whole number that it stands for.
const ROUNDING: f64 = 1e-9;

/// The angle about x between segment `nth` of a stem, from 1, and the one before (§4.1).
///
/// The first segment follows no other: it stands as the stem is set on its parent, or upright, so that DownAngle and
/// Rotate are its own angles. A stem of n segments turns therefore by (n − 1)/n of nCurve. Where nCurveBack is not 0, a
/// segment is of the half of the stem in which it begins. nCurveV adds to the same turn; below 0 it is the angle of a
/// helix and varies nothing.
pub(super) fn turn_deg(level: &Level, nth: u32, draw: f64) -> f64 {
    if nth <= 1 {
        return 0.0;
    }
    let segments = f64::from(level.curve_res);
    let in_first_half = 2 * (nth - 1) < level.curve_res;
    let stated = match level.curve_back {
        0.0 => level.curve / segments,
        _ if in_first_half => level.curve / (0.5 * segments),
        back => back / (0.5 * segments),
    };
    stated + level.curve_v.max(0.0) / segments * draw
}

/// How far segment `nth` of a helix, from 1, is turned about the axis of the helix, degrees (§4.1 names the mode and
/// not the turn). Here a stem makes one whole turn, so that each of its n segments goes on by 360/n; `start` is the
/// place of the first.
pub(super) fn helix_deg(segments: u32, nth: u32, start: f64) -> f64 {
    start + 360.0 * f64::from(nth - 1) / f64::from(segments)
}

/// The number of clones at the end of the `nth` segment of a level that can split, from 1 in the order of creation: by
/// error diffusion (§4.2), in which the sum of the numbers is always the nearest whole number to the sum of nSegSplits.
pub(super) fn diffused(splits: f64, nth: u64) -> u32 {
    let by = |count: u64| (splits * count as f64 + 0.5 + ROUNDING).floor();
    (by(nth) - by(nth - 1)) as u32
}

/// The angle by which a stem and its clones turn away from the segment at whose end they split (§4.2): `angle` is
/// nSplitAngle ± nSplitAngleV as drawn, `declination` the angle of the segment to the vertical.
pub(super) fn split_deg(angle: f64, declination: f64) -> f64 {
    (angle - declination).max(0.0)
}

/// By how much a split is undone at each segment after the one that it has turned, to the last (§4.2: "distributed over
/// the remaining segments in the reverse direction"). The parts are equal, which the paper does not say. A split after
/// which no segment remains is not undone.
pub(super) fn give_back_deg(split: f64, turned: u32, segments: u32) -> f64 {
    if segments > turned { split / f64::from(segments - turned) } else { 0.0 }
}

/// How far a stem (number 0) or a clone of it (from 1) is turned about the vertical at a split into the stem and
/// `clones` clones (§4.2). `share` is uniform in (0, 1); `side` is below or above 0 with equal probability.
///
/// The paper has a formula for a single clone, which turns the stem and not the clone. Its words and its formula
/// disagree: "20 to 50 degrees" for level branches and "up to 140" for upright ones would need a factor of 1 in the
/// place of 0.75, with which they are 42.5 and 110. The formula is used here. For several clones the paper gives no
/// rule; here the stem and its clones stand at equal angles, as in its Figure 1.
pub(super) fn spread_deg(stem: u32, clones: u32, declination: f64, share: f64, side: f64) -> f64 {
    let apart = 20.0 + 0.75 * (30.0 + (declination - 90.0).abs()) * share * share;
    match (clones, stem) {
        (1, 0) => apart * if side < 0.0 { -1.0 } else { 1.0 },
        (0 | 1, _) => 0.0,
        _ => 360.0 * f64::from(stem) / f64::from(clones + 1),
    }
}

/// The turn about x towards the vertical, radians (§4.8), of a segment with this declination, radians, and with this
/// vertical part of its y-axis: above 0 it turns the segment upwards. A stem of n segments makes n − 1 such turns, of
/// which each takes 1/n of what is left where AttractionUp is 1, so that it does not pass the vertical.
pub(super) fn curve_up(attraction_up: f64, declination: f64, y_up: f64, segments: u32) -> f64 {
    attraction_up * declination * y_up / f64::from(segments)
}

/// ShapeRatio (§4.3). The ratio 0.7 of shape 5 is in neither of its two lines; both give 1.
pub(super) fn shape_ratio(shape: u32, ratio: f64, envelope: &Envelope) -> f64 {
    match shape {
        0 => 0.2 + 0.8 * ratio,
        1 => 0.2 + 0.8 * math::sin(PI * ratio),
        2 => 0.2 + 0.8 * math::sin(0.5 * PI * ratio),
        3 => 1.0,
        4 => tapered_ratio(ratio),
        5 if ratio <= 0.7 => ratio / 0.7,
        5 => (1.0 - ratio) / 0.3,
        6 => 1.0 - 0.8 * ratio,
        7 if ratio <= 0.7 => 0.5 + 0.5 * ratio / 0.7,
        7 => 0.5 + 0.5 * (1.0 - ratio) / 0.3,
        _ => shape_8(envelope, ratio),
    }
}

/// ShapeRatio(4, ratio).
fn tapered_ratio(ratio: f64) -> f64 {
    0.5 + 0.5 * ratio
}

/// The angle between a stem and its parent (§4.3). `ratio` is (length_parent − offset)/(length_parent − length_base),
/// in which length_base is 0 on branches.
///
/// A negative nDownAngleV is no variation: then "±" stands for the sum, so that branches point downwards at the base of
/// the crown and upwards at its top, as the paper says of the Black Tupelo.
pub(super) fn down_angle_deg(level: &Level, ratio: f64, draw: f64) -> f64 {
    let (angle, v) = (level.down_angle, level.down_angle_v);
    if v < 0.0 { angle + v * (1.0 - 2.0 * (0.2 + 0.8 * ratio)) } else { angle + v * draw }
}

/// The angle of the child `nth` (from 0) of a stem about the z-axis of the stem, from the position in which their
/// y-axes agree; the child before it is at `last` (§4.3). `rotate` is nRotate ± nRotateV as drawn, `stated` nRotate.
/// The first child of a helix is turned from the y-axis of its parent, as if a child stood there.
pub(super) fn rotate_deg(stated: f64, rotate: f64, nth: u32, last: f64) -> f64 {
    if stated < 0.0 {
        let side = if nth.is_multiple_of(2) { 1.0 } else { -1.0 };
        return side * (180.0 + rotate);
    }
    math::fmod(last + rotate, 360.0)
}

/// The place of item `nth` (from 0) of `count` in a fan, degrees about the y-axis of its parent: the fan is spread over
/// the angle `over`, and a single item stands in the middle (§4.5).
pub(super) fn fan_deg(over: f64, nth: u32, count: u32) -> f64 {
    if count > 1 { over * (f64::from(nth) / f64::from(count - 1) - 0.5) } else { 0.0 }
}

/// The number of stems for a real number of them: ⌈x⌉.
pub(super) fn stems(x: f64) -> u32 {
    (x - ROUNDING).ceil().max(0.0) as u32
}

/// The number of leaves for a real number of them: ⌊x⌋.
pub(super) fn leaves(x: f64) -> u32 {
    (x + ROUNDING).floor().max(0.0) as u32
}

/// The real number of children that a stem bears (§4.3), of `most` at most. On the trunk it is `most`; on a branch of
/// the trunk it follows from the length, of which `greatest` was possible, on further branches from the place on the
/// parent; both are shares of the parent's length.
pub(super) fn children(level: u8, most: f64, length: f64, greatest: f64, offset: f64) -> f64 {
    match level {
        0 => most,
        1 => most * (0.2 + 0.8 * length / greatest),
        _ => most * (1.0 - 0.5 * offset),
    }
}

/// The real number of leaves on a stem (§4.5): more on stems nearer to the tip of their parent; `offset` is the place
/// of the stem over the length of its parent. On the trunk, which has no parent, it is `most`.
pub(super) fn leaves_on(level: u8, most: f64, offset: f64, quality: f64) -> f64 {
    if level == 0 { most * quality } else { most * tapered_ratio(offset) * quality }
}
