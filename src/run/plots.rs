//! The plots of a trial as they are sown: each member with its species, its draws, its place and its tick of sowing.
//!
//! Plots stand on the field of the trial (`field`), members beside the place of their plot, and obstacles that kill
//! buds with their plot: so a plot differs from the others of its treatment by its place and by the draws of its plants
//! alone. Draws are keyed by replicate and number, not by treatment, so treatments are compared on the same draws.
//! Where no plant can feel another one, or an obstacle, a single plant can be sown without its plot. Absent: growing.

use super::field::Field;
use phytomer_config::scenario::{FieldPlot, Host, Member, Table, exposure};
use phytomer_config::{PlantPlace, PlotPlace, Scenario, Treatment, Trial};
use phytomer_sim::management::Management;
use phytomer_sim::plant::{Seed, ThreadBudget};
use phytomer_sim::random::{PlantRandom, draw_key};
use phytomer_sim::site::Site;
use phytomer_sim::site::calendar::Calendar;
use phytomer_sim::site::light::Light;
use phytomer_sim::{GrowthModel, NEVER, Plot, Sowing};
use std::sync::Arc;

/// The plots of a run, to be sown. Costs a few words a member and treatment.
#[derive(Clone)]
pub struct Plots<'a> {
    trial: Trial,
    field: Field,
    /// What people do to the plants of each treatment: for all replicates, or for each one.
    management: Vec<Vec<Management>>,
    /// The site of each treatment, of a plot at the origin.
    sites: Vec<Site>,
    /// The light of each treatment: for all replicates, or for each one.
    lights: Vec<Vec<Option<Light>>>,
    /// The models of the cohorts of the trial.
    models: Vec<&'a dyn GrowthModel>,
    /// The members of the plots of each treatment.
    members: Vec<Vec<Member>>,
}

impl<'a> Plots<'a> {
    /// The plots of a trial whose cohorts have these models.
    pub fn of(trial: Trial, models: Vec<&'a dyn GrowthModel>) -> Self {
        let field = Field::of(&trial);
        let members = trial.treatments().iter().map(|treatment| treatment.scenario.plot_members()).collect();
        let management = (0..trial.treatments().len()).map(|treatment| managed(&trial, treatment)).collect();
        let sites = trial.treatments().iter().map(|treatment| treatment.scenario.site.felt()).collect();
        let lights = (0..trial.treatments().len()).map(|treatment| lit(&trial, treatment)).collect();
        Self { trial, field, management, sites, lights, models, members }
    }

    /// The trial.
    pub fn trial(&self) -> &Trial {
        &self.trial
    }

    /// The models of its cohorts.
    pub fn models(&self) -> &[&'a dyn GrowthModel] {
        &self.models
    }

    /// A plot before its first tick.
    pub fn sow(&self, plot: u32, budget: ThreadBudget) -> Plot<'a> {
        let mut sown = Plot::new(plot, self.models.clone(), &self.sowings(plot));
        self.settle(&mut sown, plot);
        sown.manage(self.management_of(plot).clone());
        sown.plants.iter_mut().for_each(|plant| plant.budget = budget);
        self.expose(&mut sown);
        sown
    }

    /// Makes a plot that was grown another one. The memory of its columns is kept where both are of one treatment, have
    /// members of the same cohorts, and the same is done to them at the same ticks.
    pub fn sow_again(&self, grown: &mut Plot<'a>, plot: u32) {
        let PlotPlace { treatment, replicate, .. } = self.trial.plot(plot);
        let cohorts = self.trial.cohorts_of(treatment, replicate);
        let is_alike = grown.members.iter().map(|member| member.species).eq(cohorts.iter().copied());
        let is_managed_alike = self.management[treatment].len() == 1 || replicate == grown.replicate;
        if treatment == grown.treatment as usize && is_alike && is_managed_alike {
            grown.sow_again(plot, &self.sowings(plot));
            self.settle(grown, plot);
            self.expose(grown);
        } else {
            let budget = grown.plants.first().map(|plant| plant.budget).unwrap_or_default();
            *grown = self.sow(plot, budget);
        }
    }

    /// A plant by itself in a plot of one, sown at tick 0, so that tick and age are the same.
    pub fn sow_alone(&self, plant: u32) -> Plot<'a> {
        let plot = self.trial.plant(plant).plot;
        let species = self.trial.cohort_of_plant(plant);
        let (seed, place) = (self.seed_of(plant), self.place_of(plant));
        let sown = if self.germinates(plant) { 0 } else { NEVER };
        let mut alone = Plot::new(plot, self.models.clone(), &[Sowing { species, seed, place, sown }]);
        self.settle(&mut alone, plot);
        // Light that nobody feels is recorded with the plot, not here.
        alone.site.light = None;
        alone.manage(self.management_of(plot).clone());
        self.expose(&mut alone);
        alone
    }

    /// Tells the plants of a plot what pests will do to them. Treatments are compared on the same draws.
    fn expose(&self, plot: &mut Plot) {
        for (plant, member) in plot.plants.iter_mut().zip(&plot.members) {
            let PlantPlace { treatment, replicate, number, .. } = self.trial.plant(plant.id);
            let Treatment { name, scenario, .. } = &self.trial.treatments()[treatment];
            let block = self.trial.block_of(replicate);
            let sown = if self.trial.is_successor(plant.id) { 0 } else { member.sown };
            let host = Host {
                field_plot: FieldPlot { seed: scenario.seed, treatment: name, replicate, block },
                plot: plot.number,
                plant: number,
                place: [plant.place[0], plant.place[1]],
                until: scenario.ages.until.saturating_sub(sown),
                sown,
                calendar: self.trial.calendar_of(treatment, replicate).map(Arc::as_ref),
            };
            plant.exposure = exposure(&scenario.pest, &host);
        }
    }

    /// Whether a plant depends on what else stands in its plot, or on when it was sown in it: events have ticks of the
    /// plot, and may choose among its plants.
    pub fn feed_back(&self, plant: u32) -> bool {
        let plot = self.trial.plant(plant).plot;
        self.site(plot).feeds_back() || !self.management_of(plot).is_empty()
    }

    /// What people do to the plants of a plot.
    fn management_of(&self, plot: u32) -> &Management {
        let PlotPlace { treatment, replicate, .. } = self.trial.plot(plot);
        let of_treatment = &self.management[treatment];
        &of_treatment[(replicate as usize).min(of_treatment.len() - 1)]
    }

    /// The place of a plot, metres.
    pub fn plot_place(&self, plot: u32) -> [f64; 3] {
        self.field.place(&self.trial, plot)
    }

    /// Where the seed of a plant lies, metres: the place of its plot, and from there to that of the member.
    pub fn place_of(&self, plant: u32) -> [f64; 3] {
        let place = self.plot_place(self.trial.plant(plant).plot);
        let beside = self.trial.member_of(plant).place();
        let shift = self.shift_of(plant);
        [0, 1, 2].map(|axis| place[axis] + beside[axis] + shift[axis])
    }

    /// How far a plant stands from the place of its member, metres.
    fn shift_of(&self, plant: u32) -> [f64; 3] {
        let PlantPlace { treatment, replicate, number, .. } = self.trial.plant(plant);
        let random = PlantRandom::new(self.trial.scenario().seed, draw_key(replicate, number));
        self.trial.treatments()[treatment].scenario.shift_of(&random)
    }

    /// States what the plot is in the trial, and what its plants stand on.
    fn settle(&self, sown: &mut Plot<'a>, plot: u32) {
        let PlotPlace { treatment, replicate, number, .. } = self.trial.plot(plot);
        (sown.treatment, sown.replicate, sown.number) = (treatment as u32, replicate, number);
        sown.block = self.trial.block_of(replicate);
        sown.site = self.site(plot);
    }

    fn site(&self, plot: u32) -> Site {
        let PlotPlace { treatment, replicate, .. } = self.trial.plot(plot);
        let place = self.plot_place(plot);
        let mut site = self.sites[treatment].moved(place);
        let lights = &self.lights[treatment];
        site.light = lights[(replicate as usize).min(lights.len() - 1)].as_ref().map(|light| light.moved(place));
        let sees = |cohort: &usize| self.models[*cohort].sees_light();
        if let Some(light) = &mut site.light {
            light.felt = self.trial.cohorts_of(treatment, replicate).iter().any(sees);
        }
        let claiming = |cohort: &&usize| self.models[**cohort].cell_m().is_some();
        // A plant by itself has no one to claim its cells from.
        site.cells.shared = self.trial.cohorts_of(treatment, replicate).iter().filter(claiming).count() > 1;
        site
    }

    fn sowings(&self, plot: u32) -> Vec<Sowing> {
        let of = self.trial.plot(plot);
        let place = self.plot_place(plot);
        let cohorts = self.trial.cohorts_of(of.treatment, of.replicate);
        let sowing = |((member, cohort), plant): ((&Member, &usize), u32)| {
            let (beside, shift) = (member.place(), self.shift_of(plant));
            Sowing {
                species: *cohort,
                seed: self.seed_of(plant),
                place: [0, 1, 2].map(|axis| place[axis] + beside[axis] + shift[axis]),
                // A successor waits for its event.
                sown: if member.replaces.is_none() && self.germinates(plant) { member.sown } else { NEVER },
            }
        };
        self.members[of.treatment].iter().zip(cohorts).zip(of.first_plant..).map(sowing).collect()
    }

    /// Whether the seed of a plant germinates.
    pub fn germinates(&self, plant: u32) -> bool {
        let percent = self.trial.scenario_of(plant).planting.germination;
        let PlantPlace { replicate, number, .. } = self.trial.plant(plant);
        let random = || PlantRandom::new(self.trial.scenario().seed, draw_key(replicate, number));
        percent >= 100.0 || random().germinates(percent / 100.0)
    }

    /// What a plant grows from.
    fn seed_of(&self, plant: u32) -> Seed {
        let PlantPlace { replicate, number, .. } = self.trial.plant(plant);
        Seed { draws: draw_key(replicate, number), ..seed_of(self.trial.scenario(), plant) }
    }
}

/// The most components of a plant.
pub fn component_limit(scenario: &Scenario) -> u32 {
    scenario.limits.components()
}

/// What plant number `plant` of a scenario grows from, where nothing is compared.
pub fn seed_of(scenario: &Scenario, plant: u32) -> Seed {
    Seed {
        plant,
        draws: draw_key(0, plant),
        run_seed: scenario.seed,
        component_limit: component_limit(scenario),
        keep_events: scenario.tables.contains(&Table::Events),
    }
}

/// The light of the plots of a treatment, by its calendars.
fn lit(trial: &Trial, treatment: usize) -> Vec<Option<Light>> {
    let scenario = &trial.treatments()[treatment].scenario;
    let one = |calendar: Option<&Arc<Calendar>>| {
        let told = trial.scenario().output.light;
        scenario.lit(calendar.map(Arc::as_ref)).map(|light| Light { told, ..light })
    };
    trial.calendars_of(treatment).into_iter().map(one).collect()
}

/// What people do to the plants of a treatment, by its calendars.
fn managed(trial: &Trial, treatment: usize) -> Vec<Management> {
    let scenario = &trial.treatments()[treatment].scenario;
    trial.calendars_of(treatment).into_iter().map(|calendar| scenario.management(calendar)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use phytomer_config::scenario::Limits;
    use phytomer_config::validate;

    #[test]
    fn the_smaller_limit_holds() {
        let mut resolved = validate("example1").unwrap_or_else(|report| panic!("{}", report.render(false)));
        let mut limit = |limits: Limits| {
            resolved.scenario.limits = limits;
            component_limit(&resolved.scenario)
        };
        assert_eq!(limit(Limits::default()), 50_000_000);
        assert_eq!(limit(Limits { max_memory_mb: Some(96), ..Limits::default() }), 1_000_000);
        assert_eq!(limit(Limits { max_components: 5_000, max_memory_mb: Some(96) }), 5_000);
    }
}
