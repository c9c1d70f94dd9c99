//! The needles of a piece of shoot, each by itself, golden angles apart around it, and the piece itself.
//!
//! A needle is slim or full about its own middle line, so that the brush has the area of the tables at every length.
//! Absent: how many needles there are, and how they stand (`phytomer_looks::Brush`).

use super::super::{Depth, FormMesh};
use super::build::{Build, Vector, sum, unit};
use super::sheet;
use phytomer_looks::{Brush, GOLDEN_DEG};
use phytomer_sim::math::sincosf;

/// The colour of the shoot, and its share of 255; its radius over the width of the brush.
const BROWN: [u8; 4] = [128, 104, 74, 255];
const THIN: f32 = 0.01;

/// Places along a needle with half its width there, by detail.
const POINTED: [&[[f32; 2]]; 4] = [
    &[[0.0, 1.0], [1.0, 0.0]],
    &[[0.0, 0.8], [1.0, 0.0]],
    &[[0.0, 0.6], [0.3, 1.0], [1.0, 0.0]],
    &[[0.0, 0.5], [0.12, 0.92], [0.5, 1.0], [0.86, 0.8], [1.0, 0.0]],
];

/// The angle between the needles of a bundle and its middle, radians.
const APART: f32 = 0.09;

/// Needles that leave their shoot at less than this angle, degrees, are upright.
const UPRIGHT: f32 = 45.0;

/// The greatest width of a needle over the mean length, before it is fitted to an area.
const BROADEST: f32 = 0.2;

/// The share of the box that the needles fill before they are made slimmer or fuller.
const FILLED: f32 = 0.5;

/// A brush of a width over its length.
pub fn brush(brush: &Brush, aspect: f32, detail: u8) -> FormMesh {
    let mut build = Build::default();
    let half = 0.5 * aspect;
    let bundles = brush.needles.div_ceil(u16::from(brush.bundle.max(1)));
    let mut lines = Vec::new();
    for needle in 0..brush.needles {
        let bundle = needle / u16::from(brush.bundle.max(1));
        let share = (f32::from(bundle) + 0.5) / f32::from(bundles);
        let within = needle % u16::from(brush.bundle.max(1));
        lines.push(line(brush, (bundle, within), share, half));
    }
    let whole: f32 = lines.iter().map(|(_, _, length)| length).sum();
    let wide = (FILLED * aspect / whole.max(1e-6)).min(BROADEST * whole / f32::from(brush.needles.max(1)));
    for (base, ahead, length) in lines {
        needle_of(&mut build, (base, ahead, length), (0.5 * wide, brush.bend_deg.to_radians()), detail);
    }
    if brush.shoot > 0.0 {
        // The last brush of a shoot stands on no internode.
        let thin = THIN * aspect;
        let line = [([0.0; 3], thin), ([brush.shoot, 0.0, 0.0], 0.6 * thin)];
        build.tint = BROWN;
        sheet::tube(&mut build, &line, [0.0, 0.0, 1.0], 4 + u16::from(detail));
    }
    build.into_form(aspect, Depth::Width, true)
}

/// The base, the direction and the length of a needle.
fn line(brush: &Brush, (bundle, within): (u16, u16), share: f32, half: f32) -> (Vector, Vector, f32) {
    let degrees = brush.first_deg + share * (brush.last_deg - brush.first_deg);
    let (turn_sin, turn_cos) = sincosf((f32::from(bundle) * GOLDEN_DEG % 360.0).to_radians());
    // Combed needles are turned to the nearer side, and rise a little: the rows of both sides are not one plane.
    let flat = 1.0 - brush.combed;
    let side = if turn_cos < 0.0 { -brush.combed } else { brush.combed };
    let out = unit([0.0, turn_cos * flat + side, turn_sin * flat + 0.15 * brush.combed]);
    let aside = super::build::cross([1.0, 0.0, 0.0], out);
    let (sin, cos) = sincosf(degrees.to_radians());
    let turn = std::f32::consts::TAU * f32::from(within) / f32::from(brush.bundle.max(1));
    let (bundle_sin, bundle_cos) = sincosf(turn);
    let spread = if brush.bundle > 1 { APART } else { 0.0 };
    let middle = sum(&[(cos, [1.0, 0.0, 0.0]), (sin, out)]);
    let across = sum(&[(-sin, [1.0, 0.0, 0.0]), (cos, out)]);
    let ahead = unit(sum(&[(1.0, middle), (spread * bundle_cos, aside), (spread * bundle_sin, across)]));
    let at = share * brush.shoot;
    let (ahead, length) = reaching(ahead, 1.0 - at, half, brush);
    ([at, 0.0, 0.0], ahead, length)
}

/// The direction and the length of a needle whose tip reaches the box: of a rosette an ellipsoid; of a shoot its side,
/// or its end where needles are upright, whose angles then follow from the width.
fn reaching(ahead: Vector, left_over: f32, half: f32, brush: &Brush) -> (Vector, f32) {
    let [along, aside] = [ahead[0].max(1e-3), (ahead[1] * ahead[1] + ahead[2] * ahead[2]).sqrt().max(1e-3)];
    if brush.shoot <= 0.0 {
        return (ahead, 1.0 / (along * along + aside * aside / (half * half).max(1e-9)).sqrt());
    }
    if brush.first_deg >= UPRIGHT {
        return (ahead, (half / aside).min(left_over / along));
    }
    let by = (half / (left_over * aside / along)).min(1.0) * left_over / along;
    let way = [left_over, by * ahead[1], by * ahead[2]];
    (unit(way), super::build::dot(way, way).sqrt())
}

/// Adds a needle: a folded strip that bends towards the shoot's tip.
fn needle_of(build: &mut Build, (base, ahead, length): (Vector, Vector, f32), (half, bend): (f32, f32), detail: u8) {
    let towards = unit(sum(&[(1.0, [1.0, 0.0, 0.0]), (-ahead[0], ahead)]));
    let left = super::build::cross(towards, ahead);
    // No needle bends beyond its shoot's direction.
    let aside = (ahead[1] * ahead[1] + ahead[2] * ahead[2]).sqrt();
    let bend = bend.clamp(-aside, aside);
    let keel = if detail > 2 { 0.45 } else { 0.0 };
    let columns: &[f32] = if detail > 2 { &[-1.0, 0.0, 1.0] } else { &[-1.0, 1.0] };
    let mut before: Vec<u32> = Vec::new();
    for [share, wide] in POINTED[usize::from(detail.min(3))] {
        let rise = 0.5 * bend * share * share * length;
        let on = sum(&[(1.0, base), (share * length, ahead), (rise, towards)]);
        let row: Vec<u32> = (columns.iter())
            .map(|side| {
                let across = sum(&[(side * wide * half, left), (-keel * (1.0 - side.abs()) * wide * half, towards)]);
                build.corner(sum(&[(1.0, on), (1.0, across)]), across, [0.5 + 0.5 * side, *share])
            })
            .collect();
        for (from, to) in before.windows(2).zip(row.windows(2)) {
            build.quad([from[0], to[0], to[1], from[1]]);
        }
        before = row;
    }
}
