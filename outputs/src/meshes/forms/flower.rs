//! An open flower: a narrow tube and five petals that spread from its mouth, each one plane kite.
//!
//! De Reffye 1988 §6 makes petals of convex polygons. Absent: inflorescences, which stand as one flower.

use super::round::revolve;
use super::{Depth, Shape};
use phytomer_sim::math::sincosf;
use std::f32::consts::TAU;

const PETALS: u8 = 5;
/// Where the petals leave the tube, along the flower and across.
const MOUTH: [f32; 2] = [0.5, 0.05];
/// Where they end.
const RIM: [f32; 2] = [1.0, 0.5];
/// Half the width of a petal where it is widest, at this share of its length.
const HALF_WIDTH: f32 = 0.19;
const WIDEST: f32 = 0.6;

/// Five petals on a tube.
pub fn corolla() -> Shape {
    let mut shape = Shape::new(Depth::Width);
    revolve(&mut shape, &[[0.0, 0.03], MOUTH], 5, true);
    for petal in 0..PETALS {
        let (sin, cos) = sincosf(TAU * f32::from(petal) / f32::from(PETALS));
        let at = |[x, r]: [f32; 2], aside: f32| [x, r * cos - aside * sin, r * sin + aside * cos];
        let middle = [0, 1].map(|k| MOUTH[k] + WIDEST * (RIM[k] - MOUTH[k]));
        let kite = [at(MOUTH, 0.0), at(middle, -HALF_WIDTH), at(RIM, 0.0), at(middle, HALF_WIDTH)];
        shape.polygon(&kite, |[_, y, z]| [0.5 + y, 0.5 + z], false);
    }
    shape
}
