//! Which discs meet: a grid for each size of discs, its cells as wide as the widest disc in it.
//!
//! Radii may differ by any factor, so discs are put into levels by powers of two of their diameter, and a disc asks the
//! nine cells around it at its own level and at each wider one. Discs lie in the order of their cells, so that
//! neighbours are near one another in memory too. The time is linear in the discs times the levels that occur, but for
//! the search of a cell, and in the pairs that lie in such cells. Absent: what is done with a pair.

use super::Disc;
use std::ops::Range;

/// Cells beyond this place are one: discs so far from the origin for their size are told as neighbours, if in vain.
const FARTHEST: f64 = 1e15;

/// A row and a column.
type Cell = [i64; 2];

/// Discs in the order of levels, and in each of rows and columns of its grid.
pub(super) struct Grid {
    pub discs: Vec<Disc>,
    cells: Vec<Cell>,
    levels: Vec<Level>,
}

/// The discs of one level.
struct Level {
    side: f64,
    range: Range<usize>,
}

/// The least power of two above a diameter.
fn side_of(disc: &Disc) -> f64 {
    // A normal number: see `Disc::is_there`.
    f64::from_bits((((2.0 * disc.radius).to_bits() >> 52) + 1) << 52)
}

fn cell_of(disc: &Disc, side: f64) -> Cell {
    let [x, y] = disc.centre.map(|place| (place / side).floor().clamp(-FARTHEST, FARTHEST) as i64);
    [y, x]
}

impl Grid {
    pub fn of(discs: &[Disc]) -> Self {
        let place = |disc: &Disc| {
            let side = side_of(disc);
            (side, cell_of(disc, side), *disc)
        };
        let mut placed: Vec<(f64, Cell, Disc)> = discs.iter().filter(|disc| disc.is_there()).map(place).collect();
        placed.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut levels: Vec<Level> = Vec::new();
        for (at, (side, _, _)) in placed.iter().enumerate() {
            match levels.last_mut().filter(|level| level.side == *side) {
                Some(level) => level.range.end = at + 1,
                None => levels.push(Level { side: *side, range: at..at + 1 }),
            }
        }
        let cells = placed.iter().map(|(_, cell, _)| *cell).collect();
        Self { discs: placed.into_iter().map(|(_, _, disc)| disc).collect(), cells, levels }
    }

    /// Tells each pair of discs that may meet once, by their places; all pairs that meet are among them.
    pub fn each_pair(&self, mut tell: impl FnMut(usize, usize)) {
        for (number, own) in self.levels.iter().enumerate() {
            for at in own.range.clone() {
                // Of a pair of one level the later disc tells it.
                self.near(at, own, |other| {
                    if other < at {
                        tell(at, other)
                    }
                });
                self.levels[number + 1..].iter().for_each(|level| self.near(at, level, |other| tell(at, other)));
            }
        }
    }

    /// The discs of a level in the nine cells around a disc.
    fn near(&self, at: usize, level: &Level, mut tell: impl FnMut(usize)) {
        let [row, column] = cell_of(&self.discs[at], level.side);
        for row in row - 1..=row + 1 {
            let cells = &self.cells[level.range.clone()];
            let first = level.range.start + cells.partition_point(|cell| *cell < [row, column - 1]);
            let others = (first..level.range.end).take_while(|other| self.cells[*other] <= [row, column + 1]);
            others.for_each(&mut tell);
        }
    }
}
