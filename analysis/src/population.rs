//! A population by age: how many plants live, how tall they are, how much they bear.
//!
//! The source is the table `summary`, one row per plant and recorded tick. Plants of the same age are taken together,
//! at whichever tick of its plot each plant has that age. Standing dead plants are counted as dead and are not
//! measured.

use phytomer_measures::Moments;
use phytomer_outputs::Error;
use phytomer_outputs::read::{Run, SummaryRow};
use std::collections::BTreeMap;

/// A population at one recorded age.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct AgeOfPopulation {
    /// The number of living plants, by the column `alive` of `summary`.
    pub living: u64,
    /// The number of dead plants.
    pub dead: u64,
    /// Height of the living plants, metres. A plant without a living internode has no height and is not measured.
    pub height_m: Moments,
    /// Number of living internodes of the living plants.
    pub internodes: Moments,
    /// Leaf area of the living plants, square metres.
    pub leaf_area_m2: Moments,
}

impl AgeOfPopulation {
    fn add(&mut self, plant: &SummaryRow) {
        if !plant.alive {
            self.dead += 1;
            return;
        }
        self.living += 1;
        if let Some(height) = plant.height_m {
            self.height_m.add(height);
        }
        self.internodes.add(f64::from(plant.internodes));
        self.leaf_area_m2.add(plant.leaf_area_m2);
    }
}

/// The statistics of the plants of a run by recorded age, in ticks since sowing. Reads all rows of `summary` into
/// memory once.
///
/// # Errors
/// [`Error`] where a part file of `summary` cannot be read.
pub fn population(run: &Run) -> Result<BTreeMap<u32, AgeOfPopulation>, Error> {
    let mut ages = BTreeMap::<u32, AgeOfPopulation>::new();
    for plant in run.summary()? {
        ages.entry(plant.age).or_default().add(&plant);
    }
    Ok(ages)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_dead_are_counted_and_not_measured() {
        let plant = |alive, height| SummaryRow {
            plot_id: 0,
            plant_id: 0,
            tick: 3,
            age: 3,
            internodes: 10,
            leaves: 0,
            flowers: 0,
            fruits: 0,
            buds: 1,
            dead_internodes: 0,
            axes: 1,
            max_order: 1,
            height_m: height,
            crown_width_m: None,
            leaf_area_m2: 0.5,
            wood_volume_m3: 0.0,
            alive,
            death_age: None,
            harvested_fruits: 0,
            harvested_fresh_mass_kg: None,
        };
        let mut age = AgeOfPopulation::default();
        [plant(true, Some(1.0)), plant(true, Some(3.0)), plant(false, Some(9.0)), plant(true, None)]
            .iter()
            .for_each(|plant| age.add(plant));
        assert_eq!((age.living, age.dead, age.height_m.n, age.height_m.mean), (3, 1, 2, 2.0));
        assert_eq!(age.internodes.n, 3);
    }
}
