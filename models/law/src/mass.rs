//! Probabilities of the discrete distributions, as arrays of finite length.
//!
//! Computed outwards from the mode by the ratio of neighbours and then normalised, which needs neither factorials nor
//! gamma functions and is exact to rounding; tails are cut where what remains is below 1e-18 of the whole.

/// The largest count.
pub(super) const MAX_COUNT: u32 = 65_535;
/// A tail below this fraction of the whole is cut.
const TAIL: f64 = 1e-18;
/// A tail that may be lost at [`MAX_COUNT`]: it would draw nothing from a 32-bit word.
const LOST: f64 = 1.0 / 4_294_967_296.0;

/// The probabilities of `first`, `first` + 1 …
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Mass {
    pub first: u32,
    pub weights: Vec<f64>,
}

impl Mass {
    /// All the mass on one count.
    pub fn point(count: u32) -> Self {
        Self { first: count, weights: vec![1.0] }
    }

    /// Weights from 0, normalised. The sum must be finite and above 0.
    pub fn weights(weights: &[f64]) -> Self {
        Self { first: 0, weights: weights.to_vec() }.normalised()
    }

    /// Binomial(n, p), n ≤ [`MAX_COUNT`].
    pub fn binomial(n: u32, p: f64) -> Option<Self> {
        if p <= 0.0 || p >= 1.0 {
            return Some(Self::point(if p >= 1.0 { n } else { 0 }));
        }
        let (trials, odds) = (f64::from(n), p / (1.0 - p));
        let mode = ((trials + 1.0) * p).floor().min(trials);
        Self::around(mode, 0.0, |k| (trials - k) / (k + 1.0) * odds)
    }

    /// Poisson(mean); `None` where counts exceed [`MAX_COUNT`].
    pub fn poisson(mean: f64) -> Option<Self> {
        Self::around(mean.floor(), 0.0, |k| mean / (k + 1.0))
    }

    /// Failures before the r-th success of probability p; `None` where counts exceed [`MAX_COUNT`].
    pub fn negative_binomial(r: f64, p: f64) -> Option<Self> {
        let q = 1.0 - p;
        let mode = if r > 1.0 { ((r - 1.0) * q / p).floor() } else { 0.0 };
        Self::around(mode, q, |k| (r + k) / (k + 1.0) * q)
    }

    /// The distribution with `ratio(k)` = P(k+1)/P(k), falling away from the mode; `limit` is its ratio at infinity.
    fn around(mode: f64, limit: f64, ratio: impl Fn(f64) -> f64) -> Option<Self> {
        if !(0.0..=f64::from(MAX_COUNT)).contains(&mode) {
            return None;
        }
        let mut below = Vec::new();
        let (mut k, mut weight) = (mode, 1.0);
        while k > 0.0 && weight > TAIL {
            k -= 1.0;
            weight /= ratio(k);
            below.push(weight);
        }
        let first = k as u32;
        let mut weights: Vec<f64> = below.into_iter().rev().collect();
        weights.push(1.0);
        let mut sum: f64 = weights.iter().sum();
        (k, weight) = (mode, 1.0);
        loop {
            let q = ratio(k).max(limit);
            let tail = if q < 1.0 { weight * q / (1.0 - q) } else { f64::INFINITY };
            if tail <= TAIL * sum {
                break;
            }
            if k >= f64::from(MAX_COUNT) {
                return (tail < LOST * sum).then(|| Self { first, weights }.normalised());
            }
            weight *= ratio(k);
            weights.push(weight);
            sum += weight;
            k += 1.0;
        }
        Some(Self { first, weights }.normalised())
    }

    fn normalised(mut self) -> Self {
        let sum: f64 = self.weights.iter().sum();
        self.weights.iter_mut().for_each(|weight| *weight /= sum);
        self
    }

    /// The largest count of positive probability.
    pub fn last(&self) -> u64 {
        let used = self.weights.iter().rposition(|&weight| weight > 0.0).unwrap_or(0);
        u64::from(self.first) + used as u64
    }

    /// The mixture of distributions; the weights sum to 1.
    pub fn mixture(parts: &[(f64, Mass)]) -> Self {
        let first = parts.iter().map(|(_, mass)| mass.first).min().unwrap_or(0);
        let end = parts.iter().map(|(_, mass)| mass.first as usize + mass.weights.len()).max().unwrap_or(0);
        let mut weights = vec![0.0; end.saturating_sub(first as usize).max(1)];
        for (weight, mass) in parts {
            let start = (mass.first - first) as usize;
            weights[start..].iter_mut().zip(&mass.weights).for_each(|(sum, p)| *sum += weight * p);
        }
        Self { first, weights }
    }

    /// Mean and variance.
    pub fn moments(&self) -> (f64, f64) {
        let points = || self.weights.iter().zip(0..).map(|(&p, k): (_, u32)| (p, f64::from(self.first) + f64::from(k)));
        let mean: f64 = points().map(|(p, k)| p * k).sum();
        (mean, points().map(|(p, k)| p * (k - mean) * (k - mean)).sum())
    }
}
