//! The samples that a triangle covers, with its depth at each.
//!
//! Samples stand on rows. The rows within a pixel are shifted against each other, so that a nearly upright edge meets
//! as many different columns as a pixel has samples. A sample on an edge belongs to both triangles of the edge. A
//! triangle is scanned row by row between its two sides. Absent: clipping against the eye.

use glam::Vec3;
use std::ops::Range;

/// A window of samples: all columns of some rows of a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Window {
    /// Samples in a row.
    pub width: u32,
    /// The rows, counted over the whole picture.
    pub rows: Range<u32>,
    /// The shift of the samples of a row from the middles of their columns, in columns; the list repeats row after row.
    pub shifts: &'static [f32],
}

/// The rows whose samples lie together in memory, column by column: four by four samples, such as those of a pixel, are
/// neighbours, and a triangle meets few lines of the cache.
const TOGETHER: u32 = 4;

/// Shifts for rows that stand straight below one another.
pub const UPRIGHT: &[f32] = &[0.0];

impl Window {
    /// The places of its samples in memory, of which a few at the end may have no sample.
    pub fn len(&self) -> usize {
        self.width as usize * self.rows.len().next_multiple_of(TOGETHER as usize)
    }

    /// The place of the sample of a column on a row, which is one of its rows.
    #[inline]
    pub fn index(&self, column: u32, row: u32) -> usize {
        let row = row - self.rows.start;
        ((row / TOGETHER) as usize * self.width as usize + column as usize) * TOGETHER as usize
            + (row % TOGETHER) as usize
    }

    /// The position of the sample of a column on a row, in columns.
    #[inline]
    pub fn place(&self, column: u32, row: u32) -> f32 {
        column as f32 + 0.5 + self.shifts[row as usize % self.shifts.len()]
    }
}

/// A quantity that is linear over the picture: its value at a corner, and its slopes to the right and down.
#[derive(Debug, Clone, Copy)]
pub struct Plane {
    at: [f32; 2],
    value: f32,
    gain: [f32; 2],
}

impl Plane {
    /// The plane through three corners with three values; constant where the corners lie in a line.
    #[inline]
    pub fn through(corners: &[Vec3; 3], values: [f32; 3]) -> Self {
        let [a, b, c] = corners;
        let (ab, ac) = ([b.x - a.x, b.y - a.y], [c.x - a.x, c.y - a.y]);
        let area = ab[0] * ac[1] - ab[1] * ac[0];
        let over = if area.abs() > 1e-12 { 1.0 / area } else { 0.0 };
        let (vb, vc) = (values[1] - values[0], values[2] - values[0]);
        let gain = [(vb * ac[1] - vc * ab[1]) * over, (vc * ab[0] - vb * ac[0]) * over];
        Self { at: [a.x, a.y], value: values[0], gain }
    }

    /// Its value at a place.
    #[inline]
    pub fn at(&self, x: f32, y: f32) -> f32 {
        self.value + (x - self.at[0]) * self.gain[0] + (y - self.at[1]) * self.gain[1]
    }
}

/// A sample that a triangle covers.
#[derive(Debug, Clone, Copy)]
pub struct Sample {
    /// The place of the sample in the window's memory.
    pub index: usize,
    /// Its place to the right, in columns.
    pub x: f32,
    /// Its place down, in rows.
    pub y: f32,
    /// The depth of the triangle there.
    pub depth: f32,
}

/// Twice the area of a triangle in the picture, positive where its corners run clockwise as seen (y points down).
#[inline]
pub fn turn(corners: &[Vec3; 3]) -> f32 {
    let [a, b, c] = corners;
    (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
}

/// Calls `put` with every sample of `window` that the triangle covers; corners are in columns, rows and depth.
#[inline]
pub fn cover(corners: &[Vec3; 3], window: &Window, mut put: impl FnMut(Sample)) {
    let [mut a, mut b, mut c] = *corners;
    // Sort the corners from top to bottom.
    if b.y < a.y {
        std::mem::swap(&mut a, &mut b);
    }
    if c.y < b.y {
        std::mem::swap(&mut b, &mut c);
        if b.y < a.y {
            std::mem::swap(&mut a, &mut b);
        }
    }
    let Some(rows) = between(a.y - 0.5, c.y - 0.5, &window.rows) else { return };
    // Corners that are NaN give no rows, so all values below are finite.
    let depth = Plane::through(corners, corners.map(|corner| corner.z));
    let deepest = a.z.min(b.z).min(c.z);
    let nearest = a.z.max(b.z).max(c.z);
    let (long, upper, lower) = (Side::new(a, c), Side::new(a, b), Side::new(b, c));
    for row in rows {
        let y = row as f32 + 0.5;
        let ends = [long.at(y), if y < b.y { upper.at(y) } else { lower.at(y) }];
        let shift = window.shifts[row as usize % window.shifts.len()] + 0.5;
        let Some(columns) = between(ends[0].min(ends[1]) - shift, ends[0].max(ends[1]) - shift, &(0..window.width))
        else {
            continue;
        };
        let first = window.index(0, row);
        for column in columns {
            let x = column as f32 + shift;
            // Rounding may lead slightly beyond the depths of the corners.
            let depth = depth.at(x, y).max(deepest).min(nearest);
            put(Sample { index: first + (column * TOGETHER) as usize, x, y, depth });
        }
    }
}

/// One side of a triangle, from its upper to its lower end.
struct Side {
    x: f32,
    y: f32,
    per_row: f32,
}

impl Side {
    #[inline]
    fn new(from: Vec3, to: Vec3) -> Self {
        let tall = to.y - from.y;
        let per_row = if tall > 1e-9 { (to.x - from.x) / tall } else { 0.0 };
        Self { x: from.x, y: from.y, per_row }
    }

    #[inline]
    fn at(&self, y: f32) -> f32 {
        self.x + (y - self.y) * self.per_row
    }
}

/// The whole numbers of `within` from `low` to `high`, both included; `None` where there are none.
#[inline]
fn between(low: f32, high: f32, within: &Range<u32>) -> Option<Range<u32>> {
    let [first, last] = [low as i32, high as i32];
    let first = (first.saturating_add(i32::from(low > first as f32))).max(within.start as i32);
    let last = (last.saturating_sub(i32::from(high < last as f32))).min(within.end as i32 - 1);
    // A comparison with NaN is false.
    (low <= high && first <= last).then(|| first as u32..last as u32 + 1)
}
