//! Pests: a plant that none attacks is the same to the byte, attacks join the draw of the bud, and what is eaten falls
//! when and as often as its hazard says.
//!
//! Bounds are four standard errors. Absent: how a scenario states pests.

use super::params::{Axillary, Flower, Fruit, GrowthUnit, Leaf};
use super::tests::{chimera, hydra};
use super::{BudModel, Buds, Order};
use crate::contract;
use crate::fault::Path;
use crate::law::{Count, Law};
use phytomer_sim::clock::NEVER;
use phytomer_sim::plant::{ApexFate, Cause, Class, EventKind, Exposure, Hazard, Plant, Survival};
use std::sync::Arc;

fn compiled(buds: &Buds, until: u32) -> BudModel {
    buds.compile(until, &Path::root()).unwrap_or_else(|faults| panic!("{faults:?}"))
}

/// A plant under an exposure, at the ages `by` one after another.
fn attacked(model: &BudModel, by: impl Iterator<Item = u32>, number: u32, exposure: &Exposure) -> Plant {
    let mut plot = contract::sown(model, &contract::seed_of(12, number));
    plot.plants[0].exposure = Some(Arc::new(exposure.clone()));
    for age in by {
        plot.site.begin(age);
        assert_eq!(plot.grow_to(age), Ok(()));
    }
    plot.plants.remove(0)
}

fn hazard(of: &[(u32, f64)]) -> Hazard {
    let mut hazard = Hazard::default();
    of.iter().for_each(|&(age, q)| hazard.join(age, q));
    hazard
}

fn survival(of: &[(u32, f64)]) -> Survival {
    Survival::under(&hazard(of))
}

fn columns(plant: &Plant) -> String {
    format!("{:?} {:?} {:?} {:?}", plant.axes, plant.nodes, plant.organs, plant.events)
}

/// Everything that a pest can do at once, at ages from 4 on.
fn plague() -> Exposure {
    let eaten = survival(&[(5, 0.3), (6, 0.3), (9, 0.2)]);
    let growth = vec![1.0, 1.0, 1.0, 1.0, 0.5, 0.8];
    let apex = hazard(&[(4, 0.1), (6, 0.2), (8, 0.1)]);
    let (leaf, flower, fruit) = (eaten.clone(), eaten.clone(), eaten);
    Exposure { apex, leaf, flower, fruit, growth, death: 11, ..Exposure::default() }
}

#[test]
fn a_plant_without_pests_is_the_same_to_the_byte() {
    let none =
        Exposure { apex: hazard(&[(5, 0.0)]), leaf: survival(&[(6, 0.0)]), growth: vec![1.0], ..Exposure::default() };
    for buds in [chimera(), hydra()] {
        let model = compiled(&buds, 12);
        for number in 0..20 {
            let plain = contract::grown(&model, 12, &contract::seed_of(12, number));
            let early = contract::grown(&model, 3, &contract::seed_of(12, number));
            assert!(columns(&plain) == columns(&attacked(&model, [12].into_iter(), number, &none)));
            let before = attacked(&model, [3].into_iter(), number, &plague());
            // What will be eaten later stands in the columns of organs from the first.
            assert!(format!("{:?}{:?}", early.axes, early.nodes) == format!("{:?}{:?}", before.axes, before.nodes));
        }
    }
}

/// Ahead and tick by tick, with threads of its own or not, one plant.
#[test]
fn attacked_plants_grow_ahead_as_by_the_clock() {
    for buds in [chimera(), hydra()] {
        let model = compiled(&buds, 12);
        for number in 0..20 {
            let ahead = attacked(&model, [12].into_iter(), number, &plague());
            let by_clock = attacked(&model, 1..=12, number, &plague());
            assert!(contract::components(&ahead) == contract::components(&by_clock), "plant {number}");
            contract::structure(&ahead, phytomer_sim::Growth::Extends, 12);
        }
    }
}

#[track_caller]
fn assert_share(happened: usize, of: usize, p: f64, what: &str) {
    let (share, error) = (happened as f64 / of as f64, (p * (1.0 - p) / of as f64).sqrt());
    assert!(of > 100 && (share - p).abs() <= 4.0 * error, "{what}: {share} of {of}, expected {p} ± {error}");
}

/// p = .1 and q = .2: of all buds .1 die of themselves, the same as without the pest, and .18 are attacked. A bud that
/// never dies of itself is attacked with .2.
#[test]
fn a_bud_dies_of_itself_or_is_attacked_in_one_draw() {
    let of = |death: f64, number: u32, attack: f64| {
        let model = compiled(
            &Buds { order: vec![Order { death: Law::from(death), ..Order::default() }], ..Buds::default() },
            1,
        );
        let exposure = Exposure { apex: hazard(&[(1, attack)]), ..Exposure::default() };
        let plant = attacked(&model, [1].into_iter(), number, &exposure);
        let event = plant.events.as_ref().and_then(|events| events.last().map(|event| event.kind));
        let fate = plant.axes.apex_fate[0];
        assert_eq!(fate == ApexFate::Attacked, event == Some(EventKind::Attacked));
        assert_eq!(fate.cause() == Cause::Attacked, fate == ApexFate::Attacked);
        fate
    };
    for (death, attack, died, killed) in [(0.1, 0.2, 0.1, 0.18), (0.0, 0.2, 0.0, 0.2), (0.3, 1.0, 0.3, 0.7)] {
        let fates: Vec<ApexFate> = (0..3000).map(|number| of(death, number, attack)).collect();
        let share = |wanted: ApexFate| fates.iter().filter(|fate| **fate == wanted).count();
        assert_share(share(ApexFate::Died), 3000, died, "died");
        assert_share(share(ApexFate::Attacked), 3000, killed, "attacked");
        let same = (0..3000).all(|n| (of(death, n, 0.0) == ApexFate::Died) == (fates[n as usize] == ApexFate::Died));
        assert!(same, "who dies of itself does so with the pest too");
    }
}

/// Leaves that would stand for ever are eaten at ages 4 and 6 with .3 and .5; a flower that is eaten sets no fruit.
#[test]
fn what_stands_is_eaten_by_the_hazard_of_the_tick() {
    let order = Order {
        growth_unit: GrowthUnit { nodes: Count::from(8), ..GrowthUnit::default() },
        leaf: Leaf { per_node: Count::from(2), life: None, ..Leaf::default() },
        flower: Flower {
            per_node: Count::from(1),
            lateral: Law::from(1.0),
            life: Count::from(2),
            fruit_set: Law::from(1.0),
            ..Flower::default()
        },
        fruit: Fruit { life: Count::from(5), ..Fruit::default() },
        ..Order::default()
    };
    let model = compiled(&Buds { order: vec![order], ..Buds::default() }, 8);
    let exposure = Exposure {
        leaf: survival(&[(4, 0.3), (6, 0.5)]),
        flower: survival(&[(3, 0.4)]),
        fruit: survival(&[(4, 0.25)]),
        ..Exposure::default()
    };
    let mut ends: Vec<(Class, u32, u32, Cause)> = Vec::new();
    for plant in (0..40).map(|number| attacked(&model, [8].into_iter(), number, &exposure)) {
        let organs = &plant.organs;
        let end = |o: usize| (organs.kind[o].class(), organs.birth[o], organs.death[o], organs.cause[o]);
        ends.extend((0..organs.len()).map(end));
    }
    let share = |class: Class, born: u32, death: u32, cause: Cause, p: f64| {
        let of: Vec<_> = ends.iter().filter(|end| end.0 == class && end.1 == born).collect();
        let hit = of.iter().filter(|end| (end.2, end.3) == (death, cause)).count();
        assert_share(hit, of.len(), p, &format!("{class:?} of {born} at {death}"));
    };
    for born in [1, 3] {
        share(Class::Leaf, born, 4, Cause::Attacked, 0.3);
        share(Class::Leaf, born, 6, Cause::Attacked, 0.35);
        share(Class::Leaf, born, NEVER, Cause::None, 0.35);
    }
    share(Class::Leaf, 4, 4, Cause::Attacked, 0.0);
    share(Class::Leaf, 5, 6, Cause::Attacked, 0.5);
    // Flowers of tick 1 fall at 3, those of tick 2 at 4: both can be eaten at 3, and the former set fruit at 3.
    share(Class::Flower, 2, 3, Cause::Attacked, 0.4);
    share(Class::Flower, 2, 4, Cause::FruitSet, 0.6);
    share(Class::Flower, 3, 5, Cause::FruitSet, 1.0);
    share(Class::Fruit, 3, 4, Cause::Attacked, 0.25);
    let count = |class: Class, born: u32| ends.iter().filter(|end| end.0 == class && end.1 == born).count();
    let set = ends.iter().filter(|end| end.0 == Class::Flower && end.1 == 2 && end.3 == Cause::FruitSet).count();
    assert_eq!(count(Class::Fruit, 4), set);
}

#[test]
fn a_plant_that_is_killed_whole_ends_at_that_tick() {
    let model = compiled(&chimera(), 12);
    for number in 0..20 {
        let mut plant = attacked(&model, [12].into_iter(), number, &Exposure { death: 7, ..Exposure::default() });
        let plain = contract::grown(&model, 12, &contract::seed_of(12, number));
        let axes = &plant.axes;
        let killed = (0..axes.len()).filter(|&axis| axes.apex_fate[axis] == ApexFate::Attacked);
        let ends: Vec<u32> = killed.map(|axis| axes.apex_end[axis]).collect();
        assert!(ends.iter().all(|end| *end >= 7) && axes.apex_fate.iter().all(|fate| *fate != ApexFate::Alive));
        assert!(plant.nodes.birth.iter().all(|birth| *birth < 7));
        let before = plain.nodes.birth.iter().filter(|birth| **birth < 7).count();
        assert_eq!(plant.nodes.len(), before);
        phytomer_sim::shed::shed(&mut plant);
        assert!(plant.death < NEVER || ends.is_empty());
    }
}

/// Growth units of 6 nodes under a factor .75 have 4 or 5 nodes, as often.
#[test]
fn a_weakened_plant_makes_fewer_nodes() {
    let unit = GrowthUnit { nodes: Count::from(6), per_step: Count::from(2), ..GrowthUnit::default() };
    let axillary = Axillary { buds: Count::from(1), ramification: Law::from(0.1), ..Axillary::default() };
    let order = Order { growth_unit: unit, axillary, ..Order::default() };
    let model = compiled(&Buds { order: vec![order.clone(), order], ..Buds::default() }, 9);
    let exposure =
        Exposure { growth: (0..5).map(|age| if age < 3 { 1.0 } else { 0.75 }).collect(), ..Exposure::default() };
    let mut weak = Vec::new();
    for number in 0..40 {
        let plant = attacked(&model, [9].into_iter(), number, &exposure);
        for event in plant.events.iter().flatten().filter(|event| event.kind == EventKind::Grew) {
            match event.tick {
                3 | 4 => weak.push(event.count),
                _ => assert_eq!(event.count, 6),
            }
        }
    }
    assert!(weak.iter().all(|nodes| [4, 5].contains(nodes)));
    assert_share(weak.iter().filter(|nodes| **nodes == 5).count(), weak.len(), 0.5, "units of 5 nodes");
}
