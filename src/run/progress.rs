//! How far a run has come and how fast, and the wish to stop it: numbers that the growing threads raise and a person's
//! terminal reads.
//!
//! Absent: how they are shown, which is the command line's.

use super::RunError;
use phytomer_config::Scenario;
use phytomer_outputs::Checking;
use phytomer_sim::Plot;
use phytomer_sim::plant::Plant;
use serde::Serialize;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use std::time::Instant;

/// The state of a run that is under way.
#[derive(Debug, Default)]
pub struct Progress {
    stop: AtomicBool,
    plants: AtomicU64,
    plants_in_all: AtomicU64,
    ages: AtomicU64,
    ages_a_plant: AtomicU64,
    components: AtomicU64,
    bytes: AtomicU64,
    parts: AtomicU64,
    parts_in_all: AtomicU64,
    begun: OnceLock<Instant>,
    checking: Checking,
}

/// How far a run has come at a moment, of what this start has to grow.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Reading {
    /// Seconds since growth began; 0 before.
    pub seconds: f64,
    /// The share of the work that is done, in [0, 1].
    pub share: f64,
    /// Plants grown.
    pub plants: u64,
    /// Plants to grow.
    pub plants_in_all: u64,
    /// Plants a second, from the beginning of growth.
    pub plants_per_s: f64,
    /// Components of the plants grown.
    pub components: u64,
    /// Components a second, from the beginning of growth.
    pub components_per_s: f64,
    /// Bytes written.
    pub bytes: u64,
    /// Part files of each table that are complete.
    pub parts: u64,
    /// Part files of each table to write.
    pub parts_in_all: u64,
    /// Seconds to the end, if it goes on as until now; `None` before anything is done.
    pub left_s: Option<f64>,
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

    /// All of this at one moment.
    pub fn reading(&self) -> Reading {
        let seconds = self.begun.get().map_or(0.0, |begun| begun.elapsed().as_secs_f64());
        let (share, plants, components) = (self.share(), self.plants(), self.components());
        let a_second = |number: u64| if seconds > 0.0 { number as f64 / seconds } else { 0.0 };
        Reading {
            seconds,
            share,
            plants,
            plants_in_all: self.plants_in_all(),
            plants_per_s: a_second(plants),
            components,
            components_per_s: a_second(components),
            bytes: self.bytes.load(Relaxed),
            parts: self.parts.load(Relaxed),
            parts_in_all: self.parts_in_all.load(Relaxed),
            left_s: (share > 0.0).then(|| seconds * (1.0 - share) / share),
        }
    }

    pub(super) fn begin(&self, scenario: &Scenario, plants: u64, parts: usize) {
        self.begun.get_or_init(Instant::now);
        self.parts_in_all.store(parts as u64, Relaxed);
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

    /// A plot was shown at an age; so many bytes are written in all.
    pub(super) fn end_age(&self, plot: &Plot, written: u64) {
        self.ages.fetch_add(plot.plants.len() as u64, Relaxed);
        self.bytes.fetch_max(written, Relaxed);
    }

    /// A part is complete; so many bytes are written in all.
    pub(super) fn end_part(&self, written: u64) {
        self.parts.fetch_add(1, Relaxed);
        self.bytes.fetch_max(written, Relaxed);
    }

    pub(super) fn end_plants(&self, grown: &[Plant]) {
        self.components.fetch_add(grown.iter().map(|plant| u64::from(plant.components())).sum(), Relaxed);
        let grown = grown.len() as u64;
        let plants = self.plants.fetch_add(grown, Relaxed) + grown;
        // A plant that met its limit has shown fewer ages than others.
        self.ages.fetch_max(plants * self.ages_a_plant.load(Relaxed), Relaxed);
    }
}
