//! The contract catches models that break it: a sound tree, spoilt in one way each.
//!
//! Each test checks that the message names the broken rule. Absent: sound models, which are tested in their own
//! folders.

use super::*;
use crate::fault::Path;
use crate::geometric::{Descriptor, GeometricModel, GeometricTree, Gmt1, Rule};
use phytomer_sim::model::{Grow, Growth, Overgrown};
use phytomer_sim::plant::{Habit, LineageKey, NodeId, Rest};
use phytomer_sim::site::View;
use std::panic::AssertUnwindSafe;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

pub fn sound() -> GeometricModel {
    let rule = Rule {
        h1_deg: Some(10.0.into()),
        h2_deg: Some((-60.0).into()),
        r1: Some(0.9.into()),
        r2: Some(0.7.into()),
        diameter_ratio: Some(0.7.into()),
        divergence_deg: Some(140.0.into()),
        ..Rule::default()
    };
    let tree = Gmt1::from(GeometricTree::from(Descriptor::new(rule, 5)));
    tree.compile(6, &Path::root()).expect("the tree is sound")
}

/// A tree that something happens to after each growth to an age.
struct Spoilt {
    tree: GeometricModel,
    growth: Growth,
    spoil: fn(Tick, &mut Plant),
    tells_limit: bool,
    /// The plants grown so far, where each plant is made to depend on the number of plants before it.
    crowd: Option<AtomicU32>,
}

fn spoilt(spoil: fn(Tick, &mut Plant)) -> Spoilt {
    Spoilt { tree: sound(), growth: Growth::Rebuilds, spoil, tells_limit: true, crowd: None }
}

impl Grow for Spoilt {
    type Life = ();

    fn growth(&self) -> Growth {
        self.growth
    }

    fn habit(&self) -> Arc<Habit> {
        Grow::habit(&self.tree)
    }

    fn sow(&self, plant: &mut Plant) {
        Grow::sow(&self.tree, plant);
    }

    fn grow_to(&self, age: Tick, plant: &mut Plant, life: &mut (), view: &View<'_>) -> Result<(), Overgrown> {
        let done = Grow::grow_to(&self.tree, age, plant, life, view);
        (self.spoil)(age, plant);
        if let Some(crowd) = &self.crowd {
            set(&mut plant.nodes.length, 3, crowd.fetch_add(1, Ordering::Relaxed) as f32);
        }
        if self.tells_limit { done } else { Ok(()) }
    }

    fn thicken(&self, age: Tick, plant: &mut Plant) {
        Grow::thicken(&self.tree, age, plant);
    }
}

#[track_caller]
fn breaks(model: &Spoilt, rule: &str) {
    let failure = std::panic::catch_unwind(|| check(model, 6, 1)).expect_err(rule);
    let message = match failure.downcast::<String>() {
        Ok(message) => *message,
        Err(other) => (*other.downcast::<&str>().expect("a panic has a message")).to_owned(),
    };
    assert!(message.contains(rule), "`{message}` does not say `{rule}`");
}

fn set<T>(column: &mut [T], at: usize, value: T) {
    if let Some(place) = column.get_mut(at) {
        *place = value;
    }
}

#[test]
fn a_sound_model_keeps_it() {
    check(&spoilt(|_, _| ()), 6, 1);
}

/// A tree that is made anew at each age obeys every clause but this one if it claims to extend its plants.
#[test]
fn growth_above_a_cut_is_caught() {
    breaks(&Spoilt { growth: Growth::Extends, ..spoilt(|_, _| ()) }, "nothing stands above a cut");
}

#[test]
fn a_rule_of_topology_is_named_when_it_is_broken() {
    breaks(&spoilt(|_, p| set(&mut p.nodes.component, 5, 4)), "component numbers are dense");
    breaks(&spoilt(|_, p| set(&mut p.nodes.parent, 3, NodeId(0))), "stands on the node before it");
    breaks(&spoilt(|_, p| set(&mut p.nodes.parent, 3, NodeId(30))), "a parent's index is smaller");
    breaks(&spoilt(|_, p| set(&mut p.nodes.rank, 1, 7)), "ranks along an axis are 1, 2, 3");
    breaks(&spoilt(|_, p| set(&mut p.axes.order, 1, 1)), "the order of an axis follows from its origin");
    breaks(&spoilt(|_, p| set(&mut p.axes.last_node, 0, NodeId(0))), "an axis knows its last node");
    breaks(&spoilt(|_, p| set(&mut p.axes.key, 1, LineageKey::SEED)), "lineage keys are unique");
}

#[test]
fn a_rule_of_time_or_measure_is_named_when_it_is_broken() {
    breaks(&spoilt(|_, p| p.age = 0), "has that age");
    breaks(&spoilt(|_, p| set(&mut p.nodes.birth, 0, 0)), "a node appears in 1..=6");
    breaks(&spoilt(|_, p| set(&mut p.nodes.birth, 0, 3)), "no sooner than");
    breaks(&spoilt(|_, p| set(&mut p.nodes.length, 3, f32::NAN)), "finite numbers");
    let long = |_, p: &mut Plant| p.state_rest(NodeId(3), Rest::Heading([2.0, 0.0, 0.0]));
    breaks(&spoilt(long), "a stated heading is a unit vector");
    breaks(&spoilt(|_, p| p.events.iter_mut().for_each(Vec::clear)), "the events of growth count the nodes");
}

#[test]
fn a_plant_that_depends_on_more_than_its_seed_is_caught() {
    let crowded = Spoilt { crowd: Some(AtomicU32::new(0)), ..spoilt(|_, _| ()) };
    let failure = std::panic::catch_unwind(AssertUnwindSafe(|| alone_equals_among_neighbours(&crowded, 6, 1)));
    let message = failure.expect_err("it is caught").downcast::<String>().expect("a message");
    assert!(message.contains("a plant does not depend on its neighbours"), "{message}");
    let stretching = |age, plant: &mut Plant| set(&mut plant.nodes.length, 0, age as f32);
    breaks(&Spoilt { growth: Growth::Extends, ..spoilt(stretching) }, "the plant of age 1 is the plant of age 6 read");
    breaks(&Spoilt { tells_limit: false, ..spoilt(regrown) }, "needs more than its limit");
}

#[test]
fn a_plant_that_depends_on_the_length_of_the_run_is_caught() {
    let spoils: [fn(Tick, &mut Plant); 2] =
        [|_, p| set(&mut p.nodes.azimuth, 4, 1.0), |_, p| set(&mut p.nodes.primary_diameter, 4, 1.0)];
    let seed = seed_of(1, 0);
    the_length_of_the_run_leaves_no_trace(&sound(), &spoilt(|_, _| ()), 6, &seed);
    for spoil in spoils {
        let caught = || the_length_of_the_run_leaves_no_trace(&sound(), &spoilt(spoil), 6, &seed);
        let failure = std::panic::catch_unwind(caught).expect_err("it is caught");
        let message = failure.downcast::<String>().expect("a message");
        assert!(message.contains("does not depend on how long the run lasts"), "{message}");
    }
}

/// The fault that an overgrown plant must not hide: it stands at the requested age.
fn regrown(age: Tick, plant: &mut Plant) {
    plant.age = age;
}
