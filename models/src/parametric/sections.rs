//! Cross sections of stems (Weber & Penn 1995 §4.4): the lobes and the flare of the trunk, and the spheres of tapers
//! above 1.
//!
//! A segment is a frustum between its two ends. Where lobes, the flare or spheres make it another solid, it has a
//! section: corners by the sine of the lobes, whatever the number of sides that a mesh is asked for, and rings between
//! its ends. Sections belong to the species. Those of the trunk are made for its radius without 0ScaleV. Branches with
//! a taper above 1 differ in radius over length, and have sections for a series of such ratios, of which the nearest is
//! taken. Absent: the sections themselves (`phytomer_looks::Section`).

use super::numbers::Numbers;
use super::radius::{flare, lobe, radius_at};
use phytomer_looks::{Paints, Section};
use phytomer_sim::math::{self, sincos};
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

/// The classes of branches by radius over length: quarters of an octave, from 2⁻⁸ to 1; fewer where stems have so many
/// segments that there would be more sections than `MOST_SECTIONS`.
const OCTAVES: f64 = 8.0;
const MOST_CLASSES: u32 = 32;
const MOST_SECTIONS: u32 = 1600;

/// The places of the sections of a tree among its paints.
#[derive(Debug, Clone, Default)]
pub(super) struct Sections {
    /// For each level from 0 to 3 its classes, each with the place of the section of each segment from the base.
    levels: [Vec<Vec<Option<u16>>>; 4],
}

impl Sections {
    /// Adds the sections that a tree needs to the paints.
    pub fn of(tree: &Numbers, paints: &mut Paints) -> Self {
        let mut levels: [Vec<Vec<Option<u16>>>; 4] = Default::default();
        let lobed = tree.lobes > 0 && tree.lobe_depth > 0.0;
        let taper = |level: u8| tree.of(level).taper;
        if lobed || tree.flare > 0.0 || taper(0) > 1.0 {
            levels[0].push(of_class(tree, 0, tree.ratio * tree.radius_scale, lobed, paints));
        }
        for level in (1..tree.levels.min(4)).filter(|level| taper(*level) > 1.0) {
            let classes = classes(tree.of(level).curve_res);
            let thick = |class: u32| math::exp2(OCTAVES * (f64::from(class) / f64::from(classes - 1) - 1.0));
            let all = (0..classes).map(|class| of_class(tree, level, thick(class), true, paints));
            levels[usize::from(level)] = all.collect();
        }
        Self { levels }
    }

    /// The place of the section of segment `nth`, from 0 at its base, of a stem whose radius at the base is `thick` of
    /// its length; `None` where the segment is a plain frustum.
    pub fn at(&self, level: u8, thick: f64, nth: u32) -> Option<u16> {
        let classes = &self.levels[usize::from(level.min(3))];
        let last = classes.len().checked_sub(1)?;
        let share = 1.0 + math::log2(thick.max(f64::MIN_POSITIVE)) / OCTAVES;
        let class = (share.clamp(0.0, 1.0) * last as f64).round() as usize;
        classes[class].get(nth as usize).copied().flatten()
    }
}

fn classes(curve_res: u32) -> u32 {
    (MOST_SECTIONS / curve_res).clamp(2, MOST_CLASSES)
}

/// The sections of the segments of a stem whose radius is `thick` of its length. `all` tells whether segments without
/// rings have one too, so that they are joined where the stem bends.
fn of_class(tree: &Numbers, level: u8, thick: f64, all: bool, paints: &mut Paints) -> Vec<Option<u16>> {
    let mut plain = None;
    let segment = |nth: u32| {
        let rings = rings(tree, level, thick, nth);
        match rings.is_empty() {
            true if !all => None,
            true => Some(*plain.get_or_insert_with(|| paints.add_section(section(tree, level, Vec::new())) as u16)),
            false => Some(paints.add_section(section(tree, level, rings)) as u16),
        }
    };
    (0..tree.of(level).curve_res).map(segment).collect()
}

/// The lobed or round section with rings. Angles count from the paper's x-axis, which is to the left, about its z-axis,
/// which is the heading; corners are told up and to the right.
fn section(tree: &Numbers, level: u8, rings: Vec<[f32; 2]>) -> Section {
    let lobes = if level == 0 && tree.lobe_depth > 0.0 { tree.lobes } else { 0 };
    let a_lobe = if lobes > 10 { A_SMALL_LOBE } else { A_LOBE };
    let corners = (lobes * a_lobe).max(ROUND.next_multiple_of(lobes.max(1)));
    let corner = |k: u32| {
        let angle = TAU * f64::from(k) / f64::from(corners);
        let (radius, (sin, cos)) = (lobe(lobes, tree.lobe_depth, angle), sincos(angle));
        [(radius * sin) as f32, (-radius * cos) as f32]
    };
    Section::of((0..corners).map(corner).collect(), true).with_rings(rings)
}

/// The rings between the ends of segment `nth` of a stem, from 0 at its base: of each the share of the segment's
/// length, and the bulge in lengths of the segment.
fn rings(tree: &Numbers, level: u8, thick: f64, nth: u32) -> Vec<[f32; 2]> {
    let (res, taper) = (f64::from(tree.of(level).curve_res), tree.of(level).taper);
    let wider = if level == 0 { tree.flare } else { 0.0 };
    // A stem of length 1.
    let radius = |z: f64| radius_at(z, taper, thick, 1.0) * flare(wider, z);
    let [from, to] = [f64::from(nth) / res, f64::from(nth + 1) / res];
    let mut heights: Vec<f64> = Vec::new();
    if wider > 0.0 {
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

/// The heights of the rings of all spheres of a stem of length 1, down from its end: about the middle of each, at even
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
