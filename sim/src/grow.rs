//! The loop: a plot from its seeds to the last tick.
//!
//! Where the site feeds nothing back, growth runs ahead to the last tick, axis by axis in the order of their births,
//! and the loop reads the plants at each tick from birth and death ticks. Where it does, growth follows the clock. The
//! draws are keyed, so both give the same plants, which are also those of the prefix traversal of de Reffye 1988 §4.
//! Plants stand (thicken, bend, are posed) whenever something looks: the recorder, wood that remembers, or the site.
//! The members of a plot grow and stand side by side on all threads; none sees what another does in the same tick.
//! [`Plot::ahead`], [`Plot::grow_to`] and [`Plot::stand`] are the only way to do either.

use crate::cells::Claims;
use crate::clock::Tick;
use crate::mechanics::{Scratch, Thickening, Wood, bend, thicken};
use crate::model::{GrowthModel, Life, Overgrown};
use crate::plant::Plant;
use crate::plot::{Member, Plot};
use crate::pose::{height, pose};
use crate::record::{RecordError, Recorder};
use crate::shed::{note_falls, shed};
use crate::site::stems::{Stems, Whose};
use crate::site::{Site, View};
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, IntoParallelRefMutIterator, ParallelIterator};
use std::cell::Cell;
use std::sync::Arc;

/// How a plot came to its end.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Ending {
    /// It reached the last tick.
    Complete,
    /// A plant came to its limit, or to a stop; the ticks before `age` are recorded.
    Overgrown {
        /// The tick of the plot that it could not finish.
        age: Tick,
        /// Which plant, and its limit.
        limit: Overgrown,
    },
}

/// Grows `plot` to the tick `until` and shows it to `recorder` at each tick that it wants.
///
/// # Errors
/// The recorder's.
pub fn grow(plot: &mut Plot<'_>, until: Tick, recorder: &mut dyn Recorder) -> Result<Ending, RecordError> {
    grow_and_look(plot, [until; 2], recorder)
}

/// As [`grow`] to the tick `until`, for a recorder that wants no tick after `last`: the loop ends there. Growth that
/// runs ahead still goes to `until`, since that is what numbers the components; only the plants' standing at the ticks
/// between is left out. So the recorder sees the plants that [`grow`] shows it, number for number.
///
/// # Errors
/// The recorder's.
pub fn grow_and_look(
    plot: &mut Plot<'_>,
    [last, until]: [Tick; 2],
    recorder: &mut dyn Recorder,
) -> Result<Ending, RecordError> {
    let ending = follow_ticks(plot, [last.min(until), until], recorder)?;
    let last = plot.site.tick;
    for (plant, member) in plot.plants.iter_mut().zip(&plot.members) {
        if let Some(age) = member.age_at(last) {
            note_falls(plant, age);
        }
    }
    Ok(ending)
}

fn follow_ticks(
    plot: &mut Plot<'_>,
    [last, until]: [Tick; 2],
    recorder: &mut dyn Recorder,
) -> Result<Ending, RecordError> {
    let ahead = plot.ahead(until);
    if ahead {
        recorder.grown(until, plot)?;
    }
    // Tick 0 shows what is sown: seeds, or the axiom of an L-system.
    for tick in 0..=last {
        plot.site.begin(tick);
        if tick > 0
            && !ahead
            && plot.follows(tick, recorder)
            && let Err(limit) = plot.operate(tick).and_then(|()| plot.grow_to(tick))
        {
            return Ok(Ending::Overgrown { age: tick, limit });
        }
        let wanted = recorder.wants(tick);
        // What is sown may have wood already.
        let met = || plot.feels_light() || plot.site.whose_stems != Whose::Nobody;
        if wanted || (plot.is_looked_at() && (tick > 0 || met())) {
            if wanted || tick == last || plot.needs_diameters() {
                plot.stand(tick);
            } else {
                plot.stand_unthickened(tick);
            }
        }
        if wanted {
            recorder.record(tick, plot)?;
        }
    }
    Ok(Ending::Complete)
}

impl Plot<'_> {
    /// Grows all members to the tick `until` at once, or from operation to operation, where that is allowed; whether it
    /// did. A plot in which a plant is too large for its limit starts again by the clock, so that the ticks before the
    /// limit are kept.
    pub fn ahead(&mut self, until: Tick) -> bool {
        let remade = self.species.iter().any(|model| !model.growth().keeps_its_past());
        if self.site.feeds_back() || remade || self.is_watched() || self.sees_heights() {
            return false;
        }
        let fits = self.grow_managed(until).is_ok();
        if !fits {
            self.restart();
        }
        fits
    }

    /// Grows all members to `tick`, and sheds what is dead: at once where nothing feeds back, else from tick to tick,
    /// each plant standing as it stood at the end of the last tick.
    ///
    /// # Errors
    /// [`Overgrown`], of the first plant in the order of the plot that passed its limit.
    pub fn grow_to(&mut self, tick: Tick) -> Result<(), Overgrown> {
        let claims = if self.site.cells.shared { self.claims(tick) } else { Vec::new() };
        let granted = self.site.cells.grant(&claims);
        self.look_at_stems(tick);
        let site = &self.site;
        let grown = |number: usize, model: &dyn GrowthModel, age: Tick, plant: &mut Plant, life: &mut Life| {
            let view = View { site, granted: granted.get(number).map_or(&[], Vec::as_slice) };
            model.grow_to(age, plant, life, &view)?;
            shed(plant);
            Ok(())
        };
        let Self { species, plants, lives, members, .. } = self;
        let one = |(number, ((plant, life), member)): (usize, ((&mut Plant, &mut Life), &Member))| {
            let Some(age) = member.age_at(tick).filter(|age| *age > 0) else { return Ok(()) };
            grown(number, species[member.species], age, plant, life)
        };
        if let ([plant], [life], [member]) = (&mut plants[..], &mut lives[..], &members[..]) {
            return one((0, ((plant, life), member)));
        }
        let side_by_side = plants.par_iter_mut().zip(lives).zip(&*members).enumerate();
        let ends: Vec<Result<(), Overgrown>> = side_by_side.map(one).collect();
        ends.into_iter().collect()
    }

    /// Makes the stems that shoots meet of the plants as they stood at the end of the last tick, where they meet any.
    fn look_at_stems(&mut self, tick: Tick) {
        let Self { plants, members, site, .. } = self;
        if site.whose_stems == Whose::Nobody {
            return;
        }
        let ages: Vec<Option<Tick>> = members.iter().map(|member| member.age_at(tick.saturating_sub(1))).collect();
        match &mut site.stems {
            Some(stems) if stems.whose() == site.whose_stems => Arc::make_mut(stems).follow(plants, &ages),
            stems => *stems = Some(Arc::new(Stems::of(plants, &ages, site.whose_stems))),
        }
    }

    /// What each member claims of the site for `tick`, in the order of the plot.
    fn claims(&mut self, tick: Tick) -> Vec<(u32, Claims)> {
        let Self { species, plants, lives, members, site, .. } = self;
        let members = plants.par_iter().zip(lives).zip(&*members);
        let claimed = members.map(|((plant, life), member)| {
            let mut claims = Claims::default();
            if member.age_at(tick).is_some_and(|age| age > 0) {
                species[member.species].claim(plant, life, site, &mut claims);
            }
            (plant.id, claims)
        });
        claimed.collect()
    }

    /// Gives each internode of all members its diameter and its place at `tick`, and finds their light where something
    /// asks for it.
    pub fn stand(&mut self, tick: Tick) {
        self.each_stands(tick, stand);
        self.shine(tick);
    }

    /// As [`Plot::stand`], where nothing asks for diameters: they stay those of an earlier tick.
    fn stand_unthickened(&mut self, tick: Tick) {
        self.each_stands(tick, |model, plant, age, _| {
            pose(plant, age);
            measure_height(model, plant, age);
        });
        self.shine(tick);
    }

    /// Gives each internode of all members its diameter and its place at `tick`, without light.
    pub(crate) fn stand_in_known_light(&mut self, tick: Tick) {
        self.each_stands(tick, stand);
    }

    fn each_stands(&mut self, tick: Tick, stands: impl Fn(&dyn GrowthModel, &mut Plant, Tick, &Site) + Sync) {
        let Self { species, plants, members, site, .. } = self;
        let one = |(plant, member): (&mut Plant, &Member)| {
            if let Some(age) = member.age_at(tick) {
                stands(species[member.species], plant, age, site);
            }
        };
        match (&mut plants[..], &members[..]) {
            ([plant], [member]) => one((plant, member)),
            (plants, members) => plants.par_iter_mut().zip(members).for_each(one),
        }
    }

    /// Whether something asks for the diameters of the internodes at each tick at which the plants stand: wood that
    /// bends, a rule that adds to the diameters of the last tick, shoots that meet stems, or light that wood keeps.
    pub(crate) fn needs_diameters(&self) -> bool {
        let site = &self.site;
        let bends = |wood: &Wood| wood.feels(&site.fields(&wood.drag));
        let asks =
            |plant: &Plant| plant.habit.thickening() != Thickening::Law || plant.habit.wood.as_ref().is_some_and(bends);
        let wood_keeps_light = site.light.as_ref().is_some_and(|light| light.lighting.wood);
        wood_keeps_light || site.whose_stems != Whose::Nobody || self.plants.iter().any(asks)
    }

    /// Whether plants must stand at every tick: wood remembers its shape, the site sees where buds are, or growth
    /// depends on the height or on light.
    pub(crate) fn is_looked_at(&self) -> bool {
        self.remembers() || self.site.sees_buds() || self.sees_heights() || self.feels_light()
    }

    /// Whether the growth of a member depends on its height.
    fn sees_heights(&self) -> bool {
        self.members.iter().any(|member| self.species[member.species].sees_height())
    }

    /// A model that makes the plant anew has work only at ticks that are recorded.
    fn follows(&self, tick: Tick, recorder: &dyn Recorder) -> bool {
        let extends = self.species.iter().any(|model| model.growth().keeps_its_past());
        extends || self.site.feeds_back() || recorder.wants(tick)
    }
}

thread_local! {
    /// The scratch of mechanics: of the thread, not of the plot, so that a plot of many plants needs no more of it.
    static SCRATCH: Cell<Scratch> = Cell::default();
}

/// Gives each internode of one plant its diameter and its place at its age `age`: thickens it by its species' rule, and
/// bends and poses it. Wood that remembers must have stood at each age before.
pub fn stand(model: &dyn GrowthModel, plant: &mut Plant, age: Tick, site: &Site) {
    // Taken out meanwhile: nothing that may run on this thread in between finds it in use.
    let mut scratch = SCRATCH.take();
    scratch.remember(plant);
    match plant.habit.thickening() {
        Thickening::Law => model.thicken(age, plant),
        rule => thicken(plant, age, rule, &mut scratch),
    }
    bend(plant, age, site, &mut scratch);
    SCRATCH.set(scratch);
    // Passes along the internodes that follow, of tables and meshes, find them known.
    plant.appeared.by(age, &plant.nodes);
    measure_height(model, plant, age);
}

fn measure_height(model: &dyn GrowthModel, plant: &mut Plant, age: Tick) {
    if model.sees_height() {
        plant.height = height(plant, age);
    }
}
