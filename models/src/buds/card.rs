//! The card of the bud model: its name, its source and the roles of its keys.
//!
//! Absent: the parameters themselves (`params`) and what they compile to (`compile`).

use super::Buds;
use crate::fault::{Fault, Path};
use crate::parameters::{ByPlace, Card, Keys, Parameters, Together};
use phytomer_sim::Tick;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::site::calendar::Dates;
use std::sync::Arc;

/// The keys of a wood that are checked even where its stiffness is refused; the others depend on it.
const BESIDE_STIFFNESS: [&str; 5] = ["drag", "thickening", "leaf_kg_m2", "flower_kg_m3", "fruit_kg_m3"];

impl Buds {
    /// The card of this model.
    pub const CARD: Card = Card {
        word: "buds",
        about: "every bud dies, pauses, grows and branches by laws (de Reffye et al. 1988)",
        keys: Keys {
            by_place: Some(ByPlace { list: "order", every: "every_order" }),
            referred_to: &["order", "states"],
            wood: Some(Together { table: "wood", apart: &BESIDE_STIFFNESS }),
            formed: &["internode", "leaf", "flower", "fruit"],
            texts: None,
        },
    };
}

impl Parameters for Buds {
    fn card(&self) -> &'static Card {
        &Self::CARD
    }

    fn model(&self, until: Tick, dates: Option<&Dates>, top: &Path) -> Result<Arc<dyn GrowthModel>, Vec<Fault>> {
        Ok(Arc::new(self.compile_dated(until, dates, top)?))
    }

    fn own_forms(&self) -> Vec<(Path, &str)> {
        self.meshes_of_its_own()
    }

    fn state_area_shares(&mut self, share: &dyn Fn(usize) -> Option<f64>) -> bool {
        self.state_shares_of_meshes(share)
    }

    fn states(&self) -> &[String] {
        &self.states
    }

    fn year(&self) -> Option<(Path, u32)> {
        let path = Path::root().key("season").key("ticks_per_year");
        self.season.as_ref().map(|season| (path, season.ticks_per_year.value()))
    }
}
