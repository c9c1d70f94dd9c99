//! The surfaces of shapes in triangles: houses, walls and other obstacles of a site, to be drawn with its plants.
//!
//! Boxes, what turns about an axis, sea shells and closed meshes have triangles of their own (`turned`, `swept`), whose
//! corners lie on the surface: a circle has 48 sides. All else, what is cut or runs together, is found in a grid of 72
//! cells along its longest side (`contour`). Of a union each member is drawn whole, also what lies within another. The
//! same shape gives the same triangles everywhere. Absent: half spaces, and whatever else has no end.

mod contour;
mod shading;
mod swept;
#[cfg(test)]
mod tests;
mod turned;

use super::Mesh;
use super::chunk::Tag;
use phytomer_sim::shape::{Bounds, Cuboid, Point, Shape};
use std::collections::BTreeMap;

/// The colour of an obstacle whose colour is not stated.
const PLASTER: [u8; 3] = [203, 192, 175];
/// The most triangles of a union.
const MOST_FACES: usize = 2_000_000;
/// The kind of what is no component of a plant.
const NO_KIND: u8 = 255;

/// The surface of a shape: points, and triangles that name them, counterclockwise from outside.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Solid {
    points: Vec<Point>,
    faces: Vec<[u32; 3]>,
}

/// Why a shape cannot be drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Undrawn {
    /// It reaches to infinity.
    #[error("it has no end")]
    Endless,
    /// It would have more triangles than a picture or a mesh should have.
    #[error("it has too many parts")]
    TooLarge,
    /// There is nothing of it, or too little to be seen.
    #[error("there is nothing of it")]
    Empty,
}

impl Solid {
    /// The surface of a shape.
    ///
    /// # Errors
    /// Where the shape has no end, or nothing is in it.
    pub fn of(shape: &Shape) -> Result<Self, Undrawn> {
        let bounds = shape.bounds();
        if (0..3).any(|k| bounds.low[k] > bounds.high[k]) {
            return Err(Undrawn::Empty);
        }
        if bounds.low.iter().chain(&bounds.high).any(|x| !x.is_finite()) {
            return Err(Undrawn::Endless);
        }
        let solid = match shape {
            Shape::Cuboid(of) => cuboid(of),
            Shape::Sphere(of) => turned::sphere(of),
            Shape::Ellipsoid(of) => turned::ellipsoid(of),
            Shape::Cylinder(of) => turned::cylinder(of),
            Shape::Cone(of) => turned::cone(of),
            Shape::Capsule(of) => turned::capsule(of),
            Shape::Torus(of) => turned::torus(of),
            Shape::Shell(of) => swept::shell(of),
            Shape::Mesh(of) => welded(of.triangles()),
            Shape::Placed(of) => Self::of(of.shape())?.moved(|point| of.after(point)),
            Shape::Union(of) => return Self::of_all(of.members()),
            Shape::HalfSpace(_)
            | Shape::Polyline(_)
            | Shape::Soft(_)
            | Shape::Intersection(_)
            | Shape::Difference(_)
            | Shape::Blend(_) => contour::of(shape, &bounds),
        };
        if solid.faces.is_empty() { Err(Undrawn::Empty) } else { Ok(solid) }
    }

    /// The surfaces of several shapes together; those of which there is nothing are left out.
    fn of_all(shapes: &[Shape]) -> Result<Self, Undrawn> {
        let mut all = Self::default();
        for shape in shapes {
            match Self::of(shape) {
                Ok(one) => all.add(&one),
                Err(Undrawn::Empty) => {}
                Err(why) => return Err(why),
            }
            if all.faces.len() > MOST_FACES {
                return Err(Undrawn::TooLarge);
            }
        }
        if all.faces.is_empty() { Err(Undrawn::Empty) } else { Ok(all) }
    }

    /// The triangles with normals, each vertex with a tag. Faces that meet at less than 40° are shaded as one.
    pub fn mesh(&self, tag: &Tag) -> Mesh {
        shading::shaded(self, tag)
    }

    /// The triangles of an obstacle, in a stated colour or that of plaster. It is no component of a plant: its number
    /// is −1 and its kind 255, and it lives at every age.
    pub fn obstacle(&self, colour: Option<[u8; 3]>) -> Mesh {
        let [r, g, b] = colour.unwrap_or(PLASTER);
        self.mesh(&Tag { colour: [r, g, b, 255], birth: 0.0, death: f32::INFINITY, component: -1, kind: NO_KIND })
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds {
        Bounds::of_points(&self.points)
    }

    fn add(&mut self, more: &Self) {
        let first = self.points.len() as u32;
        self.points.extend_from_slice(&more.points);
        self.faces.extend(more.faces.iter().map(|face| face.map(|corner| first + corner)));
    }

    fn moved(mut self, to: impl Fn(Point) -> Point) -> Self {
        self.points.iter_mut().for_each(|point| *point = to(*point));
        self
    }

    /// Adds a quadrangle, counterclockwise from outside; a side without length leaves a triangle, or nothing.
    fn quadrangle(&mut self, [a, b, c, d]: [u32; 4]) {
        for face in [[a, b, c], [a, c, d]] {
            if face[0] != face[1] && face[1] != face[2] && face[2] != face[0] {
                self.faces.push(face);
            }
        }
    }
}

/// A box: two triangles a face.
fn cuboid(of: &Cuboid) -> Solid {
    let points = Bounds { low: of.low, high: of.high }.corners().to_vec();
    let mut solid = Solid { points, faces: Vec::new() };
    // Corners are numbered by their bits: 1 for a high x, 2 for a high y, 4 for a high z.
    for [a, b, c, d] in [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]] {
        solid.quadrangle([a, b, c, d]);
    }
    solid
}

/// Triangles of a closed mesh, whose corners in one place are one point. All are turned round if they face inward.
fn welded(triangles: &[[Point; 3]]) -> Solid {
    let mut numbers: BTreeMap<[u64; 3], u32> = BTreeMap::new();
    let mut solid = Solid::default();
    for corners in triangles {
        let face = corners.map(|at| {
            *numbers.entry(at.map(f64::to_bits)).or_insert_with(|| {
                solid.points.push(at);
                solid.points.len() as u32 - 1
            })
        });
        solid.faces.push(face);
    }
    if solid.volume() < 0.0 {
        solid.faces.iter_mut().for_each(|face| face.swap(1, 2));
    }
    solid
}

impl Solid {
    /// The volume that the triangles enclose, m³; negative where they face inward.
    pub fn volume(&self) -> f64 {
        let Some(&first) = self.points.first() else { return 0.0 };
        let from = |corner: u32| [0, 1, 2].map(|k| self.points[corner as usize][k] - first[k]);
        let cone = |face: &[u32; 3]| {
            let [a, b, c] = face.map(from);
            let across = [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
            (a[0] * across[0] + a[1] * across[1] + a[2] * across[2]) / 6.0
        };
        self.faces.iter().map(cone).sum()
    }
}
