//! Attacks that are aggregated among plants: the beta-binomial distribution (J. G. Skellam 1948, *J. R. Stat. Soc. B*
//! 10: 257–261; for disease in fields G. Hughes & L. V. Madden 1993, *Phytopathology* 83: 759–763).
//!
//! A plant has a susceptibility of its own for a season, the probability that any of its organs is attacked. It has a
//! Beta distribution with mean p and, with a = p (1 − ρ)/ρ and b = (1 − p)(1 − ρ)/ρ, the correlation ρ between two
//! organs of one plant. Of n organs the number attacked has mean n p and variance n p (1 − p)(1 + (n − 1) ρ). Without
//! correlation every plant has the susceptibility p.

use super::draws::Draws;
use super::{DrawError, within};
use phytomer_sim::math::{exp, lgamma};

/// The least correlation that is drawn; below it plants are taken to be equal.
const LEAST: f64 = 1e-6;
/// The least shape that a Beta can be drawn with; a plant is then all or nothing.
const LEAST_SHAPE: f64 = 1e-3;

/// How attacks are spread over plants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aggregation {
    p: f64,
    rho: f64,
}

impl Aggregation {
    /// Attacks of mean probability `p` and correlation `rho` within a plant: 0 spreads them at random, 1 attacks a
    /// plant whole or not at all.
    ///
    /// # Errors
    /// Where one of them is outside [0, 1].
    pub fn new(p: f64, rho: f64) -> Result<Self, DrawError> {
        Ok(Self { p: within("the probability", p, 0.0, 1.0)?, rho: within("the correlation", rho, 0.0, 1.0)? })
    }

    /// The susceptibility of one plant for one season.
    ///
    /// # Errors
    /// None for shapes within the range of Beta, which are all that are asked for.
    pub fn susceptibility(&self, draws: &mut Draws) -> Result<f64, DrawError> {
        if self.rho < LEAST || self.p == 0.0 || self.p == 1.0 {
            return Ok(self.p);
        }
        let (a, b) = self.shapes();
        if a < LEAST_SHAPE || b < LEAST_SHAPE {
            return Ok(f64::from(u8::from(draws.happens(self.p))));
        }
        draws.beta(a, b)
    }

    /// The number of `organs` organs of one plant that are attacked in a season.
    ///
    /// # Errors
    /// Those of [`Aggregation::susceptibility`].
    pub fn attacked(&self, organs: u32, draws: &mut Draws) -> Result<u32, DrawError> {
        let own = self.susceptibility(draws)?;
        Ok((0..organs).map(|_| u32::from(draws.happens(own))).sum())
    }

    /// The variance of the number of `organs` organs that are attacked.
    pub fn variance(&self, organs: u32) -> f64 {
        let n = f64::from(organs);
        n * self.p * (1.0 - self.p) * (1.0 + (n - 1.0).max(0.0) * self.rho)
    }

    /// The probability that `attacked` of `organs` organs are attacked: C(n, k) B(a + k, b + n − k) / B(a, b). For a
    /// correlation and a probability that are neither 0 nor 1.
    pub fn probability(&self, organs: u32, attacked: u32) -> f64 {
        let (a, b) = self.shapes();
        let (n, k) = (f64::from(organs), f64::from(attacked));
        let ways = lgamma(n + 1.0) - lgamma(k + 1.0) - lgamma(n - k + 1.0);
        let beta = |a: f64, b: f64| lgamma(a) + lgamma(b) - lgamma(a + b);
        exp(ways + beta(a + k, b + n - k) - beta(a, b))
    }

    fn shapes(&self) -> (f64, f64) {
        let sum = (1.0 - self.rho) / self.rho;
        (self.p * sum, (1.0 - self.p) * sum)
    }
}
