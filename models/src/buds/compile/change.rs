//! What responses change, by the age of the plant and the light of the bud: probabilities, numbers of nodes, lengths.
//!
//! Hazards join. Independent causes of death with probabilities p and q kill with p + q − p q; of a response counts
//! what it adds to its value at the reference, d = q − q(reference), so that p becomes p + d − p d, kept within [0, 1],
//! and the species' own p where the response is at its reference. (On the logit scale p = 0 could never respond.) All
//! other quantities are multiplied by m, the response divided by its value at the reference; a number of nodes becomes
//! ⌊n m + u⌋ with u uniform over [0, 1), whose mean is n m. At the reference d = 0 and m = 1 to the bit. Absent: where
//! the values come from (`response`).

use crate::law::At;
use std::sync::Arc;

/// The most nodes that a growth unit can have after a response.
const MOST_NODES: f64 = 65_535.0;
/// What a 32-bit word stands for: so many parts of 1.
const WORDS: f64 = 4_294_967_296.0;

/// A value for each age of the plant; later ages have the last. Where something responds to light, a value for each
/// step of shade beside it.
#[derive(Debug, Clone, PartialEq)]
pub struct ByAge {
    by_age: Arc<[f64]>,
    /// Empty where nothing responds to light.
    by_shade: Arc<[f64]>,
    /// Whether the two join as hazards, and are not multiplied.
    joins: bool,
}

impl ByAge {
    /// The factors at the ages 0, 1, 2 …, at least one, and those at each step of shade.
    pub fn factors(by_age: Vec<f64>, by_shade: Vec<f64>) -> Self {
        Self { by_age: by_age.into(), by_shade: by_shade.into(), joins: false }
    }

    /// The hazards at the ages 0, 1, 2 …, at least one, and those at each step of shade.
    pub fn hazards(by_age: Vec<f64>, by_shade: Vec<f64>) -> Self {
        Self { by_age: by_age.into(), by_shade: by_shade.into(), joins: true }
    }

    /// The value at the age and the shade of a point.
    #[inline]
    pub fn at(&self, at: At) -> f64 {
        let by_age = self.by_age.get(at.age as usize).or(self.by_age.last()).copied().unwrap_or(1.0);
        match self.by_shade.get(at.shade as usize).or(self.by_shade.last()) {
            None => by_age,
            Some(by_shade) if self.joins => by_age + by_shade * (1.0 - by_age),
            Some(by_shade) => by_age * by_shade,
        }
    }

    /// No factor is larger.
    pub fn most(&self) -> f64 {
        let most = |of: &[f64]| of.iter().copied().reduce(f64::max).unwrap_or(1.0);
        most(&self.by_age) * most(&self.by_shade)
    }

    /// Whether nothing but shade changes anything, so that in full light no word is needed.
    pub fn is_of_light_alone(&self) -> bool {
        let neutral = if self.joins { 0.0 } else { 1.0 };
        let light = |by_shade: &[f64]| by_shade.first() == Some(&neutral);
        light(&self.by_shade) && self.by_age.iter().all(|value| *value == neutral)
    }

    /// The square roots: of what acts on length and on width alike, where the values act on an area.
    pub fn roots(&self) -> Self {
        let roots = |of: &[f64]| of.iter().map(|value| value.sqrt()).collect();
        Self { by_age: roots(&self.by_age), by_shade: roots(&self.by_shade), joins: false }
    }

    /// The distribution of ⌊n m + u⌋ for a number n with the probabilities `own` of 0, 1, 2 ….
    pub fn spread(&self, own: Vec<f64>, at: At) -> Vec<f64> {
        let factor = self.at(at);
        if factor == 1.0 {
            return own;
        }
        let mut spread = vec![0.0; 1];
        for (number, p) in own.into_iter().enumerate().filter(|(_, p)| *p > 0.0) {
            let product = (number as f64 * factor).min(MOST_NODES);
            let (least, above) = (product.floor() as usize, product.fract());
            spread.resize(spread.len().max(least + 2), 0.0);
            spread[least] += p * (1.0 - above);
            spread[least + 1] += p * above;
        }
        while spread.len() > 1 && spread[spread.len() - 1] == 0.0 {
            spread.pop();
        }
        spread
    }
}

/// ⌊n m + u⌋ for a word that stands for u.
#[inline]
pub fn nodes_times(number: u32, factor: f64, word: u32) -> u32 {
    (f64::from(number) * factor + f64::from(word) / WORDS).min(MOST_NODES) as u32
}

/// The probability that at least one of two independent causes takes effect; a negative `d` takes back what another
/// cause adds.
#[inline]
pub fn join(p: f64, d: f64) -> f64 {
    // p + d − p d, written so that d = 0 gives p to the bit, and d = 1 gives 1.
    (p + d * (1.0 - p)).clamp(0.0, 1.0)
}

/// How responses change a probability.
#[derive(Debug, Clone)]
pub enum Change {
    /// It is multiplied, and kept to 1.
    Times(ByAge),
    /// Another hazard joins it.
    Joins(ByAge),
}

impl Change {
    /// The changed probability.
    #[inline]
    pub fn of(&self, p: f64, at: At) -> f64 {
        match self {
            Self::Times(factor) => (p * factor.at(at)).min(1.0),
            Self::Joins(hazard) => join(p, hazard.at(at)),
        }
    }

    /// Whether the probability is unchanged at a point.
    #[inline]
    pub fn is_neutral_at(&self, at: At) -> bool {
        match self {
            Self::Times(factor) => factor.at(at) == 1.0,
            Self::Joins(hazard) => hazard.at(at) == 0.0,
        }
    }

    /// Whether nothing but shade changes the probability.
    pub fn is_of_light_alone(&self) -> bool {
        let (Self::Times(values) | Self::Joins(values)) = self;
        values.is_of_light_alone()
    }

    /// Whether a probability that is 0 at every point (`never`), or else any probability, can change.
    pub fn can_change(&self, never: bool) -> bool {
        !never || matches!(self, Self::Joins(of) if of.by_age.iter().chain(&*of.by_shade).any(|d| *d > 0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hazards_join_as_independent_causes() {
        assert!((join(0.2, 0.1) - 0.28).abs() < 1e-15);
        assert_eq!((join(0.0, 0.1), join(0.3, 0.0), join(1.0, -0.0), join(0.0, -0.5)), (0.1, 0.3, 1.0, 0.0));
        assert_eq!((join(1.0, 0.7), join(0.4, 1.0)), (1.0, 1.0));
        // For every probability that a word can be compared with, d = 0 gives it back to the bit.
        assert!((0..=u32::MAX).step_by(65_521).map(|t| f64::from(t) / WORDS).all(|p| join(p, 0.0) == p));
    }

    #[test]
    fn nodes_have_the_mean_of_the_product() {
        let factor = ByAge::factors(vec![1.0, 1.3, 0.25], Vec::new());
        let by = |age| At { age, ..At::default() };
        assert_eq!(factor.spread(vec![0.5, 0.0, 0.5], by(0)), [0.5, 0.0, 0.5]);
        let spread = factor.spread(vec![0.2, 0.3, 0.5], by(1));
        let mean: f64 = spread.iter().enumerate().map(|(n, p)| n as f64 * p).sum();
        assert!((mean - 1.3 * 1.3).abs() < 1e-12 && (spread.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{spread:?}");
        // Words spread evenly over their range give the same distribution.
        let words = (0..1000).map(|k| k * 4_294_967 + 2_147_483);
        let drawn: Vec<u32> = words.map(|word| nodes_times(2, 1.3, word)).collect();
        assert_eq!((drawn.iter().min(), drawn.iter().max()), (Some(&2), Some(&3)));
        assert_eq!(drawn.iter().filter(|n| **n == 3).count(), 600);
        assert_eq!([0, u32::MAX].map(|word| nodes_times(7, 1.0, word)), [7, 7]);
        assert_eq!(nodes_times(65_535, 1000.0, 5), 65_535);
        assert_eq!(factor.at(by(99)), 0.25);
    }
}
