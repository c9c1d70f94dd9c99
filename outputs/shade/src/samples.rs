//! Points in zones: one for each cell of a grid over a zone, with the area of the zone that lies in the cell.
//!
//! A cell that lies in its zone as a whole has its point somewhere within it: along y by the number of its column and
//! along x by that of its row, in steps of the golden ratio. So the edge of a shadow that runs along the grid, such as
//! that of a house, meets its cells at all their heights, and not all of them at once. Any other cell has its point at
//! the centroid of the zone's part. Areas sum to the zone exactly, and no zone is without points. Cells are black and
//! white like those of a chessboard: what the points of one colour say beside those of the other tells how fine the
//! grid is.

use crate::polygon::{Point, Polygon};

/// The most cells of all grids.
const MOST_CELLS: f64 = 4e6;
/// The golden ratio less 1.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// The share of a cell's area that makes it whole.
const WHOLE: f64 = 1.0 - 1e-9;
/// The fewest cells along a side of a zone.
const FEWEST: f64 = 4.0;

/// A point in a zone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Where it lies, metres.
    pub place: Point,
    /// The zone, by its number.
    pub zone: usize,
    /// The area that it stands for, m².
    pub area_m2: f64,
    /// The colour of its cell.
    pub is_black: bool,
    /// Column and row of its cell.
    pub cell: [usize; 2],
}

/// The cells of a zone.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// The south-western corner.
    pub corner: Point,
    /// The sides of a cell, metres.
    pub side: [f64; 2],
    /// Columns and rows.
    pub size: [usize; 2],
    /// For each cell, row by row from the south, its sample and one more; 0 where it has none.
    pub(crate) samples: Vec<u32>,
}

/// The points of all zones.
#[derive(Debug, Clone, PartialEq)]
pub struct Samples {
    /// Zone by zone, and row by row.
    pub all: Vec<Sample>,
    /// A grid for each zone.
    pub grids: Vec<Grid>,
    /// The area of each zone, m².
    pub areas_m2: Vec<f64>,
}

/// Grids of more cells than are followed.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("the grid would have {cells:.0} cells, and {MOST_CELLS:.0} are the most")]
pub struct TooMany {
    /// How many there would be.
    pub cells: f64,
}

impl Samples {
    /// Points at most `spacing_m` apart along x and along y, and at least four along each side of a zone.
    ///
    /// # Errors
    /// [`TooMany`].
    pub fn of(zones: &[Polygon], spacing_m: f64) -> Result<Self, TooMany> {
        let sizes: Vec<[f64; 2]> = zones.iter().map(|zone| size_of(zone, spacing_m)).collect();
        let cells: f64 = sizes.iter().map(|[columns, rows]| columns * rows).sum();
        // No number is no number of cells either.
        if cells.is_nan() || cells > MOST_CELLS {
            return Err(TooMany { cells });
        }
        let mut samples = Self { all: Vec::new(), grids: Vec::new(), areas_m2: Vec::new() };
        zones.iter().zip(sizes).for_each(|(zone, size)| samples.add(zone, size));
        Ok(samples)
    }

    fn add(&mut self, polygon: &Polygon, size: [f64; 2]) {
        let [low, high] = polygon.bounds();
        let side = [0, 1].map(|k| (high[k] - low[k]) / size[k]);
        let size = size.map(|cells| cells as usize);
        let mut grid = Grid { corner: low, side, size, samples: vec![0; size[0] * size[1]] };
        let zone = self.grids.len();
        for (number, sample) in grid.samples.iter_mut().enumerate() {
            let cell = [number % size[0], number / size[0]];
            let from = [0, 1].map(|k| low[k] + cell[k] as f64 * side[k]);
            let to = [0, 1].map(|k| low[k] + (cell[k] + 1) as f64 * side[k]);
            let Some((area_m2, centroid)) = polygon.within(from, to) else { continue };
            let is_whole = area_m2 >= WHOLE * side[0] * side[1];
            let within = |k: usize| from[k] + ((cell[1 - k] as f64 + 0.5) * GOLDEN).fract() * side[k];
            let place = if is_whole { [0, 1].map(within) } else { centroid };
            let is_black = (cell[0] + cell[1]).is_multiple_of(2);
            self.all.push(Sample { place, zone, area_m2, is_black, cell });
            *sample = self.all.len() as u32;
        }
        self.grids.push(grid);
        self.areas_m2.push(polygon.area_m2());
    }
}

/// Columns and rows of the grid of a zone.
fn size_of(zone: &Polygon, spacing_m: f64) -> [f64; 2] {
    let [low, high] = zone.bounds();
    [0, 1].map(|k| ((high[k] - low[k]) / spacing_m).ceil().max(FEWEST))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_sum_to_the_zone_and_points_lie_in_it() {
        let triangle = Polygon { corners: vec![[0.0, 0.0], [7.0, 0.0], [0.0, 3.0]] };
        let square = Polygon { corners: vec![[9.0, 9.0], [9.0, 10.0], [10.0, 10.0], [10.0, 9.0]] };
        let samples = Samples::of(&[triangle, square], 0.3).unwrap();
        let area =
            |zone: usize| samples.all.iter().filter(move |sample| sample.zone == zone).map(|sample| sample.area_m2);
        assert!((area(0).sum::<f64>() - 10.5).abs() < 1e-9 && (area(1).sum::<f64>() - 1.0).abs() < 1e-9);
        assert!(samples.all.iter().filter(|sample| sample.zone == 0).all(|sample| {
            let [x, y] = sample.place;
            x > 0.0 && y > 0.0 && x / 7.0 + y / 3.0 < 1.0
        }));
        assert_eq!((area(1).count(), samples.grids[1].size), (16, [4, 4]), "no zone is small");
        assert_eq!(samples.areas_m2, [10.5, 1.0]);
    }

    #[test]
    fn too_many_cells_are_refused() {
        let large = Polygon { corners: vec![[0.0, 0.0], [1e5, 0.0], [1e5, 1e5]] };
        assert_eq!(Samples::of(&[large], 0.1), Err(TooMany { cells: 1e12 }));
        let none = Polygon { corners: Vec::new() };
        assert!(Samples::of(&[none], 0.1).is_ok_and(|samples| samples.all.is_empty()));
    }
}
