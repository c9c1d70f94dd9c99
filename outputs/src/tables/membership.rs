//! The membership of a plant: its plot, the treatment and replicate of the plot, its species, and the tick of its
//! sowing.
//!
//! All rows of a plant share it, in every table. Ticks count from the start of the plot, ages from the sowing of a
//! plant; in the tables only this file converts between ticks and ages. Absent: the plant itself.

use super::buffers::NULL;
use phytomer_sim::{Member, Plot, Tick};

/// The plot, species and sowing of a plant.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Membership {
    /// The number of its plot.
    pub plot: u32,
    /// The treatment of the plot, as an index into the run's list of treatments.
    pub treatment: u32,
    /// The replicate of that treatment.
    pub replicate: u32,
    /// The block of the field that the plot stands in.
    pub block: Option<u32>,
    /// The model of the plant, as an index into the run's list of models; in the rows of `plants` its species, as an
    /// index into the run's list of species.
    pub species: usize,
    /// The tick of the plot at which the plant was sown.
    pub sown: Tick,
    /// Whether `components`, `records` and `events` have rows of the plant.
    pub sampled: bool,
}

impl Membership {
    /// The membership of the plant with the index `at` in a plot.
    pub fn of(plot: &Plot, at: usize) -> Self {
        let Member { species, sown } = plot.members[at];
        let Plot { id, treatment, replicate, block, .. } = *plot;
        Self { plot: id, treatment, replicate, block, species, sown, sampled: true }
    }

    /// The plant's age at a tick of the plot; `None` before it is sown.
    pub fn age_at(&self, tick: Tick) -> Option<Tick> {
        tick.checked_sub(self.sown)
    }

    /// The tick of the plot at which the plant has an age.
    #[inline]
    pub fn tick_at(&self, age: Tick) -> Tick {
        self.sown.saturating_add(age)
    }
}

/// The indices of a plot's plants in the order of the plants' numbers, which is the order of rows.
pub fn by_number(plot: &Plot) -> Vec<usize> {
    let mut places: Vec<usize> = (0..plot.plants.len()).collect();
    places.sort_by_key(|&at| plot.plants[at].id);
    places
}

/// The name of a state of a plant's model, as an index into the run's list of state names; −1 (null) where it has none.
/// `states` are the names of the model's states, by their numbers.
#[inline]
pub fn name_of(states: &[i32], state: u8) -> i32 {
    states.get(usize::from(state)).copied().unwrap_or(NULL)
}
