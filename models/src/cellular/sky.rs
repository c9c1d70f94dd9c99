//! The share of the open sky at a point: how many of evenly spread directions above the horizon meet nothing.
//!
//! Directions follow the golden angle, at heights that part the half sphere into equal areas (Swinbank & Purser 2006,
//! "Fibonacci grids"). What is farther than the stated distance of sight does not shade. Absent: the brightness of the
//! sky.

use phytomer_sim::math::sincos;

/// The number of directions.
const DIRECTIONS: usize = 48;
/// 2π (2 − φ).
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// Directions above the horizon.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sky {
    directions: Vec<[f64; 3]>,
}

impl Sky {
    /// The directions.
    pub fn new() -> Self {
        let direction = |k: usize| {
            let z = (k as f64 + 0.5) / DIRECTIONS as f64;
            let (sin, cos) = sincos(GOLDEN_ANGLE * k as f64);
            let across = (1.0 - z * z).sqrt();
            [across * cos, across * sin, z]
        };
        Self { directions: (0..DIRECTIONS).map(direction).collect() }
    }

    /// The share of the directions in which no point is shut, at steps of `step` up to `sight` from `at`, metres.
    pub fn share(&self, at: [f64; 3], step: f64, sight: f64, shut: impl Fn([f64; 3]) -> bool) -> f64 {
        let steps = (sight / step) as u32;
        let open = |direction: &&[f64; 3]| {
            let along = |n: u32| [0, 1, 2].map(|k| at[k] + direction[k] * step * f64::from(n));
            !(1..=steps).any(|n| shut(along(n)))
        };
        self.directions.iter().filter(open).count() as f64 / DIRECTIONS as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wall that covers half of the horizon shuts half of the sky; a cone about the zenith with the cosine c the
    /// share 1 − c; nothing shuts nothing.
    #[test]
    fn shares_are_those_of_areas() {
        let sky = Sky::new();
        let near = |share: f64, expected: f64| (share - expected).abs() <= 1.0 / DIRECTIONS as f64;
        assert_eq!(sky.share([0.0; 3], 0.1, 5.0, |_| false), 1.0);
        assert!(near(sky.share([0.0; 3], 0.1, 5.0, |at| at[0] > 0.0), 0.5));
        let in_cone = |at: [f64; 3]| at[2] > 0.75 * (at[0] * at[0] + at[1] * at[1] + at[2] * at[2]).sqrt();
        assert!(near(sky.share([0.0; 3], 0.1, 5.0, in_cone), 0.75));
        assert_eq!(sky.share([0.0; 3], 0.1, 5.0, |at| at[2] > 6.0), 1.0, "out of sight");
    }
}
