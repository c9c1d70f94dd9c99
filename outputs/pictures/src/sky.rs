//! The light of the sky inside a crown, which falls through a grid of leaf area.
//!
//! Light from a direction is reduced to exp(−k · area) on its way, where k · area is the mean projected area that it
//! crosses (Beer's law in a canopy, Monsi & Saeki 1953). The grid holds the area in each cell, and each direction of
//! the sky is swept through it once, from the top layer down. The arriving light is kept as a mean and a vector, the
//! first two bands of spherical harmonics, from which the light on a face of any direction is computed. Absent: light
//! scattered by leaves, which shading adds by eye.

use glam::Vec3;
use phytomer_sim::math::{expf, sincosf};
use rayon::prelude::*;
use std::f32::consts::{PI, TAU};
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// The number of cells along the longest side of a plant.
const CELLS: f32 = 72.0;
/// The number of empty cells on each side, for the air that the plant darkens around it.
const AIR: usize = 10;
/// The unit of area: this part of a cell's face. Sums of whole numbers do not depend on their order.
const PARTS: f32 = 65536.0;
/// The most pieces into which a side of a plant's triangle is cut.
const MOST_CUTS: f32 = 12.0;
/// The rings of the sky: elevation in degrees, number of directions, share of the sky.
const RINGS: [(f32, u16, f32); 4] = [(22.0, 8, 0.50), (42.0, 7, 0.30), (64.0, 4, 0.16), (90.0, 1, 0.04)];
/// The number of directions that are swept at once; fixed, so that sums have one order.
const AT_ONCE: usize = 4;

/// The area in each cell.
#[derive(Debug)]
pub struct Crown {
    low: Vec3,
    cell: f32,
    size: [usize; 3],
    areas: Vec<AtomicU32>,
}

/// The light of the sky in each cell.
#[derive(Debug)]
pub struct Sky {
    low: Vec3,
    cell: f32,
    size: [usize; 3],
    light: Vec<[f32; 4]>,
}

impl Crown {
    /// An empty grid over a box.
    pub fn over(low: Vec3, high: Vec3) -> Self {
        let cell = ((high - low).max_element() / CELLS).max(1e-5);
        let sides = (high - low) / cell;
        let margin = [2 * AIR, 2 * AIR, 2];
        let size = [0, 1, 2].map(|k| (sides[k].ceil() as usize).clamp(1, 2 * CELLS as usize) + margin[k]);
        let low = low - cell * Vec3::new(AIR as f32, AIR as f32, 1.0);
        let mut areas = Vec::new();
        areas.resize_with(size.iter().product(), AtomicU32::default);
        Self { low, cell, size, areas }
    }

    /// Adds a triangle of a plant. A leaf, which is drawn once, shows half its area to a random direction; a closed
    /// surface shows a quarter (Cauchy).
    #[inline]
    pub fn add(&self, corners: &[Vec3; 3], thin: bool) {
        self.add_cut(corners, thin, MOST_CUTS);
    }

    /// Adds a triangle of an obstacle, which may be as large as the grid: as one of a closed surface, in pieces that
    /// are no larger than a cell.
    #[inline]
    pub fn add_obstacle(&self, corners: &[Vec3; 3]) {
        self.add_cut(corners, false, 4.0 * CELLS);
    }

    /// Adds a triangle in pieces; no side is cut into more than `most`.
    #[inline]
    fn add_cut(&self, [a, b, c]: &[Vec3; 3], thin: bool, most: f32) {
        let (ab, ac) = (*b - *a, *c - *a);
        let area = 0.5 * ab.cross(ac).length() * if thin { 0.5 } else { 0.25 };
        let longest = ab.length_squared().max(ac.length_squared()).max((*c - *b).length_squared());
        let cuts = (longest.sqrt() / self.cell).ceil().clamp(1.0, most) as u16;
        let pieces = (u32::from(cuts) * (u32::from(cuts) + 1) / 2) as f32;
        let parts = (area / pieces / (self.cell * self.cell) * PARTS + 0.5) as u32;
        let at = |i: u16, j: u16| (f32::from(i) + 1.0 / 3.0, f32::from(j) + 1.0 / 3.0);
        for (i, j) in (0..cuts).flat_map(|i| (0..cuts - i).map(move |j| at(i, j))) {
            let place = (*a + (ab * i + ac * j) / f32::from(cuts) - self.low) / self.cell;
            let cell = [place.x, place.y, place.z].map(|x| x.max(0.0) as usize);
            if cell[0] < self.size[0] && cell[1] < self.size[1] && cell[2] < self.size[2] {
                let index = (cell[2] * self.size[1] + cell[1]) * self.size[0] + cell[0];
                self.areas[index].fetch_add(parts, Relaxed);
            }
        }
    }

    /// Computes the light of the sky in each cell.
    pub fn lighten(self) -> Sky {
        let depths: Vec<f32> = self.areas.iter().map(|parts| parts.load(Relaxed) as f32 / PARTS).collect();
        let directions = directions();
        let open: Vec3 = directions.iter().map(|(direction, share)| *direction * *share).sum();
        // The scale gives a face that looks straight up under open sky the light 1.
        let scale = 0.5 / open.z;
        let mut light = vec![[0.0; 4]; depths.len()];
        for some in directions.chunks(AT_ONCE) {
            let swept: Vec<Vec<f32>> = some.par_iter().map(|(direction, _)| self.sweep(&depths, *direction)).collect();
            light.par_iter_mut().enumerate().for_each(|(cell, light)| {
                for ((direction, share), swept) in some.iter().zip(&swept) {
                    let arrives = swept[cell] * share;
                    light[0] += 0.5 * arrives;
                    (0..3).for_each(|k| light[k + 1] += scale * arrives * direction[k]);
                }
            });
        }
        Sky { low: self.low, cell: self.cell, size: self.size, light }
    }

    /// The light of one direction that arrives at the middle of each cell.
    fn sweep(&self, depths: &[f32], direction: Vec3) -> Vec<f32> {
        let [width, rows, layers] = self.size;
        let layer = width * rows;
        let mut arrives = vec![1.0; depths.len()];
        let mut leaves = vec![1.0; layer];
        let (dx, dy) = (direction.x / direction.z, direction.y / direction.z);
        for z in (0..layers).rev() {
            let (arrives, depths) = (&mut arrives[z * layer..][..layer], &depths[z * layer..][..layer]);
            for (row, out) in arrives.chunks_mut(width).enumerate() {
                for (column, out) in out.iter_mut().enumerate() {
                    *out = between(&leaves, [width, rows], column as f32 + dx, row as f32 + dy);
                }
            }
            for ((arrives, depth), leaves) in arrives.iter_mut().zip(depths).zip(&mut leaves) {
                let half = if *depth > 0.0 { expf(-0.5 * depth / direction.z) } else { 1.0 };
                *arrives *= half;
                *leaves = *arrives * half;
            }
        }
        arrives
    }
}

/// The directions of the sky, and the share of the sky that each stands for.
fn directions() -> Vec<(Vec3, f32)> {
    let mut all = Vec::new();
    for (ring, (elevation, count, share)) in RINGS.into_iter().enumerate() {
        let (sin, cos) = sincosf(elevation * PI / 180.0);
        for k in 0..count {
            let (y, x) = sincosf(TAU * (f32::from(k) + 0.37 * ring as f32) / f32::from(count));
            all.push((Vec3::new(cos * x, cos * y, sin), share / f32::from(count)));
        }
    }
    all
}

/// A value interpolated between four cells of a layer; 1 outside.
#[inline]
fn between(layer: &[f32], [width, rows]: [usize; 2], x: f32, y: f32) -> f32 {
    // The whole number below, without a call of the library.
    let below = |x: f32| x as i32 - i32::from(x < (x as i32) as f32);
    let (left, top) = (below(x), below(y));
    let (fx, fy) = (x - left as f32, y - top as f32);
    let at = |x: i32, y: i32| {
        let inside = x >= 0 && y >= 0 && (x as usize) < width && (y as usize) < rows;
        if inside { layer[y as usize * width + x as usize] } else { 1.0 }
    };
    let upper = at(left, top) * (1.0 - fx) + at(left + 1, top) * fx;
    let lower = at(left, top + 1) * (1.0 - fx) + at(left + 1, top + 1) * fx;
    upper * (1.0 - fy) + lower * fy
}

impl Sky {
    /// The weight of the grid's light at a point: 1 inside the grid, falling to 0 a few cells beyond.
    pub fn holds(&self, point: Vec3) -> f32 {
        let place = (point - self.low) / self.cell;
        let size = Vec3::from_array(self.size.map(|cells| cells as f32));
        let beyond = (-place).max(place - size).max(Vec3::ZERO).length();
        (1.0 - beyond / (2 * AIR) as f32).max(0.0)
    }

    /// The light at a point: a mean, and a vector towards its source; outside the grid, that of the nearest cells.
    #[inline]
    pub fn at(&self, point: Vec3) -> [f32; 4] {
        let place = (point - self.low) / self.cell - Vec3::splat(0.5);
        let (mut first, mut share) = ([0; 3], [0.0; 3]);
        for k in 0..3 {
            let x = place[k].max(0.0).min(self.size[k] as f32 - 1.001).max(0.0);
            first[k] = x as usize;
            share[k] = x - first[k] as f32;
        }
        let step = [1, self.size[0], self.size[0] * self.size[1]];
        let last = [0, 1, 2].map(|k| if first[k] + 1 < self.size[k] { step[k] } else { 0 });
        let base = first[0] + first[1] * step[1] + first[2] * step[2];
        let mut sum = [0.0; 4];
        for corner in 0..8 {
            let (mut index, mut weight) = (base, 1.0);
            for k in 0..3 {
                let beyond = corner >> k & 1 == 1;
                index += if beyond { last[k] } else { 0 };
                weight *= if beyond { share[k] } else { 1.0 - share[k] };
            }
            (0..4).for_each(|k| sum[k] += weight * self.light[index][k]);
        }
        sum
    }
}

/// The light of a point that a face with this unit normal receives; 1 for a level face under open sky.
#[inline]
pub fn falling_on(light: [f32; 4], normal: Vec3) -> f32 {
    (light[0] + light[1] * normal.x + light[2] * normal.y + light[3] * normal.z).max(0.0)
}
