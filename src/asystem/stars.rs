//! The controllers of trees in a model: closed stars, each with five points in the plane of the front view, in the
//! colour of its tree.
//!
//! In pictures and drawings they have a size on the sheet (`phytomer_strokes`); in a model they have a size in space.

use super::trees::Tree;
use phytomer_asystem::Colour;
use phytomer_outputs::meshes::{Face, Mesh, Tag, Vertex};
use phytomer_sim::math::sincos;
use std::f64::consts::TAU;
use std::sync::Arc;

/// The outer radius of a star over the length of the first branch of its tree.
const LARGE: f64 = 0.15;
/// The inner radius and half the thickness over the outer radius: those of a pentagram, and of a flat body.
const NOTCH: f64 = 0.381_966;
const THICK: f64 = 0.25;
/// The kind of what is no component, as obstacles have it.
const NO_KIND: u8 = 255;

/// The stars of a tree.
pub fn stars(tree: &Tree) -> Vec<Arc<Mesh>> {
    let (radius, colour) = (LARGE * tree.first_m(), tree.ink());
    tree.controllers().into_iter().map(|(place, _)| Arc::new(star(place, radius, colour))).collect()
}

/// A star around a place: twenty triangles from its rim to a tip before it and to one behind.
fn star(at: [f64; 3], radius: f64, [red, green, blue]: Colour) -> Mesh {
    let rim = |k: u32| {
        let (sin, cos) = sincos(TAU * f64::from(k % 10) / 10.0);
        let own = if k.is_multiple_of(2) { radius } else { NOTCH * radius };
        [at[0] + own * sin, at[1], at[2] + own * cos]
    };
    let tag = Tag { colour: [red, green, blue, 255], birth: 0.0, death: f32::INFINITY, component: -1, kind: NO_KIND };
    let mut mesh = Mesh::default();
    for k in 0..10 {
        // Seen from the front, from −y, the rim turns to the right.
        for (side, ends) in [(-1.0, [k + 1, k]), (1.0, [k, k + 1])] {
            let tip = [at[0], at[1] + side * THICK * radius, at[2]];
            let corners = [rim(ends[0]), rim(ends[1]), tip];
            let normal = normal(corners);
            let first = mesh.vertices.len() as u32;
            mesh.vertices.extend(corners.map(|at| Vertex::new(at.map(|x| x as f32), normal, [0.0; 2], &tag)));
            mesh.faces.push(Face::new([first, first + 1, first + 2]));
        }
    }
    mesh
}

/// The unit normal of a triangle, counterclockwise.
fn normal([a, b, c]: [[f64; 3]; 3]) -> [f32; 3] {
    let (p, q) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
    let cross = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
    let long = cross.iter().map(|x| x * x).sum::<f64>().sqrt();
    cross.map(|x| if long > 0.0 { (x / long) as f32 } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All normals lead away from the middle, and the volume by the sum of signed tetrahedra is two thirds of the
    /// pentagram's area times its half thickness.
    #[test]
    fn a_star_is_closed_and_faces_outward() {
        let at = [3.0, -2.0, 5.0];
        let mesh = star(at, 2.0, [9, 8, 7]);
        let mut volume = 0.0;
        for face in &mesh.faces {
            let [a, b, c] = face.indices().map(|corner| {
                let place = mesh.vertices[corner as usize].position();
                [0, 1, 2].map(|k| f64::from(place[k]) - at[k])
            });
            let cross = [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
            let own = (a[0] * cross[0] + a[1] * cross[1] + a[2] * cross[2]) / 6.0;
            assert!(own > 0.0, "a triangle faces inward");
            volume += own;
        }
        let area = 5.0 * 4.0 * NOTCH * 0.587_785;
        assert!((volume - 2.0 / 3.0 * area * THICK * 2.0).abs() < 1e-4, "{volume}");
        assert!(mesh.faces.len() == 20 && mesh.vertices.iter().all(|vertex| vertex.tag().colour == [9, 8, 7, 255]));
    }
}
