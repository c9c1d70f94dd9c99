//! A solid with more triangles: each becomes a curved patch through its corners, perpendicular to their normals.
//!
//! Curved point-normal triangles (Vlachos et al. 2001, *Curved PN triangles*): a cubic patch whose edges depend on the
//! two corners of the edge alone, so that what was closed stays closed. An edge is computed in one order of its
//! corners, whichever triangle asks. Absent: plane polygons, whose corners share a normal, which stay plane.

use super::super::{FormMesh, Point, unit};
use super::build::{Vector, dot, minus, sum};

/// The same form, each triangle in n² of them.
pub fn rounder(form: &FormMesh, parts: u32) -> FormMesh {
    let mut fine = FormMesh { in_parts: form.in_parts, ..FormMesh::new(form.depth) };
    for face in &form.faces {
        let first = fine.points.len() as u32;
        let corners = face.map(|corner| form.points[corner as usize]);
        let place = |row: u32, column: u32| first + row * (row + 1) / 2 + column;
        for row in 0..=parts {
            fine.points.extend((0..=row).map(|column| at(&corners, [parts - row, row - column, column], parts)));
        }
        for row in 0..parts {
            for column in 0..=row {
                fine.faces.push([place(row, column), place(row + 1, column), place(row + 1, column + 1)]);
                if column < row {
                    fine.faces.push([place(row, column), place(row + 1, column + 1), place(row, column + 1)]);
                }
            }
        }
    }
    fine.measured()
}

/// A point of a patch, by the shares of its corners, in parts.
fn at(corners: &[Point; 3], shares: [u32; 3], parts: u32) -> Point {
    let by = shares.map(|share| share as f32 / parts as f32);
    let mix = |of: fn(&Point) -> Vector| sum(&[0, 1, 2].map(|k| (by[k], of(&corners[k]))));
    let texture = [0, 1].map(|i| (0..3).map(|k| by[k] * corners[k].texture[i]).sum());
    let place = match shares.iter().position(|share| *share == 0) {
        Some(k) => {
            on_edge(&corners[(k + 1) % 3], &corners[(k + 2) % 3], [shares[(k + 1) % 3], shares[(k + 2) % 3]], parts)
        }
        None => inside(corners, by),
    };
    let normal = mix(|point| point.normal);
    let normal = if dot(normal, normal) > 1e-12 { unit(normal) } else { corners[0].normal };
    Point { at: place, across: mix(|point| point.across), normal, texture, ..corners[0] }
}

/// A point of an edge, the same whichever of its corners comes first.
fn on_edge(a: &Point, b: &Point, [of_a, of_b]: [u32; 2], parts: u32) -> Vector {
    let order = |point: &Point| [point.at, point.normal].map(|v| v.map(|x| (x + 0.0).to_bits()));
    let (a, b, share) = if order(a) <= order(b) { (a, b, of_b) } else { (b, a, of_a) };
    if share == 0 || share == parts {
        return if share == 0 { a.at } else { b.at };
    }
    let (u, w) = (share as f32 / parts as f32, 1.0 - share as f32 / parts as f32);
    sum(&[(w * w * w, a.at), (3.0 * w * w * u, control(a, b)), (3.0 * w * u * u, control(b, a)), (u * u * u, b.at)])
}

/// The control point of an edge near one of its corners: in the plane of that corner.
fn control(near: &Point, far: &Point) -> Vector {
    let over = dot(minus(far.at, near.at), near.normal);
    sum(&[(2.0 / 3.0, near.at), (1.0 / 3.0, far.at), (-over / 3.0, near.normal)])
}

/// A point within a patch.
fn inside(corners: &[Point; 3], [u, v, w]: [f32; 3]) -> Vector {
    let [a, b, c] = corners;
    let edges = [control(a, b), control(b, a), control(b, c), control(c, b), control(c, a), control(a, c)];
    let mean = sum(&edges.map(|edge| (1.0 / 6.0, edge)));
    let flat = sum(&corners.map(|corner| (1.0 / 3.0, corner.at)));
    let middle = sum(&[(1.5, mean), (-0.5, flat)]);
    let [ab, ba, bc, cb, ca, ac] = edges;
    sum(&[
        (u * u * u, a.at),
        (v * v * v, b.at),
        (w * w * w, c.at),
        (3.0 * u * u * v, ab),
        (3.0 * u * v * v, ba),
        (3.0 * v * v * w, bc),
        (3.0 * v * w * w, cb),
        (3.0 * w * w * u, ca),
        (3.0 * w * u * u, ac),
        (6.0 * u * v * w, middle),
    ])
}
