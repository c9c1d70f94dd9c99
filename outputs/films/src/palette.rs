//! The one palette of a film: colours learned from a few of its pictures, and the nearest of them to each colour.
//!
//! Colours are counted in cells of two bits less a channel. The cell box with the largest sum of squared distances is
//! cut at its mean until there are enough (Wu 1991, *Efficient statistical computations for optimal color
//! quantization*, is the same in closed form); then each colour moves to the mean of the cells that are nearest to it
//! (Lloyd 1982). A cell counts by the square root of its pixels, so that the sky does not take all colours. All sums
//! are of whole numbers and ties go to the smaller index, so that the palette is the same everywhere.

use phytomer_pictures::Canvas;
use rayon::prelude::*;

/// The most colours: the last of 256 is for what does not change.
pub const MOST: usize = 255;
/// Bits of a channel that a cell has.
const BITS: usize = 6;
const CELLS: usize = 1 << (3 * BITS);
/// How often colours move to the mean of their cells.
const ROUNDS: usize = 6;
/// The cells that a thread handles at once.
const AT_ONCE: usize = 4096;

/// A palette, with the nearest of its colours to each cell.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Palette {
    /// Its colours, at least one.
    pub colours: Vec<[u8; 3]>,
    nearest: Vec<u8>,
}

/// Colours that are alike: their mean, and their weight.
#[derive(Debug, Clone, Copy)]
struct Cell {
    colour: [i64; 3],
    weight: i64,
}

/// Cells to be parted, and the sum of their squared distances from their mean by channel.
struct Part {
    cells: Vec<Cell>,
    spread: [i64; 3],
}

impl Palette {
    /// The palette of some pictures.
    pub fn of(pictures: &[Canvas]) -> Self {
        let cells = counted(pictures);
        let mut parts = vec![Part::of(cells.clone())];
        while parts.len() < MOST {
            let widest = (0..parts.len()).max_by_key(|k| (parts[*k].spread.iter().sum::<i64>(), std::cmp::Reverse(*k)));
            let Some(place) = widest.filter(|place| parts[*place].spread != [0; 3]) else { break };
            let (low, high) = parts[place].cut();
            parts[place] = low;
            parts.push(high);
        }
        let mut colours: Vec<[u8; 3]> = parts.iter().map(|part| mean_of(&part.cells)).collect();
        for _ in 0..ROUNDS {
            moved(&mut colours, &cells);
        }
        let middle = |index: usize, shift: usize| ((index >> shift & 63) << 2 | 2) as u8;
        let nearest = (0..CELLS).into_par_iter().with_min_len(AT_ONCE).map(|index| {
            let colour = [middle(index, 2 * BITS), middle(index, BITS), middle(index, 0)];
            nearest_of(&colours, colour.map(i64::from)) as u8
        });
        let nearest = nearest.collect();
        Self { colours, nearest }
    }

    /// The place in the palette of the nearest colour, to within a cell.
    #[inline]
    pub fn nearest(&self, colour: [u8; 3]) -> u8 {
        self.nearest[cell_of(colour)]
    }
}

fn cell_of([r, g, b]: [u8; 3]) -> usize {
    [r, g, b].iter().fold(0, |cell, channel| cell << BITS | usize::from(channel >> 2))
}

/// The cells of the colours of pictures, in their order; grey alone where there is no picture.
fn counted(pictures: &[Canvas]) -> Vec<Cell> {
    let mut sums = vec![[0_u64; 4]; CELLS];
    for [r, g, b, _] in pictures.iter().flat_map(|picture| &picture.pixels) {
        let sum = &mut sums[cell_of([*r, *g, *b])];
        for (sum, value) in sum.iter_mut().zip([*r, *g, *b, 1]) {
            *sum += u64::from(value);
        }
    }
    let of = |[r, g, b, count]: &[u64; 4]| Cell {
        colour: [*r, *g, *b].map(|sum| ((2 * sum + count) / (2 * count)) as i64),
        weight: count.isqrt() as i64,
    };
    let cells: Vec<Cell> = sums.iter().filter(|sum| sum[3] > 0).map(of).collect();
    if cells.is_empty() { vec![Cell { colour: [128; 3], weight: 1 }] } else { cells }
}

fn mean_of(cells: &[Cell]) -> [u8; 3] {
    let weight: i64 = cells.iter().map(|cell| cell.weight).sum::<i64>().max(1);
    [0, 1, 2].map(|k| {
        let sum: i64 = cells.iter().map(|cell| cell.weight * cell.colour[k]).sum();
        ((2 * sum + weight) / (2 * weight)) as u8
    })
}

impl Part {
    fn of(cells: Vec<Cell>) -> Self {
        let mean = mean_of(&cells).map(i64::from);
        let square = |k: usize| {
            let each = cells.iter().map(|cell| cell.weight * (cell.colour[k] - mean[k]) * (cell.colour[k] - mean[k]));
            each.sum::<i64>()
        };
        let spread = if cells.len() < 2 { [0; 3] } else { [0, 1, 2].map(square) };
        Self { cells, spread }
    }

    /// Its halves below and above the mean of its widest channel; both have cells where that channel has a spread.
    fn cut(&mut self) -> (Self, Self) {
        let channel = (0..3).max_by_key(|k| (self.spread[*k], std::cmp::Reverse(*k))).unwrap_or(0);
        let least = self.cells.iter().map(|cell| cell.colour[channel]).min().unwrap_or(0);
        // The mean is rounded: it may be that of the largest.
        let most = self.cells.iter().map(|cell| cell.colour[channel]).max().unwrap_or(0);
        let mean = i64::from(mean_of(&self.cells)[channel]).clamp(least, (most - 1).max(least));
        let (low, high) = std::mem::take(&mut self.cells).into_iter().partition(|cell| cell.colour[channel] <= mean);
        (Self::of(low), Self::of(high))
    }
}

fn distance(a: [i64; 3], b: [i64; 3]) -> i64 {
    // Green differs most to the eye, blue least: roughly the shares of luminance.
    [(0, 3), (1, 4), (2, 2)].iter().map(|(k, part)| part * (a[*k] - b[*k]) * (a[*k] - b[*k])).sum()
}

fn nearest_of(colours: &[[u8; 3]], colour: [i64; 3]) -> usize {
    let far = |place: &usize| distance(colours[*place].map(i64::from), colour);
    (0..colours.len()).min_by_key(far).unwrap_or(0)
}

/// Moves each colour to the mean of the cells that are nearest to it; one without cells stays.
fn moved(colours: &mut [[u8; 3]], cells: &[Cell]) {
    let nearest: Vec<usize> = cells.par_iter().map(|cell| nearest_of(colours, cell.colour)).collect();
    let mut sums = vec![[0_i64; 4]; colours.len()];
    for (cell, place) in cells.iter().zip(nearest) {
        let sum = &mut sums[place];
        (0..3).for_each(|k| sum[k] += cell.weight * cell.colour[k]);
        sum[3] += cell.weight;
    }
    for (colour, [r, g, b, weight]) in colours.iter_mut().zip(sums).filter(|(_, sum)| sum[3] > 0) {
        *colour = [r, g, b].map(|sum| ((2 * sum + weight) / (2 * weight)) as u8);
    }
}
