//! One beam on its way through the voxels, and all beams of one source (Amanatides & Woo 1987).
//!
//! From face to face the way in each voxel is exact. Of a beam of the intensity I a voxel with the extinction κ = G a
//! keeps I (1 − e^(−κ l)) on the way l; the mean intensity in it is I (1 − e^(−κ l)) / (κ l). Absent: which beams there
//! are (`lattice`), and the sums over all sources (`field`).

use super::grid::{BITS, Grid, NONE, VOXELS, within_brick};
use super::lattice::{Beam, each_beam};
use super::loss::lost;
use super::shadow::Shadows;
use super::spot::Spot;
use super::wanted::Wanted;
use super::{Balance, Source};
use crate::shape::Point;

/// Of each wanted voxel, the intensity along the ways of beams in it, summed over the ways, and the ways, metres; the
/// intensity on open ground is 1.
pub type Along = Vec<[f64; 2]>;

/// The light of one source.
#[derive(Debug)]
pub struct Shone {
    /// The light along the ways of its beams.
    pub along: Along,
    /// What becomes of the light, m² across the beams.
    pub balance: Balance,
    /// The area across one beam, m².
    pub section: f64,
}

/// Sends the beams of a source through a grid whose wanted voxels have these extinctions, 1/m; the others have none.
/// `room` is memory for the result.
pub fn shine(grid: &Grid, wanted: (&Wanted, &[f64]), shadows: &Shadows, source: &Source, mut room: Along) -> Shone {
    room.clear();
    room.resize(wanted.1.len(), [0.0; 2]);
    let mut shone = Shone { along: room, balance: Balance::default(), section: 0.0 };
    each_beam(grid, source, shadows.top(), &mut |beam| follow(grid, wanted, shadows, beam, &mut shone));
    shone
}

fn follow(grid: &Grid, wanted: (&Wanted, &[f64]), shadows: &Shadows, beam: &Beam, shone: &mut Shone) {
    let (Some(first), Some(last)) = (beam.stretches.first(), beam.stretches.last()) else { return };
    let ends = [first[0], last[1]];
    let dark_from = if shadows.is_empty() { f64::INFINITY } else { dark_from(grid, shadows, beam, ends) };
    let (mut light, mut kept) = (1.0, 0.0);
    let (wanted, extinction) = wanted;
    let mut in_voxel = |index: usize, from: f64, to: f64| {
        let Some(number) = wanted.number(index) else { return };
        let k = extinction[number];
        let sums = &mut shone.along[number];
        sums[1] += to - from;
        let way = to.min(dark_from) - from;
        if way <= 0.0 {
            return;
        }
        if k > 0.0 && light > 0.0 {
            let lost = light * lost(k * way);
            sums[0] += lost / k;
            kept += lost;
            light -= lost;
        } else {
            sums[0] += light * way;
        }
    };
    beam.stretches.iter().for_each(|stretch| walk(grid, beam.from, beam.way, *stretch, &mut in_voxel));
    let stopped = if dark_from < ends[1] { light } else { 0.0 };
    let [sent, kept, stopped, passed] = [1.0, kept, stopped, light - stopped].map(|of| of * beam.section);
    shone.section = beam.section;
    shone.balance = shone.balance.with(Balance { sent, kept, stopped, passed });
}

/// From where on a beam has met an opaque shape, before its first stretch too.
fn dark_from(grid: &Grid, shadows: &Shadows, beam: &Beam, [first, last]: [f64; 2]) -> f64 {
    let at = |t: f64| beam.place(grid, t);
    if shadows.hide(at(first), beam.way.map(|x| -x)) {
        return first;
    }
    shadows.first_hit(at(first), beam.way, last - first).map_or(f64::INFINITY, |gone| first + gone)
}

/// Shows the voxels of bricks on a stretch of a line in their order, by their index, with where it enters and leaves
/// each, metres from its beginning. Nothing but the place in a voxel at the beginning goes into these, so whole voxels
/// farther they are the same to the last bit.
pub fn walk(grid: &Grid, from: Spot, way: Point, [start, end]: [f64; 2], show: &mut impl FnMut(usize, f64, f64)) {
    let Spot { voxel, inner } = grid.farther(from, way, start);
    let step = way.map(|x| if x < 0.0 { -1 } else { 1 });
    let faces = [0, 1, 2].map(|k| if way[k] == 0.0 { f64::INFINITY } else { (grid.edges[k] / way[k]).abs() });
    let first_face = |k: usize| if way[k] < 0.0 { inner[k] } else { 1.0 - inner[k] };
    let mut next = [0, 1, 2].map(|k| if way[k] == 0.0 { f64::INFINITY } else { start + first_face(k) * faces[k] });
    let (mut at, mut voxel) = (start, grid.within(voxel));
    let mut brick = grid.brick(voxel.map(|x| x >> BITS));
    while at < end {
        let axis = nearest(next);
        let leaves = next[axis].min(end);
        if brick != NONE {
            show(brick as usize * VOXELS + within_brick(voxel), at, leaves);
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

/// The optical depth between a place and the light from a direction, where voxels have these extinctions, 1/m.
pub fn depth_towards(grid: &Grid, extinction: impl Fn(usize) -> f64, from: Spot, towards: Point) -> f64 {
    let Some([low, high]) = grid.bounds() else { return 0.0 };
    let mut bounds = crate::shape::Bounds { low, high };
    if grid.repeats() {
        (0..2).for_each(|k| (bounds.low[k], bounds.high[k]) = (f64::NEG_INFINITY, f64::INFINITY));
    }
    let place = grid.place(from);
    let Some((first, last)) = super::shadow::passage(&bounds, place, towards, f64::INFINITY) else { return 0.0 };
    let mut depth = 0.0;
    walk(grid, from, towards, [first, last], &mut |index, from, to| depth += extinction(index) * (to - from));
    depth
}
