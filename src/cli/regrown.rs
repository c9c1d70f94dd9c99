//! What `mesh` and `picture` have in common: a run, a scenario or a species by its name, its plants grown again, and
//! the wind that may move them.
//!
//! Nothing is read from the run's tables. A species by itself grows in a scenario made up for it. Absent: growing,
//! which is
//! `run::regrowth`'s, and what is made of the plants.

use super::named::{self, Named, Recorded};
use super::{Misuse, Verdict, refuse};
use anyhow::Result;
use clap::Args;
use phytomer::run::forms;
use phytomer::run::regrowth::{Air, Regrowth};
use phytomer_config::{Model, Resolved, ResolvedSpecies, Scenario, Species};
use phytomer_outputs::meshes::OwnForms;
use phytomer_sim::mechanics::sway::{Unmoved, yielding};
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
    /// What they are.
    pub species: Species,
    /// The species' model, compiled for all ages of the scenario.
    pub model: Arc<dyn GrowthModel>,
    /// The forms of its own that the species names.
    pub forms: Arc<OwnForms>,
}

/// The wind of one frame.
#[derive(Debug, Clone, Args)]
pub struct Breeze {
    /// A gusty wind of so many metres a second, for this frame alone; the species needs wood that bends. 0 is calm.
    #[arg(long, value_name = "M/S", allow_negative_numbers = true, value_parser = wind_speed)]
    wind: Option<f64>,
    /// The direction towards which the wind blows, degrees from the X axis (east) to the Y axis (north).
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, requires = "wind", allow_negative_numbers = true, value_parser = finite)]
    wind_towards: f64,
    /// The moment of the frame, seconds.
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0, requires = "wind", allow_negative_numbers = true, value_parser = finite)]
    time: f64,
}

impl Regrown {
    /// What a name stands for; `ages` are those asked for, to which a species by itself must grow.
    ///
    /// # Errors
    /// Where a run cannot be read. What is wrong with a file is told, and the verdict comes back instead.
    pub fn find(name: &str, ages: &[Tick]) -> Result<std::result::Result<Self, Verdict>> {
        let found = match named::find(name) {
            Ok(found) => found,
            Err(report) => return refuse(&report, false).map(Err),
        };
        Ok(Ok(match found {
            Named::Run(folder) => {
                let recorded = Recorded::of(&folder)?;
                let model = recorded.compile()?;
                let forms = forms::of_run(&recorded.species, &recorded.run)?;
                Self { scenario: recorded.scenario, species: recorded.species, model, forms }
            }
            Named::Scenario(resolved) => {
                let forms = forms::of(&resolved.species)?;
                Self { scenario: resolved.scenario, species: resolved.species, model: resolved.model, forms }
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
            Some(fault) => Misuse(format!("{name} to the age {until}: {fault}")),
            None => Misuse(format!("{name} cannot be grown to the age {until}")),
        })?;
        let forms = forms::of(&species)?;
        Ok(Self { scenario, species, model, forms })
    }

    /// Its plants, grown again in the wind that is asked for.
    ///
    /// # Errors
    /// Where wind cannot move the species.
    pub fn regrowth(&self, breeze: &Breeze) -> Result<Regrowth<'_>> {
        let air = breeze.air();
        if air.is_some() {
            yielding(&self.model.habit()).map_err(|unmoved| self.unmoved(unmoved, breeze))?;
        }
        Ok(Regrowth { scenario: &self.scenario, model: self.model.as_ref(), air })
    }

    /// Refuses what the run does not have.
    ///
    /// # Errors
    /// An age or a plant outside of the run, by the option that names it.
    pub fn check(&self, (age_option, ages): (&str, &[Tick]), (plant_option, plants): (&str, &[u32])) -> Result<()> {
        let (until, count) = (self.scenario.ages.until, self.scenario.plants);
        if let Some(age) = ages.iter().find(|age| !(1..=until).contains(*age)) {
            return Err(Misuse(format!("{age_option} {age}: the run has the ages 1 to {until}")).into());
        }
        if let Some(plant) = plants.iter().find(|plant| **plant >= count) {
            return Err(Misuse(format!("{plant_option} {plant}: the run has the plants 0 to {}", count - 1)).into());
        }
        Ok(())
    }

    /// What to do where wind cannot move the species.
    fn unmoved(&self, unmoved: Unmoved, breeze: &Breeze) -> Misuse {
        let name = &self.species.about.name;
        let (lacks, needs) = match unmoved {
            Unmoved::Stiff => ("no wood that bends", "a `[wood]` table, such as `like = \"birch\"`"),
            Unmoved::NoDrag => ("wood without drag", "`drag` in its `[wood]`, such as `drag = { c = 2, n = 0.5 }`"),
        };
        let file = &self.scenario.species;
        let wind = breeze.wind.unwrap_or_default();
        Misuse(match &self.species.model {
            Model::Buds(_) => format!(
                "--wind {wind}: the species `{name}` has {lacks}. Its file (`{file}`) needs {needs}; a species that ships is \
                 extended by a file of your own with `inherits = \"{name}\"`. `phytomer list woods` has the woods"
            ),
            model => {
                let model = model.name().word();
                format!(
                    "--wind {wind}: the species `{name}` has {lacks}, and its model `{model}` knows none: only `buds` does"
                )
            }
        })
    }
}

impl Breeze {
    /// The moving air that is asked for; a calm is none.
    pub fn air(&self) -> Option<Air> {
        let speed = self.wind.filter(|speed| *speed > 0.0)?;
        Some(Air { wind: Wind { speed, towards: self.wind_towards.to_radians() }, time: self.time })
    }

    /// The same, to be told.
    pub fn in_words(&self) -> String {
        self.air().map(|air| format!(" in a wind of {} m/s at {} s", air.wind.speed, air.time)).unwrap_or_default()
    }
}

fn wind_speed(text: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(speed) if (0.0..=MOST_WIND).contains(&speed) => Ok(speed),
        _ => Err(format!("a speed from 0 to {MOST_WIND} m/s is expected")),
    }
}

/// A number that is one.
///
/// # Errors
/// What is expected.
pub fn finite(text: &str) -> std::result::Result<f64, String> {
    text.parse::<f64>().ok().filter(|number| number.is_finite()).ok_or_else(|| "a number is expected".to_owned())
}
