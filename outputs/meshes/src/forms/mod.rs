//! The library of forms (de Reffye 1988 §6): a small mesh in a unit box for each form of organ, placed by scaling.
//!
//! In the box x runs along the organ from its base (0) to its tip (1), y across it to its left (−½ to ½), z to its
//! upper side. The length scales x, the width y, and one of both scales z; so a form grows with age. An organ with a
//! stated area is drawn slimmer or fuller until it has that area (`side`): a simple blade in its width, a compound
//! blade in each of its parts. Triangles are single-sided, counterclockwise as seen from the upper or outer side, with
//! one normal per vertex: doubled faces would flicker and count twice in areas. Leaves consist of at most four plane
//! convex polygons, folded along the midrib. The table of `phytomer_looks` states which function makes which form.
//! Absent: internodes ([`super::tube`]), and buds, which are not drawn.

mod arch;
mod blade;
mod cluster;
mod coarse;
mod flat;
mod flower;
mod fruit;
pub mod near;
pub mod own;
mod palm;
mod round;
mod side;
#[cfg(test)]
mod tests;

use super::chunk::{Tag, Vertex};
use coarse::Coarse;
use glam::Vec3;
use phytomer_looks::FormName;
use phytomer_sim::plant::Form;
use side::Side;
use std::sync::{LazyLock, OnceLock};

/// A corner of a shape, in its unit box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// The position in the box.
    pub at: [f32; 3],
    /// The offset from the middle line of its part, in a form that is slim or full in its parts.
    pub across: [f32; 3],
    /// The unit normal.
    pub normal: [f32; 3],
    /// The texture coordinates.
    pub texture: [f32; 2],
    /// Whether it has the colour of the stalk.
    pub stalk: bool,
    /// A colour that lies over that of the organ or the stalk, and its share of 255; forms of detail 0 have none.
    pub tint: [u8; 4],
}

/// The measure that scales the z direction of a shape.
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
    /// Its triangles, by the indices of its corners.
    pub faces: Vec<[u32; 3]>,
    /// The plane polygons in it: the index of the first corner and the number of corners of each.
    polygons: Vec<[u32; 2]>,
    depth: Depth,
    /// Whether it becomes slim or full in each of its parts; else in its width.
    in_parts: bool,
    side: Side,
    /// The box of its corners, and the farthest that their offsets from the middle lines of their parts reach.
    extent: [[f32; 3]; 3],
    /// Whether each of its triangles is of a closed part, of a form from near, whose fullness is found by its area.
    closed: Vec<bool>,
    /// The same form with fewer triangles, made when it is first asked for.
    coarser: OnceLock<Vec<Coarse>>,
}

/// The placement of a shape, in metres and unit vectors.
#[derive(Debug, Clone, Copy)]
pub struct Placement {
    /// The position of the base.
    pub base: [f32; 3],
    /// The direction along the organ.
    pub heading: [f32; 3],
    /// The direction of its upper side.
    pub up: [f32; 3],
    /// Its length and width.
    pub size: [f32; 2],
    /// The factor by which it is fuller than its form.
    pub fullness: f32,
}

/// The shape of a form of the library; a broad blade for the form of a mesh file, which the library does not have.
pub fn shape(form: Form) -> &'static FormMesh {
    static LIBRARY: LazyLock<[FormMesh; FormName::ALL.len()]> =
        LazyLock::new(|| FormName::ALL.map(|form| made(form).measured()));
    LIBRARY.get(usize::from(form.0)).unwrap_or(&LIBRARY[FormName::Elliptic as usize])
}

/// Makes the function `made` from the table of forms, whose rows name the functions in this folder.
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
        let side = Side::of(&points, &faces, depth, 1.0);
        Self {
            points,
            faces,
            polygons: Vec::new(),
            depth,
            in_parts: false,
            side,
            extent: [[0.0; 3]; 3],
            closed: Vec::new(),
            coarser: OnceLock::new(),
        }
    }

    /// The shape with its area computed, to be called after its last triangle is added.
    fn measured(self) -> Self {
        self.measured_at(1.0)
    }

    /// The same where the width, or the length over the width, scales what leans by about `nominal`.
    fn measured_at(mut self, nominal: f32) -> Self {
        self.side = Side::of(&self.points, &self.faces, self.depth, f64::from(nominal));
        self.extent = extent(&self.points);
        self
    }

    /// The same form with fewer triangles, the finest first; none where it has no fewer.
    fn coarser(&self) -> &[Coarse] {
        self.coarser.get_or_init(|| coarse::coarser(self))
    }

    /// The same form with fewer triangles, the finest first.
    pub(super) fn coarser_meshes(&self) -> impl Iterator<Item = &Self> {
        self.coarser().iter().map(|coarse| &coarse.mesh)
    }

    /// The coarsest form that lies within a distance, metres, of this one for an organ of this length and width.
    #[inline]
    pub fn within(&self, distance: f32, size: [f32; 2]) -> &Self {
        let serves = self.coarser().iter().rev().find(|coarse| coarse.distance(size) <= distance);
        serves.map_or(self, |coarse| &coarse.mesh)
    }

    /// Calls `take` with the coarser forms, the finest first: the distance, metres, from which on [`Self::within`]
    /// gives it or a coarser one for an organ of this length and width, and its triangles.
    pub(super) fn each_coarser(&self, size: [f32; 2], take: &mut dyn FnMut(f32, u32)) {
        let all = self.coarser();
        for (place, coarse) in all.iter().enumerate() {
            let from = all[place..].iter().map(|coarse| coarse.distance(size)).fold(f32::INFINITY, f32::min);
            take(from, coarse.mesh.faces.len() as u32);
        }
    }

    /// The area of one side as a share of length × width, for an organ with `aspect` = width / length.
    pub(super) fn area_share(&self, aspect: f64) -> f64 {
        self.side.share(aspect)
    }

    /// What scales its z direction.
    pub fn depth(&self) -> Depth {
        self.depth
    }

    /// Whether it becomes slim or full in each of its parts.
    pub fn is_in_parts(&self) -> bool {
        self.in_parts
    }

    /// The factor by which an organ of this length and width is fuller than its form, so that one side has the area
    /// `area`.
    #[inline]
    pub fn fullness(&self, size: [f32; 2], area: f32) -> f32 {
        let first = self.side.fullness(size, area, self.in_parts);
        if self.closed.is_empty() || area <= 0.0 { first } else { near::fullness(self, size, area, first) }
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
            tint: [0; 4],
        }));
        self.faces.extend((1..corners.len() as u32 - 1).map(|k| [first, first + k, first + k + 1]));
    }

    /// Adds a plane convex polygon that is slim or full about its own middle line, which lies in its plane. Each corner
    /// is a pair: its place on that line, and its offset from the line.
    fn part(&mut self, corners: &[[[f32; 3]; 2]], stalk: bool) {
        let first = self.points.len();
        let places: Vec<[f32; 3]> = corners.iter().map(|[on, across]| [0, 1, 2].map(|k| on[k] + across[k])).collect();
        self.polygon(&places, along, stalk);
        self.in_parts = true;
        self.points[first..].iter_mut().zip(corners).for_each(|(point, corner)| point.across = corner[1]);
    }

    /// Writes the vertices of the shape in its placement; `out` must have exactly one place per corner. `tags` are
    /// those of the organ and of its stalk.
    #[inline]
    pub fn write(&self, place: &Placement, tags: &[Tag; 2], out: &mut [Vertex]) {
        let Placement { base, heading: h, up, size: [length, width], fullness } = *place;
        let (width, more) = if self.in_parts { (width, fullness - 1.0) } else { (width * fullness, 0.0) };
        let left = super::tube::cross(up, h);
        let depth = if self.depth == Depth::Width { width } else { length };
        // Normals scale by the cofactors of the scales of the shape.
        let cofactors = [width * depth, length * depth, length * width];
        let turned = |[x, y, z]: [f32; 3]| [0, 1, 2].map(|k| x * h[k] + y * left[k] + z * up[k]);
        let (mut of, mut normal) = ([f32::NAN; 3], [0.0; 3]);
        for (point, vertex) in self.points.iter().zip(out) {
            let [x, y, z] = if more == 0.0 { point.at } else { point.fuller(more) };
            let offset = turned([x * length, y * width, z * depth]);
            let at = [0, 1, 2].map(|k| base[k] + offset[k]);
            // The corners of a polygon are consecutive and have one normal.
            if point.normal != of {
                (of, normal) = (point.normal, turned(scaled_normal(point.normal, cofactors)));
            }
            *vertex = Vertex::new(at, normal, point.texture, &tags[usize::from(point.stalk)]);
        }
    }
}

impl FormMesh {
    /// What scales the three axes of the box, and how much fuller its parts are.
    #[inline]
    fn scales(&self, place: &Placement) -> ([f32; 3], f32) {
        let [length, width] = place.size;
        let (width, more) = if self.in_parts { (width, place.fullness - 1.0) } else { (width * place.fullness, 0.0) };
        ([length, width, if self.depth == Depth::Width { width } else { length }], more)
    }

    /// Replaces `out` by the places of its corners in its placement, as [`FormMesh::write`] gives them to vertices.
    pub(super) fn places(&self, place: &Placement, out: &mut Vec<Vec3>) {
        let ([length, width, depth], more) = self.scales(place);
        let [base, heading, up] = [place.base, place.heading, place.up].map(Vec3::from_array);
        let axes = [heading * length, up.cross(heading) * width, up * depth];
        out.clear();
        out.extend(self.points.iter().map(|point| {
            let [x, y, z] = if more == 0.0 { point.at } else { point.fuller(more) };
            base + x * axes[0] + y * axes[1] + z * axes[2]
        }));
    }

    /// The least and the most of its corners along the organ, to its left and to its upper side, from its base, metres.
    #[inline]
    pub(super) fn bounds(&self, place: &Placement) -> [Vec3; 2] {
        let (scales, more) = self.scales(place);
        let [low, high, across] = self.extent.map(|corner| Vec3::from_array(corner) * Vec3::from_array(scales));
        let more = more.abs() * across;
        [low - more, high + more]
    }

    /// Lays the tints of its corners over the colours that [`FormMesh::write`] gave them.
    pub(crate) fn tint(&self, out: &mut [Vertex]) {
        for (point, vertex) in self.points.iter().zip(out).filter(|(point, _)| point.tint[3] > 0) {
            vertex.lay_over(point.tint);
        }
    }
}

impl Point {
    /// The position of a corner in the box when the parts of the form are fuller by the share `more`.
    #[inline]
    fn fuller(&self, more: f32) -> [f32; 3] {
        [0, 1, 2].map(|k| self.at[k] + more * self.across[k])
    }
}

/// The least and the most of the corners along each axis, and the most of their offsets.
fn extent(points: &[Point]) -> [[f32; 3]; 3] {
    let Some(first) = points.first() else { return [[0.0; 3]; 3] };
    points.iter().fold([first.at, first.at, [0.0; 3]], |[low, high, across], point| {
        [
            [0, 1, 2].map(|k| low[k].min(point.at[k])),
            [0, 1, 2].map(|k| high[k].max(point.at[k])),
            [0, 1, 2].map(|k| across[k].max(point.across[k].abs())),
        ]
    })
}

#[inline]
fn scaled_normal(normal: [f32; 3], cofactors: [f32; 3]) -> [f32; 3] {
    let n = [0, 1, 2].map(|k| normal[k] * cofactors[k]);
    let square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    // An organ without any size is not seen; its normals stay unchanged.
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
