//! A species grown without a scenario: one plant, from its seed to the age at which it shows its architecture.
//!
//! The key `shown_at` of a species file states this age. Without the key it is 100 ticks, or fewer, so that the plant
//! stays small. About ten ages are recorded, up to and with the last, and mechanics are recorded where the wood bends.

use phytomer_sim::model::GrowthModel;
use std::collections::BTreeMap;
use std::sync::OnceLock;

use crate::resolved::Resolved;
use crate::scenario::{
    Ages, DEFAULT_SEED, Every, Experiment, Laid, Limits, Output, Planting, Record, Scenario, Site, tables,
};
use crate::species::Species;
use crate::trial::Treatment;
use crate::validate::{ResolvedSpecies, SPECIES_ALONE_UNTIL};

/// A plant of a species that states no age is grown only to an age at which at most this many components are expected.
const SMALL: f64 = 200_000.0;

/// The number of recorded ages, about.
const RECORDED: u32 = 10;

impl ResolvedSpecies {
    /// The age, in ticks, at which a plant of the species shows its architecture.
    pub fn shown_at(&self) -> u32 {
        self.species.shown_at(self.model.as_ref())
    }

    /// A run of one plant of the species to [`ResolvedSpecies::shown_at`], with all tables and no meshes. `name` is the
    /// name or the path by which the species was found.
    pub fn alone(self, name: &str) -> Resolved {
        let until = self.shown_at();
        let mechanics = self.model.habit().wood.as_ref().is_some_and(|wood| wood.bends);
        let scenario = Scenario {
            pest: Vec::new(),
            name: self.species.about.name.clone(),
            description: self.species.about.description.clone(),
            species: name.to_owned(),
            plants: 1,
            seed: DEFAULT_SEED,
            spacing_m: None,
            planting: Planting::default(),
            experiment: Experiment::default(),
            site: Site::default(),
            light: None,
            define: BTreeMap::new(),
            member: Vec::new(),
            stand: None,
            laid: Laid::default(),
            event: Vec::new(),
            ages: Ages { until, record: Record::Every(recorded(until)) },
            planting_date: None,
            calendar: None,
            weather: None,
            soil: None,
            fertilizer: Vec::new(),
            sample: None,
            tables: tables::all(),
            meshes: None,
            limits: Limits::default(),
            output: Output { mechanics, ..Output::default() },
        };
        let Self { species, model, sources, tree } = self;
        let treatments = vec![Treatment::control(&scenario)];
        Resolved {
            site_seed: scenario.seed,
            shifted: OnceLock::new(),
            scenario,
            treatments,
            species,
            model,
            others: Vec::new(),
            other_models: Vec::new(),
            calendars: vec![None],
            sources,
            tree,
        }
    }
}

impl Species {
    /// The age, in ticks, at which a plant shows its architecture: as its file states, else by its expected size.
    /// `model` must be compiled up to the age in the file, or up to [`SPECIES_ALONE_UNTIL`] where the file states none.
    pub fn shown_at(&self, model: &dyn GrowthModel) -> u32 {
        let by_size = || while_small(model).min(self.model.full_grown_at().unwrap_or(u32::MAX));
        self.about.shown_at.unwrap_or_else(by_size)
    }
}

/// The recorded ages, rising, of a single plant that is grown without a scenario up to the age `until`.
pub fn recorded_alone(until: u32) -> Vec<u32> {
    Ages { until, record: Record::Every(recorded(until)) }.recorded()
}

/// About ten ages in equal steps, ending with `until`.
fn recorded(until: u32) -> Every {
    let every = until.div_ceil(RECORDED).max(1);
    // The steps are counted back from the last age.
    Every { every, from: Some(until - every * (until.saturating_sub(1) / every)) }
}

/// The last age, at most [`SPECIES_ALONE_UNTIL`], at which a plant is expected to be small.
fn while_small(model: &dyn GrowthModel) -> u32 {
    let Some(expected) = model.expectation(SPECIES_ALONE_UNTIL) else { return SPECIES_ALONE_UNTIL };
    (1..=SPECIES_ALONE_UNTIL).rev().find(|age| expected.components(*age) <= SMALL).unwrap_or(1)
}
