//! Plants of a run grown again from their seeds, and shown at some ages: what meshes and pictures are made of.
//!
//! Draws are keyed by the run's seed and the plant, so it is the same plant, with the same component numbers, that the
//! run has recorded. A plant is asked for by its number and its own ages, a plot by its number and its ticks. Where
//! something in a plot feeds back, a plant is grown with its whole plot, else by itself. In a wind each age is shown as
//! a frame that the wind has moved, for that age alone. Ages may lie between two ticks. Where no age is given, a plant
//! is shown at that of its species or in its prime. Absent: what is made of it.

use super::RunError;
pub use super::moving::Air;
use super::moving::moved;
use super::plots::Plots;
use phytomer_config::{Resolved, Species, Trial};
use phytomer_sim::between::{Moment, Passage};
use phytomer_sim::plant::{Kind, NodeId, OrganId, Plant, ThreadBudget};
use phytomer_sim::site::light::{Field, Light};
use phytomer_sim::{Ending, GrowthModel, Plot, RecordError, Recorder, Tick, grow, grow_and_look};
use std::borrow::Cow;
use std::sync::Arc;

/// The plants of a scenario, to be grown again.
#[derive(Clone)]
pub struct Regrowth<'a> {
    plots: Plots<'a>,
    /// What moves the plants, if anything does.
    air: Option<Air>,
    /// Whether what falls drops to the ground in its last tick.
    falls: bool,
}

/// What is done with a plant at an age.
pub type Show<'a> = dyn FnMut(Tick, &Plant) -> Result<(), RecordError> + 'a;

/// What is done with a plant at an age that may lie between two ticks. It stands at the later one, [`Moment::tick`].
pub type ShowAt<'a> = dyn FnMut(Moment, &Plant) -> Result<(), RecordError> + 'a;

/// What is done with the plants of a plot at a tick, or between two: those that are sown, in the order of the plot.
pub type ShowPlot<'a> = dyn FnMut(Moment, &[Standing]) -> Result<(), RecordError> + 'a;

/// What moves the plants, once for each time that they are shown at an age.
type Airs<'a> = dyn Fn(Moment) -> Vec<Option<Air>> + 'a;

/// A plant or a plot, by its number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Whose {
    /// A plant.
    Plant(u32),
    /// All plants of a plot.
    Plot(u32),
}

/// A plant of a plot at a tick.
#[derive(Debug)]
pub struct Standing<'p> {
    /// The plant as it stands.
    pub plant: Cow<'p, Plant>,
    /// Its age; between two ticks that at the later one.
    pub age: Tick,
    /// Its species, as an index into the species of the run.
    pub species: usize,
    /// The light of its plot at the tick, where the scenario has light and the whole plot has grown.
    pub light: Option<Arc<Field>>,
}

impl<'a> Regrowth<'a> {
    /// The plants of a trial whose cohorts have these models.
    pub fn new(trial: Trial, models: Vec<&'a dyn GrowthModel>, air: Option<Air>) -> Self {
        Self { plots: Plots::of(trial, models), air, falls: false }
    }

    /// The same plants, whose leaves, petals and fruits drop to the ground in the tick in which they fall, where they
    /// are shown within it.
    #[must_use]
    pub fn falling(self, falls: bool) -> Self {
        Self { falls, ..self }
    }

    /// The plants of a checked scenario, in still air.
    pub fn of(resolved: &'a Resolved) -> Self {
        Self::new(resolved.trial(), resolved.models(), None)
    }

    /// The trial.
    pub fn trial(&self) -> &Trial {
        self.plots.trial()
    }

    /// The place of a plot, metres.
    pub fn plot_place(&self, plot: u32) -> [f64; 3] {
        self.plots.plot_place(plot)
    }

    fn until(&self) -> Tick {
        self.trial().scenario().ages.until
    }

    /// Grows a plant and shows it at `ages`, its own, in their order of time.
    ///
    /// # Errors
    /// What `show` says; a plant that comes to its limit before the last of the ages.
    pub fn show(&self, plant: u32, ages: &[Tick], show: &mut Show<'_>) -> Result<(), RunError> {
        self.show_at(plant, &moments(ages), &mut |age, plant| show(age.tick(), plant))
    }

    /// As [`Regrowth::show`] at ages that may lie between two ticks.
    ///
    /// # Errors
    /// As there.
    pub fn show_at(&self, plant: u32, ages: &[Moment], show: &mut ShowAt<'_>) -> Result<(), RunError> {
        self.check_sown(plant)?;
        let sown = self.sown(plant);
        let at = sown.at;
        let ticks: Vec<Moment> = ages.iter().map(|age| age.later(at)).collect();
        self.show_moved(sown.plot, sown.until, &ticks, &mut |tick, standing| {
            let shown = standing.iter().find(|standing| standing.plant.id == plant);
            shown.map_or(Ok(()), |shown| show(tick.earlier(at), &shown.plant))
        })
    }

    /// Grows a plot and shows its plants that are sown at `ticks`, or between two, in their order of time.
    ///
    /// # Errors
    /// What `show` says; a plant that comes to its limit before the last of the ticks.
    pub fn show_plot(&self, plot: u32, ticks: &[Moment], show: &mut ShowPlot<'_>) -> Result<(), RunError> {
        self.show_moved(self.plots.sow(plot, ThreadBudget::default()), self.until(), ticks, show)
    }

    /// As [`Regrowth::show_at`] of a plant and [`Regrowth::show_plot`] of a plot, once for each of the times that
    /// `times` has for an age, seconds; without air that moves the plants a time is like any other.
    ///
    /// # Errors
    /// As those.
    pub fn show_timed(
        &self,
        whose: Whose,
        ages: &[Moment],
        times: &dyn Fn(Moment) -> Vec<f64>,
        show: &mut ShowPlot<'_>,
    ) -> Result<(), RunError> {
        let airs = |at: Moment| times(at).into_iter().map(|time| self.air.map(|air| Air { time, ..air })).collect();
        match whose {
            Whose::Plot(plot) => {
                self.show_in(self.plots.sow(plot, ThreadBudget::default()), self.until(), (ages, &airs), show)
            }
            Whose::Plant(plant) => {
                self.check_sown(plant)?;
                let sown = self.sown(plant);
                let at = sown.at;
                let ticks: Vec<Moment> = ages.iter().map(|age| age.later(at)).collect();
                let airs = |tick: Moment| airs(tick.earlier(at));
                self.show_in(sown.plot, sown.until, (&ticks, &airs), &mut |tick, standing| {
                    let shown = standing.iter().find(|standing| standing.plant.id == plant);
                    shown.map_or(Ok(()), |shown| show(tick.earlier(at), std::slice::from_ref(shown)))
                })
            }
        }
    }

    fn show_moved(
        &self,
        plot: Plot<'_>,
        until: Tick,
        ticks: &[Moment],
        show: &mut ShowPlot<'_>,
    ) -> Result<(), RunError> {
        self.show_in(plot, until, (ticks, &|_| vec![self.air]), show)
    }

    fn show_in(
        &self,
        mut plot: Plot<'_>,
        until: Tick,
        (ticks, airs): (&[Moment], &Airs<'_>),
        show: &mut ShowPlot<'_>,
    ) -> Result<(), RunError> {
        let mut ticks = ticks.to_vec();
        ticks.sort_unstable();
        ticks.dedup();
        let last = ticks.last().map(|last| last.tick());
        let passage = Passage::new(self.falls);
        let mut shown = ShownTicks { ticks, passage, airs, trial: self.trial(), show };
        // Growth ahead goes to the last tick of the run, not to the last that is shown: that numbers the components.
        let looked = [last.unwrap_or(0), until];
        let ending = grow_and_look(&mut plot, looked, &mut shown).map_err(RunError::of_recorder)?;
        match (ending, last) {
            (Ending::Overgrown { age, limit }, Some(last)) if age <= last => {
                Err(RunError::Overgrown { limit, age, last })
            }
            _ => Ok(()),
        }
    }

    /// The age at which a plant is shown where none is given: the age that its species states (`shown_at`), if
    /// the plant reaches it, else its prime.
    ///
    /// # Errors
    /// As [`Regrowth::prime`].
    pub fn shown_at(&self, species: &Species, plant: u32) -> Result<Tick, RunError> {
        let until = self.trial().last_age_of(plant);
        species
            .about
            .shown_at
            .filter(|age| (1..=until).contains(age))
            .map_or_else(|| self.prime(plant, year_of(species)), Ok)
    }

    /// The prime of a plant: its last year with at least nine tenths of the largest leaf area that it ever bears, and
    /// in it the first age that is so, which is spring where there are seasons. Of a plant without leaves internodes
    /// and organs are counted instead; a model that makes its plant anew at each age has its prime at the last. A year
    /// has so many ticks.
    ///
    /// # Errors
    /// Where it comes to its limit at its first age.
    pub fn prime(&self, plant: u32, year: Tick) -> Result<Tick, RunError> {
        self.check_sown(plant)?;
        let mut sown = self.sown(plant);
        let model = self.plots.models()[self.trial().cohort_of_plant(plant)];
        let mut last = sown.until;
        if !model.growth().keeps_its_past() {
            return Ok(last - sown.at);
        }
        if !sown.plot.ahead(last) {
            let ending = grow(&mut sown.plot, last, &mut ()).map_err(RunError::of_recorder)?;
            if let Ending::Overgrown { age, limit } = ending {
                if age <= sown.at + 1 {
                    return Err(RunError::OvergrownAtOnce { limit, age });
                }
                last = age - 1;
            }
        }
        let grown = sown.plot.plants.iter().find(|grown| grown.id == plant);
        Ok(grown.map_or(1, |grown| prime_of(grown, last - sown.at, year)))
    }

    /// Refuses a plant that is not sown, or of which only its plot tells when it is.
    fn check_sown(&self, plant: u32) -> Result<(), RunError> {
        if self.trial().is_successor(plant) {
            return Err(RunError::Successor { plant, plot: self.trial().plant(plant).plot });
        }
        if self.plots.germinates(plant) { Ok(()) } else { Err(RunError::NotGerminated { plant }) }
    }

    /// A plant before its first tick, by itself where that gives the same plant.
    fn sown(&self, plant: u32) -> SownPlant<'a> {
        let trial = self.trial();
        if self.plots.feed_back(plant) {
            let plot = self.plots.sow(trial.plant(plant).plot, ThreadBudget::default());
            return SownPlant { plot, at: trial.sown_at(plant), until: self.until() };
        }
        SownPlant { plot: self.plots.sow_alone(plant), at: 0, until: trial.last_age_of(plant) }
    }
}

/// A plant in the plot in which it is grown again.
struct SownPlant<'a> {
    plot: Plot<'a>,
    /// The tick of that plot at which it is sown.
    at: Tick,
    /// The last tick of that plot.
    until: Tick,
}

/// The ticks of a year, 1 where none are stated.
fn year_of(species: &Species) -> Tick {
    species.ticks_per_year().map_or(1, |ticks| ticks.round().max(1.0) as Tick)
}

/// The prime of a grown plant of which the ages up to `last` are known.
fn prime_of(plant: &Plant, last: Tick, year: Tick) -> Tick {
    let (organs, nodes) = (&plant.organs, &plant.nodes);
    let leaves = (0..organs.len()).filter(|&k| organs.kind[k] == Kind::Leaf);
    let areas = leaves.flat_map(|k| areas_of(plant, OrganId(k as u32)));
    let stems = (0..nodes.len()).map(|k| (nodes.birth[k], plant.death_of(NodeId(k as u32)), 1.0));
    let count = organs.birth.iter().zip(&organs.death).map(|(birth, death)| (*birth, *death, 1.0)).chain(stems);
    last_of_most(areas, last, year).or_else(|| last_of_most(count, last, year)).unwrap_or(last)
}

/// The area of a leaf while it expands and until its death, tick by tick and then at once.
fn areas_of(plant: &Plant, leaf: OrganId) -> impl Iterator<Item = (Tick, Tick, f64)> {
    let (birth, death) = (plant.organs.birth[leaf.index()], plant.organs.death[leaf.index()]);
    let last = plant.look_of_organ(leaf).map_or(0, |look| look.expansion.len().saturating_sub(1) as Tick);
    (0..=last.min(death.saturating_sub(birth))).map(move |own_age| {
        let from = birth.saturating_add(own_age);
        let until = if own_age < last { death.min(from.saturating_add(1)) } else { death };
        (from, until, plant.organ_area(leaf, from))
    })
}

/// The last year in which the weights of what lives, from a birth until before a death, come to nine tenths of their
/// largest sum, and in it the first such age; `None` where that is nothing.
fn last_of_most(lives: impl Iterator<Item = (Tick, Tick, f64)>, last: Tick, year: Tick) -> Option<Tick> {
    let mut changes = vec![0.0; last as usize + 2];
    for (birth, death, weight) in lives.filter(|(birth, death, _)| birth < death && *birth <= last) {
        changes[birth as usize] += weight;
        changes[death.min(last + 1) as usize] -= weight;
    }
    let sums = changes.iter().take(last as usize + 1).scan(0.0, |sum, change| {
        *sum += change;
        Some(*sum)
    });
    let sums: Vec<f64> = sums.collect();
    let most = sums.iter().copied().fold(0.0, f64::max);
    if most <= 0.0 {
        return None;
    }
    let full = |age: &usize| sums[*age] >= 0.9 * most;
    let end = (1..sums.len()).rev().find(full)?;
    let start = (1..=end).rev().take(year as usize).take_while(full).last()?;
    Some(start as Tick)
}

/// Ages that lie at ticks.
fn moments(ages: &[Tick]) -> Vec<Moment> {
    ages.iter().copied().map(Moment::from).collect()
}

/// Shows the plants of a plot at some ticks, and between them.
struct ShownTicks<'a, 's> {
    /// In their order.
    ticks: Vec<Moment>,
    passage: Passage,
    airs: &'a Airs<'a>,
    trial: &'a Trial,
    show: &'a mut ShowPlot<'s>,
}

impl Recorder for ShownTicks<'_, '_> {
    fn wants(&self, tick: Tick) -> bool {
        Passage::needs(&self.ticks, tick)
    }

    fn record(&mut self, tick: Tick, plot: &Plot) -> Result<(), RecordError> {
        self.passage.arrive(tick, plot);
        let from = self.ticks.partition_point(|moment| moment.tick() < tick);
        let due: Vec<Moment> = self.ticks[from..].iter().copied().take_while(|moment| moment.tick() == tick).collect();
        let mut passage = std::mem::take(&mut self.passage);
        for moment in due {
            let at = |member: usize| plot.members[member].age_at(tick).map(|age| (&plot.plants[member], age));
            let standing = match moment.share() {
                Some(share) => passage.at(share),
                None => (0..plot.plants.len()).map(at).collect(),
            };
            (self.airs)(moment).into_iter().try_for_each(|air| self.show_once(moment, plot, &standing, air))?;
        }
        self.passage = passage;
        if Passage::begins(&self.ticks, tick) {
            self.passage.keep(tick, plot);
        }
        Ok(())
    }
}

impl ShownTicks<'_, '_> {
    fn show_once(
        &mut self,
        moment: Moment,
        plot: &Plot,
        shown: &[Option<(&Plant, Tick)>],
        air: Option<Air>,
    ) -> Result<(), RecordError> {
        let mut standing = Vec::new();
        let light = plot.site.light.as_ref().and_then(|Light { found, .. }| found.clone());
        for (shown, member) in shown.iter().zip(&plot.members) {
            let Some((plant, age)) = *shown else { continue };
            let mut plant = Cow::Borrowed(plant);
            if let Some(air) = air {
                moved(plant.to_mut(), age, plot, member.species, air)?;
            }
            let (species, light) = (self.trial.cohorts()[member.species].species, light.clone());
            standing.push(Standing { plant, age, species, light });
        }
        (self.show)(moment, &standing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_prime_is_the_spring_of_the_last_full_year() {
        // Leaves of ticks 2 to 4 of each year of four, more each year; in the fifth there are fewer again.
        let lives = (0..5_u32).map(|year| (4 * year + 2, 4 * year + 5, [1.0, 4.0, 10.0, 9.5, 3.0][year as usize]));
        assert_eq!(last_of_most(lives.clone(), 20, 4), Some(14));
        assert_eq!(last_of_most(lives.clone(), 11, 4), Some(10), "later ages are not known");
        assert_eq!(last_of_most(lives, 20, 1), Some(16), "a tick is a year");
        assert_eq!(last_of_most([(3, 9, 1.0)].into_iter(), 20, 12), Some(3), "less than a year");
        assert_eq!(last_of_most(std::iter::empty(), 20, 1), None);
    }
}
