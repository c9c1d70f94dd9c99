//! The points of a skin as files have them: on a grid, each at a place of its own, with normals.
//!
//! Absent: vertices, which have the tags of their internodes (`mod`).

use super::skin::Skin;
use glam::Vec3;
use std::collections::HashSet;

/// Puts points on a grid of [`STEP`], and moves those apart that have one place on it: readers merge what is nearer
/// than a hundredth of a micrometre.
pub fn part(skin: &mut Skin) {
    let mut places: HashSet<[u32; 3]> = HashSet::with_capacity(skin.points.len());
    for (number, point) in skin.points.iter_mut().enumerate() {
        if point.one as usize != number {
            continue;
        }
        point.at = point.at.map(on_grid);
        while !places.insert(point.at.map(f32::to_bits)) && point.at[0].is_finite() {
            point.at[0] = on_grid(point.at[0] + STEP).max(point.at[0].next_up());
        }
    }
}

/// The grid of the points of welded wood, 2⁻²⁴ m: from a metre on all numbers of single precision are on it.
const STEP: f32 = 1.0 / 16_777_216.0;

/// The nearest number on the grid; never -0, which is another number for readers that compare bytes.
fn on_grid(x: f32) -> f32 {
    if x.abs() < 1.0 { (x / STEP).round() * STEP + 0.0 } else { x }
}

/// The unit normal of each point: the sum of those of its triangles, each by its area.
pub fn normals(skin: &Skin) -> Vec<Vec3> {
    let mut sums = vec![Vec3::ZERO; skin.points.len()];
    for face in &skin.faces {
        let ones = face.map(|corner| skin.points[corner as usize].one as usize);
        let [a, b, c] = ones.map(|one| Vec3::from_array(skin.points[one].at));
        let across = (b - a).cross(c - a);
        ones.into_iter().for_each(|one| sums[one] += across);
    }
    sums.into_iter().map(|sum| sum.try_normalize().unwrap_or(Vec3::Z)).collect()
}
