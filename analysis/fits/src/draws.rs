//! Random numbers for simulated data and the bootstrap: keyed by seed and number, the same on any number of threads.
//!
//! A stream is one of `phytomer_sim::random`. Absent: draws of growing plants, which have streams of their own.

use phytomer_sim::key::LineageKey;
use phytomer_sim::math;
use phytomer_sim::random::{PlantRandom, Purpose, Stream};

/// A stream of random numbers.
pub struct Draws(Stream);

impl Draws {
    /// The stream of a seed and a number, such as that of a repetition.
    pub fn new(seed: u64, number: u64) -> Self {
        Self(PlantRandom::new(seed, number).stream(LineageKey::SEED, Purpose::Plant))
    }

    /// A number in (0, 1).
    pub fn share(&mut self) -> f64 {
        self.0.share()
    }

    /// Whether something of probability `p` happens.
    pub fn happens(&mut self, p: f64) -> bool {
        self.share() < p
    }

    /// Successes among `n` trials of probability `p`.
    pub fn binomial(&mut self, n: u32, p: f64) -> u32 {
        (0..n).map(|_| u32::from(self.happens(p))).sum()
    }

    /// Trials up to the first success of probability `p`, at least 1.
    pub fn geometric(&mut self, p: f64) -> u32 {
        if p >= 1.0 {
            return 1;
        }
        let trials = 1.0 + (math::log(self.share()) / math::log1p(-p)).floor();
        trials.min(f64::from(u32::MAX)) as u32
    }

    /// A normal number of mean 0 and variance 1, by Box & Muller (1958).
    pub fn normal(&mut self) -> f64 {
        let (radius, turn) = ((-2.0 * math::log(self.share())).sqrt(), self.share());
        radius * math::cos(2.0 * std::f64::consts::PI * turn)
    }

    /// A place below `n`, which is at least 1.
    pub fn below(&mut self, n: usize) -> usize {
        ((self.share() * n as f64) as usize).min(n - 1)
    }

    /// The place of a weight, drawn in proportion to the weights.
    pub fn among(&mut self, weights: &[f64]) -> usize {
        let mut left = self.share() * weights.iter().sum::<f64>();
        let chosen = weights.iter().position(|weight| {
            left -= weight;
            left < 0.0
        });
        chosen.unwrap_or(weights.len().saturating_sub(1))
    }
}
