//! One distribution of counts: its probabilities, and its parameters of the largest likelihood from weighted counts.
//!
//! Poisson and binomial have closed forms, but for the n of the binomial, which is sought among whole numbers; the r of
//! the negative binomial is sought on a scale of ln r. Absent: mixtures, intervals.

use crate::special::{ln_choose, ln_factorial, x_ln_y};
use phytomer_sim::math;

/// The largest n of a binomial part that is tried: beyond it a binomial is a Poisson number within 1 %.
pub const MOST_TRIALS: u32 = 200;

/// A distribution's family.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Family {
    /// Poisson.
    Poisson,
    /// Binomial.
    Binomial,
    /// Negative binomial.
    NegativeBinomial,
}

/// A distribution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Part {
    /// Poisson of this mean.
    Poisson {
        /// Mean and variance.
        mean: f64,
    },
    /// Successes of n trials.
    Binomial {
        /// Trials.
        n: u32,
        /// Probability of a success.
        p: f64,
    },
    /// Failures before the r-th success.
    NegativeBinomial {
        /// Successes, above 0.
        r: f64,
        /// Probability of a success.
        p: f64,
    },
}

impl Family {
    /// How many parameters it has; the n of a binomial is one.
    pub fn parameters(self) -> usize {
        if self == Self::Poisson { 1 } else { 2 }
    }

    /// The letter of its name in formulas.
    pub fn letter(self) -> &'static str {
        match self {
            Self::Poisson => "P",
            Self::Binomial => "B",
            Self::NegativeBinomial => "NB",
        }
    }

    /// The largest likelihood from weights of 0, 1, 2 …; `n` holds the trials of a binomial. `None` where the family
    /// has none: a negative binomial of counts that vary no more than a Poisson number, a mean of 0.
    pub fn fitted(self, weights: &[f64], n: Option<u32>) -> Option<Part> {
        let total: f64 = weights.iter().sum();
        let mean = weights.iter().zip(0..).map(|(w, k)| w * f64::from(k)).sum::<f64>() / total;
        if !(mean > 0.0 && mean.is_finite()) {
            return None;
        }
        match (self, n) {
            (Self::Poisson, _) => Some(Part::Poisson { mean }),
            (Self::Binomial, Some(n)) => {
                let p = mean / f64::from(n);
                (p < 1.0 - 1e-9).then_some(Part::Binomial { n, p })
            }
            (Self::Binomial, None) => best_trials(weights, mean),
            (Self::NegativeBinomial, _) => negative_binomial(weights, mean),
        }
    }
}

/// The n of the largest likelihood, which has one top by n (Levin & Reeds 1977): upwards or downwards from that of the
/// moments. Counts that vary no less than their mean have none; they get the largest n that is tried.
fn best_trials(weights: &[f64], mean: f64) -> Option<Part> {
    // A share of an EM step that is below 10⁻⁴ of a count does not bound n.
    let largest = weights.iter().rposition(|weight| *weight > 1e-4)?;
    let weights = &weights[..=largest];
    let least = (largest as u32).max(mean as u32 + 1);
    if least > MOST_TRIALS {
        return None;
    }
    let variance = variance(weights, mean);
    let guess = if variance < mean { mean * mean / (mean - variance) } else { f64::from(MOST_TRIALS) };
    let part = |n: u32| Part::Binomial { n, p: mean / f64::from(n) };
    let value = |n: u32| part(n).log_likelihood(weights);
    let mut n = (guess.round() as u32).clamp(least, MOST_TRIALS);
    let mut best = value(n);
    for by in [-1, 1] {
        while let Some(next) = n.checked_add_signed(by).filter(|n| (least..=MOST_TRIALS).contains(n)) {
            let here = value(next);
            if here <= best {
                break;
            }
            (n, best) = (next, here);
        }
    }
    (mean / f64::from(n) < 1.0 - 1e-9).then(|| part(n))
}

fn variance(weights: &[f64], mean: f64) -> f64 {
    let off = |k: f64| (k - mean) * (k - mean);
    weights.iter().zip(0..).map(|(w, k)| w * off(f64::from(k))).sum::<f64>() / weights.iter().sum::<f64>()
}

/// The r of the largest likelihood at the p that gives the mean, which has one top where counts vary more than a
/// Poisson number (Levin & Reeds 1977): the root of Σ S/(r + j) − W ln(1 + mean/r), S the weight of the counts above j
/// and W that of all, by Newton's steps in ln r between bounds.
fn negative_binomial(weights: &[f64], mean: f64) -> Option<Part> {
    let variance = variance(weights, mean);
    if variance <= mean * 1.000_1 {
        return None;
    }
    let mut above: Vec<f64> = weights.iter().skip(1).copied().collect();
    (1..above.len()).rev().for_each(|j| above[j - 1] += above[j]);
    let whole: f64 = weights.iter().sum();
    // The slope by ln r, and its own slope without what vanishes at the root.
    let slopes = |ln_r: f64| {
        let r = math::exp(ln_r);
        let (mut first, mut second) = (-whole * math::log1p(mean / r), whole * mean / (r * (r + mean)));
        for (j, above) in above.iter().enumerate() {
            let each = 1.0 / (r + j as f64);
            first += above * each;
            second -= above * each * each;
        }
        [first, second * r]
    };
    let start = math::log(mean * mean / (variance - mean));
    let (mut low, mut high) = (start - 1.0, start + 1.0);
    let mut steps = 0;
    while slopes(low)[0] < 0.0 && steps < 60 {
        (low, steps) = (low - 1.0, steps + 1);
    }
    while slopes(high)[0] > 0.0 && steps < 60 {
        (high, steps) = (high + 1.0, steps + 1);
    }
    let mut at = start;
    for _ in 0..100 {
        let [first, second] = slopes(at);
        if first > 0.0 {
            low = at
        } else {
            high = at
        }
        let next = at - first / second;
        let next = if next > low && next < high { next } else { 0.5 * (low + high) };
        let step = (next - at).abs();
        at = next;
        if step < 1e-11 {
            break;
        }
    }
    let r = math::exp(at);
    at.is_finite().then(|| Part::NegativeBinomial { r, p: r / (r + mean) })
}

impl Part {
    /// The family that it is of.
    pub fn family(self) -> Family {
        match self {
            Self::Poisson { .. } => Family::Poisson,
            Self::Binomial { .. } => Family::Binomial,
            Self::NegativeBinomial { .. } => Family::NegativeBinomial,
        }
    }

    /// ln P(k).
    pub fn ln_mass(self, k: u32) -> f64 {
        let x = f64::from(k);
        match self {
            Self::Poisson { mean } => x_ln_y(x, mean) - mean - ln_factorial(x),
            Self::Binomial { n, .. } if k > n => f64::NEG_INFINITY,
            Self::Binomial { n, p } => {
                let trials = f64::from(n);
                ln_choose(trials, x) + x_ln_y(x, p) + (trials - x) * math::log1p(-p)
            }
            Self::NegativeBinomial { r, p } => {
                math::lgamma(r + x) - math::lgamma(r) - ln_factorial(x) + r * math::log(p) + x * math::log1p(-p)
            }
        }
    }

    /// P(0), P(1) … P(last): that of the most likely number, and from it each by its neighbour.
    pub fn masses(self, last: usize) -> Vec<f64> {
        let mut masses = vec![0.0; last + 1];
        // The most likely number, and the last one that there is.
        let (most, top) = match self {
            Self::Poisson { mean } => (mean, last),
            Self::Binomial { n, p } => ((f64::from(n) + 1.0) * p, last.min(n as usize)),
            Self::NegativeBinomial { r, p } => ((r - 1.0) * (1.0 - p) / p, last),
        };
        let start = (most as usize).min(top);
        masses[start] = math::exp(self.ln_mass(start as u32));
        for x in start..top {
            masses[x + 1] = masses[x] * self.next(x as f64);
        }
        for x in (0..start).rev() {
            masses[x] = masses[x + 1] / self.next(x as f64);
        }
        masses
    }

    /// The probability of x + 1 over that of x.
    fn next(self, x: f64) -> f64 {
        match self {
            Self::Poisson { mean } => mean / (x + 1.0),
            Self::Binomial { n, p } => (f64::from(n) - x) / (x + 1.0) * (p / (1.0 - p)),
            Self::NegativeBinomial { r, p } => (r + x) / (x + 1.0) * (1.0 - p),
        }
    }

    /// ln P of 0, 1 … so many counts. Γ(r + k)/Γ(r) is a product, one factor a count.
    fn ln_masses(self, counts: usize) -> Vec<f64> {
        let numbers = (0..counts as u32).map(f64::from);
        match self {
            Self::Poisson { mean } => {
                let ln = math::log(mean);
                numbers.map(|x| x * ln - mean - ln_factorial(x)).collect()
            }
            Self::Binomial { n, p } => {
                let (n, ln_p, ln_q) = (f64::from(n), math::log(p), math::log1p(-p));
                let mass = |x: f64| if x > n { f64::NEG_INFINITY } else { ln_choose(n, x) + x * ln_p + (n - x) * ln_q };
                numbers.map(mass).collect()
            }
            Self::NegativeBinomial { r, p } => {
                let (ln_p, ln_q, mut rising) = (r * math::log(p), math::log1p(-p), 0.0);
                let mass = |x: f64| {
                    let mass = rising - ln_factorial(x) + ln_p + x * ln_q;
                    rising += math::log(r + x);
                    mass
                };
                numbers.map(mass).collect()
            }
        }
    }

    /// Mean.
    pub fn mean(self) -> f64 {
        match self {
            Self::Poisson { mean } => mean,
            Self::Binomial { n, p } => f64::from(n) * p,
            Self::NegativeBinomial { r, p } => r * (1.0 - p) / p,
        }
    }

    /// Σ w ln P(k) of weights of 0, 1, 2 …
    pub fn log_likelihood(self, weights: &[f64]) -> f64 {
        let masses = self.ln_masses(weights.len());
        weights.iter().zip(masses).filter(|(w, _)| **w > 0.0).map(|(w, mass)| w * mass).sum()
    }

    /// The formula with its numbers.
    pub fn words(self) -> String {
        match self {
            Self::Poisson { mean } => format!("P({mean:.2})"),
            Self::Binomial { n, p } => format!("B({n}, {p:.3})"),
            Self::NegativeBinomial { r, p } => format!("NB({r:.2}, {p:.3})"),
        }
    }
}
