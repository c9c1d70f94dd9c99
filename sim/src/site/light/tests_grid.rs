//! Voxels of a grid: no order shows, places are taken back into a plot that repeats, and bricks are found.

use super::grid::{Grid, NONE, UNITS};
use super::{Borders, Lighting, Piece, Projection};
use crate::shape::Point;

fn piece(place: Point, area: f64) -> Piece {
    Piece { place, normal: [0.0, 0.6, 0.8], area }
}

#[test]
fn no_order_of_leaves_shows() {
    let lighting = Lighting { projection: Projection::OfLeaves, ..Lighting::default() };
    let pieces: Vec<Piece> = (0..3_000_u32)
        .map(|k| {
            let at = |prime: u32| f64::from(k.wrapping_mul(prime) % 1_009) * 0.013 - 6.0;
            Piece { normal: [at(3), at(5), 1.0], ..piece([at(7), at(11), at(13)], f64::from(k) * 1e-6) }
        })
        .collect();
    let mut all = Grid::of(&lighting);
    pieces.iter().for_each(|piece| all.add(piece));
    let mut parts = [Grid::of(&lighting), Grid::of(&lighting)];
    pieces.iter().rev().enumerate().for_each(|(k, piece)| parts[k % 2].add(piece));
    let mut joined = Grid::of(&lighting);
    parts.iter().for_each(|part| joined.join(part));
    all.sort();
    joined.sort();
    assert_eq!(all, joined);
    let area: f64 = pieces.iter().map(|piece| piece.area).sum();
    assert!((all.leaf_area() - area).abs() < 3_000.0 / UNITS, "{area}");
    let by_normal: u64 = all.by_normal.iter().sum();
    assert_eq!(by_normal, all.area.iter().sum::<u64>());
    for (brick, place) in all.bricks.iter().enumerate() {
        assert_eq!(all.brick(*place), brick as u32);
    }
    assert_eq!(all.brick([900, 0, 0]), NONE);
}

#[test]
fn a_voxel_that_is_full_says_so() {
    let mut grid = Grid::of(&Lighting::default());
    grid.add(&piece([0.05; 3], 4e9));
    assert!(!grid.saturated);
    grid.add(&piece([0.05; 3], 1e9));
    assert!(grid.saturated && grid.area.contains(&u64::MAX));
    for area in [f64::NAN, -1.0, 0.0] {
        grid.add(&piece([f64::NAN, f64::INFINITY, -1e300], area));
    }
    grid.add(&piece([f64::NAN, f64::INFINITY, -1e300], 1.0));
    assert_eq!(grid.bricks.len(), 2, "a place beyond all places is the farthest");
}

#[test]
fn a_plot_that_repeats_takes_places_back() {
    let lighting = Lighting { borders: Borders::Periodic([1.04, 2.0]), ..Lighting::default() };
    let grid = Grid::of(&lighting);
    assert_eq!(grid.period, [10, 20]);
    assert!((grid.edges[0] - 0.104).abs() < 1e-15);
    let within = |place| grid.within(grid.voxel(place));
    assert_eq!(within([0.05, 0.05, 0.05]), within([0.05 - 3.0 * 1.04, 0.05 + 4.0, 0.05]));
    assert_eq!(within([-0.01, 2.01, -0.01]), [9, 0, -1]);
}
