//! Opaque shapes: the sky beside a long wall, and a roof.
//!
//! A wall's height away from the foot of a long wall, level ground sees (1 + cos 45°) / 2 of the light of a uniform sky
//! (the view factor of two perpendicular planes; Howell 2010, *A Catalog of Radiation Heat Transfer Configuration
//! Factors*, B-2).

use super::grid::Grid;
use super::{Borders, Field, Lighting, Lit, Piece, Sky, SkyKind, Source};
use crate::shape::{Cuboid, Shape};
use std::sync::Arc;

fn slab(low: [f64; 3], high: [f64; 3]) -> Arc<Shape> {
    Arc::new(Shape::Cuboid(Cuboid { low, high }))
}

fn beside_a_wall(rings: u32, azimuths: u32) -> f64 {
    let wall = slab([0.0, -5_000.0, -1.0], [0.5, 5_000.0, 3.0]);
    let lighting = Lighting { opaque: vec![wall], ..Lighting::default() };
    let sky = Sky { kind: SkyKind::Uniform, rings, azimuths };
    let field = Field::in_grid(&lighting, Grid::of(&lighting), &sky.sources());
    field.share_at([-3.0, 0.7, 0.0])
}

#[test]
fn beside_a_long_wall_the_sky_is_that_of_its_view_factor() {
    let known = (1.0 + std::f64::consts::FRAC_1_SQRT_2) / 2.0;
    assert!((known - 0.853_553).abs() < 1e-6);
    let [few, many] = [(5, 8), (32, 128)].map(|(rings, azimuths)| beside_a_wall(rings, azimuths));
    assert!((few / known - 1.0).abs() < 0.04, "{few}");
    assert!((many / known - 1.0).abs() < 0.005, "{many}");
}

/// Leaves under a roof keep nothing of a vertical beam; what passes beside it they keep as ever. The edge of the shadow
/// is that of the roof, though it goes through the middle of voxels.
#[test]
fn a_shadow_ends_where_its_shape_does() {
    let roof = slab([0.0, 0.0, 2.0], [1.03, 2.0, 2.1]);
    for borders in [Borders::Open, Borders::Periodic([2.0, 2.0])] {
        let lighting = Lighting { opaque: vec![Arc::clone(&roof)], borders, ..Lighting::default() };
        let mut grid = Grid::of(&lighting);
        for voxel in 0..400 {
            let at = |k: i32| (f64::from(k) + 0.5) * 0.1;
            grid.add(&Piece { place: [at(voxel % 20), at(voxel / 20), 0.05], normal: [1.0, 0.0, 0.0], area: 0.02 });
        }
        let source = Source { towards: [0.0, 0.0, 1.0], weight: 1.0 };
        let field = Field::in_grid(&lighting, grid, &[source]);
        let balance = field.balance();
        // κ = ½ · .02 / .001 over 0.1 m: a depth of 1.
        let open = 2.0 * 0.97 * (1.0 - crate::math::exp(-1.0));
        assert!((balance.kept / open - 1.0).abs() < 0.05, "{balance:?} {open}");
        assert!((balance.sent - balance.kept - balance.stopped - balance.passed).abs() < 1e-9 * balance.sent);
        let shares = [0.5, 1.5].map(|x| field.share_at([x, 1.0, 0.05]));
        assert!(shares[0] == 0.0 && (shares[1] - 0.632).abs() < 0.001, "{shares:?}");
        let rays = [1.02, 1.04].map(|x| field.share_by_rays([x, 1.0, 0.2]));
        assert_eq!(rays, [0.0, 1.0], "{borders:?}");
    }
}
