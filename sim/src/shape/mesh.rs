//! Closed meshes of triangles.
//!
//! A point is inside where the mesh winds about it (Jacobson, Kavan & Sorkine-Hornung 2013, "Robust inside-outside
//! segmentation using generalized winding numbers"): the solid angles of the triangles (Van Oosterom & Strackee 1983)
//! add up to 4π within and to 0 outside, wherever the point lies, so that no ray can slip through an edge. Triangles
//! far from the point count together as one dipole (Barill et al. 2018, "Fast winding numbers for soups and clouds", of
//! the first order). A point on the surface counts as inside or as outside, as rounding decides. Absent: files, and
//! making a mesh closed.

use super::bounds::Bounds;
use super::tree::{Tree, Walk};
use super::{Point, Solid, along_line, cross, dot, from, length};
use crate::math::atan2;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// The distance from which triangles count as one dipole, in radii of the ball that holds them. The winding number is
/// then off by less than 1/50, and what is asked is whether it is 0 or 1.
const FAR: f64 = 3.0;

/// A closed mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    triangles: Vec<[Point; 3]>,
    tree: Tree,
    /// For each node of the tree, the triangles below it together.
    dipoles: Vec<Dipole>,
}

/// What is no closed mesh.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum MeshFault {
    /// A triangle names a point that is not there.
    #[error("triangle {triangle} names point {point}, and there are {points}")]
    NoSuchPoint {
        /// The triangle, from 0.
        triangle: usize,
        /// The point that it names.
        point: u32,
        /// The number of points.
        points: usize,
    },
    /// An edge is not passed as often one way as the other, so that the mesh has a hole or a triangle that faces the
    /// wrong way.
    #[error("the mesh is not closed at {edges} of its edges, the first from {start:?} to {end:?}")]
    Open {
        /// The number of such edges.
        edges: usize,
        /// Where the first begins, metres.
        start: Point,
        /// Where it ends, metres.
        end: Point,
    },
    /// There is no triangle with an area.
    #[error("the mesh encloses nothing")]
    Empty,
}

/// Triangles seen from afar.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Dipole {
    /// The mean of their middles, weighted by area.
    centre: Point,
    /// The sum of their normals, each as long as their area.
    normal: Point,
    /// The square of the distance from which they count together.
    far: f64,
}

impl Mesh {
    /// The mesh of points and of triangles that name them. Points in one place are one point; a triangle with two
    /// corners in one place is left out. The triangles may all face outward or all inward.
    ///
    /// # Errors
    /// A [`MeshFault`] where the triangles enclose no space.
    pub fn of(points: &[Point], faces: &[[u32; 3]]) -> Result<Self, MeshFault> {
        let mut triangles = Vec::with_capacity(faces.len());
        for (triangle, face) in faces.iter().enumerate() {
            let corner = |point: u32| {
                let known = points.get(point as usize).copied();
                // + 0 makes the two zeros one.
                let known = known.map(|at| at.map(|x| x + 0.0));
                known.ok_or(MeshFault::NoSuchPoint { triangle, point, points: points.len() })
            };
            let [a, b, c] = [corner(face[0])?, corner(face[1])?, corner(face[2])?];
            if a != b && b != c && c != a {
                triangles.push([a, b, c]);
            }
        }
        check_closed(&triangles)?;
        let tree = Tree::of(&triangles.iter().map(Bounds::of_points).collect::<Vec<_>>());
        let dipoles = (0..tree.len()).map(|node| dipole(&triangles, &tree, node)).collect();
        Ok(Self { triangles, tree, dipoles })
    }

    /// Its triangles by their corners.
    pub fn triangles(&self) -> &[[Point; 3]] {
        &self.triangles
    }

    /// How often the mesh winds about a point.
    fn winding(&self, point: Point) -> f64 {
        let mut angle = 0.0;
        self.tree.walk(|node, _, triangle| {
            let Dipole { centre, normal, far } = self.dipoles[node];
            let to = from(point, centre);
            let square = dot(to, to);
            if square > far {
                angle += dot(to, normal) / (square * square.sqrt());
                return Walk::Past;
            }
            angle += triangle.map_or(0.0, |number| solid_angle(&self.triangles[number], point));
            Walk::Below
        });
        angle / (2.0 * TAU)
    }
}

/// Each edge must be passed as often one way as the other.
fn check_closed(triangles: &[[Point; 3]]) -> Result<(), MeshFault> {
    if triangles.is_empty() {
        return Err(MeshFault::Empty);
    }
    let key = |point: Point| point.map(f64::to_bits);
    let mut passed: BTreeMap<[[u64; 3]; 2], i64> = BTreeMap::new();
    for corners in triangles {
        for (start, end) in [(0, 1), (1, 2), (2, 0)].map(|(a, b)| (key(corners[a]), key(corners[b]))) {
            let (edge, way) = if start < end { ([start, end], 1) } else { ([end, start], -1) };
            *passed.entry(edge).or_insert(0) += way;
        }
    }
    let mut open = passed.iter().filter(|(_, ways)| **ways != 0);
    let first = open.next().map(|(edge, _)| edge.map(|end| end.map(f64::from_bits)));
    first.map_or(Ok(()), |[start, end]| Err(MeshFault::Open { edges: 1 + open.count(), start, end }))
}

/// The triangles below a node of the tree, seen from afar.
fn dipole(triangles: &[[Point; 3]], tree: &Tree, node: usize) -> Dipole {
    let below = || (node..tree.below(node).0).filter_map(|leaf| tree.below(leaf).1).map(|number| &triangles[number]);
    let (mut sum, mut centre, mut normal) = (0.0, [0.0; 3], [0.0; 3]);
    for corners in below() {
        let across = cross(from(corners[0], corners[1]), from(corners[0], corners[2])).map(|x| 0.5 * x);
        let area = length(across);
        sum += area;
        for k in 0..3 {
            normal[k] += across[k];
            centre[k] += area * (corners[0][k] + corners[1][k] + corners[2][k]) / 3.0;
        }
    }
    // Triangles without area have no middle; they count one by one.
    if sum <= 0.0 {
        return Dipole { centre, normal, far: f64::INFINITY };
    }
    let centre = centre.map(|x| x / sum);
    let square = |point: &Point| dot(from(centre, *point), from(centre, *point));
    let far = below().flatten().map(square).fold(0.0, f64::max);
    Dipole { centre, normal, far: FAR * FAR * far }
}

/// The solid angle of a triangle, positive where it is seen from behind its front.
fn solid_angle(corners: &[Point; 3], point: Point) -> f64 {
    let [a, b, c] = corners.map(|corner| from(point, corner));
    let [la, lb, lc] = [a, b, c].map(length);
    let under = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    2.0 * atan2(dot(a, cross(b, c)), under)
}

/// The square of the distance from a point to a triangle.
fn square_to_triangle(corners: &[Point; 3], point: Point) -> f64 {
    let [a, b, c] = *corners;
    let normal = cross(from(a, b), from(a, c));
    let edges = [(a, b), (b, c), (c, a)];
    let above = edges.iter().all(|(start, end)| dot(cross(normal, from(*start, *end)), from(*start, point)) >= 0.0);
    let square = dot(normal, normal);
    if above && square > 0.0 {
        let off = dot(from(a, point), normal);
        return off * off / square;
    }
    let to_edge = |(start, end): (Point, Point)| {
        let beside = from(along_line(start, end, point).1, point);
        dot(beside, beside)
    };
    edges.map(to_edge).into_iter().fold(f64::INFINITY, f64::min)
}

impl Solid for Mesh {
    fn inside(&self, point: Point) -> bool {
        self.tree.bounds().holds(point) && self.winding(point).abs() > 0.5
    }

    fn distance(&self, point: Point) -> f64 {
        let square = |number: usize| square_to_triangle(&self.triangles[number], point);
        let mut least = self.tree.near(point).map_or(f64::INFINITY, square);
        self.tree.walk(|_, bounds, triangle| {
            if bounds.square_distance(point) >= least {
                return Walk::Past;
            }
            least = least.min(triangle.map_or(f64::INFINITY, square));
            Walk::Below
        });
        if self.inside(point) { -least.sqrt() } else { least.sqrt() }
    }

    fn bounds(&self) -> Bounds {
        self.tree.bounds()
    }
}
