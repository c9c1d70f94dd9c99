//! Attacks that are aggregated in space: a Thomas process (M. Thomas 1949, *Biometrika* 36: 18–25).
//!
//! Parents stand in the field at random; around each, offspring fall with a normal deviate in either direction.
//! Ripley's K is K(r) = π r² + (1 − exp(−r²/4σ²)) / (parents a m²) (P. J. Diggle 2003, *Statistical Analysis of Spatial
//! Point Patterns* §5.3). The parents of each cell of a square grid have a stream of their own, so that the pressure at
//! any place is known without the rest of the field, and a field keeps its clusters when it becomes larger. Parents
//! further away than the side of a cell, 5 σ, are left out: 4·10⁻⁶ of their offspring.

use super::draws::Draws;
use super::key::Key;
use super::{DrawError, within};
use phytomer_sim::math::exp;
use std::f64::consts::PI;

/// The side of a cell in units of the spread.
const CELL: f64 = 5.0;
/// The most parents that a cell may be expected to have.
const MOST_PARENTS: f64 = 1e4;
/// The furthest place, metres, by absolute value: cells have whole numbers.
const FURTHEST: f64 = 1e9;

/// A point of the field, metres.
pub type Point = [f64; 2];

/// Clusters in a field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clusters {
    parents_per_m2: f64,
    spread_m: f64,
}

impl Clusters {
    /// Clusters of which `parents_per_m2` are expected a square metre, each with the standard deviation `spread_m` in
    /// either direction.
    ///
    /// # Errors
    /// Where a number is not above 0 or too large, or where more clusters overlap than can be drawn.
    pub fn new(parents_per_m2: f64, spread_m: f64) -> Result<Self, DrawError> {
        let spread_m = within("the spread of a cluster, metres,", spread_m, 1e-3, 1e6)?;
        let parents_per_m2 = within("the number of clusters a square metre", parents_per_m2, 1e-12, 1e12)?;
        let across_m = CELL * spread_m;
        let parents = parents_per_m2 * across_m * across_m;
        if parents > MOST_PARENTS {
            return Err(DrawError::Crowded { parents, across_m });
        }
        Ok(Self { parents_per_m2, spread_m })
    }

    /// The pressure at a place as a multiple of its mean over the field, which is 1: the sum of the normal densities of
    /// the clusters around it, divided by their number a square metre. 1 at a place more than 10⁹ m away.
    ///
    /// # Errors
    /// None for clusters that [`Clusters::new`] has accepted.
    pub fn pressure(&self, key: &Key, at: Point) -> Result<f64, DrawError> {
        if !at.iter().all(|x| x.abs() <= FURTHEST) {
            return Ok(1.0);
        }
        let [x, y] = at.map(|x| self.cell_of(x));
        let width = 2.0 * self.spread_m * self.spread_m;
        let mut sum = 0.0;
        for cell in (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| [x, y])) {
            for [px, py] in self.parents(key, cell)?.0 {
                let square = (px - at[0]) * (px - at[0]) + (py - at[1]) * (py - at[1]);
                sum += exp(-square / width);
            }
        }
        Ok(sum / (PI * width * self.parents_per_m2))
    }

    /// The points of the pattern within the rectangle from `low` to `high`, with `offspring` expected a parent.
    ///
    /// # Errors
    /// Where the rectangle is further than 10⁹ m or has more than 10⁶ cells, or more offspring than 10⁹ are expected.
    pub fn points(&self, key: &Key, [low, high]: [Point; 2], offspring: f64) -> Result<Vec<Point>, DrawError> {
        for side in [low[0], low[1], high[0], high[1]] {
            within("the place, metres,", side, -FURTHEST, FURTHEST)?;
        }
        let cells = |k: usize| self.cell_of(low[k]) - 1..=self.cell_of(high[k]) + 1;
        let across = |k: usize| (high[k] - low[k]).max(0.0) / (CELL * self.spread_m) + 3.0;
        within("the number of cells of the field", across(0) * across(1), 0.0, 1e6)?;
        let inside = |point: &Point| (0..2).all(|k| (low[k]..high[k]).contains(&point[k]));
        let mut points = Vec::new();
        for cell in cells(0).flat_map(|x| cells(1).map(move |y| [x, y])) {
            let (parents, mut draws) = self.parents(key, cell)?;
            for [x, y] in parents {
                for _ in 0..draws.poisson(offspring)? {
                    let point = [draws.normal(x, self.spread_m)?, draws.normal(y, self.spread_m)?];
                    points.extend(Some(point).filter(inside));
                }
            }
        }
        Ok(points)
    }

    /// The parents of a cell, and the draws that follow them in its stream.
    fn parents(&self, key: &Key, cell: [i64; 2]) -> Result<(Vec<Point>, Draws), DrawError> {
        let side = CELL * self.spread_m;
        let mut draws = Draws::of(&Key { event: key.event.in_cell(cell), ..*key });
        let parents = draws.poisson(self.parents_per_m2 * side * side)?;
        let mut place = |cell: i64| (cell as f64 + draws.uniform()) * side;
        let parents = (0..parents).map(|_| [place(cell[0]), place(cell[1])]).collect();
        Ok((parents, draws))
    }

    fn cell_of(&self, x: f64) -> i64 {
        (x / (CELL * self.spread_m)).floor() as i64
    }
}
