//! A plot: the plants that share a site; the unit of parallel work, of resuming and of distribution.
//!
//! Where nothing is shared a plot is one plant.

use crate::mechanics::{Bench, Wood};
use crate::model::GrowthModel;
use crate::plant::{Plant, Seed};
use crate::site::Site;

/// The plants of one site.
#[derive(Debug, Clone)]
pub struct Plot {
    /// The plot's number in the run, from 0.
    pub id: u32,
    /// Its plants.
    pub plants: Vec<Plant>,
    /// What they stand on.
    pub site: Site,
    /// Scratch of mechanics, kept for its memory.
    pub bench: Bench,
}

impl Plot {
    /// A plot of one plant, sown by `model`.
    pub fn of_one(model: &dyn GrowthModel, seed: &Seed) -> Self {
        let mut plant = Plant::new(seed, model.habit());
        model.sow(&mut plant);
        Self { id: seed.plant, plants: vec![plant], site: Site::default(), bench: Bench::default() }
    }

    /// Sows a plot of one plant anew from another seed, keeping the memory of its columns.
    pub fn resow(&mut self, model: &dyn GrowthModel, seed: &Seed) {
        self.id = seed.plant;
        self.site.begin(0);
        for plant in &mut self.plants {
            plant.resow(seed);
            model.sow(plant);
        }
    }

    /// Whether the shape of its plants at an age depends on those at the ages before, so that each must be gone
    /// through.
    pub fn remembers(&self) -> bool {
        self.plants.iter().any(|plant| plant.habit.wood.as_ref().is_some_and(Wood::remembers))
    }

    /// Takes every plant back to its seed.
    pub fn restart(&mut self, model: &dyn GrowthModel) {
        self.site.begin(0);
        for plant in &mut self.plants {
            plant.clear();
            model.sow(plant);
        }
    }
}
