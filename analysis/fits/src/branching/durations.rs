//! Lengths of zones: 1 + NB(r, p), with weights of lengths that ended and of lengths that went on.
//!
//! A zone that the shoot's end cuts off has P(length ≥ d). r has an upper limit, since a length that varies less than a
//! Poisson number has no largest likelihood. Absent: the zones.

use crate::nodes::part::Part;
use crate::optimum::near;
use phytomer_sim::math;

/// The largest r.
pub const MOST_R: f64 = 148.0;

/// The law of a length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Length {
    pub r: f64,
    pub p: f64,
}

impl Length {
    /// P(1), P(2) … P(longest).
    pub fn masses(self, longest: usize) -> Vec<f64> {
        Part::NegativeBinomial { r: self.r, p: self.p }.masses(longest.saturating_sub(1))
    }

    /// P(length ≥ 1), P(≥ 2) … of the masses.
    pub fn survivors(masses: &[f64]) -> Vec<f64> {
        let mut left = 1.0;
        let survivor = |mass: &f64| {
            let here = f64::max(left, 1e-15);
            left -= mass;
            here
        };
        masses.iter().map(survivor).collect()
    }

    /// The mean length.
    pub fn mean(self) -> f64 {
        1.0 + self.r * (1.0 - self.p) / self.p
    }

    /// The law of a mean length, for a beginning.
    pub fn of_mean(mean: f64) -> Self {
        let r = 3.0;
        Self { r, p: r / (r + (mean - 1.0).max(0.2)) }
    }

    /// The largest likelihood near this law, from weights of ended and of cut lengths from 1.
    pub fn improved(self, ended: &[f64], cut: &[f64]) -> Self {
        let law = |at: &[f64]| Self { r: math::exp(at[0]), p: 1.0 / (1.0 + math::exp(-at[1])) };
        let value = |at: &[f64]| {
            if at[0] > math::log(MOST_R) || at[0] < -5.0 || at[1].abs() > 12.0 {
                return f64::NEG_INFINITY;
            }
            let masses = law(at).masses(ended.len());
            let survivors = Self::survivors(&masses);
            let sum = |weights: &[f64], of: &[f64]| {
                weights
                    .iter()
                    .zip(of)
                    .filter(|(w, _)| **w > 1e-12)
                    .map(|(w, p)| w * math::log(p.max(1e-300)))
                    .sum::<f64>()
            };
            sum(ended, &masses) + sum(cut, &survivors)
        };
        let start = [math::log(self.r), math::log(self.p) - math::log1p(-self.p)];
        let found = near(&value, &start, 0.15);
        if found.value > value(&start) { law(&found.at) } else { self }
    }
}
