//! Closed meshes against the forms that they were made of, and what is refused as no closed mesh.
//!
//! Absent: what holds for every shape (`tests`).

use super::*;
use crate::math::sincos;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

const CORNERS: [Point; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [1.0, 1.0, 1.0],
];

/// The sides of a cube, each of two triangles, facing outward.
const SIDES: [[u32; 3]; 12] = [
    [0, 2, 1],
    [1, 2, 3],
    [4, 5, 6],
    [5, 7, 6],
    [0, 1, 4],
    [1, 5, 4],
    [2, 6, 3],
    [3, 6, 7],
    [0, 4, 2],
    [2, 4, 6],
    [1, 3, 5],
    [3, 7, 5],
];

/// A cube of 1 m.
pub(super) fn cube() -> Mesh {
    Mesh::of(&CORNERS, &SIDES).expect("a cube is closed")
}

/// A level torus about the origin, of `n` by `n` squares that are cut in two.
fn ring(ring: f64, tube: f64, n: u32) -> Mesh {
    let at = |k: u32, count: u32| sincos(TAU * f64::from(k % count) / f64::from(count));
    let point = |k: u32| {
        let ((around_sin, around_cos), (sin, cos)) = (at(k / n, n), at(k % n, n));
        [(ring + tube * cos) * around_cos, (ring + tube * cos) * around_sin, tube * sin]
    };
    let points: Vec<Point> = (0..n * n).map(point).collect();
    let corner = |i: u32, j: u32| (i % n) * n + j % n;
    let square = |k: u32| {
        let (i, j) = (k / n, k % n);
        let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    let faces: Vec<[u32; 3]> = (0..n * n).flat_map(square).collect();
    Mesh::of(&points, &faces).expect("a torus is closed")
}

fn points(number: usize, size: f64) -> impl Iterator<Item = Point> {
    let mut random = ChaCha8Rng::seed_from_u64(9);
    (0..number).map(move |_| [0, 1, 2].map(|_| size * (2.0 * random.random::<f64>() - 1.0)))
}

#[test]
fn a_cube_is_the_box() {
    let (mesh, cuboid) = (cube(), Cuboid::on([0.5, 0.5, 0.0], [1.0; 3]));
    let mut inside = 0;
    for point in points(5000, 1.5) {
        assert_eq!(mesh.inside(point), cuboid.inside(point), "{point:?}");
        assert!((mesh.distance(point) - cuboid.distance(point)).abs() < 1e-12, "{point:?}");
        inside += u32::from(mesh.inside(point));
    }
    assert!(inside > 100, "{inside}");
    // Straight above edges and corners, where rays would slip through.
    for (x, y) in [(0.5, 0.5), (0.25, 0.25), (0.75, 0.75), (0.5, 0.0), (0.0, 0.0), (1.0, 1.0)] {
        assert!(!mesh.inside([x, y, 1.5]) && !mesh.inside([x, y, -0.5]));
        assert!(mesh.inside([0.01 + 0.98 * x, 0.01 + 0.98 * y, 0.5]));
    }
}

/// A mesh of chords lies within r (1 − cos(π / n)) of the torus, in each of the two circles.
#[test]
fn a_fine_mesh_is_the_form_that_it_was_made_of() {
    let n = 60;
    let (mesh, torus) = (ring(1.0, 0.4, n), Torus { centre: [0.0; 3], ring: 1.0, tube: 0.4 });
    let chord = (1.4 + 0.4) * (1.0 - crate::math::cos(TAU / 2.0 / f64::from(n)));
    let (mut inside, mut left_out) = (0, 0);
    for point in points(4000, 1.5) {
        let distance = torus.distance(point);
        assert!((mesh.distance(point) - distance).abs() <= chord, "{point:?}");
        if distance.abs() <= chord {
            left_out += 1;
            continue;
        }
        assert_eq!(mesh.inside(point), distance < 0.0, "{point:?}");
        inside += u32::from(distance < 0.0);
    }
    assert!(inside > 300 && left_out < 200, "{inside} inside, {left_out} left out");
}

#[test]
fn a_mesh_may_face_inward_and_repeat_its_points() {
    let inward: Vec<[u32; 3]> = SIDES.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
    let turned = Mesh::of(&CORNERS, &inward).expect("closed");
    let apart: Vec<Point> = SIDES.iter().flatten().map(|k| CORNERS[*k as usize]).collect();
    let faces: Vec<[u32; 3]> = (0..12).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    let soup = Mesh::of(&apart, &faces).expect("closed");
    for point in points(1000, 1.5) {
        let inside = cube().inside(point);
        assert_eq!([turned.inside(point), soup.inside(point)], [inside; 2], "{point:?}");
    }
}

#[test]
fn what_is_not_closed_is_refused() {
    assert_eq!(Mesh::of(&CORNERS, &[]), Err(MeshFault::Empty));
    let unknown = Mesh::of(&CORNERS, &[[0, 1, 8]]);
    assert_eq!(unknown, Err(MeshFault::NoSuchPoint { triangle: 0, point: 8, points: 8 }));
    let open = Mesh::of(&CORNERS, &SIDES[..11]);
    assert!(matches!(open, Err(MeshFault::Open { edges: 3, .. })), "{open:?}");
    let mut turned = SIDES;
    turned[0] = [0, 1, 2];
    assert!(matches!(Mesh::of(&CORNERS, &turned), Err(MeshFault::Open { edges: 3, .. })));
}
