//! The voxels whose light is wanted, numbered one after another: light is found, and memory taken, for these alone.
//!
//! Also the orders in which a source lights bricks: none meets a brick before those that lie in front of it. Absent:
//! which voxels are wanted (`grid`), light.

use super::grid::{BITS, EDGE, Grid, VOXELS};
use crate::shape::Point;
use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};

/// The rows of voxels along X in a brick.
pub const ROWS: usize = VOXELS / EDGE as usize;
/// The fewest rows that a thread looks through.
const FEWEST_ROWS: usize = 16_384;

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
    /// The bricks in the orders of light that goes down and, along X and along Y, up or down.
    orders: [Vec<u32>; 4],
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
        wanted.orders = [[false, false], [true, false], [false, true], [true, true]].map(|[x, y]| {
            let mut order: Vec<u32> = (0..grid.bricks.len() as u32).collect();
            let turned = |place: i32, falls: bool| if falls { !place } else { place };
            order.sort_unstable_by_key(|&brick| {
                let place = grid.bricks[brick as usize];
                [turned(place[0], x), turned(place[1], y), !place[2]]
            });
            order
        });
        wanted
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
    pub fn indices(&self) -> impl Iterator<Item = usize> {
        self.indices.iter().map(|index| *index as usize)
    }

    /// The least and the largest places of the wanted voxels of a brick, in the brick; `None` where there are none.
    pub fn box_of(&self, brick: usize) -> Option<[[u8; 3]; 2]> {
        self.boxes.get(brick).copied().filter(|[least, most]| least[2] <= most[2])
    }

    /// The bricks, in an order in which light along a way that goes down meets them.
    pub fn order(&self, way: Point) -> &[u32] {
        &self.orders[usize::from(way[0] < 0.0) | (usize::from(way[1] < 0.0) << 1)]
    }

    /// Shows the wanted voxels of a brick in an order in which light along a way that goes down meets them: their
    /// places in the brick, and their numbers.
    #[inline(always)]
    pub fn each_of(&self, brick: usize, way: Point, mut show: impl FnMut([usize; 3], usize)) {
        let falls = [way[0] < 0.0, way[1] < 0.0];
        for z in (0..EDGE as usize).rev() {
            for row in 0..EDGE as usize {
                let y = if falls[1] { EDGE as usize - 1 - row } else { row };
                let row = brick * ROWS + ((z << BITS) | y);
                let mut bits = u32::from(self.rows[row]);
                let [mut from, mut to] =
                    [self.first[row] as usize, self.first[row] as usize + bits.count_ones() as usize];
                while bits != 0 {
                    let (x, number) = if falls[0] {
                        to -= 1;
                        (31 - bits.leading_zeros(), to)
                    } else {
                        from += 1;
                        (bits.trailing_zeros(), from - 1)
                    };
                    bits ^= 1 << x;
                    show([x as usize, y, z], number);
                }
            }
        }
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
        assert_eq!(wanted.indices().collect::<Vec<_>>(), known);
        assert_eq!(wanted.count(), known.len());
        for index in 0..grid.area.len() {
            assert_eq!(wanted.number(index), known.iter().position(|known| *known == index));
        }
        for way in [[0.5, 0.5, -0.7], [-0.5, 0.5, -0.7], [0.5, -0.5, -0.7], [-0.5, -0.5, -0.7]] {
            let mut shown: Vec<([i32; 3], usize)> = Vec::new();
            for &brick in wanted.order(way) {
                let place = grid.bricks[brick as usize];
                wanted.each_of(brick as usize, way, |inner, number| {
                    shown.push(([0, 1, 2].map(|k| place[k] * EDGE + inner[k] as i32), number));
                });
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
