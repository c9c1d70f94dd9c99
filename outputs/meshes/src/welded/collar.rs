//! Collars: the foot of each limb widens into its bearer, while both are drawn as ever.
//!
//! A collar is a skirt around the foot. Its lower edge lies on the bearer's skin, wider than the hole would be that
//! the limb needs there; its upper edge lies on the limb. Between them each line is a parabola that touches both
//! skins, since its middle corner is on both: the border of the hole (`foot`). Absent: the limbs, which are tubes of
//! their own.

use super::skin::{Line, Point, Skin};
use super::{Course, Foot, Outline};
use glam::DVec3;
use phytomer_sim::math::sincos;
use phytomer_sim::plant::NodeId;
use std::f64::consts::TAU;

/// How wide the lower edge is, in widths of the hole.
const WIDE: f64 = 1.6;
/// How far up the limb the upper edge is, in its radii.
const HIGH: f64 = 1.5;
/// The stretches between the edges.
const STRETCHES: usize = 4;
/// How far below the bearer's skin the lower edge is, in parts of the bearer's radius.
const SUNK: f64 = 0.06;
/// How far around its bearer a collar reaches to either side, radians.
const FARTHEST: f64 = 1.5;

/// Adds the collar of a limb.
pub fn add(skin: &mut Skin, (bearer, foot): (&Course, &Foot), own: &Course, outlines: &[Outline]) {
    let [begins, end] = own.ends();
    let first = &own.stations()[0];
    let high = (begins + HIGH * first.radius).min(end);
    let count = foot.border.len();
    let at = |[angle, along]: [f64; 2], wide: f64| {
        let (angle, z) = (foot.angle + (wide * angle).clamp(-FARTHEST, FARTHEST), foot.z + wide * along);
        let [low, up] = bearer.ends();
        let (sin, cos) = sincos(angle);
        bearer.point(outlines, [angle, z.clamp(low, up)], [cos, sin])
    };
    // Where the border begins as seen along the limb.
    let start = own.angle(begins, at(foot.border[0], 1.0) - first.at).unwrap_or(0.0);
    let corners: Vec<[DVec3; 3]> = (0..count)
        .map(|k| {
            let angle = start + TAU * k as f64 / count as f64;
            let (sin, cos) = sincos(angle);
            // A little below the bearer's skin, so that its facets do not show the edge as teeth.
            let low = at(foot.border[k], WIDE).lerp(bearer.line(foot.z + foot.border[k][1]), SUNK);
            [low, at(foot.border[k], 1.0), own.point(outlines, [angle, high], [cos, sin])]
        })
        .collect();
    let mut below: Option<Line> = None;
    for step in 0..=STRETCHES {
        let line = ring(skin, &corners, step as f64 / STRETCHES as f64, (begins, first.node));
        if let Some(below) = &below {
            skin.join(below, &line);
        }
        below = Some(line);
    }
}

/// The points of all parabolas at a share of the way up.
fn ring(skin: &mut Skin, corners: &[[DVec3; 3]], share: f64, (z, node): (f64, NodeId)) -> Line {
    let mut line = Line::default();
    for (k, [low, middle, high]) in corners.iter().enumerate() {
        let at = low.lerp(*middle, share).lerp(middle.lerp(*high, share), share);
        let angle = TAU * k as f64 / corners.len() as f64;
        let one = skin.points.len() as u32;
        skin.points.push(Point { at: at.as_vec3().to_array(), one, angle: angle as f32, z: (z + share) as f32, node });
        line.push(one, angle);
    }
    skin.close(&mut line);
    line
}
