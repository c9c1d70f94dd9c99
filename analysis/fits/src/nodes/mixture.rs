//! Mixtures of two distributions by EM, from several beginnings.
//!
//! The E step shares each count between the parts, the M step takes the largest likelihood of each part from its share
//! (`part`). EM ends where a step gains less than 10⁻⁷; the rest of the way is Newton's (`laws`). Absent: more than two
//! parts, which none of the measured histograms needs.

use super::part::{Family, Part};

/// Two parts, and the weight of the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mixture {
    pub weight: f64,
    pub parts: [Part; 2],
}

impl Mixture {
    pub fn masses(&self, last: usize) -> Vec<f64> {
        sums(&self.of_parts(last))
    }

    /// The probabilities of each part, by its weight.
    fn of_parts(&self, last: usize) -> [Vec<f64>; 2] {
        let weights = [self.weight, 1.0 - self.weight];
        [0, 1].map(|part| {
            let mut masses = self.parts[part].masses(last);
            masses.iter_mut().for_each(|mass| *mass *= weights[part]);
            masses
        })
    }

    /// The share of the first part in each count.
    fn shares(&self, last: usize) -> Vec<f64> {
        shares(&self.of_parts(last))
    }

    pub fn log_likelihood(&self, counts: &[f64]) -> f64 {
        log_likelihood(counts, &self.masses(counts.len() - 1))
    }
}

fn sums([first, second]: &[Vec<f64>; 2]) -> Vec<f64> {
    first.iter().zip(second).map(|(a, b)| a + b).collect()
}

fn shares([first, second]: &[Vec<f64>; 2]) -> Vec<f64> {
    first.iter().zip(second).map(|(a, b)| if a + b > 0.0 { a / (a + b) } else { 0.5 }).collect()
}

/// Σ c ln P of counts and probabilities.
pub fn log_likelihood(counts: &[f64], masses: &[f64]) -> f64 {
    let of = |(count, mass): (&f64, &f64)| if *count > 0.0 { count * phytomer_sim::math::log(*mass) } else { 0.0 };
    counts.iter().zip(masses).map(of).sum()
}

/// The steps of EM from each beginning, after which the best two go on.
const FIRST: usize = 40;
/// The most steps of those that go on.
const MOST: usize = 1000;

/// The families of the parts, and the n of binomial parts that are held.
#[derive(Clone, Copy)]
pub struct Asked {
    pub families: [Family; 2],
    pub trials: [Option<u32>; 2],
}

/// The best mixture of two families. Its weight is within (0, 1).
pub fn fitted(counts: &[f64], families: [Family; 2]) -> Option<Mixture> {
    let asked = Asked { families, trials: [None; 2] };
    let total: f64 = counts.iter().sum();
    let from = |cut: f64| {
        let place = quantile(counts, total * cut);
        let shares: Vec<f64> = (0..counts.len()).map(|k| if k <= place { 0.9 } else { 0.1 }).collect();
        climb(counts, asked, shares, FIRST, 1e-4)
    };
    let mut begun: Vec<(f64, Mixture)> = [0.05, 0.15, 0.3, 0.5, 0.7, 0.85, 0.95].into_iter().filter_map(from).collect();
    begun.sort_by(|a, b| b.0.total_cmp(&a.0));
    let ended = begun.iter().take(2).filter_map(|begun| nearby(counts, asked, &begun.1));
    ended.max_by(|a, b| a.0.total_cmp(&b.0)).map(|best| best.1)
}

/// The best mixture that EM reaches from another one.
pub fn nearby(counts: &[f64], asked: Asked, start: &Mixture) -> Option<(f64, Mixture)> {
    climb(counts, asked, start.shares(counts.len() - 1), MOST, 1e-6)
}

/// The count below which so much of the whole lies.
fn quantile(counts: &[f64], share: f64) -> usize {
    let mut sum = 0.0;
    let place = counts.iter().position(|count| {
        sum += count;
        sum >= share
    });
    place.unwrap_or(0)
}

/// EM from a first share of each count, until a step gains less than `least`.
fn climb(counts: &[f64], asked: Asked, mut shares: Vec<f64>, steps: usize, least: f64) -> Option<(f64, Mixture)> {
    let total: f64 = counts.iter().sum();
    let mut last: Option<(f64, Mixture)> = None;
    for _ in 0..steps {
        let of_first: Vec<f64> = counts.iter().zip(&shares).map(|(c, s)| c * s).collect();
        let of_second: Vec<f64> = counts.iter().zip(&of_first).map(|(c, f)| c - f).collect();
        let weight = of_first.iter().sum::<f64>() / total;
        if !(1e-4..=1.0 - 1e-4).contains(&weight) {
            return last;
        }
        let part = |k: usize, weights: &[f64]| asked.families[k].fitted(weights, asked.trials[k]);
        let (Some(a), Some(b)) = (part(0, &of_first), part(1, &of_second)) else { return last };
        let mixture = Mixture { weight, parts: [a, b] };
        let of_parts = mixture.of_parts(counts.len() - 1);
        let value = log_likelihood(counts, &sums(&of_parts));
        if !value.is_finite() {
            return last;
        }
        let gain = last.map_or(f64::INFINITY, |last| value - last.0);
        last = Some((value, mixture));
        if gain < least {
            break;
        }
        shares = self::shares(&of_parts);
    }
    last
}
