//! Places by their voxel and by where they lie in it.
//!
//! Places are rounded to 2⁻²⁰ of a voxel before anything is made of them: so a plot that is shifted by whole voxels has
//! the same leaf area in voxels as far on, though its places in metres are rounded otherwise. Absent: voxels (`grid`).

use super::grid::{EDGE, FARTHEST, Grid, Voxel};
use crate::shape::Point;

/// The parts of a voxel's edge to which places are rounded, as a power of 2.
const FINE_BITS: u32 = 20;
/// The parts of a voxel's edge to which places are rounded.
pub(super) const FINE: f64 = (1 << FINE_BITS) as f64;

/// A place by its voxel, and how far it lies from the low corner of it, in edges of a voxel, from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spot {
    /// The voxel, before it is taken back into a plot that repeats.
    pub voxel: Voxel,
    /// The place in it.
    pub inner: [f64; 3],
}

impl Grid {
    /// The voxel of a place, before it is taken back into a plot that repeats.
    pub fn voxel(&self, place: Point) -> Voxel {
        self.fine(place).map(|fine| (fine >> FINE_BITS) as i32)
    }

    /// A place by its voxel.
    pub fn spot(&self, place: Point) -> Spot {
        let fine = self.fine(place);
        let inner = fine.map(|fine| (fine & ((1 << FINE_BITS) - 1)) as f64 / FINE);
        Spot { voxel: fine.map(|fine| (fine >> FINE_BITS) as i32), inner }
    }

    /// A place from the corner of the plot, in fine parts of a voxel's edge. What is no number is at the corner.
    fn fine(&self, place: Point) -> [i64; 3] {
        let most = f64::from(FARTHEST * EDGE) * FINE;
        [0, 1, 2].map(|k| rounded(((place[k] - self.origin[k]) / self.edges[k] * FINE).clamp(-most, most)) as i64)
    }

    /// The place of a spot, metres.
    pub fn place(&self, spot: Spot) -> Point {
        [0, 1, 2].map(|k| self.origin[k] + (f64::from(spot.voxel[k]) + spot.inner[k]) * self.edges[k])
    }

    /// The spot so many metres farther along a unit vector.
    pub fn farther(&self, spot: Spot, way: Point, metres: f64) -> Spot {
        let most = f64::from(FARTHEST * EDGE);
        let (mut voxel, mut inner) = (spot.voxel, spot.inner);
        for k in 0..3 {
            let at = spot.inner[k] + way[k] * metres / self.edges[k];
            let whole = at.floor().clamp(-most, most);
            // A number just below 0 is 1 beyond the number below it.
            inner[k] = (at - whole).clamp(0.0, 1.0);
            voxel[k] = spot.voxel[k].saturating_add(whole as i32);
        }
        Spot { voxel, inner }
    }
}

/// The largest number below ½: what lies just below a half stays below.
const HALF: f64 = 0.499_999_999_999_999_94;

/// The nearest whole number, the farther from 0 of two; for less than 2⁵². Without the call that `round` is on machines
/// that have no instruction for it.
#[inline(always)]
pub(super) fn rounded(number: f64) -> f64 {
    (number + HALF.copysign(number)) as i64 as f64
}

/// The same, for machines that have an instruction for numbers without their parts.
#[cfg(any(test, target_arch = "x86_64"))]
#[inline(always)]
pub(super) fn rounded_by_instruction(number: f64) -> f64 {
    (number + HALF.copysign(number)).trunc()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_are_the_nearest() {
        let near = [0.0_f64, 0.3, 0.499_999_999_999_999_94, 0.5, 0.500_000_000_000_000_1, 0.7, 1.0];
        for whole in [0.0, 1.0, 2.0, 3.0, 1e6 + 1.0, 1e12, 8_796_093_022_207.0] {
            for number in near.map(|near| whole + near) {
                let round = (number.round(), -number.round());
                assert_eq!((rounded(number), rounded(-number)), round, "{number}");
                assert_eq!((rounded_by_instruction(number), rounded_by_instruction(-number)), round, "{number}");
            }
        }
        assert_eq!(rounded(f64::NAN), 0.0);
    }
    use crate::site::light::Lighting;

    /// Places on the faces of voxels and anywhere, at once and a whole number of voxels farther, where they are rounded
    /// otherwise.
    #[test]
    fn whole_voxels_farther_lies_as_much_farther() {
        for edge in [0.1, 0.07, 0.3] {
            let grid = Grid::of(&Lighting { voxel_m: edge, ..Lighting::default() });
            for k in -200..200_i32 {
                for place in [f64::from(k) * edge, f64::from(k) * edge / 3.0 + 0.0123] {
                    for by in [1, 7, 1_000, 123_457] {
                        let there = place + f64::from(by) * edge;
                        let [here, moved] = [place, there].map(|x| grid.spot([x, 0.0, 0.0]));
                        assert_eq!(moved.voxel[0], here.voxel[0] + by, "{place} {by}");
                        assert!((moved.inner[0] - here.inner[0]).abs() <= 1.0 / FINE, "{place} {by}");
                    }
                }
            }
            let spot = grid.spot([1.0, -2.0, 0.04]);
            let far = grid.farther(spot, [0.6, 0.0, 0.8], 2.5);
            for (k, at) in [2.5, -2.0, 2.04].into_iter().enumerate() {
                let found = (f64::from(far.voxel[k]) + far.inner[k]) * edge;
                assert!((found - at).abs() < 2e-6 * edge, "{found} {at}");
            }
        }
    }
}
