//! The cohorts of a run: the plants of a species that have the same dates and the same surroundings, for each of which
//! one model is compiled.
//!
//! What depends on the date alone is compiled away: a law of the date is a table of the age. So a species with such
//! laws has a model for each calendar and each tick of sowing; the plants of a species without them are one cohort,
//! whatever their dates. Treatments differ in their calendars, and so do the replicates of a treatment that grow in
//! years or on soils of their own. A species that reads what the scenario states for it (`[define]`, shapes of the
//! site) has a model for each of the scenarios that differ in it. Absent: which laws hold.

use std::collections::BTreeMap;
use std::sync::Arc;

use phytomer_law::fault::{Fault, Path};
use phytomer_models::parameters::Surroundings;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::site::calendar::{Calendar, Dates};
use phytomer_sim::site::calendars::Calendars;

use crate::load::path_of;
use crate::models::{Model, Reads};
use crate::scenario::{Experiment, FieldPlot, Member, Scenario};

/// The most models of a run, and the most calendars of field plots that differ.
const MOST_COHORTS: usize = 1000;

/// The most ages that these models have tables for, and the most ticks of these calendars, in all.
const MOST_AGES: u64 = 2_000_000;

/// The plants of a species for which one model is compiled.
#[derive(Debug, Clone, PartialEq)]
pub struct Cohort {
    /// The species, as an index into the species of the run.
    pub species: usize,
    /// Their dates; `None` where the species has no laws of the date, or ticks have no dates.
    pub dates: Option<Dates>,
    /// What the scenario of their treatment states for them; `None` where the species reads nothing of it, or nothing
    /// is stated.
    pub surroundings: Option<Arc<Surroundings>>,
    /// The last age that one of them reaches.
    pub until: u32,
}

impl Cohort {
    /// The model of these plants, whose species has these parameters.
    ///
    /// # Errors
    /// Every fault, each with its path from the top of the species file.
    pub fn compile(&self, model: &Model) -> Result<Arc<dyn GrowthModel>, Vec<Fault>> {
        match &self.surroundings {
            None => model.compile_dated(self.until, self.dates.as_ref()),
            Some(around) => model.surrounded(around).compile_dated(self.until, self.dates.as_ref()),
        }
    }
}

/// The cohorts of a run, and to which of them each member of each field plot belongs.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Cohorts {
    pub all: Vec<Cohort>,
    /// Of each treatment the cohort of each member: for all replicates, or for each one.
    of_members: Vec<Vec<Vec<usize>>>,
}

impl Cohorts {
    /// The cohorts of treatments, each with its scenario and the place of each of its species in the run. `calendars`
    /// are those of each treatment. `reads` tells of each species of the run what its models depend on; a species that
    /// it does not tell of depends on nothing.
    pub fn of<'a>(
        treatments: impl Iterator<Item = (&'a Scenario, &'a [usize])>,
        calendars: &[Calendars],
        reads: &[Reads],
    ) -> Self {
        let mut found = Finding { reads, ..Finding::default() };
        let of_members = treatments.enumerate().map(|(place, treatment)| {
            let calendars = calendars.get(place).map(Calendars::all).unwrap_or_default();
            match calendars.is_empty() {
                true => vec![found.members_of(treatment, None)],
                false => calendars.iter().map(|calendar| found.members_of(treatment, Some(calendar))).collect(),
            }
        });
        let of_members = of_members.collect();
        Self { all: found.all, of_members }.by_species()
    }

    /// The same in the order of the species, so that the first cohort is of the first species.
    fn by_species(mut self) -> Self {
        let mut order: Vec<usize> = (0..self.all.len()).collect();
        order.sort_by_key(|place| self.all[*place].species);
        let mut places = vec![0; order.len()];
        order.iter().enumerate().for_each(|(place, before)| places[*before] = place);
        self.of_members.iter_mut().flatten().flatten().for_each(|cohort| *cohort = places[*cohort]);
        self.all = order.into_iter().map(|before| self.all[before].clone()).collect();
        self
    }

    /// The cohort of each member of a field plot.
    pub fn of_members(&self, treatment: usize, replicate: u32) -> &[usize] {
        let of_treatment = self.of_members.get(treatment).map(Vec::as_slice).unwrap_or_default();
        of_treatment.get(replicate as usize).or(of_treatment.last()).map(Vec::as_slice).unwrap_or_default()
    }

    /// How often the replicates of a treatment differ: 1 where all have the same cohorts.
    pub fn rows_of(&self, treatment: usize) -> &[Vec<usize>] {
        self.of_members.get(treatment).map(Vec::as_slice).unwrap_or_default()
    }

    /// The fault of too many models.
    pub fn check(&self) -> Option<Fault> {
        let dated = || self.all.iter().filter(|cohort| cohort.dates.is_some());
        let (models, ages) = (dated().count(), dated().map(|cohort| u64::from(cohort.until) + 1).sum::<u64>());
        (models > MOST_COHORTS || ages > MOST_AGES).then(|| {
            let problem = format!(
                "species with laws of the date are compiled for each calendar and tick of sowing: {models} times here, \
                 for {ages} ages in all"
            );
            let expected = format!(
                "at most {MOST_COHORTS} times and {MOST_AGES} ages: fewer replicates with years or soils of their own, \
                 or fewer ticks of sowing"
            );
            Fault::new(&path_of(&["calendar"]), problem, expected)
        })
    }
}

/// What tells cohorts apart: the species, its dates, which are the place of its calendar and its tick of sowing, and
/// the place of its surroundings.
type Distinction = (usize, Option<(usize, u32)>, Option<usize>);

/// The cohorts that are found so far.
#[derive(Default)]
struct Finding<'a> {
    reads: &'a [Reads],
    /// The calendars that differ.
    calendars: Vec<Arc<Calendar>>,
    /// What scenarios state for their species, where it differs.
    surroundings: Vec<Arc<Surroundings>>,
    /// The place of each cohort.
    places: BTreeMap<Distinction, usize>,
    all: Vec<Cohort>,
}

impl Finding<'_> {
    /// The cohort of each member of a plot with this calendar.
    fn members_of(
        &mut self,
        (scenario, species): (&Scenario, &[usize]),
        calendar: Option<&Arc<Calendar>>,
    ) -> Vec<usize> {
        let calendar = calendar.map(|calendar| (self.place_of(calendar), calendar));
        let members = scenario.plot_members();
        let around = scenario.surroundings().map(|around| self.place_of_surroundings(around));
        let cohort = |member: &Member| {
            let species = species.get(scenario.species_of(member)).copied().unwrap_or(0);
            let reads = self.reads.get(species).copied().unwrap_or_default();
            let around = around.filter(|_| reads.surroundings);
            let dated = calendar.filter(|_| reads.dates).map(|(place, calendar)| {
                ((place, member.sown), Dates { calendar: Arc::clone(calendar), sown: member.sown })
            });
            let (key, dates) = dated.unzip();
            let until = scenario.ages.until.saturating_sub(member.sown).max(1);
            let place = *self.places.entry((species, key, around)).or_insert(self.all.len());
            match self.all.get_mut(place) {
                Some(known) => known.until = known.until.max(until),
                None => {
                    let surroundings = around.map(|place| Arc::clone(&self.surroundings[place]));
                    self.all.push(Cohort { species, dates, surroundings, until });
                }
            }
            place
        };
        members.iter().map(cohort).collect()
    }

    /// The place of what a scenario states among what differs.
    fn place_of_surroundings(&mut self, around: Surroundings) -> usize {
        self.surroundings.iter().position(|other| **other == around).unwrap_or_else(|| {
            self.surroundings.push(Arc::new(around));
            self.surroundings.len() - 1
        })
    }

    /// The place of a calendar among those that differ.
    fn place_of(&mut self, calendar: &Arc<Calendar>) -> usize {
        let known = |other: &Arc<Calendar>| Arc::ptr_eq(other, calendar) || other == calendar;
        self.calendars.iter().position(known).unwrap_or_else(|| {
            self.calendars.push(Arc::clone(calendar));
            self.calendars.len() - 1
        })
    }
}

/// The calendars of a treatment, by its name and its scenario, with what its blocks and field plots shift, drawn by a
/// seed.
pub(crate) fn shifted(
    (name, scenario): (&str, &Scenario),
    calendars: &Calendars,
    experiment: &Experiment,
    seed: u64,
) -> Calendars {
    let Some(soil) = scenario.soil.as_ref().filter(|soil| soil.differs() && calendars.of(0).is_some()) else {
        return calendars.clone();
    };
    let mut known: Vec<(u64, &Arc<Calendar>, Arc<Calendar>)> = Vec::new();
    let of_replicate = |replicate| {
        let block = experiment.block_of(replicate);
        let more = soil.shift_in(&FieldPlot { seed, treatment: name, replicate, block });
        let calendar = calendars.of(replicate)?;
        let is_known = |(bits, of, _): &&(u64, &Arc<Calendar>, _)| *bits == more.to_bits() && Arc::ptr_eq(of, calendar);
        if let Some((_, _, shifted)) = known.iter().find(is_known) {
            return Some(Arc::clone(shifted));
        }
        let shifted = Arc::new(Calendar::clone(calendar).supplied(more));
        known.push((more.to_bits(), calendar, Arc::clone(&shifted)));
        Some(shifted)
    };
    Calendars::new((0..experiment.replicates).filter_map(of_replicate).collect())
}

/// The fault of more calendars of field plots than a run can have, at the key that makes them differ.
pub(crate) fn check_calendars<'a>(run: &Scenario, treatments: impl Iterator<Item = &'a Scenario>) -> Option<Fault> {
    let replicates = run.experiment.replicates as usize;
    let mut first = None;
    let mut differing = 0_usize;
    for scenario in treatments.filter(|scenario| scenario.soil.as_ref().is_some_and(|soil| soil.differs())) {
        differing = differing.saturating_add(replicates);
        first = first.or_else(|| {
            let of_blocks = scenario.soil.as_ref().is_some_and(|soil| soil.block_sd_kg_ha > 0.0);
            Some(if of_blocks { "block_sd_kg_ha" } else { "field_plot_sd_kg_ha" })
        });
    }
    let ticks = (differing as u64).saturating_mul(u64::from(run.ages.until) + 1);
    let key = first.filter(|_| differing > MOST_COHORTS || ticks > MOST_AGES)?;
    let problem =
        format!("{differing} field plots would have soils of their own, in calendars of {ticks} ticks in all");
    let expected =
        format!("at most {MOST_COHORTS} field plots and {MOST_AGES} ticks: fewer replicates, or fewer ticks");
    Some(Fault::new(&Path::root().key("soil").key(key), problem, expected))
}
