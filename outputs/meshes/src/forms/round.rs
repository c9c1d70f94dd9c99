//! Solids of revolution with few sides: cones, catkins and spikelets, and the solids that fruits are made of (`fruit`).
//!
//! A few rings of triangles are enough at the size of a fruit (de Reffye 1988 §6 draws a few vectors). A solid may be
//! bent: its rings then stand on a curve. Every solid here is closed, except the tube of a corolla.

use super::{Depth, FormMesh, Point, unit};
use phytomer_sim::math::sincosf;
use std::f32::consts::TAU;

const SIDES: u16 = 6;

/// An egg, widest near its base.
pub fn cone() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    revolve(&mut shape, &[[0.0, 0.0], [0.1, 0.36], [0.3, 0.5], [0.7, 0.34], [1.0, 0.0]], SIDES, false);
    shape
}

/// A spindle with rings of scales.
pub fn catkin() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    let rings = [
        [0.0, 0.0],
        [0.05, 0.32],
        [0.16, 0.46],
        [0.22, 0.36],
        [0.36, 0.5],
        [0.42, 0.4],
        [0.56, 0.5],
        [0.62, 0.38],
        [0.76, 0.44],
        [0.82, 0.3],
        [0.92, 0.3],
        [1.0, 0.0],
    ];
    revolve(&mut shape, &rings, SIDES, false);
    shape
}

/// A spindle of four sides.
pub fn spikelet() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    revolve(&mut shape, &[[0.0, 0.0], [0.18, 0.42], [0.42, 0.5], [0.72, 0.3], [1.0, 0.0]], 4, false);
    shape
}

/// Turns a meridian (pairs of x and radius) around the x axis: a ring of `sides` + 1 points for each pair, or a fan at
/// an end with radius 0. Normals are the mean of those of the neighbouring zones.
pub(super) fn revolve(shape: &mut FormMesh, meridian: &[[f32; 2]], sides: u16, stalk: bool) {
    let rings: Vec<u32> = (0..meridian.len()).map(|row| ring(shape, meridian, row, sides, stalk)).collect();
    for (zone, ring) in meridian.windows(2).zip(rings.windows(2)) {
        for k in 0..u32::from(sides) {
            let (low, high) = (ring[0] + k, ring[1] + k);
            if zone[1][1] > 0.0 {
                shape.faces.push([low, high + 1, high]);
            }
            if zone[0][1] > 0.0 {
                shape.faces.push([low, low + 1, high + 1]);
            }
        }
    }
}

/// Adds a ring and returns the index of its corner 0. At a pole each triangle has a corner of its own, so that a pole
/// has one corner fewer: the first pole lacks the last corner, the other pole lacks corner 0.
fn ring(shape: &mut FormMesh, meridian: &[[f32; 2]], row: usize, sides: u16, stalk: bool) -> u32 {
    let [x, r] = meridian[row];
    let [along, across] = meridian_normal(meridian, row);
    let (first_pole, last_pole) = (r == 0.0 && row == 0, r == 0.0 && row > 0);
    let first = shape.points.len() as u32 - u32::from(last_pole);
    for k in u16::from(last_pole)..=sides - u16::from(first_pole) {
        let (sin, cos) = sincosf(TAU * f32::from(k % sides) / f32::from(sides));
        let (at, normal) = ([x, r * cos, r * sin], [along, across * cos, across * sin]);
        shape.points.push(Point {
            at,
            across: [0.0; 3],
            normal,
            texture: [f32::from(k) / f32::from(sides), x],
            stalk,
            tint: [0; 4],
        });
    }
    first
}

/// The normal of a meridian at a row, as its parts along x and outward.
fn meridian_normal(meridian: &[[f32; 2]], row: usize) -> [f32; 2] {
    let before = meridian[row.saturating_sub(1)];
    let after = meridian[(row + 1).min(meridian.len() - 1)];
    let at = meridian[row];
    if at[1] == 0.0 {
        return [if row == 0 { -1.0 } else { 1.0 }, 0.0];
    }
    let normal = unit([before[1] - after[1], after[0] - before[0], 0.0]);
    [normal[0], normal[1]]
}

/// Adds rings around a curve, each given by x, the height of the curve there, and the radius; x rises. Rings stay
/// across x, so that the surface leans where the curve rises.
pub(super) fn swept(shape: &mut FormMesh, rings: &[[f32; 3]], sides: u16, stalk: bool) {
    let first = shape.points.len();
    let meridian: Vec<[f32; 2]> = rings.iter().map(|&[x, _, r]| [x, r]).collect();
    revolve(shape, &meridian, sides, stalk);
    // The slope at a ring is the mean of those to its two neighbours.
    let rise = |row: usize| {
        let (before, after) = (rings[row.saturating_sub(1)], rings[(row + 1).min(rings.len() - 1)]);
        (after[1] - before[1]) / (after[0] - before[0])
    };
    for point in &mut shape.points[first..] {
        let Some(row) = rings.iter().position(|ring| ring[0] == point.at[0]) else { continue };
        let rise = rise(row);
        let [x, y, z] = point.normal;
        point.at[2] += rings[row][1];
        // A normal shears against the surface: z' = z + f(x) takes f' times its z from its x.
        point.normal = unit([x - rise * z, y, z]);
    }
}
