//! Shapes: forms in space that clip plants, stop their buds or guide their growth.
//!
//! A library of peers: solids ([`Sphere`], [`Ellipsoid`], [`Cuboid`], [`Cylinder`], [`Cone`], [`Capsule`], [`Torus`],
//! [`HalfSpace`], [`Polyline`], [`Shell`], [`Mesh`]), soft objects ([`Soft`]), and shapes made of shapes ([`Union`],
//! [`Intersection`], [`Difference`], [`Blend`], [`Placed`]). Each answers three questions: is a point inside, what is
//! the field there, and within what bounds does the shape lie. The field is ½ on the surface of every shape, greater
//! within and smaller outside, as in Wyvill, McPheeters & Wyvill (1986): of a solid it is ½ less the distance to the
//! surface in metres, negative within; of soft objects and blends it is the sum of what their parts add. A point on the
//! surface is inside, except where [`Difference`] and [`Mesh`] say so. Absent: files, and surfaces to be drawn.

mod bounds;
mod combined;
mod mesh;
mod placed;
mod polyline;
mod round;
mod shell;
mod soft;
mod straight;
pub(crate) mod tree;

pub use bounds::Bounds;
pub use combined::{Blend, Difference, Intersection, Union};
pub use mesh::{Mesh, MeshFault};
pub use placed::Placed;
pub use polyline::Polyline;
pub use round::{Capsule, Ellipsoid, Sphere, Torus};
pub use shell::Shell;
pub use soft::{SURFACE, Skeleton, Soft, falloff};
pub use straight::{Cone, Cuboid, Cylinder, HalfSpace};

use crate::rotation::Rotation;
use std::sync::Arc;

#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_distance;
#[cfg(test)]
mod tests_mesh;
#[cfg(test)]
mod tests_volumes;

/// A point, or a direction: x, y and z, metres.
pub type Point = [f64; 3];

/// A form with a surface and a distance to it.
pub trait Solid {
    /// Whether a point is inside or on the surface.
    fn inside(&self, point: Point) -> bool;
    /// The distance to the surface, metres, negative inside. Where it is not exact, the file of the form says so.
    fn distance(&self, point: Point) -> f64;
    /// A box that holds it.
    fn bounds(&self) -> Bounds;
}

/// A shape. What is large stands in a box of its own.
#[expect(missing_docs, reason = "each is described by its type")]
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    Sphere(Sphere),
    Ellipsoid(Ellipsoid),
    Cuboid(Cuboid),
    Cylinder(Cylinder),
    Cone(Cone),
    Capsule(Capsule),
    Torus(Torus),
    HalfSpace(HalfSpace),
    Polyline(Polyline),
    Shell(Shell),
    Mesh(Arc<Mesh>),
    Soft(Soft),
    Union(Union),
    Intersection(Intersection),
    Difference(Box<Difference>),
    Blend(Blend),
    Placed(Box<Placed>),
}

/// How the distance to a solid becomes its field.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Measure {
    /// What a metre of the solid's coordinates is in those of the point that was asked.
    factor: f64,
    /// In a blend, the distance from the surface at which the field ends.
    reach: Option<f64>,
}

impl Measure {
    const METRES: Self = Self { factor: 1.0, reach: None };

    fn field(self, distance: f64) -> f64 {
        let distance = distance * self.factor;
        let Some(reach) = self.reach else { return SURFACE - distance };
        // 1 at `reach` within, ½ on the surface, 0 at `reach` outside.
        let share = ((reach + distance) / (2.0 * reach)).max(0.0);
        falloff(share * share)
    }
}

impl Shape {
    /// Whether a point is inside or on the surface.
    #[inline]
    pub fn inside(&self, point: Point) -> bool {
        match self {
            Self::Cuboid(solid) => solid.inside(point),
            Self::Sphere(solid) => solid.inside(point),
            Self::Ellipsoid(solid) => solid.inside(point),
            Self::Cylinder(solid) => solid.inside(point),
            Self::Cone(solid) => solid.inside(point),
            Self::Capsule(solid) => solid.inside(point),
            Self::Torus(solid) => solid.inside(point),
            Self::HalfSpace(solid) => solid.inside(point),
            Self::Polyline(solid) => solid.inside(point),
            Self::Shell(solid) => solid.inside(point),
            Self::Mesh(solid) => solid.inside(point),
            Self::Soft(soft) => soft.field(point) >= SURFACE,
            Self::Union(union) => union.inside(point),
            Self::Intersection(all) => all.inside(point),
            Self::Difference(rest) => rest.inside(point),
            Self::Blend(blend) => blend.level(point) >= SURFACE,
            Self::Placed(placed) => placed.shape().inside(placed.before(point)),
        }
    }

    /// The field at a point: ½ on the surface, greater within. Of a union it is that of the member of which it is the
    /// greatest; each member is asked, so it costs more than [`Shape::inside`].
    pub fn field(&self, point: Point) -> f64 {
        self.level(point, Measure::METRES)
    }

    fn level(&self, point: Point, measure: Measure) -> f64 {
        match self {
            Self::Soft(soft) => soft.field(point),
            Self::Blend(blend) => blend.level(point),
            Self::Union(union) => union.level(point, measure),
            Self::Intersection(all) => all.level(point, measure),
            Self::Difference(rest) => rest.level(point, measure),
            Self::Placed(placed) => {
                let factor = measure.factor * placed.least_scale();
                placed.shape().level(placed.before(point), Measure { factor, ..measure })
            }
            solid => solid.solid().map_or(f64::NEG_INFINITY, |solid| measure.field(solid.distance(point))),
        }
    }

    /// The distance to the surface, metres, negative inside. Of solids and of what is made of them it is ½ less the
    /// field. Of soft objects and blends it is measured along the line to the nearest part: exact for a lone point or
    /// line, else not below the true distance; infinite where that line meets no surface.
    pub fn distance(&self, point: Point) -> f64 {
        match self {
            Self::Soft(soft) => soft.distance(point),
            Self::Blend(blend) => blend.distance(point),
            Self::Union(union) => union.distance(point),
            Self::Intersection(all) => all.distance(point),
            Self::Difference(rest) => rest.distance(point),
            Self::Placed(placed) => placed.least_scale() * placed.shape().distance(placed.before(point)),
            solid => solid.solid().map_or(f64::INFINITY, |solid| solid.distance(point)),
        }
    }

    /// The solid that it is; `None` of what is made of other shapes, of soft objects and of blends.
    fn solid(&self) -> Option<&dyn Solid> {
        Some(match self {
            Self::Sphere(solid) => solid,
            Self::Ellipsoid(solid) => solid,
            Self::Cuboid(solid) => solid,
            Self::Cylinder(solid) => solid,
            Self::Cone(solid) => solid,
            Self::Capsule(solid) => solid,
            Self::Torus(solid) => solid,
            Self::HalfSpace(solid) => solid,
            Self::Polyline(solid) => solid,
            Self::Shell(solid) => solid,
            Self::Mesh(solid) => &**solid,
            _ => return None,
        })
    }

    /// The number of its parts, itself among them: shapes, points of polylines and parts of skeletons. A mesh, which is
    /// kept once, is one part.
    pub fn parts(&self) -> usize {
        let sum = |members: &[Self]| members.iter().map(Self::parts).sum::<usize>();
        1 + match self {
            Self::Polyline(line) => line.len(),
            Self::Soft(soft) => soft.len(),
            Self::Union(union) => sum(union.members()),
            Self::Intersection(all) => sum(all.members()),
            Self::Blend(blend) => sum(blend.members()),
            Self::Difference(rest) => rest.parts(),
            Self::Placed(placed) => placed.shape().parts(),
            _ => 0,
        }
    }

    /// The shape `by` metres farther.
    pub fn moved(&self, by: Point) -> Self {
        if let Self::HalfSpace(HalfSpace { point, normal }) = self {
            // Nothing but its point is moved, so that it is to the bit the half space that is stated there.
            return Self::HalfSpace(HalfSpace { point: [0, 1, 2].map(|k| point[k] + by[k]), normal: *normal });
        }
        Self::Placed(Box::new(Placed::of(self.clone(), [1.0; 3], Rotation::NONE, by)))
    }

    /// A box that holds the shape. It may reach to infinity, and be larger than the shape.
    pub fn bounds(&self) -> Bounds {
        match self {
            Self::Sphere(solid) => solid.bounds(),
            Self::Ellipsoid(solid) => solid.bounds(),
            Self::Cuboid(solid) => solid.bounds(),
            Self::Cylinder(solid) => solid.bounds(),
            Self::Cone(solid) => solid.bounds(),
            Self::Capsule(solid) => solid.bounds(),
            Self::Torus(solid) => solid.bounds(),
            Self::HalfSpace(solid) => solid.bounds(),
            Self::Polyline(solid) => solid.bounds(),
            Self::Shell(solid) => solid.bounds(),
            Self::Mesh(solid) => solid.bounds(),
            Self::Soft(soft) => soft.bounds(),
            Self::Union(union) => union.bounds(),
            Self::Intersection(all) => all.bounds(),
            Self::Difference(rest) => rest.bounds(),
            Self::Blend(blend) => blend.bounds(),
            Self::Placed(placed) => placed.bounds(),
        }
    }
}

/// The way from one point to another.
#[inline]
fn from(start: Point, end: Point) -> Point {
    [end[0] - start[0], end[1] - start[1], end[2] - start[2]]
}

#[inline]
fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline]
fn length(a: Point) -> f64 {
    dot(a, a).sqrt()
}

/// Of the line between two points the place nearest to a point: its share of the way, and the place.
#[inline]
fn along_line(start: Point, end: Point, point: Point) -> (f64, Point) {
    let way = from(start, end);
    let square = dot(way, way);
    let share = if square > 0.0 { (dot(from(start, point), way) / square).clamp(0.0, 1.0) } else { 0.0 };
    (share, [0, 1, 2].map(|k| start[k] + way[k] * share))
}
