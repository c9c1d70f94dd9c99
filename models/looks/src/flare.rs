//! The flare of a trunk: how it widens into its roots.
//!
//! Trees put wood where stress is high until it is even, so the foot of a trunk widens towards its roots along a curve
//! that tension triangles draw: 45 degrees at the ground, and half as steep a slope from the middle of each triangle on
//! (Mattheck, Kappel & Sauer 2007). Three triangles over a width w end 2.36 w above the ground. The profile here,
//! (1 − h)² (1 − h/2) of the share h of the height, is within 0.06 of theirs. Where roots leave the trunk the foot has
//! lobes; between two of them less of it flares. Absent: triangles (`phytomer_meshes`), and tables, which have the
//! diameters of the wood without the flare.

use phytomer_sim::math::cos;
use std::f64::consts::TAU;

/// The height of three tension triangles over their width.
const TRIANGLES: f64 = 2.36;

/// How the foot of a trunk widens.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "files", serde(deny_unknown_fields))]
pub struct Flare {
    /// How far the foot reaches beyond the trunk at the ground, to each side, as a share of the diameter of the trunk
    /// there: 0.5 is a foot that is twice as wide.
    #[cfg_attr(feature = "files", schemars(range(min = 0.01, max = 5.0)))]
    pub width: f64,
    /// How high the flare is, in diameters of the trunk at the ground. Left out: 2.36 times the width, as tension
    /// triangles have it.
    #[cfg_attr(feature = "files", serde(default, skip_serializing_if = "Option::is_none"))]
    #[cfg_attr(feature = "files", schemars(range(min = 0.01, max = 20.0)))]
    pub height: Option<f64>,
    /// The roots or buttresses that leave the foot; left out: it is round.
    #[cfg_attr(feature = "files", serde(default, skip_serializing_if = "is_zero"))]
    #[cfg_attr(feature = "files", schemars(range(max = 16)))]
    pub lobes: u32,
    /// How much less the foot widens between two lobes, from 0, not less, to 1, not at all.
    #[cfg_attr(feature = "files", serde(default, skip_serializing_if = "is_none"))]
    #[cfg_attr(feature = "files", schemars(range(min = 0.0, max = 1.0)))]
    pub depth: f64,
}

#[cfg(feature = "files")]
fn is_zero(lobes: &u32) -> bool {
    *lobes == 0
}

#[cfg(feature = "files")]
fn is_none(depth: &f64) -> bool {
    *depth == 0.0
}

impl Flare {
    /// Its height, in diameters of the trunk.
    pub fn height(&self) -> f64 {
        self.height.unwrap_or(TRIANGLES * self.width)
    }

    /// By how many radii of the trunk the foot is wider, at a share of its height and an angle around it.
    pub fn wider(&self, share: f64, angle: f64) -> f64 {
        let left = (1.0 - share).clamp(0.0, 1.0);
        let between =
            if self.lobes == 0 { 0.0 } else { 0.5 * (1.0 - cos(f64::from(self.lobes) * angle.rem_euclid(TAU))) };
        2.0 * self.width * left * left * (1.0 - 0.5 * share.clamp(0.0, 1.0)) * (1.0 - self.depth * between)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The corners of three tension triangles over the width 1: at 45, 67.5 and 78.75 degrees above the ground,
    /// by their tangents.
    #[test]
    fn the_profile_is_that_of_tension_triangles() {
        let flare = Flare { width: 0.5, height: None, lobes: 0, depth: 0.0 };
        let mut at = [1.0_f64, 0.0];
        for (steep, stretch) in [(1.0, 0.5), (2.4142, 0.5), (5.0273, 1.0)] {
            let [wide, high] = [flare.wider(at[1] / TRIANGLES, 0.0), at[1]];
            assert!((wide - at[0]).abs() < 0.06, "{wide} and not {} at {high}", at[0]);
            let down = at[0] * stretch;
            at = [at[0] - down, at[1] + down * steep];
        }
        assert!((at[1] - TRIANGLES).abs() < 0.01 && at[0] == 0.0, "{at:?}");
        assert_eq!((flare.height(), flare.wider(1.0, 0.0), flare.wider(2.0, 1.0)), (1.18, 0.0, 0.0));
    }

    #[test]
    fn between_two_lobes_less_flares() {
        let flare = Flare { width: 0.5, height: Some(2.0), lobes: 4, depth: 0.75 };
        let [lobe, between] = [0.0, TAU / 8.0].map(|angle| flare.wider(0.0, angle));
        assert!((lobe - 1.0).abs() < 1e-12 && (between - 0.25).abs() < 1e-12, "{lobe} {between}");
    }
}
