//! Fruits as closed solids with few sides; some hang on a stalk or sit in a cup, with the colour of the stalk.
//!
//! The length of a fruit includes its stalk. Absent: seeds, and bunches, which species files grow or draw as one form.

use super::round::{revolve, swept};
use super::{Depth, FormMesh, unit};
use phytomer_sim::math::sincosf;
use std::f32::consts::PI;

const SIDES: u16 = 6;

/// A ball of six meridians and four zones.
pub fn berry() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    ball(&mut shape, 0.0);
    shape
}

/// A ball at the end of a stalk, which is 0.55 of the length.
pub fn cherry() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    stalk(&mut shape, 0.57, 0.03);
    ball(&mut shape, 0.55);
    shape
}

/// A ball hollowed at both ends, on a short stalk.
pub fn apple() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    stalk(&mut shape, 0.26, 0.03);
    let flank =
        [[0.24, 0.0], [0.15, 0.2], [0.24, 0.42], [0.5, 0.5], [0.78, 0.42], [0.98, 0.24], [1.0, 0.14], [0.94, 0.0]];
    revolve(&mut shape, &flank, SIDES, false);
    shape
}

/// An egg that ends in a beak: a boll.
pub fn capsule() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    stalk(&mut shape, 0.2, 0.05);
    revolve(&mut shape, &[[0.18, 0.0], [0.2, 0.3], [0.42, 0.5], [0.68, 0.42], [0.9, 0.14], [1.0, 0.0]], 5, false);
    shape
}

/// A nut in its cup.
pub fn nut() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    revolve(&mut shape, &[[0.0, 0.0], [0.06, 0.34], [0.22, 0.48], [0.34, 0.5], [0.38, 0.4], [0.3, 0.0]], SIDES, true);
    revolve(&mut shape, &[[0.22, 0.0], [0.32, 0.43], [0.62, 0.42], [0.9, 0.2], [1.0, 0.0]], SIDES, false);
    shape
}

/// Longer than broad, blunt at both ends: a date.
pub fn drupe() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    revolve(&mut shape, &[[0.0, 0.0], [0.07, 0.3], [0.3, 0.5], [0.66, 0.48], [0.92, 0.28], [1.0, 0.0]], SIDES, false);
    shape
}

/// A finger of five sides, bent upward by a fifth of its width: a banana.
pub fn finger() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    let rings = [
        [0.0, 0.0],
        [0.02, 0.14],
        [0.1, 0.2],
        [0.2, 0.36],
        [0.34, 0.48],
        [0.6, 0.49],
        [0.82, 0.38],
        [0.95, 0.18],
        [1.0, 0.0],
    ];
    let bent = rings.map(|[x, r]: [f32; 2]| [x, 1.1 * x * (x - 0.9), r]);
    swept(&mut shape, &bent, 5, false);
    shape
}

/// A flat pod: a quarter as thick as broad.
pub fn pod() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    revolve(&mut shape, &[[0.0, 0.0], [0.12, 0.3], [0.3, 0.5], [0.75, 0.46], [1.0, 0.0]], SIDES, false);
    for point in &mut shape.points {
        let [x, y, z] = point.normal;
        point.at[2] *= 0.25;
        point.normal = unit([x, y, z / 0.25]);
    }
    shape
}

/// A ball from a share of the length to the tip.
fn ball(shape: &mut FormMesh, from: f32) {
    let meridian: Vec<[f32; 2]> = (0..=4_u8)
        .map(|k| {
            let (sin, cos) = sincosf(PI * f32::from(k) / 4.0);
            [from + (1.0 - from) * (0.5 - 0.5 * cos), if k % 4 == 0 { 0.0 } else { 0.5 * sin }]
        })
        .collect();
    revolve(shape, &meridian, SIDES, false);
}

/// A closed stalk of three sides from the base to `end`.
fn stalk(shape: &mut FormMesh, end: f32, radius: f32) {
    revolve(shape, &[[0.0, 0.0], [0.01, radius], [end - 0.01, radius], [end, 0.0]], 3, true);
}
