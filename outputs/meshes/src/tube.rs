//! Internodes as closed tubes (frusta with a regular polygon across, as the hexagonal cones of de Reffye 1988 §6), or
//! as plane strips where they are segments of a petal or of a blade.
//!
//! The side has normals that lean with its slope, the two caps have axial normals, so each ring is there twice. The
//! ring of the side ends on a vertex of its own, so that the texture runs once around (s) and from base to tip (t).
//! With n sides there are 4n + 2 vertices and 4n − 4 triangles. The polygon has the area of the circle with the
//! diameter, so that a tube keeps the section of its internode at every height, and its volume; its corners are √(2π /
//! (n sin 2π/n)) radii from the axis line, 1.054 for eight sides.

use super::chunk::{Tag, Vertex};
use glam::Vec3;
use phytomer_sim::math::{sin, sincos};

/// An internode as a frustum, in metres and unit vectors.
#[derive(Debug, Clone, Copy)]
pub struct Frustum {
    /// The centre of its base.
    pub base: [f32; 3],
    /// The direction along it.
    pub heading: [f32; 3],
    /// A direction across it.
    pub up: [f32; 3],
    /// Its length.
    pub length: f32,
    /// The radii at its base and at its tip.
    pub radii: [f32; 2],
}

/// The corners and triangles of a tube with a fixed number of sides, computed once per mesh.
#[derive(Debug, Clone)]
pub struct Tube {
    /// For each corner its cosine, sine and share of the way around; the first corner is repeated at the end.
    corners: Vec<[f32; 3]>,
    /// The distance of a corner from the axis line, in radii.
    reach: f32,
    faces: Vec<[u32; 3]>,
}

impl Tube {
    /// Tubes with `sides` sides, at least 3.
    pub fn new(sides: u8) -> Self {
        let sides = u32::from(sides.max(3));
        let corner = |k: u32| {
            let share = f64::from(k) / f64::from(sides);
            let (sin, cos) = sincos(std::f64::consts::TAU * f64::from(k % sides) / f64::from(sides));
            [cos as f32, sin as f32, share as f32]
        };
        let part = std::f64::consts::TAU / f64::from(sides);
        let reach = (part / sin(part)).sqrt() as f32;
        Self { corners: (0..=sides).map(corner).collect(), reach, faces: faces(sides) }
    }

    /// The number of its sides.
    pub fn sides(&self) -> u16 {
        self.corners.len() as u16 - 1
    }

    /// The number of vertices of a tube.
    pub fn vertices(&self) -> usize {
        4 * self.corners.len() - 2
    }

    /// The distance of a corner from the axis line, in radii.
    #[inline]
    pub fn reach(&self) -> f32 {
        self.reach
    }

    /// For each corner its cosine, sine and share of the way around; the first is repeated at the end.
    pub fn corners(&self) -> &[[f32; 3]] {
        &self.corners
    }

    /// How many of them, the first, stand around it; the others are its ends.
    pub fn around(&self) -> usize {
        2 * self.corners.len()
    }

    /// The triangles of a tube, by the indices of its own vertices, counterclockwise from outside.
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// Replaces `rings` by the places of the corners at its base and at its tip.
    #[inline]
    pub fn rings(&self, frustum: &Frustum, rings: &mut [Vec<Vec3>; 2]) {
        let [base, heading, up] = [frustum.base, frustum.heading, frustum.up].map(Vec3::from_array);
        let side = heading.cross(up);
        let middles = [base, base + frustum.length * heading];
        for ((ring, middle), radius) in rings.iter_mut().zip(middles).zip(frustum.radii) {
            let radius = radius * self.reach;
            ring.clear();
            let corners = &self.corners[..self.corners.len() - 1];
            ring.extend(corners.iter().map(|[cos, sin, _]| middle + radius * (*cos * up + *sin * side)));
        }
    }

    /// Writes the vertices of one tube; `out` must have exactly [`Tube::vertices`] places.
    #[inline]
    pub fn write(&self, frustum: &Frustum, tag: &Tag, out: &mut [Vertex]) {
        let Frustum { base, heading: h, up, length, radii } = *frustum;
        let side = cross(h, up);
        let tip = [base[0] + length * h[0], base[1] + length * h[1], base[2] + length * h[2]];
        let lean = lean(length, radii[0] - radii[1]);
        let radii = radii.map(|radius| radius * self.reach);
        let down = [-h[0], -h[1], -h[2]];
        let ring = self.corners.len();
        let (low, out) = out.split_at_mut(ring);
        let (high, out) = out.split_at_mut(ring);
        let (bottom, top) = out.split_at_mut(ring - 1);
        for (k, &[cos, sin, share]) in self.corners.iter().enumerate() {
            let radial = [0, 1, 2].map(|i| cos * up[i] + sin * side[i]);
            let at_base = [0, 1, 2].map(|i| base[i] + radii[0] * radial[i]);
            let at_tip = [0, 1, 2].map(|i| tip[i] + radii[1] * radial[i]);
            let normal = [0, 1, 2].map(|i| lean[0] * radial[i] + lean[1] * h[i]);
            low[k] = Vertex::new(at_base, normal, [share, 0.0], tag);
            high[k] = Vertex::new(at_tip, normal, [share, 1.0], tag);
            if k + 1 < ring {
                let round = [0.5 + 0.5 * cos, 0.5 + 0.5 * sin];
                bottom[k] = Vertex::new(at_base, down, round, tag);
                top[k] = Vertex::new(at_tip, h, round, tag);
            }
        }
    }
}

/// A plane internode: a strip as wide as its diameters, facing its upper side.
#[derive(Debug, Clone, Copy)]
pub struct Strip;

impl Strip {
    /// The number of vertices of a strip.
    pub const VERTICES: usize = 4;
    /// Its triangles, counterclockwise from its upper side.
    pub const FACES: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

    /// Writes the vertices of one strip; `out` must have exactly [`Strip::VERTICES`] places. Strips of an axis that
    /// bends in its own plane join without a gap.
    #[inline]
    pub fn write(frustum: &Frustum, tag: &Tag, out: &mut [Vertex]) {
        let Frustum { base, heading: h, up, length, radii } = *frustum;
        let left = cross(up, h);
        let tip = [0, 1, 2].map(|i| base[i] + length * h[i]);
        let corners = [(base, -radii[0], 0.0), (tip, -radii[1], 1.0), (tip, radii[1], 1.0), (base, radii[0], 0.0)];
        for ((middle, aside, along), vertex) in corners.into_iter().zip(out) {
            let at = [0, 1, 2].map(|i| middle[i] + aside * left[i]);
            let share = if aside < 0.0 { 0.0 } else { 1.0 };
            *vertex = Vertex::new(at, up, [share, along], tag);
        }
    }
}

/// The normal of the side as its parts along the radius and along the axis.
#[inline]
pub(super) fn lean(length: f32, narrowing: f32) -> [f32; 2] {
    let norm = (length * length + narrowing * narrowing).sqrt();
    if norm > 0.0 { [length / norm, narrowing / norm] } else { [1.0, 0.0] }
}

fn faces(sides: u32) -> Vec<[u32; 3]> {
    let ring = sides + 1;
    let side = (0..sides).flat_map(|k| [[k, k + 1, ring + k + 1], [k, ring + k + 1, ring + k]]);
    let (bottom, top) = (2 * ring, 2 * ring + sides);
    let caps = (1..sides - 1).flat_map(|k| [[bottom, bottom + k + 1, bottom + k], [top, top + k, top + k + 1]]);
    side.chain(caps).collect()
}

/// The vector product.
#[inline]
pub(super) fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::super::chunk::Face;
    use super::super::measure::{assert_closed, assert_unit_normals, outward_share, volume};
    use super::*;
    use bytemuck::Zeroable;

    const TAG: Tag = Tag { colour: [9, 9, 9, 255], birth: 1.0, death: f32::INFINITY, component: 0, kind: 0 };

    fn tube(sides: u8, frustum: &Frustum) -> (Vec<Vertex>, Vec<Face>) {
        let tube = Tube::new(sides);
        let mut vertices = vec![Vertex::zeroed(); tube.vertices()];
        tube.write(frustum, &TAG, &mut vertices);
        (vertices, tube.faces().iter().map(|&face| Face::new(face)).collect())
    }

    fn leaning(length: f32, radii: [f32; 2]) -> Frustum {
        Frustum { base: [0.1, -0.2, 0.3], heading: [0.6, 0.0, 0.8], up: [0.8, 0.0, -0.6], length, radii }
    }

    /// V = π h/3 · (r₁² + r₂² + r₁r₂), whatever the number of sides.
    #[test]
    fn a_tube_is_closed_and_has_the_volume_of_the_round_frustum() {
        for sides in [3, 4, 6, 8, 17, 255] {
            for radii in [[0.4, 0.4], [0.5, 0.2], [0.1, 0.6]] {
                let (vertices, faces) = tube(sides, &leaning(1.5, radii));
                let n = usize::from(sides);
                assert_eq!((vertices.len(), faces.len()), (4 * n + 2, 4 * n - 4));
                assert_closed(&vertices, &faces);
                assert_unit_normals(&vertices);
                assert_eq!(outward_share(&vertices, &faces), 1.0);
                let [a, b] = radii.map(f64::from);
                let expected = std::f64::consts::PI * 1.5 / 3.0 * (a * a + b * b + a * b);
                let measured = volume(&vertices, &faces);
                assert!((measured / expected - 1.0).abs() < 1e-5, "{sides} sides {radii:?}: {measured} {expected}");
            }
        }
    }

    #[test]
    fn a_strip_is_plane_and_seen_from_above() {
        for radii in [[0.3, 0.2], [0.2, 0.4], [0.25, 0.0]] {
            let mut vertices = vec![Vertex::zeroed(); Strip::VERTICES];
            Strip::write(&leaning(1.5, radii), &TAG, &mut vertices);
            let faces: Vec<Face> = Strip::FACES.iter().map(|&face| Face::new(face)).collect();
            assert_unit_normals(&vertices);
            let area = |face: &Face| outward_share(&vertices, std::slice::from_ref(face));
            let empty = faces.iter().filter(|face| area(face) == 0.0).count();
            assert_eq!(empty, usize::from(radii[1] == 0.0), "{radii:?}");
        }
    }

    #[test]
    fn normals_are_unit_where_there_is_hardly_a_tube() {
        for (length, radii) in [(0.0, [0.0, 0.0]), (0.0, [0.1, 0.0]), (1e-20, [0.1, 0.1]), (2.0, [0.1, 0.0])] {
            assert_unit_normals(&tube(8, &leaning(length, radii)).0);
        }
    }

    #[test]
    fn the_side_leans_with_the_cone() {
        let (vertices, _) = tube(8, &Frustum { radii: [0.3, 0.2], ..leaning(0.1, [0.0; 2]) });
        let normal = vertices[0].normal();
        let along: f32 = (0..3).map(|k| normal[k] * [0.6, 0.0, 0.8][k]).sum();
        assert!((along - 0.5_f32.sqrt()).abs() < 1e-6);
    }
}
