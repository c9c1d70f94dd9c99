//! The clause of plants whose wood bends. Such wood remembers every age, so the plant is bent at each age, and the
//! result must not depend on whether the plant was grown ahead or by the clock.
//!
//! Loads are summed in the order of the plant's columns, which differs between growth ahead and growth by the clock; so
//! poses agree to `ALIKE` and not to the bit. Absent on purpose: bending itself (`sim::mechanics`).

use super::structure::standing;
use super::{grow, sown};
use phytomer_sim::clock::Tick;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::plant::{NodeId, Plant, Seed};
use phytomer_sim::site::Wind;

/// The largest difference between places, metres, and between components of unit directions.
pub const ALIKE: f32 = 1e-5;

/// A plant grown ahead and bent at each age stands as the same plant grown and bent tick by tick, in a light wind.
///
/// # Panics
/// At the first internode whose two positions differ by more than `ALIKE`.
pub fn bends_alike_ahead_and_by_the_clock(model: &dyn GrowthModel, until: Tick, seed: &Seed) {
    let rule = "a plant bends alike, grown ahead or by the clock";
    let (ahead, by_clock) =
        (frames(&bent(model, until, seed, true), until), frames(&bent(model, until, seed, false), until));
    assert_eq!(ahead.len(), by_clock.len(), "{rule}: as many internodes stand");
    for ((key, one), (other_key, other)) in ahead.iter().zip(&by_clock) {
        assert_eq!(key, other_key, "{rule}: the same internodes stand");
        let apart = one.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(apart <= ALIKE, "{rule}: the internode {key:x} is {apart} apart: {one:?}, {other:?}");
    }
}

/// The plant, bent at each age up to `until`; grown `ahead` or by the clock.
pub(super) fn bent(model: &dyn GrowthModel, until: Tick, seed: &Seed, ahead: bool) -> Plant {
    let mut plot = sown(model, seed);
    plot.site.wind = Wind { speed: 2.0, towards: 0.5 };
    if ahead {
        grow(&mut plot, until);
    }
    for age in 1..=until {
        if !ahead {
            grow(&mut plot, age);
        }
        plot.stand(age);
    }
    plot.plants.remove(0)
}

/// Base and heading of each internode that stands, by its key.
fn frames(plant: &Plant, age: Tick) -> Vec<(u64, [f32; 6])> {
    let one = |i: usize| {
        let ([x, y, z], [a, b, c]) = (plant.frames.base[i], plant.frames.heading[i]);
        (plant.node_key(NodeId(i as u32)).0, [x, y, z, a, b, c])
    };
    let mut all: Vec<_> = standing(plant, age).map(one).collect();
    all.sort_unstable_by_key(|(key, _)| *key);
    all
}
