//! The outline of a plant from eight sides, of the compass, as samples that something covers.
//!
//! The projection is parallel and level, as from far away; so the outline from a side is that from the opposite one,
//! mirrored, and four are drawn for the eight. A sample is covered or not, whatever covers it. Samples stand on a
//! lattice of the plant that is compared with, and all that is compared is drawn on the same lattice, so that the error
//! of counting samples, a thousandth or so (`silhouette`), mostly cancels. Absent: how samples are covered (`spans`),
//! and what has which outline.

use super::costs::Costs;
use super::gaze::Gaze;
pub use super::spans::DRAWN;
use super::spans::{Lattice, Pen, Sheet};
use glam::{Vec3, Vec4};
use phytomer_meshes::{Held, Room, Scene, TakePlaces};
use phytomer_sim::plant::NodeId;
use rayon::prelude::*;
use std::f32::consts::FRAC_PI_4;

/// The room around the plant, as a share of its extent: organs that stand for others are larger.
const ROOM: f32 = 0.1;

/// How many columns there are for a row: they cost hardly more.
const COLUMNS: f32 = 2.0;

/// The corners of a box.
const CORNERS: [[f32; 3]; 8] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [1.0, 1.0, 1.0],
];

/// The most of the way from an outline that does not hold to one that does that is gone at once.
pub const MOST_PART: f64 = 0.75;

/// The organs of a block.
const BLOCK: usize = 256;

/// The lattices of four directions.
#[derive(Debug, Clone)]
pub struct Sides {
    lattice: Lattice,
    /// The longest side of the plant, metres.
    longest: f32,
    /// The share of the rows that is drawn.
    share: f64,
}

/// The samples that something covers from each direction.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Outline {
    /// For each row and each direction so many words.
    bits: Vec<u64>,
    words: usize,
}

/// How far an outline is from another, as shares of the covered area of the other.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Apart {
    /// The largest difference of the covered areas over the eight sides.
    pub area: f64,
    /// The largest area that one covers and the other does not.
    pub either: f64,
    /// The difference of the covered areas for each direction, less than 0 where it is smaller.
    pub by_side: [f64; DRAWN],
}

impl Sides {
    /// The lattices around a plant, with so many samples along the longest side; `None` where nothing of it has an
    /// extent.
    pub fn around(scene: &Scene, costs: &Costs, samples: u32) -> Option<Self> {
        let gazes: [Gaze; DRAWN] = std::array::from_fn(|side| Gaze::towards(side as f32 * FRAC_PI_4, 0.0));
        let along = [Vec3::X, Vec3::Y].map(|axis| Vec4::from_array(gazes.map(|gaze| gaze.right.dot(axis))));
        let none = || Bounds {
            along,
            low: Vec4::INFINITY,
            high: Vec4::NEG_INFINITY,
            heights: [f32::INFINITY, f32::NEG_INFINITY],
        };
        let measured = |(mut bounds, mut room): (Bounds, Room), block: usize| {
            places((scene, costs), block, &mut room, &mut bounds);
            (bounds, room)
        };
        let of_blocks = (0..blocks(scene, costs)).into_par_iter().fold(|| (none(), Room::default()), measured);
        let Bounds { low, high, heights: [foot, top], .. } =
            of_blocks.map(|(bounds, _)| bounds).reduce(none, Bounds::with);
        let (wide, tall) = (high - low, top - foot);
        let longest = wide.max_element().max(tall);
        if !(longest > 0.0 && longest.is_finite()) {
            return None;
        }
        let (scale, room) = (samples as f32 / (longest * (1.0 + 2.0 * ROOM)), ROOM * longest);
        let wide_scale = COLUMNS * scale;
        let count = |extent: f32, scale: f32| ((extent + 2.0 * room) * scale).ceil().max(1.0) as u32;
        let lattice = Lattice {
            along: along.map(|axis| axis * wide_scale),
            left: (low - room) * wide_scale,
            top: (top + room) * scale,
            scale,
            columns: wide.to_array().map(|wide| count(wide, wide_scale)),
            rows: count(tall, scale),
        };
        Some(Self { lattice, longest, share: 1.0 })
    }

    /// The same with a row for so many rows, and as many columns.
    pub fn sparser(&self, by: u32) -> Self {
        let (over, Lattice { rows, top, scale, .. }) = (1.0 / by as f32, &self.lattice);
        let lattice =
            Lattice { rows: rows.div_ceil(by), top: *top * over, scale: *scale * over, ..self.lattice.clone() };
        Self { lattice, longest: self.longest, share: 1.0 / f64::from(by) }
    }

    /// The share of the rows that is drawn.
    pub fn share(&self) -> f64 {
        self.share
    }

    /// The longest side of the plant, metres.
    pub fn longest(&self) -> f32 {
        self.longest
    }

    /// The outline of the wood of a plant.
    pub fn of_wood(&self, scene: &Scene) -> Outline {
        let sheet = Sheet::of(&self.lattice, &[]);
        (0..wood_blocks(scene))
            .into_par_iter()
            .for_each_init(|| (Pen::new(&sheet), Room::default()), |(pen, room), block| scene.places(block, room, pen));
        Outline { bits: sheet.into_bits(), words: self.lattice.words() }
    }

    /// The outline of a plant whose organs these are, with that of its wood.
    pub fn of(&self, wood: &Outline, scene: &Scene, costs: &Costs) -> Outline {
        let sheet = Sheet::of(&self.lattice, &wood.bits);
        let blocks = wood_blocks(scene)..blocks(scene, costs);
        blocks.into_par_iter().for_each_init(
            || (Pen::new(&sheet), Room::default()),
            |(pen, room), block| places((scene, costs), block, room, pen),
        );
        Outline { bits: sheet.into_bits(), words: self.lattice.words() }
    }
}

/// The blocks of wood.
fn wood_blocks(scene: &Scene) -> usize {
    scene.blocks() - scene.organ_blocks()
}

/// The blocks of wood and of organs.
fn blocks(scene: &Scene, costs: &Costs) -> usize {
    wood_blocks(scene) + costs.len().div_ceil(BLOCK)
}

/// Tells the places of a block: first come those of wood.
fn places((scene, costs): (&Scene, &Costs), block: usize, room: &mut Room, take: &mut dyn TakePlaces) {
    match block.checked_sub(wood_blocks(scene)) {
        None => scene.places(block, room, take),
        Some(block) => costs.places(block * BLOCK..((block + 1) * BLOCK).min(costs.len()), scene, room, take),
    }
}

/// The box of what is told, from each direction.
#[derive(Debug, Clone, Copy)]
struct Bounds {
    along: [Vec4; 2],
    low: Vec4,
    high: Vec4,
    heights: [f32; 2],
}

impl Bounds {
    fn with(self, other: Self) -> Self {
        let heights = [self.heights[0].min(other.heights[0]), self.heights[1].max(other.heights[1])];
        Self { low: self.low.min(other.low), high: self.high.max(other.high), heights, ..self }
    }

    fn add(&mut self, at: Vec3) {
        let seen = at.x * self.along[0] + at.y * self.along[1];
        self.low = self.low.min(seen);
        self.high = self.high.max(seen);
        self.heights = [self.heights[0].min(at.z), self.heights[1].max(at.z)];
    }
}

impl TakePlaces for Bounds {
    fn wants(&mut self, held: &Held) -> bool {
        for [x, y, z] in CORNERS {
            self.add(held.middle + x * held.half[0] + y * held.half[1] + z * held.half[2]);
        }
        false
    }

    fn tube(&mut self, rings: [&[Vec3]; 2]) {
        rings.into_iter().flatten().for_each(|at| self.add(*at));
    }

    fn faces(&mut self, places: &[Vec3], _: &[[u32; 3]]) {
        places.iter().for_each(|at| self.add(*at));
    }
}

impl Outline {
    /// The outline of the samples that this or another outline, on the same lattices, covers.
    pub fn with(&self, other: &Self) -> Self {
        let bits = self.bits.iter().zip(&other.bits).map(|(one, other)| one | other).collect();
        Self { bits, words: self.words }
    }

    /// The number of samples that are covered from each direction.
    pub fn covered(&self) -> [u64; DRAWN] {
        self.count(|word| self.bits[word])
    }

    fn count(&self, bits: impl Fn(usize) -> u64) -> [u64; DRAWN] {
        let mut counts = [0; DRAWN];
        (0..self.bits.len()).for_each(|word| counts[word / self.words % DRAWN] += u64::from(bits(word).count_ones()));
        counts
    }

    /// The standard errors of the differences of the covered areas from each direction, as shares of the covered area
    /// of the other, where a share of the rows is drawn, by the differences of neighbouring rows: of rows at equal
    /// distances that is more than the error where the differences change slowly from row to row (Wolter 1984,
    /// *Journal of the American Statistical Association* 79: 781–790, the second of eight estimators).
    pub fn errors(&self, from: &Self, share: f64) -> [f64; DRAWN] {
        let rows = self.bits.len() / (DRAWN * self.words.max(1));
        let count = |of: &Self, row: usize, side: usize| {
            let start = (row * DRAWN + side) * of.words;
            of.bits[start..start + of.words].iter().map(|word| f64::from(word.count_ones())).sum::<f64>()
        };
        std::array::from_fn(|side| {
            let pairs: Vec<[f64; 2]> =
                (0..rows).map(|row| [self, from].map(|of| count(of, row, side))).filter(|[_, of]| *of > 0.0).collect();
            let sums = pairs.iter().fold([0.0; 2], |sums, pair| [sums[0] + pair[0], sums[1] + pair[1]]);
            let ratio = sums[0] / sums[1].max(1.0);
            let left = |[own, of]: &[f64; 2]| own - ratio * of;
            let steps = pairs.windows(2).map(|two| left(&two[0]) - left(&two[1]));
            let squares: f64 = steps.map(|step| step * step).sum();
            let count = pairs.len() as f64;
            ((1.0 - share) * count * squares / (2.0 * (count - 1.0).max(1.0))).sqrt() / sums[1].max(1.0)
        })
    }

    /// How far it is from the outline of what it stands for, on the same lattices.
    pub fn apart(&self, from: &Self) -> Apart {
        let (own, of) = (self.covered(), from.covered());
        let either = self.count(|word| self.bits[word] ^ from.bits[word]);
        let mut apart = Apart::default();
        for side in 0..DRAWN {
            let over = 1.0 / (of[side].max(1) as f64);
            let difference = (own[side] as f64 - of[side] as f64) * over;
            apart.by_side[side] = difference;
            apart.area = apart.area.max(difference.abs());
            apart.either = apart.either.max(either[side] as f64 * over);
        }
        apart
    }
}

impl Apart {
    /// Where between this outline, which does not hold, and one that does lies the first that holds within a bound, if
    /// the differences from each side change evenly: the part of the way.
    pub fn part_that_holds(&self, high: &Self, bound: f64) -> f64 {
        let sides = self.by_side.iter().zip(&high.by_side).map(|(low, high)| {
            let way = high - low;
            if way.abs() > 1e-9 { (low.clamp(-bound, bound) - low) / way } else { 0.0 }
        });
        sides.fold(0.0, f64::max).clamp(0.1, MOST_PART)
    }
}

/// Calls `take` with balls that hold all that is drawn, but for what leans far out of its own length.
pub fn each_ball(scene: &Scene, take: &mut dyn FnMut(Vec3, f32)) {
    let (plant, age) = (scene.plant(), scene.age());
    for node in (0..plant.nodes.len()).map(|node| NodeId(node as u32)).filter(|node| plant.stands(*node, age)) {
        let (frame, radius) = (plant.frames.at(node), 0.5 * plant.nodes.diameter[node.index()]);
        let (base, length) = (Vec3::from_array(frame.base), plant.posed_length(node));
        take(base, radius);
        take(base + length * Vec3::from_array(frame.heading), radius);
    }
    for organ in scene.organs() {
        let drawn = scene.organ(organ);
        let length = plant.organs.length[organ.index()].max(drawn.size[0]).max(0.0);
        take(Vec3::from_array(drawn.base) + 0.5 * length * Vec3::from_array(drawn.heading), 0.5 * length);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of so many covered samples of 64, the same from each direction.
    fn outline(rows: impl Iterator<Item = u32>) -> Outline {
        let bits = rows.flat_map(|count| [u64::MAX.checked_shr(64 - count).unwrap_or(0); DRAWN]).collect();
        Outline { bits, words: 1 }
    }

    /// Rows that cover 40 and 42 samples by turns instead of 41: with d = 2 between neighbouring rows the variance of a
    /// row is d²/2, so that of the sum of n rows is 2 n, less by the share of all rows that they are.
    #[test]
    fn the_error_is_that_of_rows_that_differ_by_turns() {
        let rows = 50;
        let (own, first) = (outline((0..rows).map(|row| 40 + row % 2 * 2)), outline((0..rows).map(|_| 41)));
        for share in [0.5, 0.125] {
            let expected = ((1.0 - share) * 2.0 * f64::from(rows)).sqrt() / f64::from(41 * rows);
            for error in own.errors(&first, share) {
                assert!((error / expected - 1.0).abs() < 1e-9, "{share}: {error}, {expected}");
            }
        }
        // Rows that all cover the same share of the others have none, nor have all rows.
        let half = outline((0..rows).map(|row| 10 + row % 5));
        let double = outline((0..rows).map(|row| 2 * (10 + row % 5)));
        assert!(half.errors(&double, 0.5).iter().chain(&own.errors(&first, 1.0)).all(|error| *error < 1e-12));
        assert!((half.apart(&double).area - 0.5).abs() < 1e-12);
    }
}
