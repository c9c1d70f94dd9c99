//! The fruits of a plant: those that are picked, to thin them or for the harvest.
//!
//! A fruit hangs until its life on the plant is over, when it falls. It can be picked at any tick at which it hung at
//! the end of the tick before, also at the tick at which it would fall. Absent: harvests that cut the plant (`wood`).

use super::choice::Choice;
use super::column::Column;
use crate::clock::{NEVER, Tick};
use crate::plant::{AxisId, Cause, Class, EventKind, OrganId, Plant};
use crate::pose::node_frame;

/// The fruits that hang on a plant at the tick of an operation.
fn hanging(plant: &Plant, tick: Tick) -> Vec<usize> {
    let organs = &plant.organs;
    let hangs = |organ: &usize| {
        let fruit = organs.kind[*organ].class() == Class::Fruit && organs.birth[*organ] < tick;
        let picked = matches!(organs.cause[*organ], Cause::Harvested | Cause::Pruned);
        let end = organs.death[*organ];
        fruit && plant.is_in_reach(organs.node[*organ], tick) && (end > tick || (end == tick && !picked))
    };
    (0..organs.len()).filter(hangs).collect()
}

/// The value of a column of a fruit; NaN for columns that fruits do not have.
fn value(plant: &Plant, organ: usize, (tick, height): (Tick, f64), column: Column) -> f64 {
    let organs = &plant.organs;
    let node = organs.node[organ];
    let axis = plant.nodes.axis[node.index()].index();
    let age = tick.saturating_sub(organs.birth[organ]);
    let full = |size: f32| f64::from(size) * f64::from(plant.expanded(OrganId(organ as u32), age_before(tick)));
    match column {
        Column::Age => f64::from(age),
        Column::Order => f64::from(plant.axes.order[axis]),
        Column::Kind => f64::from(organs.kind[organ] as u8),
        Column::State => f64::from(plant.axes.state[axis]),
        Column::Rank => f64::from(plant.nodes.rank[node.index()]),
        Column::Position => f64::from(organs.position[organ]),
        Column::LifeShare => life_share(plant, organ, tick),
        Column::Length => full(organs.length[organ]),
        Column::Diameter => full(organs.width[organ]),
        Column::Height => f64::from(node_frame(plant, node).base[2]),
        Column::PlantAge => f64::from(tick),
        Column::PlantHeight => height,
        _ => f64::NAN,
    }
}

/// The age at which the plant was measured: that of the tick before.
fn age_before(tick: Tick) -> Tick {
    tick.saturating_sub(1)
}

/// The share of its life on the plant that a fruit has behind it. 0 where nothing is known of when it would fall: it
/// never falls, or pests will eat it before.
fn life_share(plant: &Plant, organ: usize, tick: Tick) -> f64 {
    let (birth, death) = (plant.organs.birth[organ], plant.organs.death[organ]);
    if death == NEVER || plant.organs.cause[organ] == Cause::Attacked {
        return 0.0;
    }
    f64::from(tick.saturating_sub(birth)) / f64::from(death.saturating_sub(birth).max(1))
}

/// Picks the chosen fruits that have at least the share `ripe` of their life behind them. `height` is that of the
/// plant. What is picked has left the plant at `tick`, and a shoot that ended in it is spent.
pub fn pick(plant: &mut Plant, choice: &Choice, ripe: f64, cause: Cause, tick: Tick, height: f64) {
    let fruits = hanging(plant, tick);
    let of = |place: usize, column: Column| value(plant, fruits[place], (tick, height), column);
    // The tiny addition lets the ninth of ten ticks be nine tenths.
    let allowed = |place: usize| {
        let ripe_enough = ripe <= 0.0 || life_share(plant, fruits[place], tick) + 1e-9 >= ripe;
        ripe_enough && !choice.protects(&mut |column| of(place, column))
    };
    let mut picked: Vec<(AxisId, usize)> = Vec::new();
    for place in choice.of(fruits.len(), allowed, of) {
        let organ = fruits[place];
        picked.push((plant.nodes.axis[plant.organs.node[organ].index()], organ));
    }
    picked.sort_unstable();
    let event = if cause == Cause::Harvested { EventKind::Harvested } else { EventKind::Thinned };
    for of_axis in picked.chunk_by(|a, b| a.0 == b.0) {
        for (axis, organ) in of_axis {
            plant.organs.death[*organ] = tick;
            plant.organs.cause[*organ] = cause;
            // The greatest position is that of the end of the axis.
            if plant.organs.position[*organ] == u16::MAX {
                let spent = &mut plant.axes.spent[axis.index()];
                *spent = tick.min(*spent);
            }
        }
        plant.note(tick, of_axis[0].0, event, of_axis.len() as u32);
    }
}
