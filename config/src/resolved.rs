//! A scenario that was checked, with all its species compiled: a run that is ready to start.
//!
//! The first species has fields of its own, since most runs have no other species; the species that members and levels
//! name are in a list. Absent: the checks (`validate`).

use std::fmt;
use std::sync::{Arc, OnceLock};

use phytomer_law::fault;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::site::calendars::Calendars;
use serde_json::{Value as Json, json};

use crate::cohorts::Cohort;
use crate::dates::{Dated, calendars_of};
use crate::document::Node;
use crate::meaning;
use crate::models::Reads;
use crate::report::Report;
use crate::scenario::{Experiment, Scenario, Soil};
use crate::source::Sources;
use crate::species::Species;
use crate::trial::{Treatment, Trial, check_size};

/// A run that is ready to start.
#[derive(Clone)]
pub struct Resolved {
    /// The scenario: plants, plots, ages, tables and meshes. Its seed is changed by [`Resolved::reseed`].
    pub scenario: Scenario,
    /// Its treatments, each a scenario of its own; one, `control`, where nothing is compared. [`Resolved::trial`] has
    /// them with what was changed in `scenario` since.
    pub treatments: Vec<Treatment>,
    /// The first species of the run, with its inheritance resolved: the scenario's own, unless each level of a factor
    /// names another.
    pub species: Species,
    /// The growth model of the first cohort, which is of the first species, compiled for all ages that its plants
    /// reach.
    pub model: Arc<dyn GrowthModel>,
    /// The other species, which members or levels name, in the order in which the treatments name them.
    pub others: Vec<OtherSpecies>,
    /// The growth models of the other cohorts, in the order of [`Trial::cohorts`].
    pub other_models: Vec<Arc<dyn GrowthModel>>,
    /// The calendars of the plots of each treatment; `None` where its scenario states none. What blocks and field plots
    /// shift is not in them: [`Resolved::trial`] has it.
    pub calendars: Vec<Option<Dated>>,
    /// Every text that was read, for hashes and provenance: the scenario first, then each species and its ancestors.
    pub sources: Sources,
    /// The seed whose draws of the site are compiled into the models.
    pub(crate) site_seed: u64,
    /// The calendars of each treatment with what blocks and field plots shift by that seed, and the experiment that
    /// these belong to: made when they are first asked for.
    pub(crate) shifted: OnceLock<(Experiment, Vec<Calendars>)>,
    pub(crate) tree: Node,
}

/// A species of a run that is not its first: a member of the plots or a level names it.
#[derive(Clone)]
pub struct OtherSpecies {
    /// The species, with its inheritance resolved.
    pub species: Species,
    pub(crate) tree: Node,
}

/// A species that does not compile: its index in [`Resolved::all_species`], and its faults.
pub type Uncompiled = (usize, Vec<fault::Fault>);

impl fmt::Debug for Resolved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Resolved").field("scenario", &self.scenario).field("species", &self.species).finish()
    }
}

impl Resolved {
    /// The treatments with the numbers of their plots and plants, their calendars and their cohorts.
    pub fn trial(&self) -> Trial {
        let trial = Trial::of(&self.scenario, &self.treatments);
        let reads: Vec<Reads> = self.all_species().into_iter().map(Species::reads).collect();
        if self.calendars.iter().all(Option::is_none) && !reads.iter().any(|reads| reads.surroundings) {
            return trial;
        }
        let shift = || trial.shifted(&calendars_of(&self.calendars), self.site_seed);
        let kept = self.shifted.get_or_init(|| (self.scenario.experiment.clone(), shift()));
        // Who changes the experiment after the check gets the calendars of what it is now.
        let calendars = if kept.0 == self.scenario.experiment { kept.1.clone() } else { shift() };
        trial.in_calendars(calendars, &reads)
    }

    /// Changes the seed of the run. Where blocks or field plots shift the site, their draws are those of the new seed,
    /// and the models are compiled for them.
    ///
    /// # Errors
    /// A species whose laws do not hold under these draws.
    pub fn reseed(&mut self, seed: u64) -> Result<(), Report> {
        self.scenario.seed = seed;
        if !self.is_stale() {
            return Ok(());
        }
        self.compile().map_err(|(species, faults)| self.report_of(species, faults))
    }

    /// Whether the models are compiled for the draws of another seed than that of the scenario.
    pub fn is_stale(&self) -> bool {
        let differs = |treatment: &Treatment| treatment.scenario.soil.as_ref().is_some_and(Soil::differs);
        self.site_seed != self.scenario.seed && self.treatments.iter().any(differs)
    }

    /// Compiles the models of all cohorts again: for other parameters of the species, or another seed of the scenario.
    ///
    /// # Errors
    /// The first species that does not compile.
    pub fn compile(&mut self) -> Result<(), Uncompiled> {
        self.site_seed = self.scenario.seed;
        self.shifted = OnceLock::new();
        let mut models = compiled(&self.trial(), &self.all_species())?.into_iter();
        if let Some(first) = models.next() {
            (self.model, self.other_models) = (first, models.collect());
        }
        Ok(())
    }

    /// Limits each replicate of each treatment to so many plants, and leaves out the meshes of plants that do not grow.
    /// Returns the number of plants whose meshes are left out.
    pub fn grow_only(&mut self, plants: u32) -> u32 {
        self.scenario.plants = plants;
        self.treatments.iter_mut().for_each(|treatment| treatment.scenario.plants = plants);
        let in_all = self.trial().plants();
        self.scenario.draw_only(in_all)
    }

    /// The faults of all treatments that came of changes since the check, each with its treatment.
    pub fn faults(&self) -> Vec<(String, fault::Fault)> {
        let trial = self.trial();
        let size = check_size(&self.scenario, trial.treatments().iter().map(|treatment| &treatment.scenario)).err();
        let size = size.map(|fault| (String::new(), fault));
        let of = |treatment: &Treatment| {
            let name = treatment.name.clone();
            let faults = treatment.scenario.faults_in_run_of(trial.plants(), Some(&self.scenario.experiment));
            faults.into_iter().map(move |fault| (name.clone(), fault))
        };
        size.into_iter().chain(trial.treatments().iter().flat_map(of)).collect()
    }

    /// A report of faults that were found in the first species after reading, such as by growing it.
    pub fn report(&self, faults: Vec<fault::Fault>) -> Report {
        self.report_of(0, faults)
    }

    /// A report of faults in the species with the index `species` in [`Resolved::all_species`].
    pub fn report_of(&self, species: usize, faults: Vec<fault::Fault>) -> Report {
        let other = species.checked_sub(1).and_then(|place| self.others.get(place));
        placed(&self.sources, other.map_or(&self.tree, |other| &other.tree), faults)
    }

    /// All species, in the order in which the treatments name them.
    pub fn all_species(&self) -> Vec<&Species> {
        [&self.species].into_iter().chain(self.others.iter().map(|other| &other.species)).collect()
    }

    /// All species, each once whatever the names by which treatments call it, in the order in which the treatments name
    /// them.
    pub fn distinct_species(&self) -> Vec<&Species> {
        let mut distinct: Vec<&Species> = Vec::new();
        for species in self.all_species() {
            if !distinct.contains(&species) {
                distinct.push(species);
            }
        }
        distinct
    }

    /// The growth models of all cohorts, in the order of [`Trial::cohorts`].
    pub fn models(&self) -> Vec<&dyn GrowthModel> {
        [&self.model].into_iter().chain(&self.other_models).map(AsRef::as_ref).collect()
    }

    /// The expected number of components that a plant of the first species has made by `age`, in ticks: the
    /// exact mean, an upper bound or an estimate. `None` where the sum would take too long.
    pub fn expected_components(&self, age: u32) -> Option<f64> {
        self.model.expectation(age).map(|means| means.components(age))
    }

    /// The whole run as JSON, for `run.json`: the scenario with its defaults, its species with inheritance resolved,
    /// under `other_species` the further species, and under `treatments` those of an experiment, each with its
    /// scenario and its calendars.
    ///
    /// # Errors
    /// A number that JSON cannot hold, which no checked run has.
    pub fn to_json(&self) -> serde_json::Result<Json> {
        let mut json = json!({"scenario": serde_json::to_value(&self.scenario)?, "species": self.species.to_json()?});
        if !self.others.is_empty() {
            let others = self.others.iter().map(|other| other.species.to_json());
            json["other_species"] = others.collect::<serde_json::Result<Vec<Json>>>()?.into();
        }
        let mut dates = self.calendars.iter().map(|dated| dated.as_ref().map(Dated::to_json));
        if self.scenario.experiment.is_control_alone() {
            add_keys(&mut json, dates.next().flatten());
        } else {
            let trial = self.trial();
            let treatments = trial.treatments().iter().map(serde_json::to_value).zip(dates);
            let told = treatments.map(|(treatment, dates)| {
                let mut treatment = treatment?;
                add_keys(&mut treatment, dates);
                Ok(treatment)
            });
            json["treatments"] = told.collect::<serde_json::Result<Vec<Json>>>()?.into();
        }
        Ok(json)
    }

    /// The scenario with its defaults, as the TOML text of a scenario file.
    ///
    /// # Errors
    /// A value that TOML cannot hold, which no checked scenario has.
    pub fn scenario_toml(&self) -> Result<String, toml::ser::Error> {
        toml::to_string(&self.scenario)
    }

    /// The scenario's own species with inheritance resolved, as the TOML text of a species file.
    ///
    /// # Errors
    /// A value that TOML cannot hold, which no checked species has.
    pub fn species_toml(&self) -> Result<String, toml::ser::Error> {
        self.species.to_toml()
    }
}

/// The models of the cohorts of a trial of these species.
///
/// # Errors
/// The first species that does not compile.
pub fn compiled(trial: &Trial, species: &[&Species]) -> Result<Vec<Arc<dyn GrowthModel>>, Uncompiled> {
    let compiled = |cohort: &Cohort| {
        let of = species.get(cohort.species).ok_or((cohort.species, Vec::new()))?;
        cohort.compile(&of.model).map_err(|faults| (cohort.species, faults))
    };
    trial.cohorts().iter().map(compiled).collect()
}

/// Adds the keys of one object to another.
fn add_keys(object: &mut Json, more: Option<Json>) {
    if let (Json::Object(keys), Some(Json::Object(more))) = (object, more) {
        keys.extend(more);
    }
}

/// A report of a model's faults, each at its place in the tree of the species.
pub(crate) fn placed(sources: &Sources, tree: &Node, faults: Vec<fault::Fault>) -> Report {
    let placed = faults.into_iter().map(|fault| meaning::place(sources, tree, fault)).collect();
    Report::new(sources.clone(), placed)
}
