//! Leaf area in boxes of space (voxels): whole numbers, so that no order in which leaves are added ever shows.
//!
//! Voxels stand in bricks of 8 × 8 × 8; a brick is made when something falls into it, so memory goes with the leaf area
//! and not with the box around the plants. A brick is found by its place through a table of open addresses. Area is
//! counted in units of 2⁻³² m², a quarter of a thousandth of a mm²; a voxel holds at most 2³² m², and what is more is
//! left out (`saturated`). Where the plot repeats, an even number of voxels spans it, so that half of it is a whole
//! number of them, and places are taken back into it. Absent: the voxel of a place (`spot`), light.

use super::normals::{CLASSES, class_of};
use super::{Borders, Lighting, Piece, Projection};
use crate::shape::Point;
use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};
use rayon::slice::ParallelSliceMut;

/// The voxels along an edge of a brick, as a power of 2.
pub const BITS: u32 = 3;
/// The voxels along an edge of a brick.
pub const EDGE: i32 = 1 << BITS;
/// The voxels of a brick.
pub const VOXELS: usize = 1 << (3 * BITS);
/// The words of marks of a brick.
const WORDS: usize = VOXELS / 64;
/// The fewest bricks that a thread takes from a grid.
const FEWEST_BRICKS: usize = 64;
/// The units of area in a m².
pub const UNITS: f64 = 4_294_967_296.0;
/// The farthest brick from the corner of the plot, along each axis.
pub(super) const FARTHEST: i32 = (1 << 20) - 1;
/// No brick.
pub const NONE: u32 = u32::MAX;

/// A voxel: its place along X, Y and Z.
pub type Voxel = [i32; 3];

/// The boxes of a plot and the leaf area in them.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// The edges of a voxel, metres.
    pub edges: [f64; 3],
    /// The corner of voxel [0, 0, 0], metres.
    pub origin: Point,
    /// The number of voxels along X and Y after which the plot repeats; a number that is never reached where it does
    /// not.
    pub period: [i32; 2],
    /// The voxel along X and Y from which beams of a plot that repeats are laid: one that goes with the plants.
    pub anchor: [i32; 2],
    /// The place of each brick, in bricks, in the order in which they were made.
    pub bricks: Vec<[i32; 3]>,
    /// The leaf area of each voxel, brick by brick.
    pub area: Vec<u64>,
    /// The leaf area of each voxel by the class of its normal; empty where normals do not matter.
    pub by_normal: Vec<u64>,
    /// Whether some voxel was too full to hold all its area.
    pub saturated: bool,
    keeps_normals: bool,
    table: Vec<u32>,
    /// The least and the largest places of bricks.
    least: [i32; 3],
    most: [i32; 3],
    /// Of each voxel, one bit a voxel, whether its light is wanted where it has no leaves.
    marked: Vec<u64>,
    /// The brick into which something fell last.
    last: usize,
}

impl Grid {
    /// The empty grid of a plot.
    pub fn of(lighting: &Lighting) -> Self {
        let edge = lighting.voxel_m;
        let (mut edges, mut period) = ([edge; 3], [i32::MAX; 2]);
        if let Borders::Periodic(width) = lighting.borders {
            for k in 0..2 {
                let count = 2.0 * (width[k] / edge / 2.0).round().clamp(1.0, 5e5);
                (edges[k], period[k]) = (width[k] / count, count as i32);
            }
        }
        Self {
            edges,
            origin: lighting.origin,
            period,
            anchor: [0; 2],
            bricks: Vec::new(),
            area: Vec::new(),
            by_normal: Vec::new(),
            saturated: false,
            keeps_normals: lighting.projection == Projection::OfLeaves,
            table: vec![NONE; 64],
            least: [i32::MAX; 3],
            most: [i32::MIN; 3],
            marked: Vec::new(),
            last: 0,
        }
    }

    /// The volume of a voxel, m³.
    pub fn volume(&self) -> f64 {
        self.edges[0] * self.edges[1] * self.edges[2]
    }

    /// The least and the largest places of bricks.
    pub(super) fn span(&self) -> [[i32; 3]; 2] {
        [self.least, self.most]
    }

    /// Whether the plot repeats.
    pub fn repeats(&self) -> bool {
        self.period[0] != i32::MAX
    }

    /// The voxel taken back into a plot that repeats.
    pub fn within(&self, [x, y, z]: Voxel) -> Voxel {
        if self.repeats() { [x.rem_euclid(self.period[0]), y.rem_euclid(self.period[1]), z] } else { [x, y, z] }
    }

    /// The index of a voxel, if its brick has been made.
    #[inline]
    pub fn index(&self, voxel: Voxel) -> Option<usize> {
        let brick = self.brick(voxel.map(|x| x >> BITS));
        (brick != NONE).then(|| brick as usize * VOXELS + within_brick(voxel))
    }

    /// The number of a brick; [`NONE`] where it has not been made.
    #[inline]
    pub fn brick(&self, place: [i32; 3]) -> u32 {
        let mask = self.table.len() - 1;
        let mut slot = hash(place) & mask;
        loop {
            let found = self.table[slot];
            if found == NONE || self.bricks[found as usize] == place {
                return found;
            }
            slot = (slot + 1) & mask;
        }
    }

    /// Adds the area of a piece of leaf.
    pub fn add(&mut self, piece: &Piece) {
        let units = (piece.area * UNITS).round();
        // Neither negative nor no number; the cast saturates.
        if units > 0.0 {
            let index = self.make(self.within(self.voxel(piece.place)));
            let class = if self.keeps_normals { class_of(piece.normal) } else { 0 };
            self.put(index, class, units as u64);
        }
    }

    /// Makes the voxel of a place, so that its light is found.
    pub fn mark(&mut self, place: Point) {
        self.mark_voxel(self.within(self.voxel(place)));
    }

    /// Makes a voxel, so that its light is found.
    pub(super) fn mark_voxel(&mut self, voxel: Voxel) {
        let index = self.make(voxel);
        self.marked[index / 64] |= 1 << (index % 64);
    }

    /// Whether the light of a voxel is wanted: it has leaves, or has been marked.
    pub fn is_wanted(&self, index: usize) -> bool {
        self.area[index] > 0 || self.marked[index / 64] & (1 << (index % 64)) != 0
    }

    /// Of eight voxels along X, one bit each, whether their light is wanted.
    #[inline]
    pub(super) fn wanted_in_row(&self, row: usize) -> u8 {
        let marked = self.marked[row / 8] >> (8 * (row % 8));
        let with_leaves = |bits: u8, (bit, area): (usize, &u64)| bits | (u8::from(*area > 0) << bit);
        self.area[row * 8..row * 8 + 8].iter().enumerate().fold(marked as u8, with_leaves)
    }

    /// The voxel into which a piece of leaf falls, the class of its normal and the units of its area.
    pub(super) fn share(&self, piece: &Piece) -> (Voxel, usize, u64) {
        let units = (piece.area * UNITS).round();
        let class = if self.keeps_normals { class_of(piece.normal) } else { 0 };
        // Neither negative nor no number; the cast saturates.
        (self.within(self.voxel(piece.place)), class, units as u64)
    }

    /// Adds units of area to a voxel, or takes those away that it has.
    pub(super) fn shift(&mut self, voxel: Voxel, class: usize, units: i64) {
        let index = self.make(voxel);
        self.area[index] = self.area[index].wrapping_add_signed(units);
        if self.keeps_normals {
            let of_class = &mut self.by_normal[index * CLASSES + class];
            *of_class = of_class.wrapping_add_signed(units);
        }
    }

    /// Forgets which voxels are marked.
    pub(super) fn unmark(&mut self) {
        self.marked.fill(0);
    }

    /// The same grid without bricks that hold nothing, in the order of their places.
    pub(super) fn sorted(&self) -> Self {
        let holds = |brick: &usize| {
            self.marked[brick * WORDS..(brick + 1) * WORDS].iter().any(|word| *word > 0)
                || self.area[brick * VOXELS..(brick + 1) * VOXELS].iter().any(|units| *units > 0)
        };
        let bricks = (0..self.bricks.len()).into_par_iter().with_min_len(FEWEST_BRICKS);
        let mut order: Vec<usize> = bricks.filter(holds).collect();
        order.sort_unstable_by_key(|&brick| self.bricks[brick]);
        let mut sorted = self.without_bricks();
        sorted.take_in_order(self, &order);
        sorted
    }

    /// Adds all of another grid of the same plot.
    pub fn join(&mut self, other: &Self) {
        for (brick, place) in other.bricks.iter().enumerate() {
            let (to, from) = (self.make(place.map(|x| x << BITS)), brick * VOXELS);
            for word in 0..WORDS {
                self.marked[to / 64 + word] |= other.marked[from / 64 + word];
            }
            for voxel in 0..VOXELS {
                if other.area[from + voxel] == 0 {
                    continue;
                }
                if self.keeps_normals {
                    let of = |class: usize| other.by_normal[(from + voxel) * CLASSES + class];
                    (0..CLASSES).for_each(|class| self.put(to + voxel, class, of(class)));
                } else {
                    self.put(to + voxel, 0, other.area[from + voxel]);
                }
            }
        }
        self.saturated |= other.saturated;
    }

    /// Sums that end at the most that there can be do not depend on their order.
    #[inline]
    fn put(&mut self, index: usize, class: usize, units: u64) {
        let (sum, is_too_much) = self.area[index].overflowing_add(units);
        self.area[index] = if is_too_much { u64::MAX } else { sum };
        self.saturated |= is_too_much;
        if self.keeps_normals {
            let of_class = &mut self.by_normal[index * CLASSES + class];
            *of_class = of_class.saturating_add(units);
        }
    }

    /// The index of a voxel, whose brick is made if need be.
    fn make(&mut self, voxel: Voxel) -> usize {
        let place = voxel.map(|x| x >> BITS);
        // What comes one after the other mostly falls into one brick.
        if self.bricks.get(self.last).is_some_and(|last| *last == place) {
            return self.last * VOXELS + within_brick(voxel);
        }
        let mut brick = self.brick(place);
        if brick == NONE {
            brick = self.bricks.len() as u32;
            self.bricks.push(place);
            self.area.resize(self.area.len() + VOXELS, 0);
            self.marked.resize(self.marked.len() + WORDS, 0);
            self.least = [0, 1, 2].map(|k| self.least[k].min(place[k]));
            self.most = [0, 1, 2].map(|k| self.most[k].max(place[k]));
            if self.keeps_normals {
                self.by_normal.resize(self.by_normal.len() + VOXELS * CLASSES, 0);
            }
            self.enter(brick);
        }
        self.last = brick as usize;
        brick as usize * VOXELS + within_brick(voxel)
    }

    fn enter(&mut self, brick: u32) {
        if self.bricks.len() * 2 > self.table.len() {
            self.table = vec![NONE; self.table.len() * 4];
            (0..self.bricks.len() as u32).for_each(|brick| self.place_in_table(brick));
        } else {
            self.place_in_table(brick);
        }
    }

    fn place_in_table(&mut self, brick: u32) {
        let mask = self.table.len() - 1;
        let mut slot = hash(self.bricks[brick as usize]) & mask;
        while self.table[slot] != NONE {
            slot = (slot + 1) & mask;
        }
        self.table[slot] = brick;
    }

    /// Puts the bricks in the order of their places, so that nothing tells in which order they were made.
    pub fn sort(&mut self) {
        let mut order: Vec<usize> = (0..self.bricks.len()).collect();
        order.sort_unstable_by_key(|&brick| self.bricks[brick]);
        let unsorted = std::mem::replace(self, self.without_bricks());
        self.take_in_order(&unsorted, &order);
    }

    /// A grid of the same plot without bricks.
    fn without_bricks(&self) -> Self {
        Self {
            bricks: Vec::new(),
            area: Vec::new(),
            by_normal: Vec::new(),
            marked: Vec::new(),
            table: Vec::new(),
            least: [i32::MAX; 3],
            most: [i32::MIN; 3],
            last: 0,
            ..*self
        }
    }

    /// Takes some bricks of another grid, in an order.
    fn take_in_order(&mut self, from: &Self, order: &[usize]) {
        let taken = |column: &[u64], each: usize| -> Vec<u64> {
            let mut taken = vec![0; if column.is_empty() { 0 } else { order.len() * each }];
            let bricks = taken.par_chunks_exact_mut(each).zip(order).with_min_len(FEWEST_BRICKS);
            bricks.for_each(|(taken, &brick)| taken.copy_from_slice(&column[brick * each..(brick + 1) * each]));
            taken
        };
        (self.area, self.by_normal) = (taken(&from.area, VOXELS), taken(&from.by_normal, VOXELS * CLASSES));
        self.marked = taken(&from.marked, WORDS);
        self.bricks = order.iter().map(|&brick| from.bricks[brick]).collect();
        for place in &self.bricks {
            self.least = [0, 1, 2].map(|k| self.least[k].min(place[k]));
            self.most = [0, 1, 2].map(|k| self.most[k].max(place[k]));
        }
        self.table = vec![NONE; (self.bricks.len() * 4).next_power_of_two().max(64)];
        (0..self.bricks.len() as u32).for_each(|brick| self.place_in_table(brick));
    }

    /// All leaf area, m².
    pub fn leaf_area(&self) -> f64 {
        self.area.iter().map(|units| *units as f64).sum::<f64>() / UNITS
    }

    /// The low and the high corner of all bricks, metres; `None` where there is none.
    pub fn bounds(&self) -> Option<[Point; 2]> {
        if self.bricks.is_empty() {
            return None;
        }
        let at = |brick: [i32; 3]| [0, 1, 2].map(|k| self.origin[k] + f64::from(brick[k] << BITS) * self.edges[k]);
        Some([at(self.least), at(self.most.map(|x| x + 1))])
    }
}

/// The place of a voxel in its brick.
#[inline]
pub fn within_brick([x, y, z]: Voxel) -> usize {
    let inner = |x: i32| (x & (EDGE - 1)) as usize;
    (inner(z) << (2 * BITS)) | (inner(y) << BITS) | inner(x)
}

#[inline]
fn hash([x, y, z]: [i32; 3]) -> usize {
    let packed = (x as u32 as u64) ^ ((y as u32 as u64) << 21) ^ ((z as u32 as u64) << 42);
    (packed.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32) as usize
}
