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
/// The most pieces into which a side of a triangle is cut: half a cell for one as long as the grid.
const MOST_CUTS: f32 = 4.0 * CELLS;
/// The pieces of a side as long as a cell, of a triangle that is longer than one.
const PIECES: f32 = 2.0;
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
    /// Whether small triangles are spread over cells too.
    spreads: bool,
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
    /// An empty grid over a box. A triangle that is larger than a cell is spread over the cells around each of its
    /// pieces, so that a plane petal is evenly dense however it cuts the cells; with `spreads` smaller ones are too, as
    /// those of a petal that is drawn from near.
    pub fn over(low: Vec3, high: Vec3, spreads: bool) -> Self {
        let cell = ((high - low).max_element() / CELLS).max(1e-5);
        let sides = (high - low) / cell;
        let margin = [2 * AIR, 2 * AIR, 2];
        let size = [0, 1, 2].map(|k| (sides[k].ceil() as usize).clamp(1, 2 * CELLS as usize) + margin[k]);
        let low = low - cell * Vec3::new(AIR as f32, AIR as f32, 1.0);
        let mut areas = Vec::new();
        areas.resize_with(size.iter().product(), AtomicU32::default);
        Self { low, cell, size, areas, spreads }
    }

    /// Adds a triangle of a plant. A leaf, which is drawn once, shows half its area to a random direction; a closed
    /// surface shows a quarter (Cauchy).
    #[inline]
    pub fn add(&self, corners: &[Vec3; 3], thin: bool) {
        self.add_cut(corners, thin);
    }

    /// Adds a triangle of an obstacle, which may be as large as the grid: as one of a closed surface, in pieces that
    /// are no larger than a cell.
    #[inline]
    pub fn add_obstacle(&self, corners: &[Vec3; 3]) {
        self.add_cut(corners, false);
    }

    /// Adds a triangle in pieces.
    #[inline]
    fn add_cut(&self, [a, b, c]: &[Vec3; 3], thin: bool) {
        let (ab, ac) = (*b - *a, *c - *a);
        let area = 0.5 * ab.cross(ac).length() * if thin { 0.5 } else { 0.25 };
        let longest = ab.length_squared().max(ac.length_squared()).max((*c - *b).length_squared());
        let cells = longest.sqrt() / self.cell;
        let large = cells > 1.0;
        let cuts = (if large { PIECES * cells } else { cells }).ceil().clamp(1.0, MOST_CUTS) as u16;
        let pieces = (u32::from(cuts) * (u32::from(cuts) + 1) / 2) as f32;
        let parts = area / pieces / (self.cell * self.cell) * PARTS;
        let at = |i: u16, j: u16| (f32::from(i) + 1.0 / 3.0, f32::from(j) + 1.0 / 3.0);
        for (i, j) in (0..cuts).flat_map(|i| (0..cuts - i).map(move |j| at(i, j))) {
            let place = (*a + (ab * i + ac * j) / f32::from(cuts) - self.low) / self.cell;
            if large || self.spreads {
                self.spread(place, parts);
            } else {
                self.put(place, (parts + 0.5) as u32);
            }
        }
    }

    /// Adds a number of parts to the cell of a place.
    #[inline]
    fn put(&self, place: Vec3, parts: u32) {
        let cell = [place.x, place.y, place.z].map(|x| x.max(0.0) as usize);
        if cell[0] < self.size[0] && cell[1] < self.size[1] && cell[2] < self.size[2] {
            let index = (cell[2] * self.size[1] + cell[1]) * self.size[0] + cell[0];
            self.areas[index].fetch_add(parts, Relaxed);
        }
    }

    /// Adds parts to the eight cells whose middles are around a place, to each the more the nearer it is.
    fn spread(&self, place: Vec3, parts: f32) {
        let first = (place - 0.5).floor();
        let share = place - 0.5 - first;
        for corner in 0..8 {
            let far = [0, 1, 2].map(|bit| corner >> bit & 1 == 1);
            let weight = |k: usize| if far[k] { share[k] } else { 1.0 - share[k] };
            let cell = first + Vec3::from_array(far.map(|far| if far { 1.5 } else { 0.5 }));
            self.put(cell, (parts * weight(0) * weight(1) * weight(2) + 0.5) as u32);
        }
    }

    /// Computes the light of the sky in each cell.
    pub fn lighten(self) -> Sky {
        let depths: Vec<f32> = self.areas.iter().map(|parts| parts.load(Relaxed) as f32 / PARTS).collect();
        let rings: Vec<Ring> = RINGS.iter().enumerate().map(|(number, ring)| Ring::new(number, *ring)).collect();
        let open: f32 = rings.iter().flat_map(|ring| ring.directions.iter().map(|to| to.z * ring.share)).sum();
        // The scale gives a face that looks straight up under open sky the light 1.
        let scale = 0.5 / open;
        let mut light = vec![[0.0; 4]; depths.len()];
        let mut swept = vec![vec![0.0; depths.len()]; AT_ONCE];
        for Ring { height, share, directions } in &rings {
            let half = |depth: &f32| if *depth > 0.0 { expf(-0.5 * depth / height) } else { 1.0 };
            let halves: Vec<f32> = depths.par_iter().map(half).collect();
            for some in directions.chunks(AT_ONCE) {
                some.par_iter().zip(&mut swept).for_each(|(to, swept)| self.sweep(&halves, *to, swept));
                let weights = some.iter().map(|to| [0.5, scale * to.x, scale * to.y, scale * to.z].map(|x| x * share));
                let weights: Vec<[f32; 4]> = weights.collect();
                light.par_iter_mut().enumerate().for_each(|(cell, light)| {
                    for (weights, swept) in weights.iter().zip(&swept) {
                        let arrives = swept[cell];
                        light.iter_mut().zip(weights).for_each(|(light, weight)| *light += arrives * weight);
                    }
                });
            }
        }
        Sky { low: self.low, cell: self.cell, size: self.size, light }
    }

    /// Puts the light of one direction that arrives at the middle of each cell into `arrives`; `halves` are the shares
    /// of it that half a cell lets through.
    fn sweep(&self, halves: &[f32], direction: Vec3, arrives: &mut [f32]) {
        let [width, rows, layers] = self.size;
        let layer = width * rows;
        let mut above = Layer::open([width, rows], [direction.x / direction.z, direction.y / direction.z]);
        for z in (0..layers).rev() {
            let (arrives, halves) = (&mut arrives[z * layer..][..layer], &halves[z * layer..][..layer]);
            for (row, (arrives, halves)) in arrives.chunks_mut(width).zip(halves.chunks(width)).enumerate() {
                above.seen_from(row, arrives);
                arrives.iter_mut().zip(halves).for_each(|(light, half)| *light *= half);
            }
            for (row, (arrives, halves)) in arrives.chunks(width).zip(halves.chunks(width)).enumerate() {
                let leaves = above.row(row).iter_mut().zip(arrives.iter().zip(halves));
                leaves.for_each(|(leaves, (light, half))| *leaves = light * half);
            }
        }
    }
}

/// The light that leaves the cells of a layer towards those below along one direction, with open sky around.
struct Layer {
    values: Vec<f32>,
    /// Values in a row.
    stride: usize,
    /// Cells of the grid in a row.
    width: usize,
    /// Cells of open sky on each side.
    margin: usize,
    /// The way along a row and across rows between the middles of two layers: whole cells, counted from the margin's
    /// edge, and the rest of a cell.
    whole: [usize; 2],
    rest: [f32; 2],
}

impl Layer {
    fn open([width, rows]: [usize; 2], way: [f32; 2]) -> Self {
        let below = way.map(f32::floor);
        let margin = below.iter().fold(1.0, |most: f32, cells| most.max(cells.abs() + 1.0)) as usize;
        let stride = width + 2 * margin;
        let whole = below.map(|cells| (margin as f32 + cells) as usize);
        let rest = [way[0] - below[0], way[1] - below[1]];
        Self { values: vec![1.0; stride * (rows + 2 * margin)], stride, width, margin, whole, rest }
    }

    /// The values of a row of the grid.
    fn row(&mut self, row: usize) -> &mut [f32] {
        &mut self.values[(row + self.margin) * self.stride + self.margin..][..self.width]
    }

    /// The light from this layer at the cells of a row of the layer below, interpolated between four cells.
    fn seen_from(&self, row: usize, out: &mut [f32]) {
        let [x, y] = self.rest;
        let start = (row + self.whole[1]) * self.stride + self.whole[0];
        let [upper, lower] = [start, start + self.stride].map(|start| {
            let (left, right) = (&self.values[start..][..self.width], &self.values[start + 1..][..self.width]);
            left.iter().zip(right)
        });
        for (out, (upper, lower)) in out.iter_mut().zip(upper.zip(lower)) {
            let [upper, lower] = [upper, lower].map(|(left, right)| left * (1.0 - x) + right * x);
            *out = upper * (1.0 - y) + lower * y;
        }
    }
}

/// A ring of directions of the sky.
struct Ring {
    /// The height of each direction, a unit vector.
    height: f32,
    /// The share of the sky that each direction stands for.
    share: f32,
    directions: Vec<Vec3>,
}

impl Ring {
    fn new(number: usize, (elevation, count, share): (f32, u16, f32)) -> Self {
        let (sin, cos) = sincosf(elevation * PI / 180.0);
        let direction = |k: u16| {
            let (y, x) = sincosf(TAU * (f32::from(k) + 0.37 * number as f32) / f32::from(count));
            Vec3::new(cos * x, cos * y, sin)
        };
        Self { height: sin, share: share / f32::from(count), directions: (0..count).map(direction).collect() }
    }
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
        let base = first[0] + first[1] * step[1] + first[2] * step[2];
        // Beyond the last cell of an axis its share is 0, and the cell counts for its neighbour.
        let next = [0, 1, 2].map(|k| if first[k] + 1 < self.size[k] { step[k] } else { 0 });
        let along = |cell: usize| mixed(&self.light[cell], &self.light[cell + next[0]], share[0]);
        let across = |cell: usize| mixed(&along(cell), &along(cell + next[1]), share[1]);
        mixed(&across(base), &across(base + next[2]), share[2])
    }
}

/// What lies between two lights, at a share of the way.
#[inline]
fn mixed(a: &[f32; 4], b: &[f32; 4], share: f32) -> [f32; 4] {
    [0, 1, 2, 3].map(|k| a[k] + (b[k] - a[k]) * share)
}

/// The light of a point that a face with this unit normal receives; 1 for a level face under open sky.
#[inline]
pub fn falling_on(light: [f32; 4], normal: Vec3) -> f32 {
    (light[0] + light[1] * normal.x + light[2] * normal.y + light[3] * normal.z).max(0.0)
}
