//! The trial of a run: its treatments, and the numbers of their plots and plants.
//!
//! Plots and plants are numbered through the whole run: treatment by treatment, in each replicate by replicate, in each
//! plot by plot and member by member. `plants` of a scenario is the number of plants of one replicate of a treatment.
//! What is drawn is keyed by the replicate and the number within it, never by the treatment, so that treatments are
//! compared on the same draws. Absent: places on the field, and growing.

use std::sync::Arc;

use phytomer_law::fault::{Fault, Path};
use phytomer_sim::site::calendar::Calendar;
use phytomer_sim::site::calendars::Calendars;
use serde::{Deserialize, Serialize};

use crate::cohorts::{Cohort, Cohorts, shifted};
use crate::models::Reads;
use crate::scenario::experiment::{CONTROL, MOST_FIELD_PLOTS};
use crate::scenario::{Member, Scenario};

/// The most plants of a run.
const MOST_PLANTS: u64 = 1_000_000_000;

/// A treatment: the scenario with one level of each factor laid over it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Treatment {
    /// Its name.
    pub name: String,
    /// The name of its level of each factor, in the order of the factors.
    pub levels: Vec<String>,
    /// Its scenario, without `experiment`.
    pub scenario: Scenario,
    /// Its species: of each of [`Scenario::species_names`], the index in the species of the run.
    pub species: Vec<usize>,
}

impl Treatment {
    /// The one treatment of a run that compares none.
    pub fn control(scenario: &Scenario) -> Self {
        let mut scenario = scenario.clone();
        scenario.experiment = Default::default();
        let species = (0..scenario.species_names().len()).collect();
        Self { name: CONTROL.to_owned(), levels: Vec::new(), scenario, species }
    }

    /// What grows in its plots: its scenario and its species.
    fn grown(&self) -> (&Scenario, &[usize]) {
        (&self.scenario, &self.species)
    }
}

/// Where a plot belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlotPlace {
    /// Its treatment, as an index into [`Trial::treatments`].
    pub treatment: usize,
    /// Its replicate, from 0.
    pub replicate: u32,
    /// Its number within treatment and replicate, from 0.
    pub number: u32,
    /// The number in the run of its first plant.
    pub first_plant: u32,
}

/// Where a plant belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlantPlace {
    /// Its treatment, as an index into [`Trial::treatments`].
    pub treatment: usize,
    /// Its replicate, from 0.
    pub replicate: u32,
    /// Its number within treatment and replicate, from 0.
    pub number: u32,
    /// The number in the run of its plot.
    pub plot: u32,
    /// Its index among the members of its plot.
    pub member: u32,
}

/// The treatments of a run with the numbers of their plots.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    scenario: Scenario,
    treatments: Vec<Treatment>,
    /// The first plot of each treatment, and the number of all plots.
    plots: Vec<u32>,
    /// The first plant of each treatment, and the number of all plants.
    plants: Vec<u32>,
    /// The calendars of each treatment.
    calendars: Vec<Calendars>,
    cohorts: Cohorts,
}

impl Trial {
    /// The trial of a scenario in which ticks have no dates. What belongs to the whole run, such as the seed and the
    /// ages, is the scenario's own in every treatment; a scenario without factors is its own treatment.
    pub fn of(scenario: &Scenario, treatments: &[Treatment]) -> Self {
        let treatments: Vec<Treatment> = match treatments {
            treatments if !treatments.is_empty() && !scenario.experiment.is_control_alone() => {
                treatments.iter().map(|treatment| settled(scenario, treatment)).collect()
            }
            _ => vec![Treatment::control(scenario)],
        };
        let replicates = scenario.experiment.replicates;
        let (mut plots, mut plants) = (vec![0_u32], vec![0_u32]);
        for Treatment { scenario, .. } in &treatments {
            let after = |firsts: &[u32], count: u32| {
                firsts.last().copied().unwrap_or(0).saturating_add(count.saturating_mul(replicates))
            };
            plots.push(after(&plots, scenario.plots()));
            plants.push(after(&plants, scenario.plots() * scenario.members()));
        }
        let cohorts = Cohorts::of(treatments.iter().map(Treatment::grown), &[], &[]);
        Self { scenario: scenario.clone(), treatments, plots, plants, calendars: Vec::new(), cohorts }
    }

    /// The same where each treatment has such calendars, which its blocks and field plots shift by draws of the seed.
    /// `reads` tells of each species of the run what its models depend on beside its own parameters.
    pub fn dated(self, calendars: &[Calendars], reads: &[Reads], seed: u64) -> Self {
        let shifted = self.shifted(calendars, seed);
        self.in_calendars(shifted, reads)
    }

    /// The calendars of each treatment with what its blocks and field plots shift, by draws of the seed.
    pub(crate) fn shifted(&self, calendars: &[Calendars], seed: u64) -> Vec<Calendars> {
        let each = self.treatments.iter().zip(calendars);
        let of_treatment = |(Treatment { name, scenario, .. }, calendars): (&Treatment, &Calendars)| {
            shifted((name, scenario), calendars, &self.scenario.experiment, seed)
        };
        each.map(of_treatment).collect()
    }

    /// The same where each treatment has these calendars, in which nothing is to be shifted.
    pub(crate) fn in_calendars(mut self, calendars: Vec<Calendars>, reads: &[Reads]) -> Self {
        self.calendars = calendars;
        self.cohorts = Cohorts::of(self.treatments.iter().map(Treatment::grown), &self.calendars, reads);
        self
    }

    /// The calendars of each treatment; none where ticks have no dates.
    pub fn calendars(&self) -> &[Calendars] {
        &self.calendars
    }

    /// The calendar of a replicate of a treatment; `None` where ticks have no dates.
    pub fn calendar_of(&self, treatment: usize, replicate: u32) -> Option<&Arc<Calendar>> {
        self.calendars.get(treatment)?.of(replicate)
    }

    /// The calendars of a treatment that may differ, by their replicates: one if all replicates have the same one, or
    /// ticks have no dates.
    pub fn calendars_of(&self, treatment: usize) -> Vec<Option<&Arc<Calendar>>> {
        let all = self.calendars.get(treatment).map(Calendars::all).unwrap_or_default();
        if all.is_empty() { vec![None] } else { all.iter().map(Some).collect() }
    }

    /// The first age at which an event of a treatment may cut a plant in some replicate; `None` where none cuts.
    pub(crate) fn first_cut(&self, treatment: usize) -> Option<u32> {
        let scenario = &self.treatments[treatment].scenario;
        let of = |calendar: Option<&Arc<Calendar>>| scenario.first_cut(calendar.map(Arc::as_ref));
        self.calendars_of(treatment).into_iter().filter_map(of).min()
    }

    /// The cohorts of the run, of each of which a model is compiled.
    pub fn cohorts(&self) -> &[Cohort] {
        &self.cohorts.all
    }

    /// The fault of more cohorts than a run can have.
    pub(crate) fn check_cohorts(&self) -> Option<Fault> {
        self.cohorts.check()
    }

    /// The cohort of each member of the plots of a treatment and replicate, as an index into [`Trial::cohorts`].
    pub fn cohorts_of(&self, treatment: usize, replicate: u32) -> &[usize] {
        self.cohorts.of_members(treatment, replicate)
    }

    /// The different rows of [`Trial::cohorts_of`] of the replicates of a treatment: one where all have the same, else
    /// one for each replicate.
    pub fn rows_of_cohorts(&self, treatment: usize) -> &[Vec<usize>] {
        self.cohorts.rows_of(treatment)
    }

    /// The cohort of a plant.
    pub fn cohort_of_plant(&self, plant: u32) -> usize {
        let PlantPlace { treatment, replicate, member, .. } = self.plant(plant);
        self.cohorts_of(treatment, replicate).get(member as usize).copied().unwrap_or(0)
    }

    /// The scenario, without the levels of any treatment.
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// The treatments, at least one.
    pub fn treatments(&self) -> &[Treatment] {
        &self.treatments
    }

    /// The number of replicates of each treatment.
    pub fn replicates(&self) -> u32 {
        self.scenario.experiment.replicates
    }

    /// The number of all plots.
    pub fn plots(&self) -> u32 {
        self.plots.last().copied().unwrap_or(0)
    }

    /// The number of all plants.
    pub fn plants(&self) -> u32 {
        self.plants.last().copied().unwrap_or(0)
    }

    /// The most plants that a plot has.
    pub fn most_members(&self) -> u32 {
        self.treatments.iter().map(|treatment| treatment.scenario.members()).max().unwrap_or(1)
    }

    /// The block of a replicate; `None` where the design has no blocks.
    pub fn block_of(&self, replicate: u32) -> Option<u32> {
        self.scenario.experiment.block_of(replicate)
    }

    /// Where a plot belongs; beyond the last plot, where that would.
    pub fn plot(&self, plot: u32) -> PlotPlace {
        let treatment = self.treatment_of(&self.plots, plot);
        let scenario = &self.treatments[treatment].scenario;
        let of_treatment = plot - self.plots[treatment];
        let (plots, members) = (scenario.plots().max(1), scenario.members());
        PlotPlace {
            treatment,
            replicate: of_treatment / plots,
            number: of_treatment % plots,
            first_plant: self.plants[treatment] + of_treatment * members,
        }
    }

    /// Where a plant belongs.
    pub fn plant(&self, plant: u32) -> PlantPlace {
        let treatment = self.treatment_of(&self.plants, plant);
        let scenario = &self.treatments[treatment].scenario;
        let of_treatment = plant - self.plants[treatment];
        let members = scenario.members();
        let plants = (scenario.plots() * members).max(1);
        PlantPlace {
            treatment,
            replicate: of_treatment / plants,
            number: of_treatment % plants,
            plot: self.plots[treatment] + of_treatment / members,
            member: of_treatment % members,
        }
    }

    /// The treatment in whose range of numbers a plot or a plant lies.
    fn treatment_of(&self, firsts: &[u32], number: u32) -> usize {
        firsts.partition_point(|first| *first <= number).clamp(1, self.treatments.len()) - 1
    }

    /// The scenario of the treatment of a plant.
    pub fn scenario_of(&self, plant: u32) -> &Scenario {
        &self.treatments[self.plant(plant).treatment].scenario
    }

    /// What a plant is in its plot.
    pub fn member_of(&self, plant: u32) -> Member {
        let PlantPlace { treatment, member, .. } = self.plant(plant);
        self.treatments[treatment].scenario.member_at(member as usize).unwrap_or_default()
    }

    /// Whether a plant is planted by an event alone, so that it is not known before when.
    pub fn is_successor(&self, plant: u32) -> bool {
        let PlantPlace { treatment, member, .. } = self.plant(plant);
        let stated = self.treatments[treatment].scenario.stated_members().get(member as usize);
        stated.is_some_and(|member| member.replaces.is_some())
    }

    /// A member of a species of the run that is planted by an event alone, by its number.
    pub(crate) fn successor_of(&self, species: usize) -> Option<usize> {
        self.treatments.iter().find_map(|Treatment { scenario, species: places, .. }| {
            let of_species = |member: &Member| places.get(scenario.species_of(member)) == Some(&species);
            scenario.stated_members().iter().position(|member| member.replaces.is_some() && of_species(member))
        })
    }

    /// The tick of its plot at which a plant is sown.
    pub fn sown_at(&self, plant: u32) -> u32 {
        self.member_of(plant).sown
    }

    /// The age, in ticks, that a plant has at the end of the run.
    pub fn last_age_of(&self, plant: u32) -> u32 {
        self.scenario.ages.until.saturating_sub(self.sown_at(plant))
    }

    /// The species of a plant, as an index into the species of the run.
    pub fn species_of_plant(&self, plant: u32) -> usize {
        let treatment = &self.treatments[self.plant(plant).treatment];
        treatment.species.get(treatment.scenario.species_of(&self.member_of(plant))).copied().unwrap_or(0)
    }
}

/// A treatment in whose scenario all that belongs to the whole run is that of the run.
fn settled(run: &Scenario, treatment: &Treatment) -> Treatment {
    let run = run.clone();
    let scenario = Scenario {
        name: run.name,
        description: run.description,
        seed: run.seed,
        ages: run.ages,
        tables: run.tables,
        sample: run.sample,
        meshes: run.meshes,
        limits: run.limits,
        output: run.output,
        experiment: Default::default(),
        ..treatment.scenario.clone()
    };
    Treatment { scenario, ..treatment.clone() }
}

/// The plants of a run whose treatments have these scenarios, and the fault of too many of them.
pub(crate) fn check_size<'a>(run: &Scenario, treatments: impl Iterator<Item = &'a Scenario>) -> Result<u32, Fault> {
    let replicates = u64::from(run.experiment.replicates);
    let path = Path::root().key("experiment").key("replicates");
    let (mut plants, mut field_plots) = (0_u64, 0_u64);
    for scenario in treatments {
        plants = plants.saturating_add(replicates.saturating_mul(scenario.plants.into()));
        field_plots = field_plots.saturating_add(replicates);
    }
    if field_plots > MOST_FIELD_PLOTS {
        let problem = format!("{field_plots} replicates of treatments are too many");
        return Err(Fault::new(&path, problem, format!("at most {MOST_FIELD_PLOTS} in all")));
    }
    let few = u32::try_from(plants).ok().filter(|few| u64::from(*few) <= MOST_PLANTS);
    few.ok_or_else(|| {
        let problem = format!("all treatments and replicates together have {plants} plants");
        Fault::new(&path, problem, format!("at most {MOST_PLANTS} plants in a run"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trial() -> Trial {
        let text = "name = \"a\"\nspecies = \"coffee\"\nplants = 4\nages = { until = 12 }\n[experiment]\nreplicates = 3\n\
                    [[experiment.factor]]\nname = \"stand\"\nlevel = [{ name = \"alone\" }, { name = \"pairs\", plants = 6, member = \
                    [{}, { species = \"phlox\", sown = 5 }] }]\n";
        let resolved =
            crate::validate_texts("a", &[("a", text)]).unwrap_or_else(|report| panic!("{}", report.render(false)));
        resolved.trial()
    }

    #[test]
    fn plots_and_plants_are_numbered_treatment_by_treatment() {
        let trial = trial();
        assert_eq!((trial.plots(), trial.plants(), trial.most_members()), (3 * 4 + 3 * 3, 3 * 4 + 3 * 6, 2));
        let place = |plot| {
            let PlotPlace { treatment, replicate, number, first_plant } = trial.plot(plot);
            (treatment, replicate, number, first_plant)
        };
        assert_eq!([0, 3, 4, 11].map(place), [(0, 0, 0, 0), (0, 0, 3, 3), (0, 1, 0, 4), (0, 2, 3, 11)]);
        assert_eq!([12, 14, 15, 20].map(place), [(1, 0, 0, 12), (1, 0, 2, 16), (1, 1, 0, 18), (1, 2, 2, 28)]);
        for plant in 0..trial.plants() {
            let at = trial.plant(plant);
            let plot = trial.plot(at.plot);
            assert_eq!(plant, plot.first_plant + at.member);
            let members = trial.scenario_of(plant).members();
            assert_eq!((at.treatment, at.replicate), (plot.treatment, plot.replicate));
            assert_eq!(at.number, plot.number * members + at.member);
        }
    }

    #[test]
    fn a_species_reaches_its_last_age_in_the_treatment_that_sows_it_first() {
        let trial = trial();
        let ages: Vec<(usize, u32)> = trial.cohorts().iter().map(|cohort| (cohort.species, cohort.until)).collect();
        assert_eq!(ages, [(0, 12), (1, 7)]);
        assert_eq!([0, 12, 13].map(|plant| trial.species_of_plant(plant)), [0, 0, 1]);
        assert_eq!([0, 12, 13].map(|plant| trial.cohort_of_plant(plant)), [0, 0, 1]);
        assert_eq!((trial.sown_at(13), trial.last_age_of(13)), (5, 7));
    }

    /// What the command line changes of the run holds in every treatment.
    #[test]
    fn what_belongs_to_the_run_is_that_of_the_scenario() {
        let before = trial();
        let mut scenario = before.scenario().clone();
        (scenario.seed, scenario.ages.until) = (3, 9);
        let after = Trial::of(&scenario, before.treatments());
        assert!(after.treatments().iter().all(|of| (of.scenario.seed, of.scenario.ages.until) == (3, 9)));
        assert_eq!(after.treatments()[1].scenario.member.len(), 2);
    }
}
