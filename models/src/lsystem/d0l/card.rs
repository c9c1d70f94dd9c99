//! The card of the L-systems: their name and their source.
//!
//! Absent: their parameters (`parameters`).

use super::D0l;
use crate::fault::{Fault, Path};
use crate::parameters::{Card, Keys, Parameters};
use phytomer_sim::Tick;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::site::calendar::Dates;
use std::sync::Arc;

impl D0l {
    /// The card of this model.
    pub const CARD: Card = Card {
        word: "lsystem",
        about: "a string of cells is rewritten at each tick and drawn (Lindenmayer; Aono & Kunii 1984)",
        keys: Keys { referred_to: &["cell"], ..Keys::PLAIN },
    };
}

impl Parameters for D0l {
    fn card(&self) -> &'static Card {
        &Self::CARD
    }

    fn model(&self, until: Tick, _: Option<&Dates>, top: &Path) -> Result<Arc<dyn GrowthModel>, Vec<Fault>> {
        Ok(Arc::new(self.compile(until, top)?))
    }
}
