//! Ulam's patterns: published numbers of cells, places on the grid, symmetry, and the contract.
//!
//! Sources: the numbers of cells in triangles are A161644 of the Online Encyclopedia of Integer Sequences, those in
//! squares A147562 (Ulam & Warburton). Absent: the grids by themselves (`grid`).

use super::{Grid, Plane, Ulam, UlamModel};
use crate::contract;
use crate::fault::Path;
use phytomer_sim::Grow;
use phytomer_sim::plant::{NodeId, Plant};
use phytomer_sim::pose::{node_frame, pose};

fn ulam(grid: Grid) -> Ulam {
    Ulam { grid, plane: Plane::Upright, cell_m: 0.5.into(), stem_m: Some(3.0.into()), diameter_mm: 10.0.into() }
}

fn compiled(ulam: &Ulam) -> UlamModel {
    ulam.compile(100, &Path::root()).expect("sound parameters")
}

fn grown(grid: Grid, age: u32) -> Plant {
    let mut plant = contract::grown(&compiled(&ulam(grid)), age, &contract::seed_of(1, 0));
    pose(&mut plant, age);
    plant
}

#[test]
fn cells_are_as_many_as_published() {
    let numbers = |grid: Grid, last: u32| (1..=last).map(|age| grown(grid, age).nodes.len()).collect::<Vec<_>>();
    let triangles = [1, 4, 10, 16, 22, 34, 52, 64, 70, 82, 106, 136];
    assert_eq!(numbers(Grid::Triangles, 12), triangles);
    let squares = [1, 5, 9, 21, 25, 37, 49, 85, 89, 101, 113, 149];
    assert_eq!(numbers(Grid::Squares, 12), squares);
}

/// The middles of the cells, metres from the middle of the first, in the plane of the grid.
fn middles(plant: &Plant) -> Vec<[f64; 2]> {
    let tip = |node: u32| node_frame(plant, NodeId(node)).base.map(f64::from);
    (0..plant.nodes.len() as u32).map(|node| [tip(node)[0], tip(node)[2] - 3.0]).collect()
}

/// A pattern is symmetric about the upward axis and under turns by a third, or a quarter, of a full turn, no cell is
/// coloured twice, and every middle lies on the grid.
#[test]
fn patterns_have_the_symmetry_of_their_grid() {
    for (grid, parts) in [(Grid::Triangles, 3_u32), (Grid::Squares, 4)] {
        let plant = grown(grid, 12);
        let cells = middles(&plant);
        let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs() < 1e-4 && (a[1] - b[1]).abs() < 1e-4;
        let coloured = |at: [f64; 2]| cells.iter().filter(|cell| near(**cell, at)).count();
        let (sin, cos) = phytomer_sim::math::sincos(std::f64::consts::TAU / f64::from(parts));
        for &[x, z] in &cells {
            assert_eq!(coloured([x, z]), 1, "{grid:?}: [{x}, {z}]");
            assert_eq!(coloured([-x, z]), 1, "{grid:?}: [{x}, {z}]");
            assert_eq!(coloured([cos * x - sin * z, sin * x + cos * z]), 1, "{grid:?}: [{x}, {z}]");
            let rows = if grid == Grid::Squares { 0.5 } else { 0.25 / 3.0_f64.sqrt() };
            let (across, up) = (x / 0.25, z / rows);
            assert!((across - across.round()).abs() < 1e-3 && (up - up.round()).abs() < 1e-3, "{grid:?}: [{x}, {z}]");
        }
        let level = Ulam { plane: Plane::Level, ..ulam(grid) };
        let mut level = contract::grown(&compiled(&level), 12, &contract::seed_of(1, 0));
        pose(&mut level, 12);
        let heights = (0..level.nodes.len() as u32).map(|node| node_frame(&level, NodeId(node)).base[2]);
        assert!(heights.into_iter().all(|z| (z - 3.0).abs() < 1e-5));
    }
}

/// Axes go straight: in squares each has one heading, in triangles it turns to and fro by 60°.
#[test]
fn axes_go_straight_on() {
    for (grid, directions) in [(Grid::Triangles, 2), (Grid::Squares, 1)] {
        let plant = grown(grid, 20);
        let mut longest = 0;
        for axis in 1..plant.axes.len() {
            let own = (0..plant.nodes.len()).filter(|node| plant.nodes.axis[*node].index() == axis);
            let headings: std::collections::BTreeSet<[i32; 3]> =
                own.map(|node| plant.frames.heading[node].map(|x| (x * 1000.0).round() as i32)).collect();
            assert!(headings.len() <= directions, "{grid:?}, axis {axis}: {headings:?}");
            let last = plant.axes.last_node[axis].index();
            longest = longest.max(plant.nodes.rank[last]);
        }
        assert!(longest > 5, "{longest}");
    }
}

#[test]
fn patterns_keep_the_contract_of_growth_models() {
    contract::check(&compiled(&ulam(Grid::Triangles)), 9, 3);
    contract::check(&compiled(&Ulam { stem_m: None, plane: Plane::Level, ..ulam(Grid::Squares) }), 8, 3);
}

#[test]
fn the_forecast_counts_every_cell() {
    let model = compiled(&ulam(Grid::Squares));
    let foretold = model.expectation(12).expect("a forecast");
    for age in 0..=12 {
        let plant = contract::grown(&model, age.max(1), &contract::seed_of(1, 0));
        let expected = if age == 0 { 1.0 } else { f64::from(plant.components()) };
        assert_eq!(foretold.components(age), expected, "age {age}");
    }
    assert!(model.expectation(60_000).is_none(), "billions of cells are not grown to be foretold");
}

#[test]
fn an_earlier_age_is_grown_anew() {
    let model = compiled(&ulam(Grid::Triangles));
    let mut plot = contract::sown(&model, &contract::seed_of(1, 0));
    assert_eq!(plot.grow_to(9), Ok(()));
    assert_eq!(plot.grow_to(4), Ok(()));
    assert_eq!(plot.plants[0].nodes.len(), 16);
}

#[test]
fn what_has_no_size_is_told() {
    let wrong =
        Ulam { cell_m: 0.0.into(), diameter_mm: (-1.0).into(), stem_m: Some(f64::NAN.into()), ..ulam(Grid::Squares) };
    let faults = wrong.compile(70_000, &Path::root()).err().unwrap_or_default();
    let told: Vec<String> = faults.iter().map(|fault| fault.path.to_string()).collect();
    assert_eq!(told, ["", "cell_m", "stem_m", "diameter_mm"]);
}
