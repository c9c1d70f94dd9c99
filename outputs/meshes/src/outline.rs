//! Organs that state their outline: a polygon in their plane, in triangles; it may be concave.
//!
//! The corners are the vertices, in their order. The upper side is the side from which they run counterclockwise. The
//! polygon grows from the organ's base as the organ expands. Its triangles are computed once per scene.

use super::chunk::{Tag, Vertex};
use super::forms::own::polygon::triangles;
use super::forms::plane_normal;
use super::tube::cross;
use phytomer_sim::plant::{OrganId, Plant};
use phytomer_sim::pose::Frame;
use std::ops::Range;

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

/// Writes the vertices of an outline that has grown to `share` of its size; `out` has exactly one place per corner.
pub fn write(corners: &[[f32; 3]], frame: &Frame, share: f32, tag: &Tag, out: &mut [Vertex]) {
    let left = cross(frame.up, frame.heading);
    let turned = |[x, y, z]: [f32; 3]| [0, 1, 2].map(|k| x * frame.heading[k] + y * left[k] + z * frame.up[k]);
    let normal = plane_normal(corners);
    let normal = if normal.iter().all(|x| x.is_finite()) { turned(normal) } else { frame.up };
    let extent = |k: usize| {
        let of = corners.iter().map(|corner| corner[k]);
        let (low, high) = of.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        (low, if high > low { 1.0 / (high - low) } else { 0.0 })
    };
    let [(x, along), (y, across)] = [extent(0), extent(1)];
    for (corner, vertex) in corners.iter().zip(out) {
        let offset = turned(corner.map(|x| share * x));
        let at = [0, 1, 2].map(|k| frame.base[k] + offset[k]);
        *vertex = Vertex::new(at, normal, [(corner[1] - y) * across, (corner[0] - x) * along], tag);
    }
}
