//! Where the seed of each plant of a trial lies in its plot.
//!
//! A member has a place; a stand with random places or with jitter draws how far from it the plant stands, by the draws
//! of the plant. Absent: the place of the plot on the field.

use crate::Trial;
use crate::trial::PlantPlace;
use phytomer_sim::random::{PlantRandom, draw_key};

impl Trial {
    /// The place of a plant, metres from that of its plot, with what its stand has drawn for it. Constant time.
    pub fn place_in_plot(&self, plant: u32) -> [f64; 3] {
        let PlantPlace { replicate, number, .. } = self.plant(plant);
        let random = PlantRandom::new(self.scenario().seed, draw_key(replicate, number));
        let (beside, shift) = (self.member_of(plant).place(), self.scenario_of(plant).shift_of(&random));
        [0, 1, 2].map(|axis| beside[axis] + shift[axis])
    }
}
