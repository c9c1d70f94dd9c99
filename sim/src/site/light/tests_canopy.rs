//! A uniform canopy in a plot that repeats, against Beer's law and the exponential integral.
//!
//! Of a beam from the elevation β passes e^(−G L / sin β); of a uniform sky 2 E₃(G L), with L leaf area by ground area
//! (Monsi & Saeki 1953; Norman & Campbell 1989). Numbers of E₃: Abramowitz & Stegun 1964, table 5.5. Areas are whole
//! numbers of units, of which a leaf here has some million, so sums agree to 10⁻⁶.

use super::grid::Grid;
use super::{Borders, Field, Lighting, Lit, Piece, Projection, Sky, SkyKind, Source};
use crate::math::exp;

/// 2 × 2 m of ground with 1 m of canopy of this leaf area index, in voxels of 0.1 m; all leaves face one way.
fn canopy(leaf_area_index: f64, projection: Projection, normal: [f64; 3]) -> (Lighting, Grid) {
    let lighting = Lighting { borders: Borders::Periodic([2.0, 2.0]), projection, ..Lighting::default() };
    let mut grid = Grid::of(&lighting);
    for voxel in 0..4_000 {
        let at = |k: i32| (f64::from(k) + 0.5) * 0.1;
        let place = [at(voxel % 20), at(voxel / 20 % 20), at(voxel / 400)];
        grid.add(&Piece { place, normal, area: leaf_area_index * 4.0 / 4_000.0 });
    }
    (lighting, grid)
}

fn passed(lighting: &Lighting, grid: &Grid, sources: &[Source]) -> f64 {
    let balance = Field::in_grid(lighting, grid.clone(), sources).balance();
    assert!((balance.sent - 4.0).abs() < 1e-9, "{balance:?}");
    balance.passed / balance.sent
}

#[test]
fn a_beam_is_weakened_by_the_law_of_beer() {
    for leaf_area_index in [0.5, 1.0, 4.0] {
        let (lighting, grid) = canopy(leaf_area_index, Projection::Even(0.5), [0.0, 0.0, 1.0]);
        for degrees in [5.0_f64, 20.0, 45.0, 70.0, 90.0] {
            for azimuth in [0.0_f64, 30.0, 45.0, 200.0] {
                let ((sin, cos), (s, c)) = (sincos(degrees), sincos(azimuth));
                let source = Source { towards: [cos * c, cos * s, sin], weight: 1.0 };
                let (passed, known) = (passed(&lighting, &grid, &[source]), exp(-0.5 * leaf_area_index / sin));
                assert!((passed - known).abs() < 1e-6, "{leaf_area_index}, {degrees}°: {passed} {known}");
            }
        }
    }
}

fn sincos(degrees: f64) -> (f64, f64) {
    crate::math::sincos(degrees.to_radians())
}

/// Five rings are enough for a thousandth.
#[test]
fn of_a_uniform_sky_passes_twice_the_third_exponential_integral() {
    for (index, known) in [(1.0, 0.443_209), (4.0, 0.060_267)] {
        let (lighting, grid) = canopy(index, Projection::Even(0.5), [0.0, 0.0, 1.0]);
        let sky = Sky { kind: SkyKind::Uniform, rings: 5, azimuths: 8 };
        let passed = passed(&lighting, &grid, &sky.sources());
        assert!((passed - known).abs() < 1e-3, "{index}: {passed}");
        let finer = Field::in_grid(&lighting, grid, &Sky { rings: 16, ..sky }.sources()).balance();
        assert!((finer.passed / finer.sent - known).abs() < 2e-5, "{index}: {finer:?}");
    }
}

/// Level leaves are met by the sine of the elevation, so that of every beam e^(−L) passes.
#[test]
fn level_leaves_let_pass_as_much_from_everywhere() {
    let (lighting, grid) = canopy(2.0, Projection::OfLeaves, [0.0, 0.0, -1.0]);
    let passed = passed(&lighting, &grid, &Sky::default().sources());
    assert!((passed - exp(-2.0)).abs() < 1e-6, "{passed}");
}

/// In the depth z of the canopy the light is that which a canopy of the leaves above lets pass.
#[test]
fn light_falls_from_layer_to_layer() {
    let (lighting, grid) = canopy(3.0, Projection::Even(0.5), [0.0, 0.0, 1.0]);
    let source = Source { towards: [0.6, 0.0, 0.8], weight: 1.0 };
    let field = Field::in_grid(&lighting, grid, &[source]);
    for layer in 0..10_i32 {
        let (above, below) = (f64::from(9 - layer) * 0.1, f64::from(10 - layer) * 0.1);
        let k = 0.5 * 3.0 / 0.8;
        let mean = (exp(-k * above) - exp(-k * below)) / (k * 0.1);
        let place = |x: f64| [x, 0.31, f64::from(layer) * 0.1 + 0.05];
        for x in [0.05, 0.95, 1.55] {
            let share = field.share_at(place(x));
            assert!((share - mean).abs() < 0.03 * mean, "layer {layer}: {share} {mean}");
            let ray = field.share_by_rays(place(x));
            assert!((ray - exp(-k * (above + 0.05))).abs() < 1e-6, "layer {layer}: {ray}");
        }
    }
    assert_eq!(field.share_at([1.0, 1.0, 1.15]), 1.0, "above the canopy");
    assert!((field.share_at([7.0, -3.0, -40.0]) - exp(-1.875)).abs() < 1e-6, "below it, at any place");
    let ground = field.share_of_ground([[0.0; 2], [2.0; 2]], 0.0, 4);
    assert!((ground - exp(-1.875)).abs() < 1e-6, "{ground}");
    // A piece keeps its share of what its voxel keeps.
    let kept: f64 = (0..4_000)
        .map(|voxel| {
            let at = |k: i32| (f64::from(k) + 0.5) * 0.1;
            let place = [at(voxel % 20), at(voxel / 20 % 20), at(voxel / 400)];
            field.kept_by(&Piece { place, normal: [1.0, 0.0, 0.0], area: 3.0 * 4.0 / 4_000.0 })
        })
        .sum();
    assert!((kept - field.balance().kept).abs() < 1e-6 * kept, "{kept} {:?}", field.balance());
}
