//! Measures of a mesh, for tests: closedness, area, signed volume, normals.
//!
//! They read vertices and triangles as a file has them, without the plant. Absent: the bounds, which each test states.

use super::chunk::{Face, Vertex};
use std::collections::BTreeMap;

fn corners(vertices: &[Vertex], face: &Face) -> [[f64; 3]; 3] {
    face.indices().map(|index| vertices[index as usize].position().map(f64::from))
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Twice the area of a triangle, as a vector along its normal.
fn area_vector(vertices: &[Vertex], face: &Face) -> [f64; 3] {
    let [a, b, c] = corners(vertices, face);
    cross(minus(b, a), minus(c, a))
}

/// The volume that the triangles enclose, positive where they face outward.
pub fn volume(vertices: &[Vertex], faces: &[Face]) -> f64 {
    let cone = |face| {
        let [a, b, c] = corners(vertices, face);
        dot(a, cross(b, c)) / 6.0
    };
    faces.iter().map(cone).sum()
}

/// The area of all triangles.
pub fn surface(vertices: &[Vertex], faces: &[Face]) -> f64 {
    let area = |face| {
        let across = area_vector(vertices, face);
        0.5 * dot(across, across).sqrt()
    };
    faces.iter().map(area).sum()
}

/// Asserts that each edge between two positions belongs to exactly one triangle in each direction.
pub fn assert_closed(vertices: &[Vertex], faces: &[Face]) {
    let mut edges: BTreeMap<[[u32; 3]; 2], i32> = BTreeMap::new();
    for face in faces {
        let at = face.indices().map(|index| vertices[index as usize].position().map(f32::to_bits));
        for k in 0..3 {
            *edges.entry([at[k], at[(k + 1) % 3]]).or_default() += 1;
        }
    }
    for (&[from, to], &count) in &edges {
        assert_eq!((count, edges.get(&[to, from])), (1, Some(&1)));
    }
}

pub fn assert_unit_normals(vertices: &[Vertex]) {
    for vertex in vertices {
        let normal = vertex.normal().map(f64::from);
        assert!((dot(normal, normal) - 1.0).abs() < 1e-5, "{normal:?}");
    }
}

/// The share of the triangles whose vertex normals all point to the triangle's outer side.
pub fn outward_share(vertices: &[Vertex], faces: &[Face]) -> f64 {
    let agrees = |face: &&Face| {
        let across = area_vector(vertices, face);
        face.indices().iter().all(|&index| dot(across, vertices[index as usize].normal().map(f64::from)) > 0.0)
    };
    faces.iter().filter(agrees).count() as f64 / faces.len() as f64
}
