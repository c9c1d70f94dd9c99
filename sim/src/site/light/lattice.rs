//! Where the beams of a source run: evenly spaced across their direction, so that fewer meet level ground the lower
//! they come.
//!
//! On open ground the beams stand on a lattice in the plane across them, an edge of a voxel apart, and only those are
//! followed that meet a brick: for each tile of 8 × 8 beams, the stretches along the beams in which bricks lie. Where
//! the plot repeats, beams start from one plot of a level above all plants, as many as the plot is wide across them,
//! and lie about a voxel that goes with the plants: whole voxels farther, plants have the same light to the last bit.
//! Each row is shifted by the golden ratio against the one before, so that no beams follow one another through the
//! same planes of voxels. Absent: what becomes of a beam (`beam`).

use super::Source;
use super::grid::{BITS, EDGE, Grid};
use super::spot::Spot;
use crate::shape::Point;

/// What each row of beams is shifted by, as a share of the distance of two beams.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// The beams along an edge of a tile, as a power of 2.
const TILE: u32 = 3;

/// One beam: a line, and the stretches of it that are followed.
#[derive(Debug, Clone, PartialEq)]
pub struct Beam<'a> {
    /// Where it begins.
    pub from: Spot,
    /// The unit vector along which it goes.
    pub way: Point,
    /// Its area across its way, m².
    pub section: f64,
    /// The stretches in which it may meet leaves, metres from its beginning, rising and apart.
    pub stretches: &'a [[f64; 2]],
}

impl Beam<'_> {
    /// The place so many metres from its beginning, metres.
    pub fn place(&self, grid: &Grid, along: f64) -> Point {
        let from = grid.place(self.from);
        [0, 1, 2].map(|k| from[k] + self.way[k] * along)
    }
}

/// Shows each beam of a source that may meet a brick of the grid, in a fixed order. `top` is the height, metres, above
/// which nothing is in its way, in plots that repeat.
pub fn each_beam(grid: &Grid, source: &Source, top: f64, show: &mut dyn FnMut(&Beam)) {
    if grid.repeats() { of_plot(grid, source, top, show) } else { on_open_ground(grid, source, show) }
}

/// What a row of beams is shifted by, as a share of the distance of two beams.
pub(super) fn shift_of(row: i64) -> f64 {
    let turned = row as f64 * GOLDEN;
    let whole = turned as i64 as f64;
    // The next whole number below, without the call that `floor` is on machines that have no instruction for it.
    turned - if whole > turned { whole - 1.0 } else { whole }
}

/// The directions across a source, level first.
pub fn across([x, y, z]: [f64; 3]) -> [Point; 2] {
    let level = (x * x + y * y).sqrt();
    let right = if level > 1e-9 { [-y / level, x / level, 0.0] } else { [1.0, 0.0, 0.0] };
    let up = [y * right[2] - z * right[1], z * right[0] - x * right[2], x * right[1] - y * right[0]];
    [right, up]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A tile of beams and a stretch of them in which a brick lies.
type Stretch = ([i32; 2], [f64; 2]);

fn on_open_ground(grid: &Grid, source: &Source, show: &mut dyn FnMut(&Beam)) {
    let apart = grid.edges[0];
    let [right, up] = across(source.towards);
    let way = source.towards.map(|x| -x);
    let stretches = stretches(grid, [right, up, way], apart);
    let mut first = 0;
    while first < stretches.len() {
        let tile = stretches[first].0;
        let count = stretches[first..].iter().take_while(|stretch| stretch.0 == tile).count();
        let merged = merged(&stretches[first..first + count]);
        first += count;
        let [left, low] = tile.map(|place| i64::from(place) << TILE);
        for row in low..low + (1 << TILE) {
            for column in left..left + (1 << TILE) {
                let u = (column as f64 + 0.5 + shift_of(row)) * apart;
                let v = (row as f64 + 0.5) * apart;
                let from = grid.spot([0, 1, 2].map(|k| grid.origin[k] + right[k] * u + up[k] * v));
                show(&Beam { from, way, section: apart * apart, stretches: &merged });
            }
        }
    }
}

/// For each tile of beams the stretches in which bricks lie, in order.
fn stretches(grid: &Grid, axes: [Point; 3], apart: f64) -> Vec<Stretch> {
    let half = grid.edges.map(|edge| edge * f64::from(EDGE) / 2.0);
    let reach = axes.map(|axis| dot(axis.map(f64::abs), half));
    let mut stretches: Vec<Stretch> = Vec::with_capacity(grid.bricks.len() * 8);
    for place in &grid.bricks {
        let middle = [0, 1, 2].map(|k| f64::from(place[k] << BITS) * grid.edges[k] + half[k]);
        let at = axes.map(|axis| dot(axis, middle));
        let tiles = |k: usize, shift: f64| {
            let beams = [at[k] - reach[k], at[k] + reach[k]].map(|side| side / apart);
            let [low, high] = [beams[0] - 0.5 - shift, beams[1] - 0.5].map(|beam| beam.floor() as i64 >> TILE);
            low as i32..=high as i32
        };
        let along = [at[2] - reach[2], at[2] + reach[2]];
        for row in tiles(1, 0.0) {
            stretches.extend(tiles(0, 1.0).map(|column| ([column, row], along)));
        }
    }
    stretches.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1[0].total_cmp(&b.1[0])));
    stretches
}

/// The stretches of one tile, joined where they touch.
fn merged(stretches: &[Stretch]) -> Vec<[f64; 2]> {
    let mut merged: Vec<[f64; 2]> = Vec::with_capacity(4);
    for &(_, [from, to]) in stretches {
        match merged.last_mut() {
            Some(last) if from <= last[1] => last[1] = last[1].max(to),
            _ => merged.push([from, to]),
        }
    }
    merged
}

fn of_plot(grid: &Grid, source: &Source, top: f64, show: &mut dyn FnMut(&Beam)) {
    let Some([[_, _, bottom], [_, _, crown]]) = grid.bounds() else { return };
    let top = if top.is_finite() { top.max(crown) } else { crown };
    let [x, y, sine] = source.towards;
    let way = source.towards.map(|x| -x);
    // Beams are 1/sine farther apart along the level way of the light than across it.
    let level = (x * x + y * y).max(1e-18);
    let stretched = |share: f64| crate::math::pow(sine, share / level);
    let counts = [(0, x), (1, y)]
        .map(|(k, along)| (stretched(along * along) * f64::from(grid.period[k])).ceil().clamp(1.0, 1e6) as i64);
    // In voxels.
    let apart = [0, 1].map(|k| f64::from(grid.period[k]) / counts[k] as f64);
    let section = apart[0] * grid.edges[0] * apart[1] * grid.edges[1] * sine;
    let stretches = [[0.0, (top - bottom) / sine]];
    let height = grid.spot([grid.origin[0], grid.origin[1], top]);
    let anchor = Spot { voxel: [grid.anchor[0], grid.anchor[1], height.voxel[2]], inner: [0.0, 0.0, height.inner[2]] };
    for row in 0..counts[1] {
        for column in 0..counts[0] {
            let beside = [(column as f64 + shift_of(row)) * apart[0], (row as f64 + 0.5) * apart[1]];
            let mut from = anchor;
            for (k, beside) in beside.into_iter().enumerate() {
                // Whole voxels go to the voxel alone, so that beams lie about the anchor alike wherever it is.
                from.voxel[k] += beside.floor() as i32;
                from.inner[k] = beside - beside.floor();
            }
            show(&Beam { from, way, section, stretches: &stretches });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::site::light::{Borders, Lighting, Piece, Sky};

    /// The beams of each direction that pass a lone brick carry the area that it turns to them, and they miss nothing
    /// of it.
    #[test]
    fn beams_cover_what_they_may_meet() {
        let mut grid = Grid::of(&Lighting::default());
        grid.add(&Piece { place: [3.01, -2.0, 1.0], normal: [0.0, 0.0, 1.0], area: 1.0 });
        let [low, high] = grid.bounds().expect("a brick");
        let bounds = crate::shape::Bounds { low, high };
        for source in (Sky { rings: 4, azimuths: 7, ..Sky::default() }).sources() {
            let mut area = 0.0;
            each_beam(&grid, &source, 0.0, &mut |beam| {
                let from = beam.place(&grid, 0.0);
                let met = crate::site::light::shadow::passage(&bounds, from, beam.way, f64::INFINITY);
                let back = crate::site::light::shadow::passage(&bounds, from, source.towards, f64::INFINITY);
                if met.is_some() || back.is_some() {
                    area += beam.section;
                    let holds = |t: f64, [from, to]: &[f64; 2]| from - 1e-3 <= t && t <= to + 1e-3;
                    let reaches = |t: f64| beam.stretches.iter().any(|stretch| holds(t, stretch));
                    let ends = met.map(|(_, leaves)| leaves).or(back.map(|(_, leaves)| -leaves));
                    assert!(ends.is_some_and(reaches), "{beam:?}");
                }
            });
            let faces = source.towards.iter().map(|share| share.abs() * 0.64).sum::<f64>();
            assert!((area / faces - 1.0).abs() < 0.08, "{source:?}: {area} {faces}");
        }
    }

    #[test]
    fn beams_of_a_plot_that_repeats_carry_its_ground() {
        let lighting = Lighting { borders: Borders::Periodic([2.0, 3.0]), ..Lighting::default() };
        let mut grid = Grid::of(&lighting);
        grid.add(&Piece { place: [1.0; 3], normal: [0.0, 0.0, 1.0], area: 1.0 });
        let mut counts = Vec::new();
        for source in (Sky { rings: 5, azimuths: 6, ..Sky::default() }).sources() {
            let (mut area, mut count) = (0.0, 0);
            each_beam(&grid, &source, 0.0, &mut |beam| {
                area += beam.section / source.towards[2];
                count += 1;
            });
            assert!((area - 6.0).abs() < 1e-9, "{area}");
            counts.push(count);
        }
        assert!(counts[0] < counts[29] / 4, "fewer, the lower they come: {counts:?}");
    }
}
