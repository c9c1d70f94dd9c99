//! What is gathered of the attacks on one plant, until it is what the plant meets.
//!
//! Absent: the attacks themselves (`attack`).

use phytomer_sim::NEVER;
use phytomer_sim::plant::{Exposure, Hazard, Survival};
use std::ops::Range;

/// The attacks on one plant so far.
pub(super) struct Exposed {
    pub apex: Hazard,
    pub leaf: Hazard,
    pub flower: Hazard,
    pub fruit: Hazard,
    pub plant: Hazard,
    growth: Vec<f64>,
    /// The age at which every bud is killed.
    pub death: u32,
}

impl Default for Exposed {
    fn default() -> Self {
        let [apex, leaf, flower, fruit, plant] = [const { Hazard(Vec::new()) }; 5];
        Self { apex, leaf, flower, fruit, plant, growth: Vec::new(), death: NEVER }
    }
}

impl Exposed {
    /// Takes a share of its growth away at some ages.
    pub fn weaken(&mut self, ages: Range<u32>, factor: f64) {
        let end = ages.end as usize;
        if self.growth.len() < end {
            self.growth.resize(end, 1.0);
        }
        let weakened = self.growth.get_mut(ages.start as usize..end).unwrap_or_default();
        weakened.iter_mut().for_each(|growth| *growth *= factor);
    }

    /// What the plant meets.
    pub fn into_exposure(self) -> Exposure {
        let Self { apex, leaf, flower, fruit, plant, growth, death } = self;
        let [leaf, flower, fruit] = [leaf, flower, fruit].map(|hazard| Survival::under(&hazard));
        Exposure { apex, leaf, flower, fruit, plant, growth, death }
    }
}
