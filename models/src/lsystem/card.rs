//! What the L-systems offer to everything above them.
//!
//! Absent: their parameters (`d0l`).

use super::D0l;
use crate::fault::{Fault, Path};
use crate::parameters::{Card, Keys, Parameters};
use phytomer_sim::Tick;
use phytomer_sim::model::GrowthModel;
use std::sync::Arc;

impl D0l {
    /// What the model is called, and how its keys stand.
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

    fn model(&self, until: Tick, top: &Path) -> Result<Arc<dyn GrowthModel>, Vec<Fault>> {
        Ok(Arc::new(self.compile(until, top)?))
    }
}
