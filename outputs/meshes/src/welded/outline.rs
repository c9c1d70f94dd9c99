//! Outlines of rings: how far the skin is from the axis line in each direction, in radii.
//!
//! A round stem has the regular polygon of its circle's area, as in tubes (`tube`); a stem with a closed cross section
//! has that section, where each ray from the axis line meets it once. Absent: where rings are (`course`).

use phytomer_looks::Section;
use phytomer_sim::math::{atan2, sin, sincos};
use std::f64::consts::{PI, TAU};

/// A corner of an outline.
#[derive(Debug, Clone, Copy)]
pub struct Corner {
    /// Its angle, from 0 to 2π, rising from corner to corner.
    pub angle: f64,
    /// The cosine and the sine of the angle.
    pub turned: [f64; 2],
    /// Its distance from the axis line, in radii.
    pub reach: f64,
}

/// An outline, counterclockwise against the heading.
#[derive(Debug, Clone, Default)]
pub struct Outline {
    corners: Vec<Corner>,
    /// Whether the corners stand at equal angles from 0 on.
    regular: bool,
    is_lobed: bool,
}

impl Outline {
    /// The regular polygon of the area of the unit circle; at least three sides.
    pub fn regular(sides: u16) -> Self {
        let count = f64::from(sides.max(3));
        let reach = (TAU / count / sin(TAU / count)).sqrt();
        let corner = |k: u16| {
            let angle = TAU * f64::from(k) / count;
            let (sin, cos) = sincos(angle);
            Corner { angle, turned: [cos, sin], reach }
        };
        Self { corners: (0..sides.max(3)).map(corner).collect(), regular: true, is_lobed: false }
    }

    /// A polygon of so many corners at equal angles, each as far out as `reach` tells of its angle.
    pub fn lobed(corners: u32, reach: impl Fn(f64) -> f64) -> Self {
        let corner = |k: u32| {
            let angle = TAU * f64::from(k) / f64::from(corners);
            let (sin, cos) = sincos(angle);
            Corner { angle, turned: [cos, sin], reach: reach(angle) }
        };
        Self { corners: (0..corners).map(corner).collect(), regular: true, is_lobed: true }
    }

    /// Whether it goes in and out, so that not all of it is seen from each of its corners.
    pub fn is_lobed(&self) -> bool {
        self.is_lobed
    }

    /// A closed section; `None` where it is open, or where a ray from the axis line meets it more than once.
    pub fn of_section(section: &Section) -> Option<Self> {
        if !section.is_closed() || section.corners().len() < 3 {
            return None;
        }
        let corner = |&[x, y]: &[f32; 2]| {
            let (x, y) = (f64::from(x), f64::from(y));
            let reach = (x * x + y * y).sqrt();
            let angle = atan2(y, x).rem_euclid(TAU);
            Corner { angle: if angle < TAU { angle } else { 0.0 }, turned: [x / reach, y / reach], reach }
        };
        let mut corners: Vec<Corner> = section.corners().iter().map(corner).collect();
        let first = (0..corners.len()).min_by(|a, b| corners[*a].angle.total_cmp(&corners[*b].angle))?;
        corners.rotate_left(first);
        let steps = (0..corners.len()).map(|k| step(&corners, k));
        let star = corners.iter().all(|corner| corner.reach > 1e-6)
            && steps.into_iter().all(|step| step > 1e-6 && step < 0.95 * PI);
        star.then_some(Self { corners, regular: false, is_lobed: false })
    }

    /// Its corners, by their angles.
    pub fn corners(&self) -> &[Corner] {
        &self.corners
    }

    /// The distance of the outline from the axis line at an angle, in radii.
    pub fn reach(&self, angle: f64) -> f64 {
        let (count, angle) = (self.corners.len(), angle.rem_euclid(TAU));
        let after = if self.regular {
            (angle / TAU * count as f64) as usize + 1
        } else {
            self.corners.partition_point(|corner| corner.angle <= angle)
        };
        let (before, next) = (after.min(count).checked_sub(1).unwrap_or(count - 1), after % count);
        let [a, b] = [&self.corners[before], &self.corners[next]];
        // Where a ray at an angle φ from the first of two corners a and b at the angle ω meets the line between them:
        // r = a b sin ω / (a sin φ + b sin (ω - φ)).
        let (whole, part) = (step(&self.corners, before), (angle - a.angle).rem_euclid(TAU));
        let below = a.reach * sin(part) + b.reach * sin(whole - part);
        if below > 0.0 { a.reach * b.reach * sin(whole) / below } else { a.reach }
    }
}

/// The angle from a corner to the next.
fn step(corners: &[Corner], from: usize) -> f64 {
    let next = corners.get(from + 1).map_or(corners[0].angle + TAU, |next| next.angle);
    next - corners[from].angle
}

#[cfg(test)]
mod tests {
    use super::*;
    use phytomer_sim::math::cos;

    /// The polygon is as far as its sides are, r cos(π/n) / cos(φ) at φ from the middle of a side.
    #[test]
    fn a_regular_outline_runs_along_its_sides() {
        for sides in [3_u16, 4, 8, 17, 100] {
            let outline = Outline::regular(sides);
            let (part, corner) = (TAU / f64::from(sides), outline.corners()[0].reach);
            for step in -50..200 {
                let angle = 0.1 * f64::from(step);
                let from_middle = angle.rem_euclid(part) - 0.5 * part;
                let expected = corner * cos(0.5 * part) / cos(from_middle);
                assert!((outline.reach(angle) - expected).abs() < 1e-9, "{sides} {angle}");
            }
        }
    }

    #[test]
    fn a_section_is_an_outline_where_each_ray_meets_it_once() {
        let square = Section::of(vec![[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]], true);
        let outline = Outline::of_section(&square).expect("a star");
        for (angle, reach) in [(0.0, 1.0), (PI / 4.0, 0.5_f64.sqrt()), (1.5 * PI, 1.0), (-PI / 4.0, 0.5_f64.sqrt())] {
            assert!((outline.reach(angle) - reach).abs() < 1e-9, "{angle}");
        }
        let l = Section::of(vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]], true);
        let hook = Section::of(vec![[1.0, 1.0], [-1.0, 1.0], [-1.0, 0.9], [0.9, 0.9], [0.9, -1.0], [1.0, -1.0]], true);
        let open = Section::of(vec![[1.0, 0.0], [0.0, 1.0], [-1.0, -1.0]], false);
        assert!([l, hook, open].iter().all(|section| Outline::of_section(section).is_none()));
    }
}
