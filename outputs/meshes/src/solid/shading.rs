//! Normals for the triangles of a solid: flat faces stay flat, round ones are shaded round.
//!
//! At a corner of a triangle the normal is the mean, weighted by area, of the triangles about the point that lean from
//! it by less than 40°. A point is a vertex for each of its normals. Absent: textures.

use super::Solid;
use crate::Mesh;
use crate::chunk::{Face, Tag, Vertex};
use phytomer_sim::shape::Point;

/// The cosine of the angle from which an edge is sharp: 40°.
const SHARP: f64 = 0.766;

pub(super) fn shaded(solid: &Solid, tag: &Tag) -> Mesh {
    let across: Vec<Point> =
        solid.faces.iter().map(|face| across(face.map(|corner| solid.points[corner as usize]))).collect();
    let about = triangles_about(solid);
    let mut mesh = Mesh::default();
    // For each point its vertices: the normal and the number of each.
    let mut known: Vec<Vec<([f32; 3], u32)>> = vec![Vec::new(); solid.points.len()];
    for (number, face) in solid.faces.iter().enumerate() {
        let own = across[number];
        let corners = face.map(|corner| {
            let near =
                about[corner as usize].iter().map(|other| across[*other as usize]).filter(|other| smooth(own, *other));
            let sum = near.fold([0.0; 3], |sum: Point, other| [0, 1, 2].map(|k| sum[k] + other[k]));
            let normal = unit(sum);
            let vertices = &mut known[corner as usize];
            if let Some((_, vertex)) = vertices.iter().find(|(known, _)| *known == normal) {
                return *vertex;
            }
            let vertex = mesh.vertices.len() as u32;
            let at = solid.points[corner as usize].map(|x| x as f32);
            mesh.vertices.push(Vertex::new(at, normal, [0.0; 2], tag));
            vertices.push((normal, vertex));
            vertex
        });
        mesh.faces.push(Face::new(corners));
    }
    mesh
}

fn triangles_about(solid: &Solid) -> Vec<Vec<u32>> {
    let mut about = vec![Vec::new(); solid.points.len()];
    for (number, face) in solid.faces.iter().enumerate() {
        face.iter().for_each(|corner| about[*corner as usize].push(number as u32));
    }
    about
}

/// Whether two faces are shaded as one; a face is always one with itself.
fn smooth(one: Point, other: Point) -> bool {
    one == other || dot(one, other) >= SHARP * (dot(one, one) * dot(other, other)).sqrt()
}

fn unit(of: Point) -> [f32; 3] {
    let size = dot(of, of).sqrt();
    if size > 0.0 { of.map(|x| (x / size) as f32) } else { [0.0, 0.0, 1.0] }
}

fn across([a, b, c]: [Point; 3]) -> Point {
    let (u, v) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
