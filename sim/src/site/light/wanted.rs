//! The voxels whose light is wanted, numbered one after another: light is found, and memory taken, for these alone.
//!
//! Also the orders in which a source lights bricks, and the voxels of each: it meets none before those that lie in
//! front of it. Absent: which voxels are wanted (`grid`), light.

use super::grid::{BITS, EDGE, Grid, VOXELS};
use crate::shape::Point;
use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, IntoParallelRefIterator, ParallelIterator};

/// The rows of voxels along X in a brick.
pub const ROWS: usize = VOXELS / EDGE as usize;
/// The fewest rows that a thread looks through.
const FEWEST_ROWS: usize = 16_384;
/// The bits of the place of a voxel in its brick.
const INNER: u32 = 3 * BITS;
/// Whether light goes down along X and along Y, in the order in which the orders of voxels are kept.
const WAYS: [[bool; 2]; 4] = [[false, false], [true, false], [false, true], [true, true]];

/// The voxels of a grid that have leaves or are marked.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Wanted {
    /// Of each row of voxels along X, brick by brick, one bit a voxel.
    rows: Vec<u8>,
    /// The number of the first of each row.
    first: Vec<u32>,
    /// Their indices in the grid.
    indices: Vec<u32>,
    /// Of each brick the least and the largest places of those in it.
    boxes: Vec<[[u8; 3]; 2]>,
    /// The orders of light that goes down and, along X and along Y, up or down.
    orders: [Order; 4],
}

/// An order in which light meets bricks and voxels.
#[derive(Debug, Clone, Default, PartialEq)]
struct Order {
    bricks: Vec<u32>,
    /// The wanted voxels of each brick, brick by brick as bricks are numbered: the place in the brick, and above it how
    /// many wanted voxels of the brick have a lower number.
    voxels: Vec<u32>,
}

impl Wanted {
    /// Those of a grid.
    pub fn of(grid: &Grid) -> Self {
        let mut wanted = Self::default();
        let all = grid.area.len() >> BITS;
        let in_row = |row: usize| grid.wanted_in_row(row);
        wanted.rows = (0..all).into_par_iter().with_min_len(FEWEST_ROWS).map(in_row).collect();
        wanted.first.reserve_exact(all);
        for (row, &bits) in (0..).zip(&wanted.rows) {
            wanted.first.push(wanted.indices.len() as u32);
            let mut left = u32::from(bits);
            while left != 0 {
                wanted.indices.push(row << BITS | left.trailing_zeros());
                left &= left - 1;
            }
        }
        wanted.boxes = wanted.rows.chunks_exact(ROWS).map(box_of).collect();
        let orders: Vec<Order> = WAYS.par_iter().map(|falls| wanted.order_of(grid, *falls)).collect();
        orders.into_iter().zip(&mut wanted.orders).for_each(|(order, of)| *of = order);
        wanted
    }

    /// The order of light that goes down and, along X and along Y, falls or rises.
    fn order_of(&self, grid: &Grid, falls: [bool; 2]) -> Order {
        let mut bricks: Vec<u32> = (0..grid.bricks.len() as u32).collect();
        let turned = |place: i32, falls: bool| if falls { !place } else { place };
        bricks.sort_unstable_by_key(|&brick| {
            let place = grid.bricks[brick as usize];
            [turned(place[0], falls[0]), turned(place[1], falls[1]), !place[2]]
        });
        let mut voxels = Vec::with_capacity(self.count());
        for brick in 0..grid.bricks.len() {
            let first = self.first[brick * ROWS];
            for z in (0..EDGE as usize).rev() {
                for row in 0..EDGE as usize {
                    let y = if falls[1] { EDGE as usize - 1 - row } else { row };
                    let row = (z << BITS) | y;
                    let mut bits = u32::from(self.rows[brick * ROWS + row]);
                    let from = self.first[brick * ROWS + row] - first;
                    let all = bits;
                    while bits != 0 {
                        let x = if falls[0] { 31 - bits.leading_zeros() } else { bits.trailing_zeros() };
                        bits ^= 1 << x;
                        let number = from + (all & ((1 << x) - 1)).count_ones();
                        voxels.push(number << INNER | (row as u32) << BITS | x);
                    }
                }
            }
        }
        Order { bricks, voxels }
    }

    /// Their count.
    pub fn count(&self) -> usize {
        self.indices.len()
    }

    /// The number of a voxel by its index in the grid, if its light is wanted.
    #[inline]
    pub fn number(&self, index: usize) -> Option<usize> {
        let (row, bit) = (index >> BITS, 1 << (index as u32 & (EDGE as u32 - 1)));
        let bits = self.rows[row];
        (bits & bit != 0).then(|| self.first[row] as usize + (bits & (bit - 1)).count_ones() as usize)
    }

    /// Their indices in the grid, in the order of their numbers.
    pub fn indices(&self) -> &[u32] {
        &self.indices
    }

    /// The least and the largest places of the wanted voxels of a brick, in the brick; `None` where there are none.
    pub fn box_of(&self, brick: usize) -> Option<[[u8; 3]; 2]> {
        self.boxes.get(brick).copied().filter(|[least, most]| least[2] <= most[2])
    }

    /// The bricks, in an order in which light along a way that goes down meets them.
    pub fn order(&self, way: Point) -> &[u32] {
        &self.along(way).bricks
    }

    fn along(&self, way: Point) -> &Order {
        &self.orders[usize::from(way[0] < 0.0) | (usize::from(way[1] < 0.0) << 1)]
    }

    /// The wanted voxels of a brick in an order in which light along a way that goes down meets them.
    #[inline]
    pub fn brick(&self, brick: usize, way: Point) -> Brick<'_> {
        let first = self.first[brick * ROWS] as usize;
        let end = self.first.get((brick + 1) * ROWS).map_or(self.indices.len(), |end| *end as usize);
        Brick { first, voxels: &self.along(way).voxels[first..end] }
    }
}

/// The wanted voxels of a brick in some order.
#[derive(Debug, Clone, Copy)]
pub struct Brick<'a> {
    /// The number of the first.
    first: usize,
    /// Each of them, to be asked by [`Brick::voxel`].
    pub voxels: &'a [u32],
}

impl Brick<'_> {
    /// The place of a voxel in the brick, and its number.
    #[inline(always)]
    pub fn voxel(&self, entry: u32) -> ([usize; 3], usize) {
        let inner = |axis: u32| (entry >> (axis * BITS)) as usize & (EDGE as usize - 1);
        ([inner(0), inner(1), inner(2)], self.first + (entry >> INNER) as usize)
    }
}

/// The least and the largest places in the rows of a brick; the least are larger where there are none.
fn box_of(rows: &[u8]) -> [[u8; 3]; 2] {
    let (mut least, mut most, mut along_x) = ([EDGE as u8; 3], [0; 3], 0);
    for (row, bits) in rows.iter().enumerate().filter(|(_, bits)| **bits != 0) {
        let [y, z] = [row as u8 & (EDGE as u8 - 1), (row >> BITS) as u8];
        along_x |= bits;
        (least[1], most[1]) = (least[1].min(y), most[1].max(y));
        (least[2], most[2]) = (least[2].min(z), most[2].max(z));
    }
    (least[0], most[0]) = (along_x.trailing_zeros() as u8, 7 - (along_x.leading_zeros() as u8).min(7));
    [least, most]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::site::light::{Lighting, Piece};

    /// Numbers follow the order of the grid, and along any way each wanted voxel is shown once, after all that lie
    /// before it.
    #[test]
    fn voxels_are_shown_as_light_meets_them() {
        let mut grid = Grid::of(&Lighting::default());
        for k in 0..400_u32 {
            let at = |prime: u32| f64::from(k * prime % 101) * 0.03 - 1.5;
            let piece = Piece { place: [at(7), at(11), at(13)], normal: [0.0, 0.0, 1.0], area: 1.0 };
            if k % 3 == 0 { grid.mark(piece.place) } else { grid.add(&piece) }
        }
        grid.sort();
        let wanted = Wanted::of(&grid);
        let known: Vec<usize> = (0..grid.area.len()).filter(|index| grid.is_wanted(*index)).collect();
        assert!(wanted.indices().iter().map(|index| *index as usize).eq(known.iter().copied()));
        assert_eq!(wanted.count(), known.len());
        for index in 0..grid.area.len() {
            assert_eq!(wanted.number(index), known.iter().position(|known| *known == index));
        }
        for way in [[0.5, 0.5, -0.7], [-0.5, 0.5, -0.7], [0.5, -0.5, -0.7], [-0.5, -0.5, -0.7]] {
            let mut shown: Vec<([i32; 3], usize)> = Vec::new();
            for &brick in wanted.order(way) {
                let place = grid.bricks[brick as usize];
                let of_brick = wanted.brick(brick as usize, way);
                for &entry in of_brick.voxels {
                    let (inner, number) = of_brick.voxel(entry);
                    shown.push(([0, 1, 2].map(|k| place[k] * EDGE + inner[k] as i32), number));
                }
            }
            for (voxel, number) in &shown {
                assert_eq!(grid.index(*voxel), Some(known[*number]));
            }
            for (brick, place) in grid.bricks.iter().enumerate() {
                let inner = shown.iter().filter(|(voxel, _)| voxel.map(|x| x >> BITS) == *place);
                let inner: Vec<[i32; 3]> = inner.map(|(voxel, _)| voxel.map(|x| x & (EDGE - 1))).collect();
                let [least, most] = wanted.box_of(brick).expect("bricks are made for something");
                for k in 0..3 {
                    let ends = [inner.iter().map(|x| x[k]).min(), inner.iter().map(|x| x[k]).max()];
                    assert_eq!(ends, [Some(i32::from(least[k])), Some(i32::from(most[k]))]);
                }
            }
            let mut numbers: Vec<usize> = shown.iter().map(|(_, number)| *number).collect();
            numbers.sort_unstable();
            assert!(numbers.iter().copied().eq(0..known.len()));
            let lies_before = |one: [i32; 3], other: [i32; 3]| {
                let gone = [0, 1, 2].map(|k| f64::from(other[k] - one[k]) * way[k]);
                gone.iter().all(|gone| *gone >= 0.0) && one != other
            };
            for (place, (voxel, _)) in shown.iter().enumerate() {
                assert!(shown[..place].iter().all(|(earlier, _)| !lies_before(*voxel, *earlier)), "{way:?} {voxel:?}");
            }
        }
    }
}
