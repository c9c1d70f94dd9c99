//! The equations of Weber & Penn 1995 §4.1 to §4.4, each a function of plain numbers. Angles are in degrees, as in the
//! paper, lengths in metres; a `draw` is uniform in (−1, 1), the place of ± in the paper.
//!
//! Where the paper leaves something open, the decision stands at the formula. Absent: the stems and their draws
//! (`stems`); tapers above 1, flare and lobes (§4.4), and the envelope among the forms of crowns (§4.6).

use super::tree::Crown;
use phytomer_sim::math;
use std::f64::consts::PI;

/// nCurveRes, nCurve, nCurveBack and nCurveV of a level (§4.1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Curve {
    pub segments: u32,
    pub deg: f64,
    pub back_deg: f64,
    pub v_deg: f64,
}

impl Curve {
    /// The angle about x between segment `nth` of a stem, from 1, and the one before (§4.1).
    ///
    /// The first segment follows no other: it stands as the stem is set on its parent, or upright, so that DownAngle
    /// and Rotate are its own angles. A stem of n segments turns therefore by (n − 1)/n of nCurve. Where nCurveBack is
    /// not 0, a segment is of the half of the stem in which it begins.
    pub fn turn_deg(&self, nth: u32, draw: f64) -> f64 {
        if nth <= 1 {
            return 0.0;
        }
        let segments = f64::from(self.segments);
        let in_first_half = 2 * (nth - 1) < self.segments;
        let stated = match self.back_deg {
            0.0 => self.deg / segments,
            _ if in_first_half => self.deg / (0.5 * segments),
            back => back / (0.5 * segments),
        };
        stated + self.v_deg / segments * draw
    }
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
/// rule; here the stem and its clones stand at equal angles.
pub(super) fn spread_deg(stem: u32, clones: u32, declination: f64, share: f64, side: f64) -> f64 {
    let apart = 20.0 + 0.75 * (30.0 + (declination - 90.0).abs()) * share * share;
    match (clones, stem) {
        (1, 0) => apart * if side < 0.0 { -1.0 } else { 1.0 },
        (0 | 1, _) => 0.0,
        _ => 360.0 * f64::from(stem) / f64::from(clones + 1),
    }
}

/// Where a branch leaves its parent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    /// offset_child over length_parent.
    pub share: f64,
    /// The segment of the parent, from 0.
    pub segment: u32,
    /// The number of the branch among the branches on that segment, from 0.
    pub position: u16,
    /// (length_parent − offset_child) / (length_parent − length_base): 1 at the base of the crown, 0 at the top.
    pub ratio: f64,
}

/// The places of all `number` branches of a parent, from the base to the top (§4.3). `base` is length_base over
/// length_parent, below 1.
///
/// The paper does not say where along its parent a branch stands. Here the part of the parent above its base is divided
/// into equal parts, one for each branch, and each branch stands in the middle of its part.
pub(super) fn places(number: u32, base: f64, segments: u32) -> impl Iterator<Item = Place> {
    let mut last = None;
    (0..number).map(move |nth| {
        let above = (f64::from(nth) + 0.5) / f64::from(number);
        let share = base + above * (1.0 - base);
        let segment = ((share * f64::from(segments)) as u32).min(segments - 1);
        let before = last.filter(|last: &Place| last.segment == segment);
        let place = Place { share, segment, position: before.map_or(0, |last| last.position + 1), ratio: 1.0 - above };
        last = Some(place);
        place
    })
}

/// ShapeRatio (§4.3). The ratio 0.7 of shape 5 is in neither of its two lines; both give 1.
pub(super) fn shape_ratio(shape: Crown, ratio: f64) -> f64 {
    match shape {
        Crown::Conical => 0.2 + 0.8 * ratio,
        Crown::Spherical => 0.2 + 0.8 * math::sin(PI * ratio),
        Crown::Hemispherical => 0.2 + 0.8 * math::sin(0.5 * PI * ratio),
        Crown::Cylindrical => 1.0,
        Crown::TaperedCylindrical => 0.5 + 0.5 * ratio,
        Crown::Flame if ratio <= 0.7 => ratio / 0.7,
        Crown::Flame => (1.0 - ratio) / 0.3,
        Crown::InverseConical => 1.0 - 0.8 * ratio,
        Crown::TendFlame if ratio <= 0.7 => 0.5 + 0.5 * ratio / 0.7,
        Crown::TendFlame => 0.5 + 0.5 * (1.0 - ratio) / 0.3,
    }
}

/// The angle between a branch and its parent (§4.3).
///
/// A negative nDownAngleV is no variation: then "±" stands for the sum, so that branches point downwards at the base of
/// the crown and upwards at its top, as the paper says of the Black Tupelo.
pub(super) fn down_angle_deg(angle: f64, v: f64, ratio: f64, draw: f64) -> f64 {
    if v < 0.0 { angle + v * (1.0 - 2.0 * shape_ratio(Crown::Conical, ratio)) } else { angle + v * draw }
}

/// The angle of branch `nth` (from 0) about the z-axis of the parent, from the position in which their y-axes agree;
/// the branch before it is at `last` (§4.3). `rotate` is nRotate ± nRotateV as drawn, `stated` nRotate. The first
/// branch of a helix is turned from the y-axis of its parent, as if a branch stood there.
pub(super) fn rotate_deg(stated: f64, rotate: f64, nth: u32, last: f64) -> f64 {
    if stated < 0.0 {
        let side = if nth.is_multiple_of(2) { 1.0 } else { -1.0 };
        return side * (180.0 + rotate);
    }
    math::fmod(last + rotate, 360.0)
}

/// The radius at the base of a branch (§4.4), at most `there`, the radius of the parent where the branch leaves it.
pub(super) fn branch_radius(parent_radius: f64, length_ratio: f64, ratio_power: f64, there: f64) -> f64 {
    (parent_radius * math::pow(length_ratio, ratio_power)).min(there)
}

/// The radius of a stem at the share `z` of its length, for nTaper from 0 to 1 (§4.4: unit_taper is nTaper below 1 and
/// 2 − nTaper at 1; the two agree at 1).
pub(super) fn tapered(radius: f64, taper: f64, z: f64) -> f64 {
    radius * (1.0 - taper * z)
}
