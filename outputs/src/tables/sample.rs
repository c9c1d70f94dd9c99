//! A sample of the plants of a run: `components`, `records` and `events` have rows of the chosen plants alone,
//! `summary` and `plants` of all.
//!
//! Each plant draws a lot from the run's seed and its own number, and the plants with the lowest lots are chosen. So a
//! plant is chosen by itself, on any thread and in any part of the run; a larger sample has the plants of a smaller
//! one; and where plants are added, a plant that was not chosen is not chosen then either, while some of the chosen
//! give way to new ones. Numbers are those within a treatment and replicate: each of them has the same plants in its
//! sample, so that treatments are compared plant by plant. Absent: the meshes, which a scenario chooses by number.

use phytomer_sim::key::{mix, scramble};
use serde::Serialize;
use std::collections::BinaryHeap;

/// Keeps lots apart from the draws of growth, which begin with the seed and the number too.
const LOTS: u64 = 0x0073_616d_706c_6521;

/// The chosen plants of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sample {
    stated: Stated,
    seed: u64,
    /// The highest lot that is chosen, with the number that has it.
    last: (u64, u32),
}

/// What a run states of its sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Stated {
    /// The number of chosen plants of each treatment and replicate.
    pub plants: u32,
    /// The number of plants of each treatment and replicate.
    pub of: u32,
}

impl Sample {
    /// A sample of `plants` of the `of` plants of each treatment and replicate; `None` where it would be all of them.
    /// Takes about 10 ns for each of the `of` plants, and memory for the chosen ones until it returns.
    pub fn of(seed: u64, plants: u32, of: u32) -> Option<Self> {
        if plants >= of {
            return None;
        }
        let mut lowest = BinaryHeap::with_capacity(plants as usize + 1);
        for number in 0..of {
            let lot = (lot(seed, number), number);
            if lowest.len() < plants as usize {
                lowest.push(lot);
            } else if lowest.peek().is_some_and(|last| lot < *last) {
                lowest.pop();
                lowest.push(lot);
            }
        }
        Some(Self { stated: Stated { plants, of }, seed, last: *lowest.peek()? })
    }

    /// What the run states of it.
    pub fn stated(&self) -> Stated {
        self.stated
    }

    /// Whether a plant is chosen.
    pub fn has(&self, plant: u32) -> bool {
        let number = plant % self.stated.of.max(1);
        (lot(self.seed, number), number) <= self.last
    }
}

/// The lot of the plant with a number.
fn lot(seed: u64, number: u32) -> u64 {
    mix(mix(scramble(seed), LOTS), u64::from(number))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn chosen(seed: u64, plants: u32, of: u32) -> BTreeSet<u32> {
        let sample = Sample::of(seed, plants, of).unwrap();
        (0..of).filter(|plant| sample.has(*plant)).collect()
    }

    #[test]
    fn exactly_so_many_are_chosen_and_the_seed_decides_which() {
        for (plants, of) in [(1, 2), (1, 1000), (200, 10_000), (999, 1000)] {
            assert_eq!(chosen(7, plants, of).len(), plants as usize, "{plants} of {of}");
        }
        assert_ne!(chosen(7, 200, 10_000), chosen(8, 200, 10_000));
        assert!(Sample::of(7, 10, 10).is_none() && Sample::of(7, 11, 10).is_none());
    }

    #[test]
    fn samples_are_nested_and_a_plant_that_is_not_chosen_stays_so() {
        let small = chosen(7, 50, 5_000);
        assert!(small.is_subset(&chosen(7, 200, 5_000)), "a larger sample has the smaller one");
        let more = chosen(7, 50, 20_000);
        let old: BTreeSet<u32> = more.iter().copied().filter(|plant| *plant < 5_000).collect();
        assert!(old.is_subset(&small), "of the plants that were there none is new");
        assert!(old.len() < small.len(), "some give way to plants that are added");
    }

    /// The mean of the numbers of 2,000 of 100,000 plants is that of all within four standard errors, and neighbours
    /// are chosen no more often than by chance.
    #[test]
    fn the_sample_is_spread_over_the_run() {
        let (plants, of) = (2_000_u32, 100_000_u32);
        for seed in 0..5 {
            let chosen = chosen(seed, plants, of);
            let mean = chosen.iter().map(|plant| f64::from(*plant)).sum::<f64>() / f64::from(plants);
            let error = f64::from(of) / 12_f64.sqrt() / f64::from(plants).sqrt();
            assert!((mean - f64::from(of) / 2.0).abs() < 4.0 * error, "seed {seed}: mean {mean}");
            let pairs = chosen.iter().filter(|plant| chosen.contains(&(**plant + 1))).count() as f64;
            let expected = f64::from(plants) * f64::from(plants) / f64::from(of);
            assert!((pairs - expected).abs() < 4.0 * expected.sqrt() + 1.0, "seed {seed}: {pairs} pairs of neighbours");
        }
    }

    #[test]
    fn each_treatment_and_replicate_has_the_same_plants() {
        let sample = Sample::of(7, 20, 1_000).unwrap();
        assert!((0..1_000).all(|plant| sample.has(plant) == sample.has(3_000 + plant)));
    }
}
