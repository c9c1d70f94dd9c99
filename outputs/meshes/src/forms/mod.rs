//! The library of forms (de Reffye 1988 §6): a small mesh for each form of organ, in a unit box, put in place by
//! scaling.
//!
//! In the box x runs along the organ from its base (0) to its tip (1), y across it to its left (−½ to ½), z to its
//! upper side. The length scales x, the width y, and one of the two z; so a form is parametrised by age. An organ of
//! which an area is stated is drawn slimmer or fuller until it has that area (`side`): a simple blade in its width, a
//! compound one in each of its parts. Triangles are single-sided, counterclockwise as seen from the upper or outer
//! side, with one normal a vertex: doubled faces would flicker and count twice in areas. Leaves are assemblies of at
//! most four plane convex polygons, folded along the midrib. Which functions make which forms is in the table of
//! `phytomer_looks`. Absent: internodes ([`super::tube`]), and buds, which are not drawn.

mod arch;
mod blade;
mod cluster;
mod flower;
mod fruit;
pub mod own;
mod palm;
mod round;
mod side;
#[cfg(test)]
mod tests;

use super::chunk::{Tag, Vertex};
use phytomer_looks::FormName;
use phytomer_sim::plant::Form;
use side::Side;
use std::sync::LazyLock;

/// A corner of a shape, in its unit box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Where.
    pub at: [f32; 3],
    /// How far it is from the middle of its part, in a form that is slim or full in its parts.
    across: [f32; 3],
    /// The unit normal.
    pub normal: [f32; 3],
    /// The place in the texture.
    pub texture: [f32; 2],
    /// Whether it has the colour of the stalk.
    pub stalk: bool,
}

/// What scales the third direction of a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depth {
    /// The width, as in fruits and folded blades.
    Width,
    /// The length, as in arching leaves.
    Length,
}

/// A mesh in its unit box.
#[derive(Debug, Clone, PartialEq)]
pub struct FormMesh {
    /// Its corners.
    pub points: Vec<Point>,
    /// Its triangles, by the numbers of its corners.
    pub faces: Vec<[u32; 3]>,
    /// The plane polygons among it: the first corner and the number of corners of each.
    polygons: Vec<[u32; 2]>,
    depth: Depth,
    /// Whether it is slim or full in each of its parts, not in its width.
    in_parts: bool,
    side: Side,
}

/// Where a shape goes, in metres and unit vectors.
#[derive(Debug, Clone, Copy)]
pub struct Placement {
    /// The base.
    pub base: [f32; 3],
    /// Along the organ.
    pub heading: [f32; 3],
    /// Its upper side.
    pub up: [f32; 3],
    /// Its length and width.
    pub size: [f32; 2],
    /// How many times fuller it is than its form.
    pub fullness: f32,
}

/// The shape of a form of the library; of a mesh of the user's that is not at hand, a broad blade.
pub fn shape(form: Form) -> &'static FormMesh {
    static LIBRARY: LazyLock<[FormMesh; FormName::ALL.len()]> =
        LazyLock::new(|| FormName::ALL.map(|form| made(form).measured()));
    LIBRARY.get(usize::from(form.0)).unwrap_or(&LIBRARY[FormName::Elliptic as usize])
}

/// Makes the function `made` of the table of forms, whose rows name the functions of this folder.
macro_rules! made {
    ($(#[doc = $prose:tt] $form:ident, $name:tt, $share:literal, $module:ident :: $mesh:ident;)*) => {
        /// Makes the shape of a form.
        fn made(form: FormName) -> FormMesh {
            match form {
                $(FormName::$form => $module::$mesh(),)*
            }
        }
    };
}

phytomer_looks::forms!(made);

impl FormMesh {
    fn new(depth: Depth) -> Self {
        let (points, faces) = (Vec::new(), Vec::new());
        let side = Side::of(&points, &faces, depth);
        Self { points, faces, polygons: Vec::new(), depth, in_parts: false, side }
    }

    /// With its area known, once it has all its triangles.
    fn measured(mut self) -> Self {
        self.side = Side::of(&self.points, &self.faces, self.depth);
        self
    }

    /// The area of one side as a share of length × width, of an organ so many times as wide as long.
    pub(super) fn area_share(&self, aspect: f64) -> f64 {
        self.side.share(aspect)
    }

    /// How many times fuller than its form an organ of this length and width is that has `area`, of one side.
    #[inline]
    pub fn fullness(&self, size: [f32; 2], area: f32) -> f32 {
        self.side.fullness(size, area, self.in_parts)
    }

    /// Adds a plane convex polygon, its corners counterclockwise as seen from its upper side.
    fn polygon(&mut self, corners: &[[f32; 3]], texture: impl Fn([f32; 3]) -> [f32; 2], stalk: bool) {
        let first = self.points.len() as u32;
        let normal = plane_normal(corners);
        self.polygons.push([first, corners.len() as u32]);
        self.points.extend(corners.iter().map(|&at| Point {
            at,
            across: [0.0; 3],
            normal,
            texture: texture(at),
            stalk,
        }));
        self.faces.extend((1..corners.len() as u32 - 1).map(|k| [first, first + k, first + k + 1]));
    }

    /// The same for a part that is slim or full about its own middle line, which lies in its plane: corners by their
    /// places on that line and their distances from it.
    fn part(&mut self, corners: &[[[f32; 3]; 2]], stalk: bool) {
        let first = self.points.len();
        let places: Vec<[f32; 3]> = corners.iter().map(|[on, across]| [0, 1, 2].map(|k| on[k] + across[k])).collect();
        self.polygon(&places, along, stalk);
        self.in_parts = true;
        self.points[first..].iter_mut().zip(corners).for_each(|(point, corner)| point.across = corner[1]);
    }

    /// Writes the vertices of the shape in its place; `out` has exactly their number. `tags` are of the organ and of
    /// its stalk.
    #[inline]
    pub fn write(&self, place: &Placement, tags: &[Tag; 2], out: &mut [Vertex]) {
        let Placement { base, heading: h, up, size: [length, width], fullness } = *place;
        let (width, more) = if self.in_parts { (width, fullness - 1.0) } else { (width * fullness, 0.0) };
        let left = super::tube::cross(up, h);
        let depth = if self.depth == Depth::Width { width } else { length };
        // A normal scales by the cofactors of what scales the shape.
        let cofactors = [width * depth, length * depth, length * width];
        let turned = |[x, y, z]: [f32; 3]| [0, 1, 2].map(|k| x * h[k] + y * left[k] + z * up[k]);
        let (mut of, mut normal) = ([f32::NAN; 3], [0.0; 3]);
        for (point, vertex) in self.points.iter().zip(out) {
            let [x, y, z] = if more == 0.0 { point.at } else { point.fuller(more) };
            let offset = turned([x * length, y * width, z * depth]);
            let at = [0, 1, 2].map(|k| base[k] + offset[k]);
            // The corners of a polygon follow one another and have one normal.
            if point.normal != of {
                (of, normal) = (point.normal, turned(scaled_normal(point.normal, cofactors)));
            }
            *vertex = Vertex::new(at, normal, point.texture, &tags[usize::from(point.stalk)]);
        }
    }
}

impl Point {
    /// Where it is in a form whose parts are by so much fuller, as a share.
    #[inline]
    fn fuller(&self, more: f32) -> [f32; 3] {
        [0, 1, 2].map(|k| self.at[k] + more * self.across[k])
    }
}

#[inline]
fn scaled_normal(normal: [f32; 3], cofactors: [f32; 3]) -> [f32; 3] {
    let n = [0, 1, 2].map(|k| normal[k] * cofactors[k]);
    let square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    // Of an organ without any size nothing is seen; its normals stay as they are.
    if square > f32::MIN_POSITIVE * 1e8 { n.map(|x| x / square.sqrt()) } else { normal }
}

/// The normal of a plane polygon, by Newell's sum over its edges.
pub(super) fn plane_normal(corners: &[[f32; 3]]) -> [f32; 3] {
    let mut sum = [0.0; 3];
    for (k, a) in corners.iter().enumerate() {
        let b = corners[(k + 1) % corners.len()];
        let across = super::tube::cross(*a, b);
        (0..3).for_each(|i| sum[i] += across[i]);
    }
    unit(sum)
}

fn unit(v: [f32; 3]) -> [f32; 3] {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|x| x / length)
}

/// The texture of a blade: s across, t along.
fn along([x, y, _]: [f32; 3]) -> [f32; 2] {
    [0.5 + y, x]
}
