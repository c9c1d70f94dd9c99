//! Flowers drawn whole, and the parts of a flower that are not blades.
//!
//! De Reffye 1988 §6 makes petals of convex polygons; here each is one plane polygon. Absent: inflorescences with axes
//! of their own (§5), which species files grow; catkins and spikelets are solids (`round`).

use super::round::{revolve, swept};
use super::{Depth, FormMesh};
use phytomer_sim::math::sincosf;
use std::f32::consts::TAU;

const PETALS: u8 = 5;

/// Five petals on a tube, spreading from its mouth: a coffee flower.
pub fn corolla() -> FormMesh {
    const MOUTH: [f32; 2] = [0.5, 0.05];
    const RIM: [f32; 2] = [1.0, 0.5];
    const HALF_WIDTH: f32 = 0.19;
    const WIDEST: f32 = 0.6;
    let mut shape = FormMesh::new(Depth::Width);
    revolve(&mut shape, &[[0.0, 0.03], MOUTH], 5, true);
    let middle = [0, 1].map(|k| MOUTH[k] + WIDEST * (RIM[k] - MOUTH[k]));
    let kite = [(MOUTH, 0.0), (middle, -HALF_WIDTH), (RIM, 0.0), (middle, HALF_WIDTH)];
    petals(&mut shape, &kite);
    shape
}

/// Five broad petals, nearly flat, around a tuft of stamens on a stalk: a cherry flower.
pub fn rosette() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    swept(
        &mut shape,
        &[[0.0, 0.0, 0.0], [0.02, 0.0, 0.02], [0.62, 0.0, 0.025], [0.7, 0.0, 0.08], [0.9, 0.0, 0.0]],
        5,
        true,
    );
    let at = |out: f32, aside: f32| ([0.66 + 0.3 * out, out], aside);
    let petal = [
        at(0.06, 0.0),
        at(0.2, -0.14),
        at(0.38, -0.17),
        at(0.48, -0.08),
        at(0.48, 0.08),
        at(0.38, 0.17),
        at(0.2, 0.14),
    ];
    petals(&mut shape, &petal);
    shape
}

/// A filament with its anther.
pub fn stamen() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    swept(&mut shape, &[[0.0, 0.0, 0.0], [0.02, 0.0, 0.12], [0.78, 0.12, 0.09], [0.8, 0.12, 0.0]], 4, true);
    swept(&mut shape, &[[0.74, 0.12, 0.0], [0.8, 0.12, 0.38], [0.94, 0.12, 0.34], [1.0, 0.12, 0.0]], 4, false);
    shape
}

/// An ovary with its style, and the stigma on it.
pub fn pistil() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    let ovary =
        [[0.0, 0.0, 0.0], [0.05, 0.0, 0.38], [0.22, 0.0, 0.44], [0.38, 0.0, 0.14], [0.88, 0.0, 0.1], [0.9, 0.0, 0.0]];
    swept(&mut shape, &ovary, 6, true);
    swept(
        &mut shape,
        &[[0.86, 0.0, 0.0], [0.88, 0.0, 0.2], [0.93, 0.0, 0.3], [0.98, 0.0, 0.2], [1.0, 0.0, 0.0]],
        6,
        false,
    );
    shape
}

/// Five petals around the x axis: each a plane polygon of points along x and out from the axis, and aside.
fn petals(shape: &mut FormMesh, petal: &[([f32; 2], f32)]) {
    for number in 0..PETALS {
        let (sin, cos) = sincosf(TAU * f32::from(number) / f32::from(PETALS));
        let at = |&([x, r], aside): &([f32; 2], f32)| [x, r * cos - aside * sin, r * sin + aside * cos];
        let corners: Vec<[f32; 3]> = petal.iter().map(at).collect();
        shape.polygon(&corners, |[_, y, z]| [0.5 + y, 0.5 + z], false);
    }
}
