//! What `mesh` and `picture` have in common: a run, a scenario or a species by its name, its plants grown again, and
//! the wind that may move them.
//!
//! Nothing is read from the run's tables. A species by itself grows in a scenario made up for it. Absent: growing,
//! which is
//! `run::regrowth`'s, and what is made of the plants.

use super::constants::Constants;
use super::named::{self, Named, Recorded};
use super::{Misuse, Verdict, refuse};
use anyhow::{Result, anyhow};
use clap::Args;
use phytomer::run::forms;
use phytomer::run::regrowth::{Air, Regrowth};
use phytomer_config::{MODELS, Resolved, ResolvedSpecies, Scenario, Species, Treatment, Trial, compiled};
use phytomer_outputs::meshes::OwnForms;
use phytomer_sim::mechanics::sway::{GUSTS_S, Unmoved, yielding};
use phytomer_sim::site::Wind;
use phytomer_sim::{GrowthModel, Tick};
use std::sync::Arc;

/// The strongest wind that is asked for, m/s: as in a scenario's site.
const MOST_WIND: f64 = 100.0;

/// Plants of a species by itself: each number below is one of them.
const PLANTS_ALONE: u32 = 1000;
/// The most components of such a plant: it may be of any species.
const MOST_COMPONENTS_ALONE: u32 = 4_000_000;

/// Something whose plants can be grown again.
pub struct Regrown {
    /// How they grow.
    pub scenario: Scenario,
    /// The treatments that they are given.
    pub trial: Trial,
    /// What they are: the species in the order of the run.
    species: Vec<Species>,
    /// The models of the cohorts of the trial, compiled for all ages that their plants reach.
    models: Vec<Arc<dyn GrowthModel>>,
    /// The forms of its own that each species names.
    pub forms: Vec<Arc<OwnForms>>,
}

/// What drops.
#[derive(Debug, Clone, Copy, Args)]
pub struct Fall {
    /// Between two ticks, let leaves, petals and fruits that fall by the later one drop to the ground first. Without it
    /// they stay until then.
    #[arg(long)]
    pub fall: bool,
}

/// The wind of one frame; by default none.
#[derive(Debug, Clone, Default, Args)]
pub struct Breeze {
    /// A gusty wind of so many metres a second, for this frame alone; the species needs wood that bends, or is a tree
    /// of stems with a law of sway of its own. 0 is calm.
    #[arg(long, value_name = "M/S", allow_negative_numbers = true, value_parser = wind_speed)]
    wind: Option<f64>,
    /// The direction towards which the wind blows, degrees from the X axis (east) to the Y axis (north).
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, requires = "wind", allow_negative_numbers = true, value_parser = finite)]
    wind_towards: f64,
    /// By how much gusts are faster, m/s: of a tree of stems, which sways by a law of its own (Weber & Penn 1995 §4.7).
    #[arg(long, value_name = "M/S", requires = "wind", allow_negative_numbers = true, value_parser = wind_speed)]
    gust: Option<f64>,
    /// Let a tree of stems be, after so many seconds of wind, as it was: the rates at which its stems swing are
    /// rounded, so that a film of this length closes.
    #[arg(long = "loop", value_name = "SECONDS", requires = "wind", allow_negative_numbers = true, value_parser = closing)]
    closes: Option<f64>,
    /// The moment of the frame, seconds.
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0, requires = "wind", allow_negative_numbers = true, value_parser = finite)]
    time: f64,
}

impl Regrown {
    /// What a name stands for, an L-system with these constants; `ages` are those asked for, to which a species by
    /// itself must grow.
    ///
    /// # Errors
    /// Where a run cannot be read, or the constants are for nothing. What is wrong with a file is told, and the verdict
    /// comes back instead.
    pub fn find(name: &str, constants: &Constants, ages: &[Tick]) -> Result<std::result::Result<Self, Verdict>> {
        let found = match named::find_with(name, &constants.surroundings()) {
            Ok(found) => found,
            Err(report) => return refuse(&report, false).map(Err),
        };
        constants.check(name, &found)?;
        Ok(Ok(match found {
            Named::Run(folder) => {
                let recorded = Recorded::of(&folder)?;
                let models = recorded.compile()?;
                let forms = recorded.all_species().map(|species| forms::of_run(species, &recorded.run));
                let forms = forms.collect::<std::result::Result<_, _>>()?;
                let species = recorded.all_species().cloned().collect();
                Self { scenario: recorded.scenario, trial: recorded.trial, species, models, forms }
            }
            Named::Scenario(resolved) => {
                let species: Vec<Species> = resolved.all_species().into_iter().cloned().collect();
                let trial = resolved.trial();
                let forms = species.iter().map(forms::of).collect::<std::result::Result<_, _>>()?;
                let models = [resolved.model].into_iter().chain(resolved.other_models).collect();
                Self { scenario: resolved.scenario, trial, species, models, forms }
            }
            Named::Species(found) => Self::alone(name, *found, ages)?,
        }))
    }

    /// Grown to the last of `ages`, or as long as it takes to show what it is.
    fn alone(name: &str, found: ResolvedSpecies, ages: &[Tick]) -> Result<Self> {
        let until = ages.iter().copied().max().unwrap_or_else(|| found.shown_at()).max(1);
        let Resolved { mut scenario, species, .. } = found.alone(name);
        scenario.ages.until = until;
        scenario.plants = PLANTS_ALONE;
        scenario.limits.max_components = MOST_COMPONENTS_ALONE;
        let model = species.model.compile(until).map_err(|faults| match faults.into_iter().next() {
            // A fault of the age itself has no path before its words.
            Some(fault) => Misuse(format!("{name} to the age {until}: {}", fault.to_string().trim_start_matches(": "))),
            None => Misuse(format!("{name} cannot be grown to the age {until}")),
        })?;
        let forms = vec![forms::of(&species)?];
        let trial = Trial::of(&scenario, &[]);
        Ok(Self { scenario, trial, species: vec![species], models: vec![model], forms })
    }

    /// The same, with trees of stems of another quality.
    ///
    /// # Errors
    /// A species that does not hold at this quality.
    pub fn with_quality(mut self, quality: f64) -> Result<Self> {
        self.species.iter_mut().for_each(|species| {
            species.model.set_quality(quality);
        });
        let species: Vec<&Species> = self.species.iter().collect();
        self.models = compiled(&self.trial, &species).map_err(|(_, faults)| match faults.into_iter().next() {
            Some(fault) => anyhow!(Misuse(format!("--quality {quality}: {fault}"))),
            None => anyhow!(Misuse(format!("--quality {quality}: the species cannot be grown"))),
        })?;
        Ok(self)
    }

    /// The species in the order of the run.
    pub fn species(&self) -> Vec<&Species> {
        self.species.iter().collect()
    }

    /// The models of the cohorts of the trial.
    pub fn models(&self) -> Vec<&dyn GrowthModel> {
        self.models.iter().map(AsRef::as_ref).collect()
    }

    /// The species of a plant.
    pub fn species_of(&self, plant: u32) -> &Species {
        &self.species[self.trial.species_of_plant(plant)]
    }

    /// Its plants, grown again in the wind that is asked for.
    ///
    /// # Errors
    /// Where wind cannot move a species.
    pub fn regrowth(&self, breeze: &Breeze) -> Result<Regrowth<'_>> {
        let air = breeze.air();
        for (cohort, model) in self.trial.cohorts().iter().zip(&self.models) {
            let species = &self.species[cohort.species];
            breeze.check(model.sways(), species)?;
            if model.sways() || air.is_none() {
                continue;
            }
            yielding(&model.habit()).map_err(|unmoved| self.unmoved(species, unmoved, breeze))?;
        }
        Ok(Regrowth::new(self.trial.clone(), self.models(), air))
    }

    /// Refuses what the run does not have.
    ///
    /// # Errors
    /// An age or a plant outside of the run, by the option that names it.
    pub fn check(
        &self,
        (age_option, ages): (&str, &[impl Into<f64> + Copy]),
        (plant_option, plants): (&str, &[u32]),
    ) -> Result<()> {
        let count = self.trial.plants();
        if let Some(plant) = plants.iter().find(|plant| **plant >= count) {
            return Err(Misuse(format!("{plant_option} {plant}: the run has the plants 0 to {}", count - 1)).into());
        }
        for &plant in plants {
            let until = self.trial.last_age_of(plant);
            let beyond = |age: &f64| *age > f64::from(until);
            let Some(age) = ages.iter().map(|age| (*age).into()).find(beyond) else { continue };
            let sown = self.trial.sown_at(plant);
            let whose = if sown == 0 {
                format!("the run has the ages 0 to {until}")
            } else {
                format!("plant {plant}, which is sown at tick {sown}, has the ages 0 to {until}")
            };
            return Err(Misuse(format!("{age_option} {age}: {whose}")).into());
        }
        Ok(())
    }

    /// Refuses a plot or a tick that the run does not have.
    ///
    /// # Errors
    /// By the option that names it.
    pub fn check_plot(&self, (tick_option, ticks): (&str, &[impl Into<f64> + Copy]), plot: u32) -> Result<()> {
        let (until, plots) = (self.scenario.ages.until, self.trial.plots());
        if plot >= plots {
            return Err(Misuse(format!("--plot {plot}: the run has the plots 0 to {}", plots - 1)).into());
        }
        match ticks.iter().map(|tick| (*tick).into()).find(|tick: &f64| *tick > f64::from(until)) {
            Some(tick) => Err(Misuse(format!("{tick_option} {tick}: the plot has the ticks 0 to {until}")).into()),
            None => Ok(()),
        }
    }

    /// What to do where wind cannot move a species.
    fn unmoved(&self, species: &Species, unmoved: Unmoved, breeze: &Breeze) -> Misuse {
        let name = &species.about.name;
        let (lacks, needs) = match unmoved {
            Unmoved::Stiff => ("no wood that bends", "a `[wood]` table, such as `like = \"birch\"`"),
            Unmoved::NoDrag => ("wood without drag", "`drag` in its `[wood]`, such as `drag = { c = 2, n = 0.5 }`"),
        };
        let place = self.species.iter().position(|known| std::ptr::eq(known, species)).unwrap_or(0);
        let of_treatment = |treatment: &'_ Treatment| {
            let known = treatment.species.iter().position(|known| *known == place)?;
            treatment.scenario.species_names().get(known).map(|name| (*name).to_owned())
        };
        let file = self.trial.treatments().iter().find_map(of_treatment).unwrap_or_else(|| name.clone());
        let wind = breeze.wind.unwrap_or_default();
        let model = species.model.name();
        let with_wood = MODELS.into_iter().filter(|model| model.card().keys.wood.is_some());
        Misuse(match model.card().keys.wood {
            Some(_) => format!(
                "--wind {wind}: the species `{name}` has {lacks}. Its file (`{file}`) needs {needs}; a species that ships is \
                 extended by a file of your own with `inherits = \"{name}\"`. `phytomer list woods` has the woods"
            ),
            None => {
                let knowing: Vec<String> = with_wood.map(|model| format!("`{}`", model.word())).collect();
                let (model, knowing) = (model.word(), knowing.join(" and "));
                format!(
                    "--wind {wind}: the species `{name}` has {lacks}, and its model `{model}` knows none: only {knowing} does"
                )
            }
        })
    }
}

impl Breeze {
    /// Whether anything is said of a wind.
    pub fn is_stated(&self) -> bool {
        self.wind.is_some()
    }

    /// The moving air that is asked for; a calm is none.
    pub fn air(&self) -> Option<Air> {
        let (speed, gust) = (self.wind?, self.gust.unwrap_or(0.0));
        let wind = Wind { speed, towards: self.wind_towards.to_radians() };
        (speed > 0.0 || gust > 0.0).then_some(Air { wind, gust, closes: self.closes, time: self.time })
    }

    /// The length after which the motion closes, seconds.
    pub fn closes(&self) -> Option<f64> {
        self.closes
    }

    /// The same wind, in which trees of stems close after so many seconds, if nothing else is asked for.
    pub fn closing(&self, seconds: f64) -> Self {
        Self { closes: self.closes.or(Some(seconds)), ..self.clone() }
    }

    /// Refuses what the law of sway of a species does not know: gusts and closing films are for models with a law of
    /// their own, directions for mechanics.
    fn check(&self, sways: bool, species: &Species) -> Result<(), Misuse> {
        let name = &species.about.name;
        let own = [("--gust", self.gust.is_some()), ("--loop", self.closes.is_some())];
        match own.into_iter().find(|(_, used)| *used && !sways) {
            Some((option, _)) => Err(Misuse(format!(
                "{option}: the species `{name}` sways by its wood, in gusts every {GUSTS_S} seconds that always close; this \
                 is for trees that sway by a law of their model, such as `wp/quaking_aspen`"
            ))),
            None if sways && self.wind_towards != 0.0 => Err(Misuse(format!(
                "--wind-towards {}: the species `{name}` sways by a law of its model, which moves stems to all sides and knows \
                 no direction",
                self.wind_towards
            ))),
            None => Ok(()),
        }
    }

    /// The same, to be told.
    pub fn in_words(&self) -> String {
        let gusts = |gust: f64| if gust > 0.0 { format!(" with gusts of {gust} m/s more") } else { String::new() };
        let told = |air: Air| format!(" in a wind of {} m/s{} at {} s", air.wind.speed, gusts(air.gust), air.time);
        self.air().map(told).unwrap_or_default()
    }
}

fn wind_speed(text: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(speed) if (0.0..=MOST_WIND).contains(&speed) => Ok(speed),
        _ => Err(format!("a speed from 0 to {MOST_WIND} m/s is expected")),
    }
}

/// A length of a film that closes.
fn closing(text: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if (1e-3..=3600.0).contains(&seconds) => Ok(seconds),
        _ => Err("a length from 0.001 to 3600 seconds is expected".to_owned()),
    }
}

/// A number that is one.
///
/// # Errors
/// What is expected.
pub fn finite(text: &str) -> std::result::Result<f64, String> {
    text.parse::<f64>().ok().filter(|number| number.is_finite()).ok_or_else(|| "a number is expected".to_owned())
}
