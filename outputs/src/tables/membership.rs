//! Where a plant belongs: its plot, what the plot is in the run, and the tick at which the plant was sown.
//!
//! All rows of a plant share this, in every table. Ticks count from the beginning of the plot, ages from the sowing of
//! a plant; in the tables this file alone converts ticks into ages. Absent: the plant itself.

use phytomer_sim::{Member, Plot, Tick};

/// Where a plant belongs.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Membership {
    /// The number of its plot.
    pub plot: u32,
    /// The treatment of the plot, as a place in the run's list of treatments.
    pub treatment: u32,
    /// The replicate of that treatment.
    pub replicate: u32,
    /// The species of the plant, as a place in the run's list of species.
    pub species: usize,
    /// The tick of the plot at which the plant was sown.
    pub sown: Tick,
}

impl Membership {
    /// Of the plant that stands at place `at` in a plot.
    pub fn of(plot: &Plot, at: usize) -> Self {
        let Member { species, sown } = plot.members[at];
        Self { plot: plot.id, treatment: plot.treatment, replicate: plot.replicate, species, sown }
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

/// The places of a plot's plants in the order of their numbers, which is that of their rows.
pub fn by_number(plot: &Plot) -> Vec<usize> {
    let mut places: Vec<usize> = (0..plot.plants.len()).collect();
    places.sort_by_key(|&at| plot.plants[at].id);
    places
}
