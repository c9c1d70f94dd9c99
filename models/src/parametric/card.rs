//! The card of the parametric trees: their name, their source and the age at which they are full-grown.
//!
//! Absent: their parameters (`tree`).

use super::Tree;
use super::model::BIRTH;
use crate::fault::{Fault, Path};
use crate::parameters::{Card, Keys, Levelled, Parameters};
use phytomer_sim::Tick;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::site::calendar::Dates;
use std::sync::Arc;

impl Tree {
    /// The card of this model.
    pub const CARD: Card = Card {
        word: "parametric",
        about: "curved stems that split and bear branches, by lengths and angles a level (Weber & Penn 1995)",
        keys: Keys::PLAIN,
    };
}

impl Parameters for Tree {
    fn card(&self) -> &'static Card {
        &Self::CARD
    }

    fn model(&self, until: Tick, _: Option<&Dates>, top: &Path) -> Result<Arc<dyn GrowthModel>, Vec<Fault>> {
        Ok(Arc::new(self.compile(until, top)?))
    }

    fn levelled(&self, _: Tick) -> Option<Levelled> {
        Some(Levelled { quality: 1.0, in_leaf: true, spring: false })
    }

    /// The whole tree stands from its first age on.
    fn full_grown_at(&self) -> Option<Tick> {
        Some(BIRTH)
    }
}
