//! The slow and exact model of light: parallel rays, millimetres apart, against the triangles of all leaves.
//!
//! A ray ends at the first leaf. It shares nothing with the voxels but the trait: triangles are those of meshes.

use phytomer_outputs::meshes::{Mesh, MeshOptions, mesh_plant};
use phytomer_sim::plant::{Kind, Plant};
use phytomer_sim::site::light::lattice::across;
use phytomer_sim::site::light::{Balance, Canopy, LightModel, Lit, Piece, Source};
use std::collections::HashSet;

type Point = [f64; 3];

/// The leaves of a plant as triangles, and how far rays are apart, metres.
#[derive(Debug, Clone)]
pub struct Rays {
    triangles: Vec<[Point; 3]>,
    apart: f64,
}

/// The light that they let pass.
#[derive(Debug)]
struct Exact {
    rays: Rays,
    sources: Vec<Source>,
    balance: Balance,
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn minus(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The leaves of a plant as a mesh.
pub fn leaves(plant: &Plant, age: u32) -> Mesh {
    let kinds = Kind::ALL.map(Kind::is_foliage);
    mesh_plant(plant, age, &MeshOptions { kinds, ..MeshOptions::default() })
}

impl Rays {
    pub fn of(plant: &Plant, age: u32, apart: f64) -> Self {
        let mesh = leaves(plant, age);
        let place = |corner: u32| mesh.vertices[corner as usize].position().map(f64::from);
        let triangles = mesh.faces.iter().map(|face| face.indices().map(place)).collect();
        Self { triangles, apart }
    }

    /// The area across a source that the leaves cover.
    pub fn shadow(&self, source: &Source) -> f64 {
        let axes = across(source.towards);
        let flat = |point: Point| axes.map(|axis| dot(axis, point) / self.apart);
        let mut covered: HashSet<[i32; 2]> = HashSet::new();
        for triangle in &self.triangles {
            let corners = triangle.map(flat);
            let range = |k: usize| {
                let of = corners.map(|corner| corner[k]);
                let [low, high] =
                    [of.iter().copied().fold(f64::MAX, f64::min), of.iter().copied().fold(f64::MIN, f64::max)];
                (low - 0.5).ceil() as i32..=(high - 0.5).floor() as i32
            };
            for u in range(0) {
                covered.extend(
                    range(1).filter(|v| holds(corners, [f64::from(u) + 0.5, f64::from(*v) + 0.5])).map(|v| [u, v]),
                );
            }
        }
        covered.len() as f64 * self.apart * self.apart
    }

    fn is_lit(&self, from: Point, towards: Point) -> bool {
        !self.triangles.iter().any(|triangle| meets(triangle, from, towards))
    }
}

/// Whether a triangle in the plane holds a point.
fn holds(corners: [[f64; 2]; 3], [x, y]: [f64; 2]) -> bool {
    let side = |k: usize| {
        let ([ax, ay], [bx, by]) = (corners[k], corners[(k + 1) % 3]);
        (bx - ax) * (y - ay) - (by - ay) * (x - ax)
    };
    let sides = [side(0), side(1), side(2)];
    sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0)
}

/// Whether a ray meets a triangle (Möller & Trumbore 1997).
fn meets(triangle: &[Point; 3], from: Point, way: Point) -> bool {
    let (one, two) = (minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]));
    let p = cross(way, two);
    let det = dot(one, p);
    if det.abs() < 1e-18 {
        return false;
    }
    let s = minus(from, triangle[0]);
    let u = dot(s, p) / det;
    let q = cross(s, one);
    let v = dot(way, q) / det;
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && dot(two, q) / det > 1e-6
}

impl LightModel for Rays {
    fn light(&self, _: &dyn Canopy, sources: &[Source]) -> Box<dyn Lit> {
        let kept = sources.iter().map(|source| self.shadow(source) * source.weight / source.towards[2]).sum();
        let balance = Balance { sent: f64::NAN, kept, stopped: 0.0, passed: f64::NAN };
        Box::new(Exact { rays: self.clone(), sources: sources.to_vec(), balance })
    }
}

impl Lit for Exact {
    fn share_at(&self, place: Point) -> f64 {
        let lit = self.sources.iter().filter(|source| self.rays.is_lit(place, source.towards));
        lit.map(|source| source.weight).sum()
    }

    fn kept_by(&self, piece: &Piece) -> f64 {
        let lit = self.sources.iter().filter(|source| self.rays.is_lit(piece.place, source.towards));
        lit.map(|source| source.weight / source.towards[2] * dot(piece.normal, source.towards).abs() * piece.area).sum()
    }

    fn balance(&self) -> Balance {
        self.balance
    }
}
