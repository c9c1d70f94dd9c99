//! The birth of an axis: the quantities that it draws once, and the bud from which it grows.
//!
//! Absent: the quantities that its growth needs, which `grow` reads when it grows.

use super::bud::ApicalBud;
use super::compile::BudModel;
use crate::law::At;
use phytomer_sim::clock::{NEVER, Tick};
use phytomer_sim::plant::{AxisId, NewAxis, Plant};
use phytomer_sim::random::PlantRandom;

/// The point at which the laws of the head of an axis are evaluated.
pub(super) fn at_birth(birth: Tick, state: u8) -> At {
    At { age: birth, state, ..At::default() }
}

/// Adds an axis, with the quantities drawn at its birth that do not concern its growth: the time from its death to its
/// fall, and the trends of its own.
pub(super) fn add_axis(model: &BudModel, plant: &mut Plant, new: NewAxis) -> AxisId {
    let new = NewAxis { shed_after: shed_after(model, &plant.random, &new), ..new };
    let axis = plant.add_axis(new);
    give_trends(model, plant, &new, axis);
    axis
}

/// The ticks from the death of a new axis to its fall; `NEVER` where dead wood stays.
pub(super) fn shed_after(model: &BudModel, random: &PlantRandom, new: &NewAxis) -> Tick {
    let laws = &model.laws(new.order).head;
    let Some(ticks) = &laws.shed_after else { return NEVER };
    ticks.fixed().unwrap_or_else(|| {
        let words = laws.words(random, new.key);
        ticks.draw(&words, 0, at_birth(new.birth, new.state))
    })
}

/// Gives an axis the trends that it draws, where it draws them.
pub(super) fn give_trends(model: &BudModel, plant: &mut Plant, new: &NewAxis, axis: AxisId) {
    let laws = &model.laws(new.order).head;
    if laws.trends.has_own() {
        let words = laws.words(&plant.random, new.key);
        plant.own_trends.give(axis, laws.trends.draw_own(&words, at_birth(new.birth, new.state)));
    }
}

/// A bud at the start of the axis `axis`.
pub(super) fn first_bud(model: &BudModel, plant: &Plant, axis: AxisId) -> ApicalBud {
    let place = axis.index();
    let (birth, state) = (plant.axes.birth[place], plant.axes.state[place]);
    let laws = &model.laws(plant.axes.order[place]).head;
    let azimuth = laws.first_azimuth.fixed().unwrap_or_else(|| {
        let words = laws.words(&plant.random, plant.axes.key[place]);
        laws.first_azimuth.draw(&words, 0, at_birth(birth, state))
    });
    ApicalBud {
        axis,
        age: birth,
        cycle: 0,
        units: 0,
        birth,
        passages: 0,
        rank: 0,
        last_node: plant.axes.bearer[place],
        azimuth,
        state,
        dormant: 0,
        bud_spacing: 0.0,
    }
}
