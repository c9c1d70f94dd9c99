//! How far a run has come, and the wish to stop it: numbers that the growing threads raise and a person's terminal
//! reads.
//!
//! Absent: how they are shown, which is the command line's.

use super::RunError;
use phytomer_config::Scenario;
use phytomer_outputs::Checking;
use phytomer_sim::Plot;
use phytomer_sim::plant::Plant;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};

/// The state of a run that is under way.
#[derive(Debug, Default)]
pub struct Progress {
    stop: AtomicBool,
    plants: AtomicU64,
    plants_in_all: AtomicU64,
    ages: AtomicU64,
    ages_a_plant: AtomicU64,
    components: AtomicU64,
    checking: Checking,
}

impl Progress {
    /// Asks the run to stop soon: shards that are not complete are given up, committed ones stay.
    pub fn stop(&self) {
        self.stop.store(true, Relaxed);
        self.checking.stop();
    }

    /// How far the check of what a resumed run keeps has come.
    pub fn checking(&self) -> &Checking {
        &self.checking
    }

    /// Whether it was asked to stop.
    pub fn is_stopped(&self) -> bool {
        self.stop.load(Relaxed)
    }

    /// Plants grown so far in this start.
    pub fn plants(&self) -> u64 {
        self.plants.load(Relaxed)
    }

    /// Plants that this start has to grow; 0 before it began.
    pub fn plants_in_all(&self) -> u64 {
        self.plants_in_all.load(Relaxed)
    }

    /// Components of the plants grown so far.
    pub fn components(&self) -> u64 {
        self.components.load(Relaxed)
    }

    /// The share of the work that is done, in [0, 1]; recorded ages count, so that a single plant moves too.
    pub fn share(&self) -> f64 {
        let ages = self.ages.load(Relaxed) as f64;
        let in_all = (self.plants_in_all() * self.ages_a_plant.load(Relaxed)).max(1) as f64;
        (ages / in_all).min(1.0)
    }

    pub(super) fn begin(&self, scenario: &Scenario, plants: u64) {
        let mut ages = scenario.ages.recorded();
        ages.extend(scenario.mesh_ages());
        ages.sort_unstable();
        ages.dedup();
        self.ages_a_plant.store(ages.len() as u64, Relaxed);
        self.plants_in_all.store(plants, Relaxed);
    }

    pub(super) fn check(&self) -> Result<(), RunError> {
        if self.is_stopped() { Err(RunError::Stopped) } else { Ok(()) }
    }

    pub(super) fn end_age(&self, plot: &Plot) {
        self.ages.fetch_add(plot.plants.len() as u64, Relaxed);
    }

    pub(super) fn end_plants(&self, grown: &[Plant]) {
        self.components.fetch_add(grown.iter().map(|plant| u64::from(plant.components())).sum(), Relaxed);
        let grown = grown.len() as u64;
        let plants = self.plants.fetch_add(grown, Relaxed) + grown;
        // A plant that met its limit has shown fewer ages than others.
        self.ages.fetch_max(plants * self.ages_a_plant.load(Relaxed), Relaxed);
    }
}
