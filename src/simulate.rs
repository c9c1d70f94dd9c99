//! The simulator of fits and sensitivities: from numbers of a species and a seed to summaries of the plants that grow
//! with them.
//!
//! Numbers are set by their paths (`order.1.pause.value`), the model is compiled, and so many plants of the seed grow
//! on open ground, each by itself. Equal seeds give equal draws whatever the numbers are (common random numbers), and a
//! simulation is a function of its numbers and its seed alone. Works for every model whose species has numbers. Absent:
//! estimation (`phytomer_fits`), files but the journal, and scenarios.

pub mod journal;
mod measured;
pub mod observed;
pub mod summaries;

use measured::Measures;
use phytomer_config::{Numbers, Report, ResolvedSpecies, Unknown, validate_species};
use phytomer_models::fault::Fault;
use phytomer_outputs::tables;
use phytomer_sim::clock::LAST_TICK;
use phytomer_sim::plant::Seed;
use phytomer_sim::random::draw_key;
use phytomer_sim::{Ending, GrowthModel, Plot, RecordError, Recorder, Tick, grow};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use std::time::Instant;
use summaries::{Summary, What};

/// The most components of a simulated plant.
const COMPONENT_LIMIT: u32 = 5_000_000;

/// Steps to which a number is rounded where the model refuses any number: those of speeds, and whole numbers.
const STEPS: [f64; 2] = [1e-4, 1.0];

/// A number that is varied, within limits.
#[derive(Debug, Clone, PartialEq)]
pub struct Varied {
    /// Its path.
    pub name: String,
    /// The least and the largest value.
    pub limits: [f64; 2],
    /// The step to which it is rounded; `None` where it can have any value.
    pub step: Option<f64>,
    number: usize,
}

/// Why there is no simulator.
#[derive(Debug, thiserror::Error)]
pub enum Unready {
    /// The species is wrong.
    #[error(transparent)]
    Species(#[from] Box<Report>),
    /// A path leads to no number.
    #[error("{species}: {unknown}")]
    Unknown {
        /// The species.
        species: String,
        /// What is not known.
        unknown: Unknown,
    },
    /// Limits that a number cannot have.
    #[error("{species}: {number} = {value}: {problem}")]
    Limit {
        /// The species.
        species: String,
        /// The path of the number.
        number: String,
        /// The value.
        value: f64,
        /// What the model says.
        problem: String,
    },
    /// Anything else that was asked for and cannot be.
    #[error("{0}")]
    Asked(String),
}

/// Why a simulation has no summaries.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Failure {
    /// It was told to stop.
    #[error("stopped")]
    Stopped,
    /// The model refuses the numbers.
    #[error("the model refuses these numbers: {0}")]
    Refused(String),
    /// A plant grew too large.
    #[error("a plant has more than {COMPONENT_LIMIT} components at age {0}")]
    Overgrown(Tick),
    /// No plant has a value.
    #[error("no plant has a value of {0}")]
    Nothing(String),
    /// A table could not be made.
    #[error("{0}")]
    Table(String),
}

/// A simulator.
pub struct Simulator {
    found: ResolvedSpecies,
    numbers: Numbers,
    varied: Vec<Varied>,
    asked: Vec<Summary>,
    measures: Measures,
    plants: u32,
    until: Tick,
    /// The ages at which sizes of plants are asked for.
    ages: Vec<Tick>,
    stop: AtomicBool,
    spent: [AtomicU64; 2],
}

impl Simulator {
    /// A simulator of a species, shipped or in a file, that varies no number yet.
    ///
    /// # Errors
    /// [`Unready`]: a species that is wrong, no summaries, no plants, an age that is no age.
    pub fn of(species: &str, asked: Vec<Summary>, plants: u32) -> Result<Self, Unready> {
        let until = asked.iter().map(|summary| summary.age).max().unwrap_or(0);
        if !(1..=LAST_TICK).contains(&until) || plants == 0 {
            return Err(Unready::Asked("a summary at an age and at least one plant are expected".to_owned()));
        }
        let found = validate_species(species, until).map_err(Box::new)?;
        let numbers = Numbers::of(&found.species).map_err(|error| Unready::Asked(error.to_string()))?;
        let of_sizes = |summary: &&Summary| matches!(summary.what, What::Size { .. } | What::Living);
        let mut ages: Vec<Tick> = asked.iter().filter(of_sizes).map(|summary| summary.age).collect();
        ages.sort_unstable();
        ages.dedup();
        let measures = Measures::of(&found, species, &asked, plants);
        let (stop, spent) = (AtomicBool::new(false), [AtomicU64::new(0), AtomicU64::new(0)]);
        Ok(Self { found, numbers, varied: Vec::new(), asked, measures, plants, until, ages, stop, spent })
    }

    /// Varies a number within limits.
    ///
    /// # Errors
    /// A path that leads to no number, limits that are not in order, and a limit that the model refuses.
    pub fn vary(&mut self, path: &str, limits: [f64; 2]) -> Result<(), Unready> {
        let species = || self.name().to_owned();
        let unknown = |unknown| Unready::Unknown { species: species(), unknown };
        let number = self.numbers.find(path).map_err(unknown)?;
        self.vary_number(number, limits)
    }

    /// Varies every number that the species has under a prior.
    ///
    /// # Errors
    /// A limit that the model refuses.
    pub fn vary_priors(&mut self) -> Result<(), Unready> {
        let priors = self.numbers.priors().map_err(|faults| Unready::Asked(told(&faults)))?;
        for prior in priors {
            self.vary_number(prior.number, prior.limits).map_err(|unready| match unready {
                Unready::Limit { value, problem, .. } => {
                    let problem = format!("the prior reaches {value}, which the model refuses: {problem}");
                    let fault = Fault::new(&prior.path, problem, "limits that the number can have");
                    Unready::Species(Box::new(self.found.report(vec![fault])))
                }
                other => other,
            })?;
        }
        Ok(())
    }

    /// Varies every number by so large a share of itself, but those that are 0 or whole, and those that the model
    /// refuses to change. Returns how many of these there are.
    pub fn vary_all(&mut self, share: f64) -> usize {
        let mut refused = 0;
        for number in 0..self.numbers.all().len() {
            let (value, whole) = (self.numbers.all()[number].value, self.numbers.all()[number].whole);
            if value == 0.0 || whole {
                continue;
            }
            let off = share * value.abs();
            refused += usize::from(self.vary_number(number, [value - off, value + off]).is_err());
        }
        refused
    }

    fn vary_number(&mut self, number: usize, limits: [f64; 2]) -> Result<(), Unready> {
        let name = self.numbers.all()[number].name.clone();
        let [low, high] = limits;
        if !(low.is_finite() && high.is_finite() && low < high) {
            return Err(Unready::Asked(format!("{name} = {low}..{high}: two numbers in order are expected")));
        }
        if self.varied.iter().any(|known| known.number == number) {
            return Err(Unready::Asked(format!("{name} is varied twice: name it once")));
        }
        let at = |value: f64| self.compiled(&[(number, value)]).map(drop);
        for value in limits {
            at(value).map_err(|problem| Unready::Limit {
                species: self.name().to_owned(),
                number: name.clone(),
                value,
                problem,
            })?;
        }
        // A value with many digits, which no whole number and no speed has.
        let between = low + (high - low) * 0.543_210_987_6;
        let step = if self.numbers.all()[number].whole { Some(1.0) } else { None };
        let step = match (step, at(between)) {
            (Some(step), _) => Some(step),
            (None, Ok(())) => None,
            (None, Err(problem)) => {
                let fits = STEPS.into_iter().find(|step| at((between / step).round() * step).is_ok());
                Some(fits.ok_or(Unready::Limit {
                    species: self.name().to_owned(),
                    number: name.clone(),
                    value: between,
                    problem,
                })?)
            }
        };
        self.varied.push(Varied { name, limits, step, number });
        Ok(())
    }

    /// The numbers that are varied.
    pub fn varied(&self) -> &[Varied] {
        &self.varied
    }

    /// The places of the varied numbers in [`Simulator::numbers`].
    pub fn places(&self) -> Vec<usize> {
        self.varied.iter().map(|varied| varied.number).collect()
    }

    /// All numbers of the species.
    pub fn numbers(&self) -> &Numbers {
        &self.numbers
    }

    /// The summaries that are asked for.
    pub fn asked(&self) -> &[Summary] {
        &self.asked
    }

    /// The plants of a simulation.
    pub fn plants(&self) -> u32 {
        self.plants
    }

    fn name(&self) -> &str {
        &self.numbers.species().about.name
    }

    /// Tells all simulations to stop soon.
    pub fn stop(&self) {
        self.stop.store(true, Relaxed);
    }

    /// Whether it was told to stop.
    pub fn is_stopped(&self) -> bool {
        self.stop.load(Relaxed)
    }

    /// The seconds that its threads have spent in all simulations, and in growth with its measures alone.
    pub fn spent(&self) -> [f64; 2] {
        [0, 1].map(|of| self.spent[of].load(Relaxed) as f64 * 1e-9)
    }

    /// A value as the species takes it.
    pub fn rounded(&self, varied: usize, value: f64) -> f64 {
        self.varied[varied].step.map_or(value, |step| (value / step).round() * step)
    }

    /// The values of the varied numbers at shares of their ranges.
    pub fn values(&self, shares: &[f64]) -> Vec<f64> {
        let of = |(varied, share): (&Varied, &f64)| varied.limits[0] + (varied.limits[1] - varied.limits[0]) * share;
        self.varied.iter().zip(shares).map(of).collect()
    }

    /// The share of its range at which the species states each varied number.
    pub fn stated_shares(&self) -> Vec<f64> {
        let of = |varied: &Varied| {
            let [low, high] = varied.limits;
            ((self.numbers.all()[varied.number].value - low) / (high - low)).clamp(0.0, 1.0)
        };
        self.varied.iter().map(of).collect()
    }

    /// Why a summary has no value in a simulation; `None` where it has one.
    pub fn lack(&self, of: usize, values: &[f64], seed: u64) -> Option<Failure> {
        match self.simulate(values, seed) {
            Err(failure) => Some(failure),
            Ok(found) if found[of].is_finite() => None,
            Ok(_) => Some(Failure::Nothing(self.asked[of].name.clone())),
        }
    }

    /// The summaries of plants that grow with these values of the varied numbers and this seed; NaN where no plant has
    /// a value.
    ///
    /// # Errors
    /// [`Failure`].
    pub fn simulate(&self, values: &[f64], seed: u64) -> Result<Vec<f64>, Failure> {
        let begun = Instant::now();
        let found = self.grown(values, seed);
        self.spent[0].fetch_add(begun.elapsed().as_nanos() as u64, Relaxed);
        found
    }

    fn grown(&self, values: &[f64], seed: u64) -> Result<Vec<f64>, Failure> {
        if self.is_stopped() {
            return Err(Failure::Stopped);
        }
        let set = self.varied.iter().zip(values).enumerate();
        let set: Vec<(usize, f64)> =
            set.map(|(place, (varied, value))| (varied.number, self.rounded(place, *value))).collect();
        let species = self.numbers.with(&set).map_err(Failure::Refused)?;
        let seen = if self.ages.is_empty() {
            Vec::new()
        } else {
            let model = species.model.compile(self.until).map_err(|faults| Failure::Refused(told(&faults)))?;
            let begun = Instant::now();
            let seen = self.plants_of(model.as_ref(), seed)?;
            self.spent[1].fetch_add(begun.elapsed().as_nanos() as u64, Relaxed);
            seen
        };
        let begun = Instant::now();
        let measured = self.measures.taken(&species, seed)?;
        if !self.measures.is_empty() {
            self.spent[1].fetch_add(begun.elapsed().as_nanos() as u64, Relaxed);
        }
        let of = |(place, summary): (usize, &Summary)| {
            let found = match &summary.what {
                What::Size { .. } | What::Living => of_seen(summary, &seen),
                _ => measured.get(&place).copied(),
            };
            found.filter(|value| value.is_finite()).unwrap_or(f64::NAN)
        };
        Ok(self.asked.iter().enumerate().map(of).collect())
    }

    fn compiled(&self, set: &[(usize, f64)]) -> Result<std::sync::Arc<dyn GrowthModel>, String> {
        self.numbers.with(set)?.model.compile(self.until).map_err(|faults| told(&faults))
    }

    /// What is seen of each plant at each age.
    fn plants_of(&self, model: &dyn GrowthModel, seed: u64) -> Result<Vec<Seen>, Failure> {
        let mut view = View { ages: &self.ages, seen: Vec::new() };
        for plant in 0..self.plants {
            if self.is_stopped() {
                return Err(Failure::Stopped);
            }
            let draws = draw_key(0, plant);
            let sown = Seed { plant, draws, run_seed: seed, component_limit: COMPONENT_LIMIT, keep_events: false };
            let mut plot = Plot::of_one(model, &sown);
            match grow(&mut plot, self.until, &mut view) {
                Ok(Ending::Complete) => {}
                Ok(Ending::Overgrown { age, .. }) => return Err(Failure::Overgrown(age)),
                Err(error) => return Err(Failure::Table(error.to_string())),
            }
        }
        Ok(view.seen)
    }
}

/// The first fault of a model, with its path.
fn told(faults: &[Fault]) -> String {
    faults.first().map_or_else(|| "it does not compile".to_owned(), ToString::to_string)
}

/// A plant at an age, and whether it lived.
struct Seen {
    age: Tick,
    lives: bool,
    sizes: tables::Summary,
}

struct View<'a> {
    ages: &'a [Tick],
    seen: Vec<Seen>,
}

impl Recorder for View<'_> {
    fn wants(&self, age: Tick) -> bool {
        self.ages.contains(&age)
    }

    fn record(&mut self, age: Tick, plot: &Plot) -> Result<(), RecordError> {
        let plant = &plot.plants[0];
        self.seen.push(Seen { age, lives: plant.death > age, sizes: tables::Summary::of(plant, age)? });
        Ok(())
    }
}

/// A summary of the plants that are seen: a mean or a deviation of those that live, or the share of these.
fn of_seen(summary: &Summary, seen: &[Seen]) -> Option<f64> {
    let at_age: Vec<&Seen> = seen.iter().filter(|own| own.age == summary.age).collect();
    let living: Vec<&&Seen> = at_age.iter().filter(|own| own.lives).collect();
    let (size, spread) = match &summary.what {
        What::Living => return Some(living.len() as f64 / at_age.len() as f64),
        What::Size { size, spread, .. } => (size, *spread),
        _ => return None,
    };
    let values: Vec<f64> = living.iter().map(|own| size(&own.sizes)).filter(|value| value.is_finite()).collect();
    summaries::summarised(&values, spread)
}
