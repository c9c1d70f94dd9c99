//! A scenario that was checked, with all its species compiled: a run that can begin.
//!
//! The scenario's own species stands by itself, since most runs have no other; those that members name beside it stand
//! in a list. Absent: the checks, which are `validate`'s.

use std::fmt;
use std::sync::Arc;

use phytomer_law::fault;
use phytomer_sim::model::GrowthModel;
use serde_json::{Value as Json, json};

use crate::document::Node;
use crate::meaning;
use crate::report::Report;
use crate::scenario::Scenario;
use crate::source::Sources;
use crate::species::Species;

/// A run that can begin.
#[derive(Clone)]
pub struct Resolved {
    /// What the run grows and keeps.
    pub scenario: Scenario,
    /// The scenario's own species, with its inheritance resolved.
    pub species: Species,
    /// Its model, compiled for all ages that a plant of it reaches.
    pub model: Arc<dyn GrowthModel>,
    /// The other species that members name, in the order of [`Scenario::species_names`] without the first.
    pub others: Vec<OtherSpecies>,
    /// Every text that was read, for hashes and provenance: the scenario first, then each species and its ancestors.
    pub sources: Sources,
    pub(crate) tree: Node,
}

/// A species of a scenario beside its own.
#[derive(Clone)]
pub struct OtherSpecies {
    /// The species, with its inheritance resolved.
    pub species: Species,
    /// Its model, compiled for all ages that a plant of it reaches.
    pub model: Arc<dyn GrowthModel>,
    pub(crate) tree: Node,
}

impl fmt::Debug for Resolved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Resolved").field("scenario", &self.scenario).field("species", &self.species).finish()
    }
}

impl Resolved {
    /// A report of what was found wrong with the scenario's own species after it was read, as
    /// [`ResolvedSpecies::report`].
    pub fn report(&self, faults: Vec<fault::Fault>) -> Report {
        self.report_of(0, faults)
    }

    /// The same of any of its species, by its place in [`Scenario::species_names`].
    pub fn report_of(&self, species: usize, faults: Vec<fault::Fault>) -> Report {
        let other = species.checked_sub(1).and_then(|place| self.others.get(place));
        placed(&self.sources, other.map_or(&self.tree, |other| &other.tree), faults)
    }

    /// All species, in the order of [`Scenario::species_names`].
    pub fn all_species(&self) -> Vec<&Species> {
        [&self.species].into_iter().chain(self.others.iter().map(|other| &other.species)).collect()
    }

    /// The models of all species, in the same order.
    pub fn models(&self) -> Vec<&dyn GrowthModel> {
        [self.model.as_ref()].into_iter().chain(self.others.iter().map(|other| other.model.as_ref())).collect()
    }

    /// The components that a plant of the scenario's own species is expected to have made by `age`: the mean, a bound
    /// from above or an estimate; `None` where the sum would take too long.
    pub fn expected_components(&self, age: u32) -> Option<f64> {
        self.model.expectation(age).map(|means| means.components(age))
    }

    /// The whole run as data, for `run.json`: the scenario with its defaults, its species without ancestors, and in
    /// `other_species` those that members name beside it.
    ///
    /// # Errors
    /// A number that JSON cannot hold, which no checked run has.
    pub fn to_json(&self) -> serde_json::Result<Json> {
        let mut json = json!({"scenario": serde_json::to_value(&self.scenario)?, "species": self.species.to_json()?});
        if !self.others.is_empty() {
            let others = self.others.iter().map(|other| other.species.to_json());
            json["other_species"] = others.collect::<serde_json::Result<Vec<Json>>>()?.into();
        }
        Ok(json)
    }

    /// The scenario with its defaults, as a file that could be run again.
    ///
    /// # Errors
    /// A value that TOML cannot hold, which no checked scenario has.
    pub fn scenario_toml(&self) -> Result<String, toml::ser::Error> {
        toml::to_string(&self.scenario)
    }

    /// The species without ancestors, as a file.
    ///
    /// # Errors
    /// A value that TOML cannot hold, which no checked species has.
    pub fn species_toml(&self) -> Result<String, toml::ser::Error> {
        self.species.to_toml()
    }
}

/// Faults of meaning, each at its place in the tree of its species.
pub(crate) fn placed(sources: &Sources, tree: &Node, faults: Vec<fault::Fault>) -> Report {
    let placed = faults.into_iter().map(|fault| meaning::place(sources, tree, fault)).collect();
    Report::new(sources.clone(), placed)
}
