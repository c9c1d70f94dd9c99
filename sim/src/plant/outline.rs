//! The frame and the form that single organs state: a frame relative to that of the node, and the polygon that the
//! organ fills or the curved surface that it is.
//!
//! An organ that states its frame keeps it: neither insertion nor trends turn it, and it begins at the stated offset,
//! not on the surface of its stem. An outline is a list of corners in the organ's frame, x along it, y to its left, z
//! to its upper side, in metres when it is full-grown; the area of the organ is then that of the polygon. The corners
//! of all organs share one list. A curved surface is named by its place among those that the habit carries for drawing;
//! the organ states its size. A plant whose organs state nothing has empty columns. Absent: triangles, which a mesh
//! makes of an outline and takes from a surface.

use super::Plant;
use super::handle::OrganId;
use super::rare::Rare;
use crate::rotation::Rotation;
use crate::vector::Vector;

/// All frames and outlines that organs of one plant state.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StatedOrgans {
    /// Unit quaternions; all 0 where an organ follows insertion and trend.
    turns: Rare<[f64; 4]>,
    /// Offsets in the frame of the node, metres.
    starts: Rare<[f32; 3]>,
    /// The first corner and the number of corners.
    spans: Rare<[u32; 2]>,
    corners: Vec<[f32; 3]>,
    /// The place of the curved surface, counted from 1, and its factors along the organ, to its left and to its upper
    /// side.
    surfaces: Rare<(u32, [f32; 3])>,
}

impl StatedOrgans {
    /// Whether no organ states a frame.
    #[inline]
    pub fn keep_insertion(&self) -> bool {
        self.turns.is_empty()
    }

    /// Whether no organ has an outline.
    #[inline]
    pub fn have_forms(&self) -> bool {
        self.spans.is_empty()
    }

    /// The curved surface of an organ: its place among those of the habit, and its factors along the organ, to its left
    /// and to its upper side; `None` where the organ has another form.
    #[inline]
    pub fn surface(&self, organ: OrganId) -> Option<(usize, [f32; 3])> {
        let (place, scale) = self.surfaces.at(organ.index());
        Some((place.checked_sub(1)? as usize, scale))
    }

    /// How an organ is turned in the frame of its node, and where it begins there; `None` where it states no frame.
    pub(crate) fn frame(&self, organ: OrganId) -> Option<(Rotation, [f32; 3])> {
        let turn = self.turns.at(organ.index());
        (turn != [0.0; 4]).then(|| (Rotation::of_parts(turn), self.starts.at(organ.index())))
    }

    /// Adds the frames and outlines of a fragment, whose first organ becomes the organ `first`.
    pub(super) fn join(&mut self, more: &Self, first: usize) {
        self.turns.join(&more.turns, |organ| first + organ);
        self.starts.join(&more.starts, |organ| first + organ);
        let corners = self.corners.len() as u32;
        self.spans.join(&more.spans, |organ| first + organ);
        if !more.spans.is_empty() {
            self.spans.change_from(first, |[start, count]| [start + corners, count]);
            self.corners.extend_from_slice(&more.corners);
        }
        self.surfaces.join(&more.surfaces, |organ| first + organ);
    }

    pub(super) fn clear(&mut self) {
        self.turns.clear();
        self.starts.clear();
        self.spans.clear();
        self.corners.clear();
        self.surfaces.clear();
    }
}

impl Plant {
    /// States the frame of an organ in that of its node: how it is turned, and where it begins from the tip of the
    /// internode, metres along its heading, to its left and to its upper side.
    pub fn state_organ(&mut self, organ: OrganId, rotation: Rotation, offset: [f32; 3]) {
        self.stated_organs.turns.set(organ.index(), rotation.parts());
        if offset != [0.0; 3] || !self.stated_organs.starts.is_empty() {
            self.stated_organs.starts.set(organ.index(), offset);
        }
    }

    /// Gives an organ its outline, and the area of the polygon; fewer than three corners are no outline.
    pub fn state_outline(&mut self, organ: OrganId, corners: &[[f32; 3]]) {
        let of = &mut self.stated_organs;
        let count = if corners.len() < 3 { 0 } else { corners.len() };
        of.spans.set(organ.index(), [of.corners.len() as u32, count as u32]);
        of.corners.extend_from_slice(&corners[..count]);
        self.organs.area[organ.index()] = area(&corners[..count]) as f32;
    }

    /// Gives an organ a curved surface as its form: the place of the surface among those of the habit, its factors
    /// along the organ, to its left and to its upper side when it is full-grown, and the area of one side then, m².
    pub fn state_surface(&mut self, organ: OrganId, place: u32, scale: [f32; 3], area: f32) {
        self.stated_organs.surfaces.set(organ.index(), (place.saturating_add(1), scale));
        self.organs.area[organ.index()] = area;
    }

    /// Moves the corners of the outline of an organ, and gives it the area of the polygon.
    pub(crate) fn move_outline(&mut self, organ: OrganId, to: impl Iterator<Item = [f32; 3]>) {
        let of = &mut self.stated_organs;
        let [start, count] = of.spans.at(organ.index());
        let corners = &mut of.corners[start as usize..(start + count) as usize];
        corners.iter_mut().zip(to).for_each(|(corner, to)| *corner = to);
        self.organs.area[organ.index()] = area(corners) as f32;
    }

    /// Changes the factors of the curved surface of an organ; its area stays.
    pub(crate) fn scale_surface(&mut self, organ: OrganId, scale: [f32; 3]) {
        let of = &mut self.stated_organs;
        let (place, _) = of.surfaces.at(organ.index());
        of.surfaces.set(organ.index(), (place, scale));
    }

    /// The corners of the polygon that an organ fills, in its frame, metres when it is full-grown; empty where it has
    /// the shape of its form.
    #[inline]
    pub fn outline_of(&self, organ: OrganId) -> &[[f32; 3]] {
        let [start, count] = self.stated_organs.spans.at(organ.index());
        &self.stated_organs.corners[start as usize..(start + count) as usize]
    }
}

/// The area of a plane polygon by Newell's sum over its edges, m²; for a polygon that is not plane, the area of its
/// projection along its mean normal.
fn area(corners: &[[f32; 3]]) -> f64 {
    let Some(&first) = corners.first() else { return 0.0 };
    let from = |corner: &[f32; 3]| Vector::from(*corner) - Vector::from(first);
    let sum = corners.windows(2).fold(Vector::default(), |sum, edge| sum + from(&edge[0]).cross(from(&edge[1])));
    0.5 * sum.dot(sum).sqrt()
}
