//! The samples that a triangle covers, with its depth at each.
//!
//! Samples stand on rows. The rows within a pixel are shifted against each other, so that a nearly upright edge meets
//! as many different columns as a pixel has samples. A sample on an edge belongs to both triangles of the edge. A
//! triangle is scanned row by row between its two sides. Absent: clipping against the eye.

use glam::Vec3;
use std::ops::Range;

/// A window of samples: some columns of some rows of a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Window {
    /// The columns, counted over the whole picture.
    pub columns: Range<u32>,
    /// The rows, counted over the whole picture.
    pub rows: Range<u32>,
    /// The shift of the samples of a row from the middles of their columns, in columns; the list repeats row after row.
    pub shifts: [f32; TOGETHER as usize],
}

/// The rows whose samples lie together in memory, column by column: four by four samples, such as those of a pixel, are
/// neighbours, and a triangle meets few lines of the cache.
pub const TOGETHER: u32 = 4;

/// Shifts for rows that stand straight below one another.
pub const UPRIGHT: [f32; TOGETHER as usize] = [0.0; TOGETHER as usize];

impl Window {
    /// The places of its samples in memory, of which a few at the end may have no sample.
    pub fn len(&self) -> usize {
        self.columns.len() * self.rows.len().next_multiple_of(TOGETHER as usize)
    }

    /// The place of the sample of a column on a row, which is one of its rows.
    #[inline]
    pub fn index(&self, column: u32, row: u32) -> usize {
        let (column, row) = (column - self.columns.start, row - self.rows.start);
        ((row / TOGETHER) as usize * self.columns.len() + column as usize) * TOGETHER as usize
            + (row % TOGETHER) as usize
    }

    /// The samples of the window that lie together with that of a column on a row, where both are the first of
    /// [`TOGETHER`]: their places in memory, columns and rows, in the order of memory.
    #[inline]
    pub fn together(&self, column: u32, row: u32) -> impl Iterator<Item = (usize, u32, u32)> + use<> {
        let first = self.index(column, row);
        (0..TOGETHER * TOGETHER).map(move |k| (first + k as usize, column + k / TOGETHER, row + k % TOGETHER))
    }

    /// The position of the sample of a column on a row, in columns.
    #[inline]
    pub fn place(&self, column: u32, row: u32) -> f32 {
        column as f32 + 0.5 + self.shifts[(row % TOGETHER) as usize]
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

/// The corners of a triangle from top to bottom, by their rows.
#[inline]
pub fn from_top<T>([mut a, mut b, mut c]: [T; 3], row: impl Fn(&T) -> f32) -> [T; 3] {
    if row(&b) < row(&a) {
        std::mem::swap(&mut a, &mut b);
    }
    if row(&c) < row(&b) {
        std::mem::swap(&mut b, &mut c);
        if row(&b) < row(&a) {
            std::mem::swap(&mut a, &mut b);
        }
    }
    [a, b, c]
}

/// Calls `put` with every sample of `window` that the triangle covers; corners are in columns, rows and depth.
#[inline]
pub fn cover(corners: &[Vec3; 3], window: &Window, mut put: impl FnMut(Sample)) {
    let [a, b, c] = from_top(*corners, |corner| corner.y);
    let Some(rows) = between(a.y - 0.5, c.y - 0.5, &window.rows) else { return };
    // Corners that are NaN give no rows, so all values below are finite.
    let depth = Plane::through(corners, corners.map(|corner| corner.z));
    let deepest = a.z.min(b.z).min(c.z);
    let nearest = a.z.max(b.z).max(c.z);
    let sides = [Side::new(a, c), Side::new(a, b), Side::new(b, c)];
    let mut four = rows.start - rows.start % TOGETHER;
    while four < rows.end {
        let (firsts, lasts) = spans(&sides, b.y, four, &window.shifts);
        for row in four.max(rows.start)..(four + TOGETHER).min(rows.end) {
            let k = (row % TOGETHER) as usize;
            let first = firsts[k].max(window.columns.start as i32);
            let last = lasts[k].min(window.columns.end as i32 - 1);
            if first > last {
                continue;
            }
            let (y, shift) = (row as f32 + 0.5, window.shifts[k] + 0.5);
            let start = window.index(window.columns.start, row);
            for column in first as u32..=last as u32 {
                let x = column as f32 + shift;
                // Rounding may lead slightly beyond the depths of the corners.
                let depth = depth.at(x, y).max(deepest).min(nearest);
                put(Sample { index: start + ((column - window.columns.start) * TOGETHER) as usize, x, y, depth });
            }
        }
        four += TOGETHER;
    }
}

/// The first and the last column on each of some rows from `four` on, between the long side of a triangle and its upper
/// side, from the middle corner on its lower side. The rows are computed together, which a processor does at once.
#[inline]
fn spans([long, upper, lower]: &[Side; 3], middle: f32, four: u32, shifts: &Four<f32>) -> (Four<i32>, Four<i32>) {
    let (mut firsts, mut lasts) = ([0; TOGETHER as usize], [0; TOGETHER as usize]);
    for k in 0..TOGETHER as usize {
        let y = (four as i32 + k as i32) as f32 + 0.5;
        let ends = [long.at(y), if y < middle { upper.at(y) } else { lower.at(y) }];
        let shift = shifts[k] + 0.5;
        (firsts[k], lasts[k]) = (above(ends[0].min(ends[1]) - shift), below(ends[0].max(ends[1]) - shift));
    }
    (firsts, lasts)
}

type Four<T> = [T; TOGETHER as usize];

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

/// The least whole number that is not below `x`.
#[inline]
pub fn above(x: f32) -> i32 {
    let whole = x as i32;
    whole.saturating_add(i32::from(x > whole as f32))
}

/// The largest whole number that is not above `x`.
#[inline]
pub fn below(x: f32) -> i32 {
    let whole = x as i32;
    whole.saturating_sub(i32::from(x < whole as f32))
}

/// The whole numbers of `within` from `low` to `high`, both included; `None` where there are none.
#[inline]
pub fn between(low: f32, high: f32, within: &Range<u32>) -> Option<Range<u32>> {
    let [first, last] = [above(low).max(within.start as i32), below(high).min(within.end as i32 - 1)];
    // A comparison with NaN is false.
    (low <= high && first <= last).then(|| first as u32..last as u32 + 1)
}
