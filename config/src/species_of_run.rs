//! The species of a run: each that its treatments name, read and checked once, and compiled for each of its cohorts.
//!
//! Where a scenario could not be read, its species are compiled all the same, for the ages and dates that are known, so
//! that the faults of all files are told at once. Absent: calendars (`dates`), cohorts, and what must hold between
//! species and scenario (`checked`).

use std::sync::Arc;

use phytomer_law::Constant;
use phytomer_law::fault::{self, Segment};
use phytomer_models::parameters::Surroundings;
use phytomer_sim::clock::LAST_TICK;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::site::calendar::Dates;

use crate::about::About;
use crate::checked::{Compiled, Stated};
use crate::cohorts::{Cohort, check_calendars};
use crate::dates::{Dated, Refused, calendars_of};
use crate::document::Node;
use crate::load::{Found, Loader, Mention, path_of};
use crate::meaning;
use crate::models::{Model, Reads};
use crate::numbers::Numbers;
use crate::report::Fault;
use crate::scenario::Scenario;
use crate::species::Species;
use crate::treatments::Read;
use crate::trial::{Treatment, Trial};

/// A run as far as it is known: its tree, its scenario, its last tick, and the calendars of its treatments.
pub(crate) struct Run<'a> {
    pub node: &'a Node,
    pub scenario: Option<&'a Scenario>,
    pub until: Option<u32>,
    pub calendars: Result<&'a [Option<Dated>], &'a Refused>,
    pub read: &'a [Read],
}

/// The species of a run and its treatments, with the model of each cohort of its trial.
pub(crate) struct SpeciesOfRun {
    pub treatments: Vec<Treatment>,
    pub species: Vec<Stated>,
    pub trial: Trial,
    pub models: Vec<Arc<dyn GrowthModel>>,
}

impl Run<'_> {
    /// Reads, checks and compiles the species of all treatments; `None` where there are faults, which are told.
    pub fn check(&self, loader: &mut Loader) -> Option<SpeciesOfRun> {
        let names = self.names();
        let found: Vec<Option<Found>> = names.iter().map(|mention| read_species(loader, mention)).collect();
        // Without its calendars a run cannot know which laws of the date hold.
        let calendars = self.calendars.ok()?;
        let Some(treatments) = self.treatments(&names) else {
            for (mention, found) in names.iter().zip(&found) {
                self.compile_alone(loader, mention, found.as_ref(), calendars);
            }
            return None;
        };
        let trial = self.trial(loader, &treatments, calendars, &found)?;
        let models = self.compile(loader, &trial, &found);
        let stated = |of: Found| {
            let Found { about, model, node } = of;
            Some(Stated { species: Species { about: about?, model }, tree: node })
        };
        let species = found.into_iter().map(|of| stated(of?)).collect::<Option<Vec<Stated>>>()?;
        Some(SpeciesOfRun { treatments, species, trial, models: models? })
    }

    /// The species that treatments name, each once.
    fn names(&self) -> Vec<&Mention> {
        let mut names: Vec<&Mention> = Vec::new();
        for mention in self.read.iter().flat_map(|read| &read.species) {
            if names.iter().all(|known| known.name != mention.name) {
                names.push(mention);
            }
        }
        names
    }

    /// The treatments with the places of their species; `None` where a scenario or its last tick could not be read.
    fn treatments(&self, names: &[&Mention]) -> Option<Vec<Treatment>> {
        let run = self.scenario.filter(|_| self.until.is_some())?;
        let treatment = |read: &Read| {
            let place = |mention: &Mention| names.iter().position(|known| known.name == mention.name);
            let chosen = &read.expanded.chosen;
            Some(Treatment {
                name: chosen.name.clone(),
                levels: run.experiment.level_names(&chosen.levels),
                scenario: read.scenario.clone()?,
                species: read.species.iter().map(place).collect::<Option<_>>()?,
            })
        };
        self.read.iter().map(treatment).collect()
    }

    /// The trial of these treatments; `None` where it has more calendars or cohorts than a run can have.
    fn trial(
        &self,
        loader: &mut Loader,
        treatments: &[Treatment],
        calendars: &[Option<Dated>],
        found: &[Option<Found>],
    ) -> Option<Trial> {
        let scenario = self.scenario?;
        let many = check_calendars(scenario, treatments.iter().map(|treatment| &treatment.scenario));
        let trial = many.map_or_else(
            || {
                let of = |found: &Option<Found>| found.as_ref().map(|of| of.model.reads()).unwrap_or_default();
                let reads: Vec<Reads> = found.iter().map(of).collect();
                let trial = Trial::of(scenario, treatments).dated(&calendars_of(calendars), &reads, scenario.seed);
                trial.check_cohorts().map_or(Ok(trial), Err)
            },
            Err,
        );
        trial.map_err(|fault| loader.faults.push(meaning::place(&loader.sources, self.node, fault))).ok()
    }

    /// Compiles a species whose cohorts are not known, for the faults that it has.
    fn compile_alone(
        &self,
        loader: &mut Loader,
        mention: &Mention,
        found: Option<&Found>,
        calendars: &[Option<Dated>],
    ) {
        let (Some(found), Some(until)) = (found, self.until) else { return };
        let each = self.read.iter().zip(calendars).filter_map(|(Read { scenario, .. }, dated)| {
            let scenario = scenario.as_ref()?;
            let place = scenario.species_names().iter().position(|name| *name == mention.name)?;
            Some((scenario, place, dated))
        });
        let ages = each.clone().map(|(scenario, place, _)| scenario.last_age_of_species(place).clamp(1, LAST_TICK));
        let dates = each.clone().find_map(|(scenario, place, dated)| {
            let calendar = Arc::clone(dated.as_ref()?.calendars.of(0)?);
            Some(Dates { calendar, sown: scenario.first_sowing_of(place) })
        });
        let around = each.clone().find_map(|(scenario, ..)| scenario.surroundings()).map(Arc::new);
        let surroundings = around.filter(|_| found.model.reads_surroundings());
        let cohort = Cohort { species: 0, dates, surroundings, until: ages.max().unwrap_or(until) };
        if let Err(faults) = cohort.compile(&found.model) {
            self.tell(loader, found, &cohort, faults);
        }
    }

    /// The model of each cohort. Of a species whose laws do not hold for one cohort no other cohort is compiled, since
    /// it would have the same faults.
    fn compile(
        &self,
        loader: &mut Loader,
        trial: &Trial,
        found: &[Option<Found>],
    ) -> Option<Vec<Arc<dyn GrowthModel>>> {
        let mut refused = vec![false; found.len()];
        let mut models = Vec::with_capacity(trial.cohorts().len());
        for cohort in trial.cohorts() {
            let Some(of) = found.get(cohort.species).and_then(Option::as_ref) else { continue };
            if refused[cohort.species] {
                continue;
            }
            match cohort.compile(&of.model) {
                Ok(model) => models.push(model),
                Err(faults) => {
                    self.tell(loader, of, cohort, faults);
                    refused[cohort.species] = true;
                }
            }
        }
        Some(models).filter(|models| models.len() == trial.cohorts().len())
    }

    /// Adds the faults of a cohort: those of a constant that a scenario states at the place where it is stated, all
    /// others in the species.
    fn tell(&self, loader: &mut Loader, found: &Found, cohort: &Cohort, faults: Vec<fault::Fault>) {
        for fault in faults {
            let stated = match fault.path.0.as_slice() {
                [Segment::Key(table), Segment::Key(name)] if table == "define" => self.states(cohort, name),
                _ => None,
            };
            loader.tell(stated.unwrap_or(&found.node), vec![fault]);
        }
    }

    /// The tree of the first treatment that states a constant for a cohort.
    fn states(&self, cohort: &Cohort, name: &str) -> Option<&Node> {
        let surroundings = cohort.surroundings.as_ref().filter(|around| around.constants.contains_key(name))?;
        let is_of = |read: &&Read| {
            let around = read.scenario.as_ref().and_then(Scenario::surroundings);
            around.is_some_and(|around| around == **surroundings)
        };
        self.read.iter().find(is_of).map(|read| &read.expanded.node)
    }
}

/// Reads a species and checks what it says of itself.
fn read_species(loader: &mut Loader, mention: &Mention) -> Option<Found> {
    let found = loader.species(mention)?;
    if let Some(about) = &found.about {
        loader.tell(&found.node, about.faults());
        check_year(loader, &found.node, about, &found.model);
        check_priors(loader, &found.node, about, &found.model);
    }
    Some(found)
}

/// Reads, checks and compiles a species without dates, in surroundings of its own.
pub(crate) fn check_species(
    loader: &mut Loader,
    mention: &Mention,
    until: impl Fn(Option<&About>) -> u32,
    around: &Surroundings,
) -> Option<Compiled> {
    let Found { about, model, node } = read_species(loader, mention)?;
    let model = if model.reads_surroundings() { model.surrounded(around) } else { model };
    match model.compile(until(about.as_ref())) {
        Ok(compiled) => Some(Compiled { species: Species { about: about?, model }, model: compiled, tree: node }),
        Err(faults) => {
            loader.tell(&node, faults);
            None
        }
    }
}

/// Each prior names a number of its table.
fn check_priors(loader: &mut Loader, node: &Node, about: &About, model: &Model) {
    let species = Species { about: about.clone(), model: model.clone() };
    if let Err(faults) = Numbers::of(&species).map_or(Ok(Vec::new()), |numbers| numbers.priors()) {
        loader.tell(node, faults);
    }
}

/// A species has one year: where its season states the ticks of a year too, both numbers must agree.
fn check_year(loader: &mut Loader, node: &Node, about: &About, model: &Model) {
    let (Some(stated), Some((path, in_season))) = (about.ticks_per_year.as_ref().map(Constant::value), model.year())
    else {
        return;
    };
    if stated == f64::from(in_season) {
        return;
    }
    let other = path_of(&["ticks_per_year"]);
    let span = node.locate(&other);
    let ((line, column), file) = (loader.sources.place(span), &loader.sources.get(span.source).name);
    let problem = format!(
        "the year of the season is of {in_season} ticks, and `ticks_per_year` is {stated} ({file}:{line}:{column})"
    );
    loader.faults.push(Fault::new(node.locate(&path), &path, problem, "the same number at both places"));
}
