//! Organs that state their form: their outline, a polygon in triangles that may be concave, or a curved surface.
//!
//! The corners are the vertices, in their order. The upper side is the side from which they run counterclockwise. The
//! polygon grows from the organ's base as the organ expands. Its triangles are computed once per scene. A polygon that
//! is not plane has at each corner the mean normal of its triangles; a surface has normals of its own.

use super::chunk::{Tag, Vertex};
use super::forms::{FormMesh, plane_normal};
use super::near::NearForm;
use super::tube::cross;
use phytomer_looks::polygon::{is_plane, triangles};
use phytomer_looks::{Surface, SurfacePoint};
use phytomer_sim::plant::{OrganId, Plant};
use phytomer_sim::pose::Frame;
use std::ops::Range;

/// The form that an organ states for itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OwnForm {
    /// That of a detail above 0.
    Near(NearForm),
    /// None: it has the form of its column.
    None,
    /// An outline, [`Plant::outline_of`].
    Outline,
    /// A curved surface, by its place among the paints of the habit.
    Surface(usize),
}

/// The form of an organ.
#[derive(Debug, Clone, Copy)]
pub enum OrganForm<'s> {
    /// A form of the library, or a mesh file.
    Shape(&'s FormMesh),
    /// A polygon: its corners and triangles.
    Outline(&'s [[f32; 3]], &'s [[u32; 3]]),
    /// A curved surface, and its factors along the axes of the organ when it is full-grown.
    Surface(&'s Surface, [f32; 3]),
}

impl<'s> OrganForm<'s> {
    /// The number of its vertices.
    #[inline]
    pub fn vertices(self) -> usize {
        match self {
            Self::Shape(shape) => shape.points.len(),
            Self::Outline(corners, _) => corners.len(),
            Self::Surface(surface, _) => surface.points().len(),
        }
    }

    /// Its triangles.
    #[inline]
    pub fn faces(self) -> &'s [[u32; 3]] {
        match self {
            Self::Shape(shape) => &shape.faces,
            Self::Outline(_, faces) => faces,
            Self::Surface(surface, _) => surface.faces(),
        }
    }
}

/// An organ as it is drawn at a range.
#[derive(Debug, Clone, Copy)]
pub enum Shown<'s> {
    /// In its form.
    Whole(OrganForm<'s>),
    /// As a point: one triangle.
    Point,
}

/// The triangle of a point.
const POINT: [[u32; 3]; 1] = [[0, 1, 2]];

impl<'s> Shown<'s> {
    /// The number of its vertices.
    #[inline]
    pub fn vertices(self) -> usize {
        match self {
            Self::Whole(form) => form.vertices(),
            Self::Point => POINT[0].len(),
        }
    }

    /// Its triangles.
    #[inline]
    pub fn faces(self) -> &'s [[u32; 3]] {
        match self {
            Self::Whole(form) => form.faces(),
            Self::Point => &POINT,
        }
    }
}

/// The triangles of every outline of a plant.
#[derive(Debug, Default)]
pub struct Outlines {
    faces: Vec<[u32; 3]>,
    /// For each organ its triangles; empty where no organ of the plant has an outline.
    spans: Vec<Range<u32>>,
}

impl Outlines {
    /// The triangles of the organs of `plant`.
    pub fn of(plant: &Plant) -> Self {
        let mut outlines = Self::default();
        if plant.stated_organs.have_forms() {
            return outlines;
        }
        for organ in 0..plant.organs.len() as u32 {
            let start = outlines.faces.len() as u32;
            let corners = plant.outline_of(OrganId(organ));
            if !corners.is_empty() {
                outlines.faces.extend(triangles(corners).iter().map(|face| face.map(|corner| corner as u32)));
            }
            outlines.spans.push(start..outlines.faces.len() as u32);
        }
        outlines
    }

    /// The triangles of an organ by the indices of its corners; `None` for an organ without an outline.
    #[inline]
    pub fn faces(&self, organ: OrganId) -> Option<&[[u32; 3]]> {
        let span = self.spans.get(organ.index()).filter(|span| !span.is_empty())?;
        Some(&self.faces[span.start as usize..span.end as usize])
    }
}

/// Writes the vertices of an outline of these triangles that has grown to `share` of its size; `out` has exactly one
/// place per corner.
pub fn write((corners, faces): (&[[f32; 3]], &[[u32; 3]]), frame: &Frame, share: f32, tag: &Tag, out: &mut [Vertex]) {
    let axes = axes(frame);
    let turned = |at: [f32; 3]| turned(&axes, at);
    let mean = plane_normal(corners);
    let mean = if mean.iter().all(|x| x.is_finite()) { turned(mean) } else { frame.up };
    let bent = if is_plane(corners) { Vec::new() } else { sums(corners, faces) };
    let extent = |k: usize| {
        let of = corners.iter().map(|corner| corner[k]);
        let (low, high) = of.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        (low, if high > low { 1.0 / (high - low) } else { 0.0 })
    };
    let [(x, along), (y, across)] = [extent(0), extent(1)];
    for (number, (corner, vertex)) in corners.iter().zip(out).enumerate() {
        let offset = turned(corner.map(|x| share * x));
        let at = [0, 1, 2].map(|k| frame.base[k] + offset[k]);
        let normal = bent.get(number).and_then(|sum| unit(*sum)).map_or(mean, turned);
        *vertex = Vertex::new(at, normal, [(corner[1] - y) * across, (corner[0] - x) * along], tag);
    }
}

/// Writes the vertices of a surface that is scaled along its axes; `out` has exactly one place per point.
pub fn write_surface(surface: &Surface, scale: [f32; 3], frame: &Frame, tag: &Tag, out: &mut [Vertex]) {
    let axes = axes(frame);
    for (point, vertex) in surface.points().iter().zip(out) {
        let SurfacePoint { at, texture, .. } = *point;
        let offset = turned(&axes, [0, 1, 2].map(|k| scale[k] * at[k]));
        let normal = turned(&axes, point.normal_scaled(scale));
        *vertex = Vertex::new([0, 1, 2].map(|k| frame.base[k] + offset[k]), normal, texture, tag);
    }
}

/// Writes the triangle that stands for an organ as a point: of its area and its length, with its base to the stem;
/// `out` has three places.
pub fn write_point([length, area]: [f32; 2], frame: &Frame, tag: &Tag, out: &mut [Vertex]) {
    let axes = axes(frame);
    let half = if length > 0.0 { area / length } else { 0.0 };
    let corners = [([0.0, -half, 0.0], [0.0, 0.0]), ([length, 0.0, 0.0], [0.5, 1.0]), ([0.0, half, 0.0], [1.0, 0.0])];
    for ((corner, texture), vertex) in corners.into_iter().zip(out) {
        let offset = turned(&axes, corner);
        *vertex = Vertex::new([0, 1, 2].map(|k| frame.base[k] + offset[k]), frame.up, texture, tag);
    }
}

/// Along the organ, to its left and to its upper side.
fn axes(frame: &Frame) -> [[f32; 3]; 3] {
    [frame.heading, cross(frame.up, frame.heading), frame.up]
}

fn turned(axes: &[[f32; 3]; 3], [x, y, z]: [f32; 3]) -> [f32; 3] {
    [0, 1, 2].map(|k| x * axes[0][k] + y * axes[1][k] + z * axes[2][k])
}

/// For each corner the sum of the normals of its triangles, weighted by area.
fn sums(corners: &[[f32; 3]], faces: &[[u32; 3]]) -> Vec<[f32; 3]> {
    let mut sums = vec![[0.0; 3]; corners.len()];
    for face in faces {
        let [a, b, c] = face.map(|corner| corners[corner as usize]);
        let from = |to: [f32; 3]| [0, 1, 2].map(|k| to[k] - a[k]);
        let across = cross(from(b), from(c));
        face.iter().for_each(|corner| (0..3).for_each(|k| sums[*corner as usize][k] += across[k]));
    }
    sums
}

/// The direction of a vector, if it has one.
fn unit(of: [f32; 3]) -> Option<[f32; 3]> {
    let length = (of[0] * of[0] + of[1] * of[1] + of[2] * of[2]).sqrt();
    (length > f32::MIN_POSITIVE && length.is_finite()).then(|| of.map(|x| x / length))
}
