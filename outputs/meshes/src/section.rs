//! Internodes with a cross section of their own: prisms and frusta over a closed section, strips over an open one.
//!
//! Where an internode goes on from one with a section, both end in the plane that halves their angle (a mitre), so that
//! a generalised cylinder has no gap where it bends and keeps its volume: what the mitre takes on one side of the axis
//! line it gives on the other. The ends of a closed section are closed by caps, which lie within the cylinder but at
//! its ends. Normals stand across the section; they lean with a change of width where a section has rings between base
//! and tip, and else do not. Absent: circles, which are tubes.

use super::chunk::{Tag, Vertex};
use super::tube::{Frustum, cross};
use phytomer_looks::{Section, polygon};

/// The corners and triangles of internodes with a section, computed once per mesh.
#[derive(Debug, Clone)]
pub struct Prism {
    /// Each corner with its normal and its share of the way around; the first is repeated at the end of a closed one.
    corners: Vec<Corner>,
    /// Between base and tip, each the share of the length and the bulge.
    rings: Vec<[f32; 2]>,
    caps: bool,
    faces: Vec<[u32; 3]>,
}

#[derive(Debug, Clone, Copy)]
struct Corner {
    at: [f32; 2],
    normal: [f32; 2],
    share: f32,
}

/// A ring about the axis line.
#[derive(Debug, Clone, Copy)]
pub struct Ring {
    /// Its middle.
    pub middle: [f32; 3],
    /// The direction across it.
    pub heading: [f32; 3],
    /// The direction of the first axis of the section.
    pub up: [f32; 3],
    /// Half the width.
    pub radius: f32,
    /// A vector across the plane that the ring is moved into, along its heading; `None`: the plane across the heading.
    mitre: Option<[f32; 3]>,
}

/// The cosine of the sharpest bend that is mitred, 120 degrees: there a mitred ring is twice as wide.
const SHARPEST: f32 = -0.5;

impl Ring {
    /// The ring at the base of an internode.
    pub fn base(of: &Frustum) -> Self {
        Self { middle: of.base, heading: of.heading, up: of.up, radius: of.radii[0], mitre: None }
    }

    /// The ring at its tip.
    pub fn tip(of: &Frustum) -> Self {
        let middle = [0, 1, 2].map(|k| of.base[k] + of.length * of.heading[k]);
        Self { middle, heading: of.heading, up: of.up, radius: of.radii[1], mitre: None }
    }

    /// Whether another ring lies about the same point.
    pub fn meets(&self, other: &Self) -> bool {
        let apart: f32 = (0..3).map(|k| (self.middle[k] - other.middle[k]) * (self.middle[k] - other.middle[k])).sum();
        let near = 1e-3 * self.radius.max(other.radius);
        apart <= near * near
    }

    /// This ring moved into the plane that halves the angle with the ring that it meets; where the bend is too sharp it
    /// stays.
    pub fn mitred(self, with: &Self) -> Self {
        let both = [0, 1, 2].map(|k| self.heading[k] + with.heading[k]);
        let bends = dot(self.heading, with.heading) >= SHARPEST;
        Self { mitre: bends.then_some(both), ..self }
    }

    /// The mitred ring at the base of an internode that goes on from another one's tip on its axis: it begins with the
    /// section of that one as the bend carries it along.
    pub fn after(self, tip: &Self) -> Self {
        let ring = self.mitred(tip);
        // The least turn of one unit vector a to another one b takes a vector v across a to v - (b v)/(1 + a b) (a +
        // b).
        let carried = ring.mitre.map(|both| {
            let share = dot(self.heading, tip.up) / (1.0 + dot(self.heading, tip.heading));
            [0, 1, 2].map(|k| tip.up[k] - share * both[k])
        });
        Self { up: carried.unwrap_or(self.up), ..ring }
    }

    /// The unit vector across the plane of the ring.
    fn across(&self) -> [f32; 3] {
        let Some(both) = self.mitre else { return self.heading };
        let length = dot(both, both).sqrt();
        both.map(|x| x / length)
    }

    fn turned(&self, [x, y]: [f32; 2]) -> [f32; 3] {
        let side = cross(self.heading, self.up);
        [0, 1, 2].map(|k| x * self.up[k] + y * side[k])
    }

    fn at(&self, corner: [f32; 2]) -> [f32; 3] {
        let out = self.turned(corner);
        let along = self.mitre.map_or(0.0, |both| -dot(out, both) / dot(self.heading, both));
        [0, 1, 2].map(|k| self.middle[k] + self.radius * (out[k] + along * self.heading[k]))
    }
}

impl Prism {
    /// Internodes with a section.
    pub fn new(section: &Section) -> Self {
        let (corners, caps) = (around(section), section.is_closed());
        let rings = section.rings().to_vec();
        let (ring, steps) = (corners.len() as u32, rings.len() as u32 + 1);
        let sides = ring.saturating_sub(1);
        let quads = (0..steps).flat_map(|step| (0..sides).map(move |k| step * ring + k));
        let mut faces: Vec<[u32; 3]> =
            quads.flat_map(|k| [[k, k + 1, ring + k + 1], [k, ring + k + 1, ring + k]]).collect();
        if caps {
            let flat: Vec<[f32; 3]> = section.corners().iter().map(|[x, y]| [*x, *y, 0.0]).collect();
            for face in polygon::triangles(&flat) {
                let [a, b, c] = face.map(|corner| (steps + 1) * ring + corner as u32);
                faces.extend([[a, c, b], [sides + a, sides + b, sides + c]]);
            }
        }
        Self { corners, rings, caps, faces }
    }

    /// The number of vertices of an internode.
    pub fn vertices(&self) -> usize {
        let ring = self.corners.len();
        (2 + self.rings.len()) * ring + if self.caps { 2 * (ring - 1) } else { 0 }
    }

    /// How many of them, the first, stand around it; the others are its ends.
    pub fn around(&self) -> usize {
        (2 + self.rings.len()) * self.corners.len()
    }

    /// The triangles of an internode, by the indices of its own vertices.
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// Writes the vertices of an internode between two rings; `out` has exactly [`Prism::vertices`] places.
    pub fn write(&self, rings: [Ring; 2], tag: &Tag, out: &mut [Vertex]) {
        let count = self.corners.len();
        let (sides, ends) = out.split_at_mut((2 + self.rings.len()) * count);
        for (nth, out) in sides.chunks_mut(count.max(1)).enumerate() {
            let (ring, along) = self.ring(rings, nth);
            let [across, back] = self.lean(rings, nth);
            for (corner, vertex) in self.corners.iter().zip(out) {
                let flat = ring.turned(corner.normal);
                let normal = [0, 1, 2].map(|k| across * flat[k] - back * ring.heading[k]);
                *vertex = Vertex::new(ring.at(corner.at), normal, [corner.share, along], tag);
            }
        }
        if !self.caps {
            return;
        }
        for ((ring, out), way) in rings.iter().zip(ends.chunks_mut(self.corners.len() - 1)).zip([-1.0, 1.0]) {
            let normal = ring.across().map(|x| way * x);
            for (corner, vertex) in self.corners.iter().zip(out) {
                let round = corner.at.map(|x| 0.5 + 0.5 * x);
                *vertex = Vertex::new(ring.at(corner.at), normal, round, tag);
            }
        }
    }
}

impl Prism {
    /// Ring `nth` from the base, of all between the two outer ones, and its share of the length.
    fn ring(&self, [base, tip]: [Ring; 2], nth: usize) -> (Ring, f32) {
        match nth.checked_sub(1) {
            None => (base, 0.0),
            Some(inner) => self.rings.get(inner).map_or((tip, 1.0), |&[share, bulge]| {
                let middle = [0, 1, 2].map(|k| base.middle[k] + share * (tip.middle[k] - base.middle[k]));
                let even = base.radius + share * (tip.radius - base.radius);
                let radius = (even + bulge * length(&[base, tip])).max(0.0);
                (Ring { middle, radius, mitre: None, ..tip }, share)
            }),
        }
    }

    /// How a normal leans at ring `nth`: its part across the internode and its part against the heading. Upright where
    /// there is no ring between base and tip.
    fn lean(&self, rings: [Ring; 2], nth: usize) -> [f32; 2] {
        let length = length(&rings);
        if self.rings.is_empty() || length <= 0.0 {
            return [1.0, 0.0];
        }
        let (before, from) = self.ring(rings, nth.saturating_sub(1));
        let (after, to) = self.ring(rings, (nth + 1).min(self.rings.len() + 1));
        let (wider, further) = (after.radius - before.radius, (to - from) * length);
        let scale = (wider * wider + further * further).sqrt();
        if scale > 0.0 { [further / scale, wider / scale] } else { [1.0, 0.0] }
    }
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The distance between two rings.
fn length([base, tip]: &[Ring; 2]) -> f32 {
    let apart = [0, 1, 2].map(|k| tip.middle[k] - base.middle[k]);
    (apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2]).sqrt()
}

/// The corners of a section with their normals, which stand across the line between their neighbours.
fn around(section: &Section) -> Vec<Corner> {
    let (corners, closed) = (section.corners(), section.is_closed());
    let count = corners.len();
    if count < 2 {
        return Vec::new();
    }
    let last = if closed { count } else { count - 1 };
    let normal = |k: usize| {
        let before = if closed { corners[(k + count - 1) % count] } else { corners[k.saturating_sub(1)] };
        let after = if closed { corners[(k + 1) % count] } else { corners[(k + 1).min(count - 1)] };
        let [x, y] = [after[1] - before[1], before[0] - after[0]];
        let length = (x * x + y * y).sqrt();
        if length > 0.0 { [x / length, y / length] } else { [1.0, 0.0] }
    };
    (0..=last)
        .map(|k| Corner { at: corners[k % count], normal: normal(k % count), share: k as f32 / last as f32 })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::chunk::Face;
    use super::super::measure::{assert_closed, assert_unit_normals, outward_share, surface, volume};
    use super::*;
    use bytemuck::Zeroable;

    const TAG: Tag = Tag { colour: [9, 9, 9, 255], birth: 1.0, death: f32::INFINITY, component: 0, kind: 0 };

    fn drawn(section: &Section, rings: [Ring; 2]) -> (Vec<Vertex>, Vec<Face>) {
        let prism = Prism::new(section);
        let mut vertices = vec![Vertex::zeroed(); prism.vertices()];
        prism.write(rings, &TAG, &mut vertices);
        (vertices, prism.faces().iter().map(|&face| Face::new(face)).collect())
    }

    fn frustum(radii: [f32; 2]) -> Frustum {
        Frustum { base: [0.1, -0.2, 0.3], heading: [0.6, 0.0, 0.8], up: [0.8, 0.0, -0.6], length: 1.5, radii }
    }

    /// An L of three squares of half the width: a prism of 3 r² h, a frustum of 3 h/3 (r² + R² + r R). Either way
    /// round.
    #[test]
    fn a_closed_section_is_a_solid_of_its_volume() {
        let mut corners = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
        for _ in 0..2 {
            let section = Section::of(corners.clone(), true);
            for radii in [[0.4, 0.4], [0.5, 0.2]] {
                let of = frustum(radii);
                let (vertices, faces) = drawn(&section, [Ring::base(&of), Ring::tip(&of)]);
                assert_closed(&vertices, &faces);
                assert_unit_normals(&vertices);
                let [a, b] = radii.map(f64::from);
                let expected = 1.5 * (a * a + b * b + a * b);
                let measured = volume(&vertices, &faces);
                assert!((measured / expected - 1.0).abs() < 1e-5, "{radii:?}: {measured} {expected}");
            }
            corners.reverse();
        }
    }

    /// A regular polygon of 24 sides: a tube of that many, whose normals point out.
    #[test]
    fn a_round_section_is_seen_from_outside() {
        let corner = |k: u32| {
            let (sin, cos) = phytomer_sim::math::sincos(std::f64::consts::TAU * f64::from(k) / 24.0);
            [cos as f32, sin as f32]
        };
        let of = frustum([0.3, 0.3]);
        let (vertices, faces) =
            drawn(&Section::of((0..24).map(corner).collect(), true), [Ring::base(&of), Ring::tip(&of)]);
        assert_eq!(outward_share(&vertices, &faces), 1.0);
    }

    /// With rings a square prism is a pile of frusta, each of a b of the widths at its ends: closed, its volume theirs,
    /// its normals out. A ring that would have no width has none.
    #[test]
    fn rings_between_base_and_tip_make_a_pile_of_frusta() {
        let corners = vec![[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        let rings = vec![[0.2, 0.1], [0.5, -0.05], [0.9, 0.2]];
        let section = Section::of(corners, true).with_rings(rings.clone());
        for radii in [[0.4, 0.2], [0.3, 0.0], [0.05, 0.01]] {
            let of = frustum(radii);
            let (vertices, faces) = drawn(&section, [Ring::base(&of), Ring::tip(&of)]);
            // Where a ring has no width its corners lie at one point, and some triangles have no area.
            let at = |index: u32| vertices[index as usize].position().map(f32::to_bits);
            let is_flat = |face: &Face| (0..3).any(|k| at(face.indices()[k]) == at(face.indices()[(k + 1) % 3]));
            let wide: Vec<Face> = faces.iter().filter(|face| !is_flat(face)).copied().collect();
            assert_eq!(wide.len() < faces.len(), radii[1] < 0.1, "{radii:?}");
            assert_closed(&vertices, &wide);
            assert_unit_normals(&vertices);
            let even = |share: f32| radii[0] + share * (radii[1] - radii[0]);
            let inner = rings.iter().map(|[share, bulge]| [*share, (even(*share) + bulge * of.length).max(0.0)]);
            let all: Vec<[f32; 2]> = [[0.0, radii[0]]].into_iter().chain(inner).chain([[1.0, radii[1]]]).collect();
            let frustum = |pair: &[[f32; 2]]| {
                let [[from, a], [to, b]] = [pair[0], pair[1]].map(|ring| ring.map(f64::from));
                (to - from) * f64::from(of.length) * (a * a + b * b + a * b) * 2.0 / 3.0
            };
            let expected: f64 = all.windows(2).map(frustum).sum();
            let measured = volume(&vertices, &faces);
            assert!((measured / expected - 1.0).abs() < 1e-4, "{radii:?}: {measured} {expected}");
        }
    }

    fn tilted(degrees: f64, from: &Frustum, radii: [f32; 2]) -> Frustum {
        let (sin, cos) = phytomer_sim::math::sincos(degrees.to_radians());
        let (sin, cos) = (sin as f32, cos as f32);
        let (h, up) = (from.heading, from.up);
        let heading = [0, 1, 2].map(|k| cos * h[k] + sin * up[k]);
        let up = [0, 1, 2].map(|k| cos * up[k] - sin * h[k]);
        Frustum { base: Ring::tip(from).middle, heading, up, length: 1.1, radii }
    }

    /// Two square prisms at an angle are both closed, meet corner by corner, and each has the volume that it has alone:
    /// a mitre takes a wedge on one side and gives the same on the other. A sharper bend than 120 degrees is not
    /// mitred.
    #[test]
    fn a_bend_is_mitred_and_takes_no_volume() {
        let section = Section::of(vec![[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]], true);
        let from = frustum([0.2, 0.2]);
        for degrees in [0.0, 5.0, 40.0, 90.0, -110.0, 130.0] {
            let on = tilted(degrees, &from, [0.2, 0.2]);
            let [tip, base] = [Ring::tip(&from), Ring::base(&on)];
            let (below, faces) = drawn(&section, [Ring::base(&from), tip.mitred(&base)]);
            let (above, _) = drawn(&section, [base.after(&tip), Ring::tip(&on)]);
            let apart = (0..5).map(|k| {
                let [a, b] = [below[5 + k].position(), above[k].position()];
                (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f32::max)
            });
            let apart = apart.fold(0.0, f32::max);
            assert_eq!(apart < 1e-6, degrees < 120.0, "{degrees}: {apart}");
            for (vertices, length) in [(&below, 1.5), (&above, 1.1)] {
                assert_closed(vertices, &faces);
                assert_unit_normals(vertices);
                let measured = volume(vertices, &faces);
                assert!((measured / (2.0 * 0.04 * length) - 1.0).abs() < 1e-5, "{degrees}: {measured}");
            }
        }
    }

    /// An open section of two sides, each half the width long, is a strip of twice half the width times the length.
    #[test]
    fn an_open_section_is_a_bent_strip() {
        let section = Section::of(vec![[0.0, 1.0], [0.0, 0.0], [1.0, 0.0]], false);
        let of = frustum([0.4, 0.4]);
        let (vertices, faces) = drawn(&section, [Ring::base(&of), Ring::tip(&of)]);
        assert_eq!((vertices.len(), faces.len()), (6, 4));
        assert_unit_normals(&vertices);
        assert!((surface(&vertices, &faces) - 2.0 * 0.4 * 1.5).abs() < 1e-6);
    }
}
