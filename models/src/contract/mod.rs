//! The contract: the rules that every growth model obeys, as a test suite that each model instantiates.
//!
//! [`check`] tests all clauses for one model, and [`the_length_of_the_run_leaves_no_trace`] the clause that takes a
//! second model, compiled for a longer run; the finer functions test one clause each. They are for tests: each panics
//! with the broken rule, the plant and the component, and returns nothing. The clauses are those of the plant's columns
//! (`sim::plant`), of the loop (`sim::grow`: growing ahead equals growing by the clock) and of keyed draws (a plant
//! depends on nothing but its seed). Absent on purpose: rules of one model alone; counts from papers stand with the
//! literature tests.

mod bending;
mod component;
mod cuts;
mod growth;
mod length;
mod plot;
mod structure;
#[cfg(test)]
mod tests;

#[cfg(test)]
pub(crate) use tests::sound;

pub use bending::bends_alike_ahead_and_by_the_clock;
pub use component::{Component, components};
pub use cuts::a_cut_takes_what_is_above_it;
pub use growth::{
    ages_agree, ahead_equals_the_clock, alone_equals_among_neighbours, limit_holds, memory_is_forgotten,
    sown_later_is_the_same_later, threads_change_nothing,
};
pub use length::the_length_of_the_run_leaves_no_trace;
pub use plot::two_species_share_a_plot;
pub use structure::{diameters, events_tell_the_plant, poses, structure};

use phytomer_sim::clock::Tick;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::plant::{MOST_COMPONENTS, Plant, Seed};
use phytomer_sim::plot::Plot;

/// Tests every clause of the contract for `model`, on plants of the run seed `seed` grown to the age `until` (at least
/// 1). The plant is grown some thirty times and once to each age, so a few thousand components are enough.
///
/// # Panics
/// At the first broken rule, with its name.
pub fn check(model: &dyn GrowthModel, until: Tick, seed: u64) {
    for number in [0, 1, 77] {
        let mut plant = grown(model, until, &seed_of(seed, number));
        structure(&plant, model.growth(), until);
        events_tell_the_plant(&plant, until);
        diameters(model, &mut plant, until);
        poses(&mut plant);
        ahead_equals_the_clock(model, until, &seed_of(seed, number));
        threads_change_nothing(model, until, &seed_of(seed, number));
        if model.habit().wood.as_ref().is_some_and(|wood| wood.bends) {
            bends_alike_ahead_and_by_the_clock(model, until, &seed_of(seed, number));
        }
    }
    ages_agree(model, until, &seed_of(seed, 0));
    alone_equals_among_neighbours(model, until, seed);
    sown_later_is_the_same_later(model, until, seed);
    memory_is_forgotten(model, until, seed);
    limit_holds(model, until, &seed_of(seed, 0));
    if model.growth().keeps_its_past() && until > 1 {
        [0, 1].iter().for_each(|&number| a_cut_takes_what_is_above_it(model, until, &seed_of(seed, number)));
    }
}

/// The seed of plant `number` in the run `run_seed`, without a limit of components; its events are kept.
pub fn seed_of(run_seed: u64, number: u32) -> Seed {
    Seed { plant: number, draws: number.into(), run_seed, component_limit: MOST_COMPONENTS, keep_events: true }
}

/// A plot of one plant, sown by `model`.
pub fn sown<'m>(model: &'m dyn GrowthModel, seed: &Seed) -> Plot<'m> {
    Plot::of_one(model, seed)
}

/// A plant grown ahead to `until` at once, with its dead parts shed.
///
/// # Panics
/// Where the model returns that the plant is overgrown.
pub fn grown(model: &dyn GrowthModel, until: Tick, seed: &Seed) -> Plant {
    let mut plot = sown(model, seed);
    grow(&mut plot, until);
    plot.plants.remove(0)
}

/// A plant grown tick by tick to `until`, with its dead parts shed at each tick.
///
/// # Panics
/// Where the model returns that the plant is overgrown.
pub fn grown_by_the_clock(model: &dyn GrowthModel, until: Tick, seed: &Seed) -> Plant {
    let mut plot = sown(model, seed);
    (1..=until).for_each(|age| grow(&mut plot, age));
    plot.plants.remove(0)
}

fn grow(plot: &mut Plot<'_>, tick: Tick) {
    plot.site.begin(tick);
    assert_eq!(plot.grow_to(tick), Ok(()), "plants without limit come to the tick {tick}");
}
