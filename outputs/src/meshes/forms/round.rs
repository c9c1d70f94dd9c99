//! Fruits as solids of revolution with few sides: a berry, and the cone of a conifer.
//!
//! A few rings of triangles are enough at the size of a fruit (de Reffye 1988 §6 draws a few vectors). Absent: stalks.

use super::{Depth, Point, Shape, unit};
use phytomer_sim::math::sincosf;
use std::f32::consts::{PI, TAU};

const SIDES: u16 = 6;

/// A ball of six meridians and four zones.
pub fn berry() -> Shape {
    let mut shape = Shape::new(Depth::Width);
    let meridian: Vec<[f32; 2]> = (0..=4_u8)
        .map(|k| {
            let (sin, cos) = sincosf(PI * f32::from(k) / 4.0);
            [0.5 - 0.5 * cos, if k % 4 == 0 { 0.0 } else { 0.5 * sin }]
        })
        .collect();
    revolve(&mut shape, &meridian, SIDES, false);
    shape
}

/// An egg, widest near its base, with a stalk's breadth at neither end.
pub fn cone() -> Shape {
    let mut shape = Shape::new(Depth::Width);
    revolve(&mut shape, &[[0.0, 0.0], [0.1, 0.36], [0.3, 0.5], [0.7, 0.34], [1.0, 0.0]], SIDES, false);
    shape
}

/// Turns a meridian, places along x with radii, around the x axis: a ring of `sides` + 1 points at each of its places,
/// or a fan at an end without a radius. Normals are the mean of the neighbouring zones'.
pub(super) fn revolve(shape: &mut Shape, meridian: &[[f32; 2]], sides: u16, stalk: bool) {
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

/// Adds a ring and says at which number its corner 0 is. At a pole each triangle has a corner of its own, so that there
/// is one fewer: the first pole lacks the last corner, the other one corner 0.
fn ring(shape: &mut Shape, meridian: &[[f32; 2]], row: usize, sides: u16, stalk: bool) -> u32 {
    let [x, r] = meridian[row];
    let [along, across] = meridian_normal(meridian, row);
    let (first_pole, last_pole) = (r == 0.0 && row == 0, r == 0.0 && row > 0);
    let first = shape.points.len() as u32 - u32::from(last_pole);
    for k in u16::from(last_pole)..=sides - u16::from(first_pole) {
        let (sin, cos) = sincosf(TAU * f32::from(k % sides) / f32::from(sides));
        let (at, normal) = ([x, r * cos, r * sin], [along, across * cos, across * sin]);
        shape.points.push(Point { at, normal, texture: [f32::from(k) / f32::from(sides), x], stalk });
    }
    first
}

/// The normal of a meridian at one of its places, along x and outward.
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
