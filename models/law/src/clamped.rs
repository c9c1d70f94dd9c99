//! Values within bounds, the means of random variables that are clamped to bounds, and the moments of logarithms.

use super::quantile::{density, phi};
use phytomer_sim::math;

/// A value within bounds.
// Parameters are finite, so that no value is without order: one instruction a bound.
#[inline(always)]
pub(super) fn clamp(value: f64, low: f64, high: f64) -> f64 {
    let value = if value < low { low } else { value };
    if value > high { high } else { value }
}

/// The bounds to which a random variable is clamped; its means are those of the clamped variable.
pub(super) struct Clamped {
    pub low: f64,
    pub high: f64,
}

impl Clamped {
    /// The mean of a uniform variable between `a` and `b`.
    pub fn uniform(&self, a: f64, b: f64) -> f64 {
        if a == b || self.low >= b || self.high <= a {
            return clamp(a, self.low, self.high);
        }
        let (low, high) = (self.low.max(a), self.high.min(b));
        ((low - a) * low + (high - low) * (low + high) / 2.0 + (b - high) * high) / (b - a)
    }

    /// E[clamp(X)] = l Φ(α) + m (Φ(β) − Φ(α)) − s (φ(β) − φ(α)) + h (1 − Φ(β)), α = (l − m)/s, β = (h − m)/s, of a
    /// normal variable of mean m and standard deviation s.
    pub fn normal(&self, m: f64, s: f64) -> f64 {
        let (alpha, beta) = ((self.low - m) / s, (self.high - m) / s);
        m * (phi(beta) - phi(alpha)) - s * (density(beta) - density(alpha))
            + part(self.low, phi(alpha))
            + part(self.high, phi(-beta))
    }

    /// As the normal's, with E[X; l < X < h] = exp(μ + s²/2) (Φ(β − s) − Φ(α − s)).
    pub fn lognormal(&self, m: f64, s: f64) -> f64 {
        let standard = |bound: f64| if bound > 0.0 { (math::log(bound) - m) / s } else { f64::NEG_INFINITY };
        let (alpha, beta) = (standard(self.low), standard(self.high));
        math::exp(m + s * s / 2.0) * (phi(beta - s) - phi(alpha - s))
            + part(self.low, phi(alpha))
            + part(self.high, phi(-beta))
    }
}

/// A bound times the probability of being clamped to it; nothing for an infinite bound.
fn part(bound: f64, probability: f64) -> f64 {
    if probability == 0.0 { 0.0 } else { bound * probability }
}

/// Mean and standard deviation of the logarithm from those of the variable.
pub(super) fn of_logarithm([mean, sd]: [f64; 2]) -> [f64; 2] {
    let variance = math::log1p((sd / mean) * (sd / mean));
    [math::log(mean) - variance / 2.0, variance.sqrt()]
}
