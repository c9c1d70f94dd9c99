//! Outlines in bits: what covers which samples of four level directions at once, row by row.
//!
//! The directions have their rows in common, since they are level; so the corners of a triangle are sorted once, and
//! its two sides on a row are computed for all four together. What is covered is set as runs of bits. What lies within
//! what is covered already is not drawn: bits are only ever set, so that neither the order in which components come nor
//! the number of threads has an effect. For that the box of a component is taken wider than rounding can move its
//! samples. Absent: depths and colours (`raster`, `film`), and the lattice (`sides`).

use super::raster::{above, below, between, from_top};
use glam::{Vec3, Vec4};
use phytomer_meshes::{Held, TakePlaces, meeting};
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// The directions that are drawn together.
pub const DRAWN: usize = 4;

/// The samples by which a box is wider than what it holds.
const SLACK: f32 = 0.05;

/// How places are seen from the four directions, in samples: to the right and down.
#[derive(Debug, Clone)]
pub struct Lattice {
    /// What a metre along X, and one along Y, is to the right.
    pub along: [Vec4; 2],
    /// What lies to the left of the first column.
    pub left: Vec4,
    /// What lies above the first row.
    pub top: f32,
    /// The samples of a metre down; to the right there may be more.
    pub scale: f32,
    /// The number of columns of each direction.
    pub columns: [u32; DRAWN],
    /// The number of rows.
    pub rows: u32,
}

impl Lattice {
    /// The words of a row of a direction.
    pub fn words(&self) -> usize {
        self.columns.iter().max().map_or(0, |columns| columns.div_ceil(64) as usize)
    }

    #[inline]
    fn see(&self, at: Vec3) -> Seen {
        Seen { x: at.x * self.along[0] + at.y * self.along[1] - self.left, y: self.top - at.z * self.scale }
    }
}

/// A place as it is seen.
#[derive(Debug, Clone, Copy)]
struct Seen {
    x: Vec4,
    y: f32,
}

/// The samples that are covered, for each row and each direction some words.
#[derive(Debug)]
pub struct Sheet<'l> {
    lattice: &'l Lattice,
    words: usize,
    bits: Vec<AtomicU64>,
}

impl<'l> Sheet<'l> {
    /// A sheet on which what these bits tell is covered; nothing where there are none.
    pub fn of(lattice: &'l Lattice, bits: &[u64]) -> Self {
        let words = lattice.words();
        let count = lattice.rows as usize * DRAWN * words;
        let bits = (0..count).map(|word| AtomicU64::new(bits.get(word).copied().unwrap_or(0))).collect();
        Self { lattice, words, bits }
    }

    /// The covered samples as bits, row by row and direction by direction.
    pub fn into_bits(self) -> Vec<u64> {
        self.bits.into_iter().map(AtomicU64::into_inner).collect()
    }

    /// Calls `each` with the words of a run of columns on a row of a direction and the bits of the run in each, until
    /// it returns false; whether it never did.
    #[inline]
    fn run(&self, row: u32, side: usize, low: f32, high: f32, mut each: impl FnMut(&AtomicU64, u64) -> bool) -> bool {
        let first = above(low - 0.5).max(0);
        let last = below(high - 0.5).min(self.lattice.columns[side] as i32 - 1);
        if first > last {
            return true;
        }
        let (first, last) = (first as u32, last as u32);
        let (from, until) = (u64::MAX << (first % 64), u64::MAX >> (63 - last % 64));
        let start = (row as usize * DRAWN + side) * self.words;
        let words = &self.bits[start + (first / 64) as usize..=start + (last / 64) as usize];
        match words {
            [one] => each(one, from & until),
            [first, between @ .., last] => {
                each(first, from) && between.iter().all(|word| each(word, u64::MAX)) && each(last, until)
            }
            [] => true,
        }
    }

    #[inline]
    fn cover(&self, row: u32, low: Vec4, high: Vec4) {
        let (low, high) = (low.to_array(), high.to_array());
        for side in 0..DRAWN {
            self.run(row, side, low[side], high[side], |word, run| {
                if word.load(Relaxed) & run != run {
                    word.fetch_or(run, Relaxed);
                }
                true
            });
        }
    }

    /// Whether all samples of a box are covered, or it has none.
    #[inline]
    fn covers(&self, [low, high]: [Seen; 2]) -> bool {
        let Some(rows) = between(low.y - 0.5 - SLACK, high.y - 0.5 + SLACK, &(0..self.lattice.rows)) else {
            return true;
        };
        let (left, right) = ((low.x - SLACK).to_array(), (high.x + SLACK).to_array());
        for row in rows {
            for side in 0..DRAWN {
                if !self.run(row, side, left[side], right[side], |word, run| word.load(Relaxed) & run == run) {
                    return false;
                }
            }
        }
        true
    }
}

/// What draws on a sheet.
#[derive(Debug)]
pub struct Pen<'s, 'l> {
    sheet: &'s Sheet<'l>,
    seen: [Vec<Seen>; 2],
    /// The least and the most to the right, of each row of a tube.
    spans: Vec<[Vec4; 2]>,
}

impl<'s, 'l> Pen<'s, 'l> {
    /// A pen for a sheet.
    pub fn new(sheet: &'s Sheet<'l>) -> Self {
        Self { sheet, seen: Default::default(), spans: Vec::new() }
    }

    /// Sees places, and returns the box around them.
    fn see(&mut self, list: usize, places: &[Vec3]) -> [Seen; 2] {
        let mut bounds = [1.0, -1.0].map(|sign| Seen { x: Vec4::splat(sign * f32::INFINITY), y: sign * f32::INFINITY });
        let seen = &mut self.seen[list];
        seen.clear();
        seen.extend(places.iter().map(|at| {
            let seen = self.sheet.lattice.see(*at);
            bounds = joined(bounds, [seen; 2]);
            seen
        }));
        bounds
    }

    fn triangle(&self, corners: [Seen; 3]) {
        let [a, b, c] = from_top(corners, |corner| corner.y);
        let Some(rows) = between(a.y - 0.5, c.y - 0.5, &(0..self.sheet.lattice.rows)) else { return };
        let long = slope(a, c);
        // Above and below the middle corner; a small triangle often has rows on one side of it alone.
        let below = rows.clone().find(|row| *row as f32 + 0.5 >= b.y).unwrap_or(rows.end);
        for (rows, from, to) in [(rows.start..below, a, b), (below..rows.end, b, c)] {
            if rows.is_empty() {
                continue;
            }
            let short = slope(from, to);
            for row in rows {
                let y = row as f32 + 0.5;
                let (one, other) = (a.x + (y - a.y) * long, from.x + (y - from.y) * short);
                self.sheet.cover(row, one.min(other), one.max(other));
            }
        }
    }

    /// Widens the rows of a tube, of which these are the first ones, by an edge.
    #[inline]
    fn edge(spans: &mut [[Vec4; 2]], first: u32, one: Seen, other: Seen) {
        let (a, b) = if one.y <= other.y { (one, other) } else { (other, one) };
        let Some(rows) = between(a.y - 0.5, b.y - 0.5, &(first..first + spans.len() as u32)) else { return };
        let slope = slope(a, b);
        for row in rows {
            let x = a.x + (row as f32 + 0.5 - a.y) * slope;
            let [low, high] = &mut spans[(row - first) as usize];
            (*low, *high) = (low.min(x), high.max(x));
        }
    }
}

impl TakePlaces for Pen<'_, '_> {
    #[inline]
    fn wants(&mut self, held: &Held) -> bool {
        let lattice = self.sheet.lattice;
        let (seen, mut x, mut y) = (lattice.see(held.middle), Vec4::ZERO, 0.0);
        for half in &held.half {
            x += (half.x * lattice.along[0] + half.y * lattice.along[1]).abs();
            y += half.z.abs() * lattice.scale;
        }
        !self.sheet.covers([Seen { x: seen.x - x, y: seen.y - y }, Seen { x: seen.x + x, y: seen.y + y }])
    }

    fn tube(&mut self, rings: [&[Vec3]; 2]) {
        let bounds = [self.see(0, rings[0]), self.see(1, rings[1])];
        let bounds = joined(bounds[0], bounds[1]);
        let Some(rows) = between(bounds[0].y - 0.5, bounds[1].y - 0.5, &(0..self.sheet.lattice.rows)) else { return };
        if self.sheet.covers(bounds) {
            return;
        }
        let Self { seen: [low, high], spans, .. } = self;
        spans.clear();
        spans.resize(rows.len(), [Vec4::INFINITY, Vec4::NEG_INFINITY]);
        if low.len() == high.len() {
            low.iter().zip(&*high).for_each(|(a, b)| Self::edge(spans, rows.start, *a, *b));
        } else {
            for (_, [i, j]) in meeting([low.len() as u32, high.len() as u32]) {
                Self::edge(spans, rows.start, low[i as usize % low.len()], high[j as usize % high.len()]);
            }
        }
        for ring in [&*low, &*high] {
            ring.iter().zip(ring.iter().cycle().skip(1)).for_each(|(a, b)| Self::edge(spans, rows.start, *a, *b));
        }
        for (row, [low, high]) in rows.zip(&*spans) {
            self.sheet.cover(row, *low, *high);
        }
    }

    fn faces(&mut self, places: &[Vec3], faces: &[[u32; 3]]) {
        let lattice = self.sheet.lattice;
        let (low, high) =
            places.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), at| (a.min(at.z), b.max(at.z)));
        let [down, up] = [low, high].map(|z| lattice.top - z * lattice.scale - 0.5);
        let Some(met) = between(up, down, &(0..lattice.rows)) else { return };
        if met.len() <= 2 {
            // Of rows far from one another most triangles meet none.
            for corners in faces.iter().map(|face| face.map(|corner| places[corner as usize])) {
                let down = corners.map(|at| lattice.top - at.z * lattice.scale - 0.5);
                let [low, high] = [down[0].min(down[1]).min(down[2]), down[0].max(down[1]).max(down[2])];
                if between(low, high, &met).is_some() {
                    self.triangle(corners.map(|at| lattice.see(at)));
                }
            }
            return;
        }
        let bounds = self.see(0, places);
        if !self.sheet.covers(bounds) {
            faces.iter().for_each(|face| self.triangle(face.map(|corner| self.seen[0][corner as usize])));
        }
    }
}

#[inline]
fn joined(one: [Seen; 2], other: [Seen; 2]) -> [Seen; 2] {
    [
        Seen { x: one[0].x.min(other[0].x), y: one[0].y.min(other[0].y) },
        Seen { x: one[1].x.max(other[1].x), y: one[1].y.max(other[1].y) },
    ]
}

/// How much farther to the right a side is a row below.
#[inline]
fn slope(from: Seen, to: Seen) -> Vec4 {
    let tall = to.y - from.y;
    if tall > 1e-9 { (to.x - from.x) / tall } else { Vec4::ZERO }
}

#[cfg(test)]
mod tests {
    use super::super::raster::{UPRIGHT, Window, cover};
    use super::*;
    use phytomer_sim::math::sincosf;
    use std::f32::consts::{FRAC_PI_4, TAU};

    /// Four directions, with ten samples a metre on a square of 30 m.
    fn lattice() -> Lattice {
        let right: [[f32; 2]; DRAWN] = std::array::from_fn(|side| {
            let (sin, cos) = sincosf(side as f32 * FRAC_PI_4);
            [10.0 * sin, -10.0 * cos]
        });
        let along = [0, 1].map(|axis| Vec4::from_array(right.map(|right| right[axis])));
        Lattice { along, left: Vec4::splat(-150.0), top: 150.0, scale: 10.0, columns: [300; DRAWN], rows: 300 }
    }

    /// Numbers from −1 to 1, always the same.
    fn numbers() -> impl FnMut() -> f32 {
        let mut state = 1_u32;
        move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / 8_388_608.0 - 1.0
        }
    }

    fn drawn(lattice: &Lattice, draw: impl FnOnce(&mut Pen)) -> Vec<u64> {
        let sheet = Sheet::of(lattice, &[]);
        draw(&mut Pen::new(&sheet));
        sheet.into_bits()
    }

    fn count(bits: impl Iterator<Item = u64>) -> u32 {
        bits.map(u64::count_ones).sum()
    }

    /// The samples of the rasteriser of pictures, one direction and one triangle at a time.
    fn by_pictures(lattice: &Lattice, triangles: &[[Vec3; 3]]) -> Vec<u64> {
        let mut bits = vec![0_u64; lattice.rows as usize * DRAWN * lattice.words()];
        let window = Window { columns: 0..300, rows: 0..300, shifts: UPRIGHT };
        for (triangle, side) in triangles.iter().flat_map(|triangle| (0..DRAWN).map(move |side| (triangle, side))) {
            let corners = triangle.map(|at| {
                let seen = lattice.see(at);
                Vec3::new(seen.x[side], seen.y, 0.5)
            });
            cover(&corners, &window, |sample| {
                let (row, column) = (sample.y as usize, sample.x as usize);
                bits[(row * DRAWN + side) * lattice.words() + column / 64] |= 1 << (column % 64);
            });
        }
        bits
    }

    #[test]
    fn triangles_cover_what_the_rasteriser_of_pictures_covers() {
        let (lattice, mut next) = (lattice(), numbers());
        let mut at = |reach: f32| Vec3::new(next(), next(), next()) * reach;
        let triangles: Vec<[Vec3; 3]> = (0..400)
            .map(|number| {
                let middle = at(12.0);
                let size = [0.05, 0.3, 3.0, 20.0][number % 4];
                [at(size), at(size), at(size)].map(|corner| middle + corner)
            })
            .collect();
        // One by one, so that none lies within others.
        for triangle in &triangles {
            let own = drawn(&lattice, |pen| pen.faces(triangle, &[[0, 1, 2]]));
            let expected = by_pictures(&lattice, std::slice::from_ref(triangle));
            let apart = count(own.iter().zip(&expected).map(|(one, other)| one ^ other));
            let all = count(expected.iter().copied());
            assert!(f64::from(apart) <= 0.002 * f64::from(all) + 2.0, "{triangle:?}: {apart} of {all}");
        }
        // And together, where most lie within others.
        let own = drawn(&lattice, |pen| triangles.iter().for_each(|triangle| pen.faces(triangle, &[[0, 1, 2]])));
        let expected = by_pictures(&lattice, &triangles);
        let apart = count(own.iter().zip(&expected).map(|(one, other)| one ^ other));
        assert!(apart < 60 && count(own.into_iter()) > 100_000, "{apart}");
    }

    /// A frustum with so many corners at its base and at its tip.
    fn rings(counts: [u32; 2], next: &mut impl FnMut() -> f32) -> [Vec<Vec3>; 2] {
        let (base, along) = (10.0 * Vec3::new(next(), next(), next()), Vec3::new(next(), next(), next()).normalize());
        let (up, length, radius) = (along.any_orthonormal_vector(), 2.0 + 2.0 * next(), 0.6 + 0.5 * next());
        let side = along.cross(up);
        [(counts[0], 0.0, radius), (counts[1], length, 0.7 * radius)].map(|(count, above, radius)| {
            let corner = |k: u32| {
                let (sin, cos) = sincosf(TAU * k as f32 / count as f32);
                base + above * along + radius * (cos * up + sin * side)
            };
            (0..count).map(corner).collect()
        })
    }

    #[test]
    fn tubes_cover_what_their_triangles_cover() {
        let (lattice, mut next) = (lattice(), numbers());
        for number in 0..300 {
            let [n, m] = [[8, 8], [3, 3], [5, 3], [3, 8]][number % 4];
            let [low, high] = rings([n, m], &mut next);
            let places: Vec<Vec3> = low.iter().chain(&high).copied().collect();
            let side = meeting([n, m]).map(|(lower, [i, j])| {
                if lower { [i % n, (i + 1) % n, n + j % m] } else { [i % n, n + (j + 1) % m, n + j % m] }
            });
            let caps = (2..n).map(|k| [0, k - 1, k]).chain((2..m).map(|k| [n, n + k - 1, n + k]));
            let faces: Vec<[u32; 3]> = side.chain(caps).collect();
            let own = drawn(&lattice, |pen| pen.tube([&low, &high]));
            let expected = drawn(&lattice, |pen| pen.faces(&places, &faces));
            let apart = count(own.iter().zip(&expected).map(|(one, other)| one ^ other));
            let all = count(expected.into_iter());
            assert!(f64::from(apart) <= 0.005 * f64::from(all) + 2.0, "{n} {m}: {apart} of {all}");
        }
    }

    #[test]
    fn what_lies_within_others_is_not_asked_for() {
        let lattice = lattice();
        let sheet = Sheet::of(&lattice, &[]);
        let mut pen = Pen::new(&sheet);
        let cube = |middle, half| Held { middle, half: [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| half * axis) };
        let nowhere = cube(Vec3::Z * 99.0, 1.0);
        assert!(pen.wants(&cube(Vec3::ZERO, 1.0)) && !pen.wants(&nowhere));
        // Two upright walls across one another cover the middle from all directions.
        for wall in [Vec3::new(9.0, 3.0, 0.0), Vec3::new(-3.0, 9.0, 0.0)] {
            let up = Vec3::Z * 5.0;
            pen.faces(&[wall - up, wall + up, -wall + up, -wall - up], &[[0, 1, 2], [0, 2, 3]]);
        }
        assert!(!pen.wants(&cube(Vec3::ZERO, 1.0)) && pen.wants(&cube(Vec3::Z * 4.9, 1.0)));
        assert!(pen.wants(&cube(Vec3::ZERO, 12.0)));
        let before = count(sheet.bits.iter().map(|word| word.load(Relaxed)));
        Pen::new(&sheet).faces(&[Vec3::ZERO, Vec3::X, Vec3::Z], &[[0, 1, 2]]);
        assert_eq!(count(sheet.bits.iter().map(|word| word.load(Relaxed))), before);
    }
}
