//! Cross sections of the trunk (Weber & Penn 1995 §4.4): its lobes, its flare, and the spheres of a taper above 1.
//!
//! A segment of the trunk is a frustum between its two ends. Where lobes, the flare or spheres make it another solid,
//! it has a section: corners by the sine of the lobes, whatever the number of sides that a mesh is asked for, and rings
//! between its ends. A section belongs to the species: where 0ScaleV makes the trunk of a plant thicker or thinner, the
//! rings keep the bulge of the trunk that is not varied. Branches have no sections: the sphere at the end of one with a
//! taper above 1 is a cone over its last segment. Absent: the sections themselves (`phytomer_looks::Section`).

use super::numbers::Numbers;
use super::radius::{flare, lobe, radius_at};
use phytomer_looks::{Paints, Section};
use phytomer_sim::math::sincos;
use std::f64::consts::TAU;

/// The corners of a round trunk, and those of a lobe of few or of many.
const ROUND: u32 = 16;
const A_LOBE: u32 = 6;
const A_SMALL_LOBE: u32 = 4;

/// The rings of the flare, as shares of the part of the trunk that flares, and those of a sphere.
const FLARE: [f64; 6] = [0.125, 0.25, 0.375, 0.5, 0.75, 1.0];
const FLARES_TO: f64 = 0.125;
const A_SPHERE: u32 = 8;
/// The most rings of a segment.
const MOST_RINGS: usize = 64;

/// Adds the sections of the trunk to the paints. Returns the place of that of each segment, from the base; nothing
/// where every segment is a plain frustum.
pub(super) fn of_trunk(tree: &Numbers, paints: &mut Paints) -> Vec<Option<u16>> {
    let lobed = tree.lobes > 0 && tree.lobe_depth > 0.0;
    let mut plain = None;
    let segment = |nth: u32| {
        let rings = rings(tree, nth);
        if rings.is_empty() && !lobed {
            return None;
        }
        if rings.is_empty() {
            return Some(*plain.get_or_insert_with(|| paints.add_section(section(tree, Vec::new())) as u16));
        }
        Some(paints.add_section(section(tree, rings)) as u16)
    };
    (0..tree.of(0).curve_res).map(segment).collect()
}

/// The lobed or round section with rings. Angles count from the paper's x-axis, which is to the left, about its z-axis,
/// which is the heading; corners are told up and to the right.
fn section(tree: &Numbers, rings: Vec<[f32; 2]>) -> Section {
    let lobes = if tree.lobe_depth > 0.0 { tree.lobes } else { 0 };
    let a_lobe = if lobes > 10 { A_SMALL_LOBE } else { A_LOBE };
    let corners = (lobes * a_lobe).max(ROUND.next_multiple_of(lobes.max(1)));
    let corner = |k: u32| {
        let angle = TAU * f64::from(k) / f64::from(corners);
        let (radius, (sin, cos)) = (lobe(lobes, tree.lobe_depth, angle), sincos(angle));
        [(radius * sin) as f32, (-radius * cos) as f32]
    };
    Section::of((0..corners).map(corner).collect(), true).with_rings(rings)
}

/// The rings between the ends of segment `nth` of the trunk, from 0 at its base: of each the share of the segment's
/// length, and the bulge in lengths of the segment.
fn rings(tree: &Numbers, nth: u32) -> Vec<[f32; 2]> {
    let (res, taper) = (f64::from(tree.of(0).curve_res), tree.of(0).taper);
    // The trunk of length 1.
    let thick = tree.ratio * tree.radius_scale;
    let radius = |z: f64| radius_at(z, taper, thick, 1.0) * flare(tree.flare, z);
    let [from, to] = [f64::from(nth) / res, f64::from(nth + 1) / res];
    let mut heights: Vec<f64> = Vec::new();
    if tree.flare > 0.0 {
        heights.extend(FLARE.map(|share| share * FLARES_TO));
    }
    if taper > 1.0 {
        heights.extend(spheres(thick, taper));
    }
    heights.retain(|z| *z > from + 1e-6 && *z < to - 1e-6);
    heights.sort_by(f64::total_cmp);
    heights.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
    let sparse = heights.len().div_ceil(MOST_RINGS).max(1);
    let ring = |z: f64| {
        let share = (z - from) / (to - from);
        let even = radius(from) + share * (radius(to) - radius(from));
        [share as f32, ((radius(z) - even) / (to - from)) as f32]
    };
    heights.into_iter().step_by(sparse).map(ring).collect()
}

/// The heights of the rings of all spheres of a trunk of length 1, down from its end: about the middle of each, at even
/// angles. Below a taper of 2 the sphere at the end alone.
fn spheres(thick: f64, taper: f64) -> Vec<f64> {
    let radius = thick * if taper < 2.0 { taper - 1.0 } else { 1.0 };
    let most = if taper < 2.0 { 1 } else { (0.5 / radius).min(1000.0) as u32 + 1 };
    let ring = |k: u32| {
        let (_, cos) = sincos(0.5 * TAU * f64::from(k % A_SPHERE) / f64::from(A_SPHERE));
        2.0 * radius * f64::from(k / A_SPHERE) + radius * (1.0 - cos)
    };
    (1..most * A_SPHERE + 1).map(|k| 1.0 - ring(k)).filter(|z| *z > 0.0).collect()
}
