//! The rings of a reduced tube: how many sides they have, their vertices, and the triangles between them.
//!
//! A ring of radius r has n = ⌈π / arccos(1 − e/r)⌉ sides within the tolerance e, so that a side of the polygon inside
//! the circle is at most e from it; at least 3. Drawn is the polygon of the circle's area, as in tubes of single
//! internodes (`tube`): its corners are at most 2e/3 outside of the circle and the middles of its sides at most e/2
//! inside. For pictures it is the polygon of the circle's circumference, whose sides may lie 0.8 e inside. Rings of
//! different numbers of sides are joined corner to nearest corner, n + m triangles.

use super::super::Keeping;
use super::super::chunk::{Face, Tag, Vertex};
use glam::Vec3;
use phytomer_sim::math::{acos, sin, sincos};
use std::f64::consts::{PI, TAU};

/// The most sides of a ring, far above what the smallest tolerance asks of any wood: a ring must fit into a chunk.
const MOST_SIDES: f64 = 8192.0;

/// The number of sides of a ring of `radius` within a tolerance, metres.
#[inline]
pub fn sides(radius: f32, tolerance: f32) -> u16 {
    if radius > 2.0 * tolerance {
        let part = acos(1.0 - f64::from(tolerance) / f64::from(radius));
        (PI / part).ceil().clamp(3.0, MOST_SIDES) as u16
    } else {
        3
    }
}

/// Around the unit circle the corners of the polygon of so many sides that has its area.
pub fn corners_of_area(sides: u16) -> Vec<[f32; 2]> {
    let Polygon { corners, reach } = Polygon::of(sides, Keeping::Section);
    corners[..usize::from(sides)].iter().map(|[cos, sin, _]| [cos * reach, sin * reach]).collect()
}

/// How the triangles between two rings of n and m sides go around, n + m of them: for each whether its side is one of
/// the first ring, and the corners of both rings that it begins at.
pub fn meeting([n, m]: [u32; 2]) -> impl Iterator<Item = (bool, [u32; 2])> {
    let (mut i, mut j) = (0, 0);
    (0..n + m).map(move |_| {
        let at = [i, j];
        // The ring whose next side has its middle earlier on the way around goes on.
        let lower = i < n && (j == m || (2 * i + 1) * m <= (2 * j + 1) * n);
        if lower {
            i += 1
        } else {
            j += 1
        }
        (lower, at)
    })
}

/// The corners of the polygon of a number of sides.
#[derive(Debug, Clone, Default)]
pub struct Polygon {
    /// For each corner its cosine, sine and share of the way around; the first corner is repeated at the end.
    corners: Vec<[f32; 3]>,
    /// The distance of a corner from the middle, in radii of the circle.
    reach: f32,
}

impl Polygon {
    /// The polygon of so many sides that keeps the area of a circle, its circumference, or that of another polygon.
    pub fn of(sides: u16, keeps: Keeping) -> Self {
        let count = f64::from(sides);
        let corner = |k: u16| {
            let (sin, cos) = sincos(TAU * f64::from(k % sides) / count);
            [cos as f32, sin as f32, (f64::from(k) / count) as f32]
        };
        let of_area = |count: f64| (TAU / count / sin(TAU / count)).sqrt();
        let reach = match keeps {
            Keeping::Section => of_area(count),
            Keeping::Width => PI / count / sin(PI / count),
            Keeping::Tube(sides) => {
                let of = f64::from(sides.max(3));
                of_area(of) * of * sin(PI / of) / (count * sin(PI / count))
            }
        };
        Self { corners: (0..=sides).map(corner).collect(), reach: reach as f32 }
    }

    /// Whether it has been made.
    pub fn is_empty(&self) -> bool {
        self.corners.is_empty()
    }
}

/// Where a ring is and how it is turned.
#[derive(Debug, Clone, Copy)]
pub struct Place {
    /// Its middle.
    pub at: Vec3,
    /// The unit vector along the tube.
    pub along: Vec3,
    /// The unit vector towards its first corner.
    pub up: Vec3,
    /// Its radius.
    pub radius: f32,
    /// The parts of the normal of the side along the radius and along the tube.
    pub lean: [f32; 2],
    /// The number of internodes below it.
    pub below: f32,
}

impl Place {
    #[inline]
    fn radial(&self, side: Vec3, [cos, sin, _]: [f32; 3]) -> Vec3 {
        self.up * cos + side * sin
    }

    /// Replaces `out` by the places of its corners.
    pub fn corners(&self, polygon: &Polygon, out: &mut Vec<Vec3>) {
        let side = self.along.cross(self.up);
        let corners = &polygon.corners[..polygon.corners.len().saturating_sub(1)];
        out.clear();
        out.extend(corners.iter().map(|corner| self.at + self.radial(side, *corner) * (self.radius * polygon.reach)));
    }

    /// Writes the ring of the side: a vertex a corner, the first one again at the end.
    pub fn write_side(&self, polygon: &Polygon, tag: &Tag, out: &mut [Vertex]) {
        let side = self.along.cross(self.up);
        for (corner, out) in polygon.corners.iter().zip(out) {
            let radial = self.radial(side, *corner);
            let at = self.at + radial * (self.radius * polygon.reach);
            let normal = radial * self.lean[0] + self.along * self.lean[1];
            *out = Vertex::new(at.to_array(), normal.to_array(), [corner[2], self.below], tag);
        }
    }

    /// Writes the ring of a cap, a vertex a corner; `outward` is its normal along the tube, −1 or 1.
    pub fn write_cap(&self, polygon: &Polygon, outward: f32, tag: &Tag, out: &mut [Vertex]) {
        let side = self.along.cross(self.up);
        let normal = (self.along * outward).to_array();
        for (corner, out) in polygon.corners.iter().zip(out) {
            let at = self.at + self.radial(side, *corner) * (self.radius * polygon.reach);
            *out = Vertex::new(at.to_array(), normal, [0.5 + 0.5 * corner[0], 0.5 + 0.5 * corner[1]], tag);
        }
    }
}

/// Writes the n + m triangles between two rings, by the indices of their first vertices and their numbers of sides.
pub fn join([a, n]: [u32; 2], [b, m]: [u32; 2], out: &mut [Face]) {
    for ((lower, [i, j]), out) in meeting([n, m]).zip(out) {
        *out = Face::new(if lower { [a + i, a + i + 1, b + j] } else { [a + i, b + j + 1, b + j] });
    }
}

/// Writes the n − 2 triangles of a cap; those of the lower end face the other way.
pub fn close([first, n]: [u32; 2], lower: bool, out: &mut [Face]) {
    for (k, out) in (1..n).zip(out) {
        let [a, b] = if lower { [k + 1, k] } else { [k, k + 1] };
        *out = Face::new([first, first + a, first + b]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sagitta of a side is within the tolerance, and a polygon of one side fewer is not.
    #[test]
    fn the_number_of_sides_is_the_least_within_the_tolerance() {
        use phytomer_sim::math::cos;
        for (radius, tolerance) in [(0.1_f32, 1e-3_f32), (0.25, 5e-4), (0.01, 4e-3), (0.004, 1e-4), (2.0, 1e-5)] {
            let count = f64::from(sides(radius, tolerance));
            let sagitta = |count: f64| f64::from(radius) * (1.0 - cos(PI / count));
            assert!(sagitta(count) <= f64::from(tolerance) * 1.000_001, "{radius} {tolerance}");
            assert!(count == 3.0 || sagitta(count - 1.0) > f64::from(tolerance), "{radius} {tolerance}");
        }
        assert_eq!([sides(0.0, 1e-3), sides(1e-9, 1e-3), sides(2e-3, 1e-3), sides(f32::NAN, 1e-3)], [3, 3, 3, 3]);
        assert_eq!(sides(1e9, 1e-5), 8192);
    }

    /// Corners stand out by at most 2e/3 and sides cut in by at most e/2, as the bound of the whole mesh needs it; of a
    /// triangle, any point of the circle is near a side.
    #[test]
    fn a_polygon_of_equal_area_is_near_the_circle() {
        use phytomer_sim::math::cos;
        for sides in 3_u16..400 {
            let polygon = Polygon::of(sides, Keeping::Section);
            let part = PI / f64::from(sides);
            let around = 2.0 * f64::from(sides) * f64::from(Polygon::of(sides, Keeping::Width).reach) * sin(part);
            assert!((around / TAU - 1.0).abs() < 1e-6);
            // The largest circle, in tolerances, that has so many sides.
            let radius = 1.0 / (1.0 - cos(part));
            let apothem = f64::from(polygon.reach) * cos(part);
            let at_corner = (apothem - cos(part)) * radius;
            assert!(at_corner < 0.67 && (1.0 - apothem) * radius < 0.5, "{sides}: {at_corner}");
            let area = 0.5 * f64::from(sides) * f64::from(polygon.reach * polygon.reach) * sin(2.0 * part);
            assert!((area / PI - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn rings_of_any_sides_are_joined_once_around() {
        for (n, m) in [(3, 3), (8, 8), (3, 8), (9, 4), (100, 3), (5, 6)] {
            let mut faces = vec![Face::new([0; 3]); (n + m) as usize];
            join([0, n], [n + 1, m], &mut faces);
            let on = |lower: bool| {
                let two = |face: &&Face| face.indices().iter().filter(|&&index| (index <= n) == lower).count() == 2;
                faces.iter().filter(two).count() as u32
            };
            assert_eq!([on(true), on(false)], [n, m]);
            let last = faces.last().map(Face::indices);
            assert!(last.is_some_and(|last| last.contains(&n) && last.contains(&(n + 1 + m))));
        }
    }
}
