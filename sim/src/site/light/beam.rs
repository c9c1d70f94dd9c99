//! One beam on its way through the voxels, and all beams of one source (Amanatides & Woo 1987).
//!
//! From face to face the way in each voxel is exact. Of a beam of the intensity I a voxel with the extinction κ = G a
//! keeps I (1 − e^(−κ l)) on the way l; the mean intensity in it is I (1 − e^(−κ l)) / (κ l). Absent: which beams there
//! are (`lattice`), and the sums over all sources (`field`).

use super::grid::{BITS, Grid, NONE, VOXELS, Voxel, within_brick};
use super::lattice::{Beam, each_beam};
use super::shadow::Shadows;
use super::{Balance, Source};
use crate::math::exp;
use crate::shape::Point;

/// The light of one source.
#[derive(Debug)]
pub struct Shone {
    /// Of each voxel, the intensity along the ways of beams in it, summed over the ways, and the ways, metres; the
    /// intensity on open ground is 1.
    pub along: Vec<[f64; 2]>,
    /// What becomes of the light, m² across the beams.
    pub balance: Balance,
    /// The area across one beam, m².
    pub section: f64,
}

/// Sends the beams of a source through a grid whose voxels have these extinctions, 1/m.
pub fn shine(grid: &Grid, extinction: &[f64], shadows: &Shadows, source: &Source) -> Shone {
    let mut shone = Shone { along: vec![[0.0; 2]; extinction.len()], balance: Balance::default(), section: 0.0 };
    each_beam(grid, source, shadows.top(), &mut |beam| follow(grid, extinction, shadows, beam, &mut shone));
    shone
}

fn follow(grid: &Grid, extinction: &[f64], shadows: &Shadows, beam: &Beam, shone: &mut Shone) {
    let (Some(first), Some(last)) = (beam.stretches.first(), beam.stretches.last()) else { return };
    let dark_from = if shadows.is_empty() { f64::INFINITY } else { dark_from(shadows, beam, [first[0], last[1]]) };
    let mut light = 1.0;
    let mut kept = 0.0;
    for &[from, to] in beam.stretches {
        let lit_to = to.min(dark_from);
        let mut walk = |from: f64, to: f64, light: &mut f64| {
            let mut in_voxel = |index: usize, way: f64| {
                let k = extinction[index];
                let sums = &mut shone.along[index];
                sums[1] += way;
                if k > 0.0 && *light > 0.0 {
                    let lost = lost(k * way);
                    sums[0] += *light * lost / k;
                    kept += *light * lost;
                    *light -= *light * lost;
                } else {
                    sums[0] += *light * way;
                }
            };
            walk(grid, beam, [from, to], &mut in_voxel);
        };
        if lit_to > from {
            walk(from, lit_to, &mut light);
        }
        if lit_to < to {
            walk(from.max(lit_to), to, &mut 0.0);
        }
    }
    let stopped = if dark_from < last[1] { light } else { 0.0 };
    let balance = Balance { sent: 1.0, kept, stopped, passed: light - stopped };
    let section = beam.section;
    let scaled = |of: f64| of * section;
    shone.section = section;
    shone.balance = shone.balance.with(Balance {
        sent: section,
        kept: scaled(balance.kept),
        stopped: scaled(balance.stopped),
        passed: scaled(balance.passed),
    });
}

/// From where on a beam has met an opaque shape, before its first stretch too.
fn dark_from(shadows: &Shadows, beam: &Beam, [first, last]: [f64; 2]) -> f64 {
    let at = |t: f64| [0, 1, 2].map(|k| beam.from[k] + beam.way[k] * t);
    if shadows.hide(at(first), beam.way.map(|x| -x)) {
        return first;
    }
    shadows.first_hit(at(first), beam.way, last - first).map_or(f64::INFINITY, |gone| first + gone)
}

/// 1 − e^(−x), for x of 0 or more.
#[inline]
pub fn lost(x: f64) -> f64 {
    if x < 0.1 {
        // The series up to x⁸: off by less than 10⁻¹⁴ of its value.
        let term = |sum: f64, k: f64| 1.0 - x / k * sum;
        x * [8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0].into_iter().fold(1.0, term)
    } else {
        1.0 - exp(-x)
    }
}

/// Shows the voxels of bricks on a stretch of a beam in their order, by their index, with the way in each, metres.
pub fn walk(grid: &Grid, beam: &Beam, [mut at, end]: [f64; 2], show: &mut impl FnMut(usize, f64)) {
    let start = [0, 1, 2].map(|k| beam.from[k] + beam.way[k] * at);
    let mut voxel = grid.voxel(start);
    let mut next = [0, 1, 2].map(|k| first_face(grid, beam, voxel, k).max(at));
    let step = beam.way.map(|x| if x < 0.0 { -1 } else { 1 });
    let faces = [0, 1, 2].map(|k| if beam.way[k] == 0.0 { f64::INFINITY } else { (grid.edges[k] / beam.way[k]).abs() });
    voxel = grid.within(voxel);
    let mut brick = grid.brick(voxel.map(|x| x >> BITS));
    while at < end {
        let axis = nearest(next);
        let leaves = next[axis].min(end);
        if brick != NONE {
            show(brick as usize * VOXELS + within_brick(voxel), leaves - at);
        }
        at = leaves;
        let was = voxel[axis];
        voxel[axis] += step[axis];
        next[axis] += faces[axis];
        if axis < 2 {
            let period = grid.period[axis];
            if voxel[axis] == period {
                voxel[axis] = 0;
            } else if voxel[axis] < 0 && period != i32::MAX {
                voxel[axis] = period - 1;
            }
        }
        if was >> BITS != voxel[axis] >> BITS {
            brick = grid.brick(voxel.map(|x| x >> BITS));
        }
    }
}

/// Where a beam leaves a voxel along an axis, metres from its beginning.
fn first_face(grid: &Grid, beam: &Beam, voxel: Voxel, axis: usize) -> f64 {
    let way = beam.way[axis];
    if way == 0.0 {
        return f64::INFINITY;
    }
    let face = f64::from(voxel[axis] + i32::from(way > 0.0));
    (grid.origin[axis] + face * grid.edges[axis] - beam.from[axis]) / way
}

#[inline]
fn nearest([x, y, z]: [f64; 3]) -> usize {
    if x < y {
        if x < z { 0 } else { 2 }
    } else if y < z {
        1
    } else {
        2
    }
}

/// The optical depth between a place and the light from a direction.
pub fn depth_towards(grid: &Grid, extinction: &[f64], place: Point, towards: Point) -> f64 {
    let Some([low, high]) = grid.bounds() else { return 0.0 };
    let mut bounds = crate::shape::Bounds { low, high };
    if grid.repeats() {
        (0..2).for_each(|k| (bounds.low[k], bounds.high[k]) = (f64::NEG_INFINITY, f64::INFINITY));
    }
    let Some((from, to)) = super::shadow::passage(&bounds, place, towards, f64::INFINITY) else { return 0.0 };
    let beam = Beam { from: place, way: towards, section: 0.0, stretches: &[] };
    let mut depth = 0.0;
    walk(grid, &beam, [from, to], &mut |index, way| depth += extinction[index] * way);
    depth
}
