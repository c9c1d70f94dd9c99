//! The card of the parametric trees: their name, their source and the age at which they are full-grown.
//!
//! Absent: their parameters (`params`).

use super::Tree;
use super::checks::BIRTH;
use super::seen;
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
        about: "stems that split and bear branches and leaves, by lengths and angles a level (Weber & Penn 1995)",
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

    fn levelled(&self, age: Tick) -> Option<Levelled> {
        Some(seen::levelled(&self.whole, age))
    }

    fn set_quality(&mut self, quality: f64) -> bool {
        self.whole.quality = quality.into();
        true
    }

    fn year(&self) -> Option<(Path, u32)> {
        let path = Path::root().key("season").key("ticks_per_year");
        self.whole.season.as_ref().map(|season| (path, season.ticks_per_year.value()))
    }

    /// A tree without growth stands whole from its first age on.
    fn full_grown_at(&self) -> Option<Tick> {
        (self.whole.growth.is_none() && self.whole.season.is_none()).then_some(BIRTH)
    }
}
