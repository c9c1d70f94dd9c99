//! The loop: a plot from its seeds to the last age.
//!
//! Where the site feeds nothing back, growth runs ahead to the last age, axis by axis in the order of
//! their births, and the loop reads the plant at each age from birth and death ticks. Where it does, growth follows the
//! clock. The draws are keyed, so both give the same plant, which is also that of the prefix traversal of de Reffye
//! 1988 §4. Wood remembers: a plant that bends or lays rings thickens and bends at each age, one that does neither at
//! the ages that are recorded.

use crate::clock::Tick;
use crate::mechanics::{Thickening, bend, thicken};
use crate::model::{Growth, GrowthModel, Overgrown};
use crate::plot::Plot;
use crate::record::{RecordError, Recorder};
use crate::shed::{note_falls, shed};

/// How a plot came to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// It reached the last age.
    Complete,
    /// A plant came to its limit; the ages before `age` are recorded.
    Overgrown {
        /// The tick that it could not finish.
        age: Tick,
        /// Which plant, and its limit.
        limit: Overgrown,
    },
}

/// Grows `plot` to the age `until` and shows it to `recorder` at each age that it wants.
///
/// # Errors
/// The recorder's.
pub fn grow(
    model: &dyn GrowthModel,
    plot: &mut Plot,
    until: Tick,
    recorder: &mut dyn Recorder,
) -> Result<Ending, RecordError> {
    let ending = follow_ages(model, plot, until, recorder)?;
    let last = plot.site.age;
    plot.plants.iter_mut().for_each(|plant| note_falls(plant, last));
    Ok(ending)
}

fn follow_ages(
    model: &dyn GrowthModel,
    plot: &mut Plot,
    until: Tick,
    recorder: &mut dyn Recorder,
) -> Result<Ending, RecordError> {
    let ahead = run_ahead(model, plot, until);
    if ahead {
        recorder.grown(until, plot)?;
    }
    for age in 1..=until {
        plot.site.begin(age);
        if !ahead && follows(model, plot, age, recorder) {
            if let Err(limit) = model.grow_to(age, &mut plot.plants, &plot.site) {
                return Ok(Ending::Overgrown { age, limit });
            }
            plot.plants.iter_mut().for_each(shed);
        }
        let wanted = recorder.wants(age);
        if wanted || plot.remembers() {
            stand(model, plot, age);
        }
        if wanted {
            recorder.record(age, plot)?;
        }
    }
    Ok(Ending::Complete)
}

/// Gives each internode its diameter and its place at `age`.
fn stand(model: &dyn GrowthModel, plot: &mut Plot, age: Tick) {
    let Plot { plants, site, bench, .. } = plot;
    for plant in plants {
        bench.remember(plant);
        match plant.habit.thickening() {
            Thickening::Law => model.thicken(age, plant),
            rule => thicken(plant, age, rule, bench),
        }
        bend(plant, age, site, bench);
    }
}

/// Grows the whole plot to its last age at once, where that is allowed. A plot too large for its limit starts again by
/// the clock, so that the ages before the limit are kept.
fn run_ahead(model: &dyn GrowthModel, plot: &mut Plot, until: Tick) -> bool {
    if model.growth() == Growth::Rebuilds || plot.site.feeds_back() {
        return false;
    }
    let fits = model.grow_to(until, &mut plot.plants, &plot.site).is_ok();
    if fits {
        plot.plants.iter_mut().for_each(shed);
    } else {
        plot.restart(model);
    }
    fits
}

/// A model that rebuilds the plant has work only at ages that are recorded.
fn follows(model: &dyn GrowthModel, plot: &Plot, age: Tick, recorder: &dyn Recorder) -> bool {
    model.growth() == Growth::Extends || plot.site.feeds_back() || recorder.wants(age)
}
