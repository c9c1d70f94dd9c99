//! What pests do to one plant, by its age: the hazards of its apices and of the organs that stand, the share of its
//! growth that is left, and the end of the whole plant.
//!
//! A plant's exposure is drawn before it grows, since a pest does not depend on what the plant has become. An organ of
//! birth b stands until the first tick t at which 1 − ∏ (1 − h) over the ticks b + 1 … t exceeds its draw u; the
//! product is kept as a sum of −ln(1 − h), so that the tick is found by a binary search. Absent: where the hazards come
//! from, and the growth that they act on, which is the model's.

use crate::clock::{NEVER, Tick};
use crate::math::{expm1, log1p};
use crate::random::share;

/// The least share that survives a tick: even a hazard of 1 leaves it, so that sums of logarithms stay finite.
const LEAST_LEFT: f64 = 1e-15;

/// What pests do to one plant.
#[derive(Debug, Clone, PartialEq)]
pub struct Exposure {
    /// The probability, by age, that an apical bud is killed at a clock step.
    pub apex: Hazard,
    /// The probability, by age, that a leaf which stands is eaten at a tick.
    pub leaf: Survival,
    /// As for a leaf, for a flower.
    pub flower: Survival,
    /// As for a leaf, for a fruit.
    pub fruit: Survival,
    /// The probability, by age, that every bud of the plant is killed. [`Exposure::death`] is drawn by it.
    pub plant: Hazard,
    /// The factor, by age, of the nodes of a growth unit.
    pub growth: Vec<f64>,
    /// The age at which every bud of the plant is killed; [`NEVER`] where none is.
    pub death: Tick,
}

impl Default for Exposure {
    fn default() -> Self {
        let none = Survival::default();
        Self {
            apex: Hazard::default(),
            leaf: none.clone(),
            flower: none.clone(),
            fruit: none,
            plant: Hazard::default(),
            growth: vec![],
            death: NEVER,
        }
    }
}

impl Exposure {
    /// The probabilities that an apical bud, a leaf, a flower, a fruit and the whole plant are attacked at an age;
    /// `None` where no pest attacks such a thing at any age.
    pub fn pressures(&self, age: Tick) -> [Option<f64>; 5] {
        let hazard = |hazard: &Hazard| (!hazard.0.is_empty()).then(|| hazard.at(age));
        let survival = |survival: &Survival| (!survival.sum.is_empty()).then(|| survival.hazard_at(age));
        let Self { apex, leaf, flower, fruit, plant, .. } = self;
        [hazard(apex), survival(leaf), survival(flower), survival(fruit), hazard(plant)]
    }

    /// The factor of the nodes of a growth unit that is made at an age; 1 at ages that are not told.
    #[inline]
    pub fn growth_at(&self, age: Tick) -> f64 {
        self.growth.get(age as usize).copied().unwrap_or(1.0)
    }
}

/// A probability by age; 0 at ages that are not told.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Hazard(pub Vec<f64>);

impl Hazard {
    /// The probability at an age.
    #[inline]
    pub fn at(&self, age: Tick) -> f64 {
        self.0.get(age as usize).copied().unwrap_or(0.0)
    }

    /// Another independent cause with probability `q` at an age: p + q − p q.
    pub fn join(&mut self, age: Tick, q: f64) {
        let age = age as usize;
        if self.0.len() <= age {
            self.0.resize(age + 1, 0.0);
        }
        self.0[age] += q * (1.0 - self.0[age]);
    }
}

/// The survival of things that stand, by age.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Survival {
    /// The sum of −ln(1 − h) over the ages up to each.
    sum: Vec<f64>,
}

impl Survival {
    /// The survival under a hazard at each tick.
    pub fn under(Hazard(hazard): &Hazard) -> Self {
        let mut sum = 0.0;
        let sums = hazard.iter().map(|h| {
            sum -= log1p(-h.clamp(0.0, 1.0 - LEAST_LEFT));
            sum
        });
        Self { sum: sums.collect() }
    }

    /// The probability at an age that a thing which stands is eaten; 0 at ages that are not told.
    pub fn hazard_at(&self, age: Tick) -> f64 {
        let sum = |age: Option<usize>| age.and_then(|age| self.sum.get(age)).copied().unwrap_or(0.0);
        let age = age as usize;
        if age < self.sum.len() { -expm1(sum(age.checked_sub(1)) - sum(Some(age))) } else { 0.0 }
    }

    /// The tick at which a thing that appears at `birth` is eaten, by a word that stands for its draw; [`NEVER`] where
    /// none of the ages told reaches it. It stands for one tick at least. Logarithmic in the ages.
    pub fn end(&self, birth: Tick, word: u32) -> Tick {
        let Some(&before) = self.sum.get(birth as usize).filter(|_| self.sum.last() > self.sum.get(birth as usize))
        else {
            return NEVER;
        };
        let reached = before - log1p(-share(word));
        let end = self.sum.partition_point(|sum| *sum < reached);
        if end < self.sum.len() { (end as Tick).max(birth + 1) } else { NEVER }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of words spread evenly over their range the share (1 − h)ᵗ⁻¹ h falls t ticks after the birth.
    #[test]
    fn things_are_eaten_by_the_hazard_of_each_tick() {
        let mut hazard = Hazard::default();
        [(3, 0.2), (4, 0.5), (6, 1.0)].into_iter().for_each(|(age, q)| hazard.join(age, q));
        hazard.join(4, 0.2);
        assert!((hazard.at(4) - 0.6).abs() < 1e-15 && hazard.at(5) == 0.0 && hazard.at(99) == 0.0);
        let survival = Survival::under(&hazard);
        let words = || (0..10_000).map(|k| k * 429_496 + 214_748_u32);
        let share = |birth, end| words().filter(|word| survival.end(birth, *word) == end).count() as f64 / 1e4;
        for (birth, end, expected) in [
            (0, 3, 0.2),
            (2, 3, 0.2),
            (0, 4, 0.48),
            (0, 6, 0.32),
            (3, 4, 0.6),
            (3, 6, 0.4),
            (5, 6, 1.0),
            (6, NEVER, 1.0),
        ] {
            assert!((share(birth, end) - expected).abs() < 2e-4, "{birth} to {end}: {}", share(birth, end));
        }
        for (age, expected) in [(2, 0.0), (3, 0.2), (4, 0.6), (5, 0.0), (7, 0.0)] {
            assert!((survival.hazard_at(age) - expected).abs() < 1e-15, "{age}: {}", survival.hazard_at(age));
        }
        assert!((1.0 - survival.hazard_at(6)).abs() < 1e-14);
        let exposure = Exposure { leaf: survival.clone(), apex: hazard, ..Exposure::default() };
        let [apex, leaf, others @ ..] = exposure.pressures(4);
        assert!(apex.zip(leaf).is_some_and(|(apex, leaf)| (apex - leaf).abs() < 1e-15) && others == [None; 3]);
        assert!([0, 1, u32::MAX].iter().all(|&word| Survival::default().end(0, word) == NEVER));
        assert!([0, 1, u32::MAX].iter().all(|&word| survival.end(5, word) == 6 && survival.end(1, word) >= 3));
    }
}
