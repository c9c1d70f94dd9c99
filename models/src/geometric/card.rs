//! The card of GMT1: its name, its source and the age at which it is full-grown.
//!
//! Absent: its parameters (`gmt1`).

use super::Gmt1;
use crate::fault::{Fault, Path};
use crate::parameters::{Card, Keys, Parameters};
use phytomer_sim::Tick;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::site::calendar::Dates;
use std::sync::Arc;

impl Gmt1 {
    /// The card of this model.
    pub const CARD: Card = Card {
        word: "gmt1",
        about: "two branches at every tip, by ratios and angles (Aono & Kunii 1984)",
        keys: Keys::PLAIN,
    };
}

impl Parameters for Gmt1 {
    fn card(&self) -> &'static Card {
        &Self::CARD
    }

    fn model(&self, until: Tick, _: Option<&Dates>, top: &Path) -> Result<Arc<dyn GrowthModel>, Vec<Fault>> {
        Ok(Arc::new(self.compile(until, top)?))
    }

    /// The full growth level is reached at this age: as in the figures of the paper, growth level 0 is age 1.
    fn full_grown_at(&self) -> Option<Tick> {
        Some(self.levels.value() + 1)
    }
}
