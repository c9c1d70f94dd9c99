//! The clauses that compare two growths of one plant: ahead or by the clock, alone or among neighbours, in fresh or in
//! used memory, by one thread or by several, with or without room.
//!
//! All rest on draws that are keyed by lineage and on ticks that are columns (`sim::random`, `sim::grow`). Absent on
//! purpose: the clauses for one plant by itself (`structure`).

use super::component::{Component, assert_same, components, events, numbered};
use super::structure::standing;
use super::{grown, grown_by_the_clock, seed_of, sown};
use phytomer_sim::clock::{NEVER, Tick};
use phytomer_sim::model::{Growth, GrowthModel};
use phytomer_sim::plant::{NodeId, Plant, Seed, ThreadBudget};
use phytomer_sim::plot::{Plot, Sowing};

/// Growing ahead to `until` equals growing tick by tick, component for component and event for event; a model that
/// rebuilds its plants also gives each component the same number.
///
/// # Panics
/// At the first difference.
pub fn ahead_equals_the_clock(model: &dyn GrowthModel, until: Tick, seed: &Seed) {
    let rule = "growing ahead equals growing by the clock";
    let ahead = grown(model, until, seed);
    let by_clock = grown_by_the_clock(model, until, seed);
    assert_same(rule, &components(&ahead), &components(&by_clock));
    assert_eq!(ahead.death, by_clock.death, "{rule}, to the death of the plant");
    assert_same(&format!("{rule}, event for event"), &events(&ahead), &events(&by_clock));
    if !model.growth().keeps_its_past() {
        assert!(
            numbered(&ahead) == numbered(&by_clock),
            "a model that makes its plant anew numbers components alike at each time"
        );
    }
}

/// A plant grown to an age equals, at that age, the plant grown to `until`: the same components with the same births;
/// where the model extends its plants, also the same lives so far, measures and diameters.
///
/// # Panics
/// At the first difference.
pub fn ages_agree(model: &dyn GrowthModel, until: Tick, seed: &Seed) {
    let mut last = grown(model, until, seed);
    let whole = components(&last);
    for age in 1..=until {
        let mut then = grown(model, age, seed);
        let rule = format!("the plant of age {age} is the plant of age {until} read at {age}");
        let read = |all: &[Component]| all.iter().filter_map(|c| at(c, age, model.growth())).collect::<Vec<_>>();
        assert_same(&rule, &read(&components(&then)), &read(&whole));
        if model.growth().keeps_its_past() {
            model.thicken(age, &mut then);
            model.thicken(age, &mut last);
            let alike = thicknesses(&then, age) == thicknesses(&last, age);
            assert!(alike, "{rule}, to the diameters of its internodes");
        } else {
            numbers_hold(&then, &last);
        }
    }
}

/// A component as far as it is known at `age`: without later events, and without values that a rebuild may change.
fn at(component: &Component, age: Tick, growth: Growth) -> Option<Component> {
    let past = |tick: Tick| if tick <= age { tick } else { NEVER };
    let mut known = component.clone();
    known.death = past(known.death);
    known.shed = past(known.shed);
    known.state.clear();
    if !growth.keeps_its_past() {
        known.measures.clear();
    }
    if growth == Growth::Rewrites {
        known.parent = None;
    }
    (component.birth <= age).then_some(known)
}

fn thicknesses(plant: &Plant, age: Tick) -> Vec<(u64, u32, u32)> {
    let nodes = &plant.nodes;
    let one =
        |i: usize| (plant.node_key(NodeId(i as u32)).0, nodes.diameter[i].to_bits(), nodes.diameter_tip[i].to_bits());
    let mut all: Vec<_> = standing(plant, age).map(one).collect();
    all.sort_unstable();
    all
}

/// Where a model rebuilds its plants, a component has the same number at all ages, since tables of several ages are
/// joined by it.
fn numbers_hold(young: &Plant, old: &Plant) {
    let named = |plant: &Plant| {
        let mut all: Vec<_> = numbered(plant).into_iter().map(|(number, c)| (c.key, number)).collect();
        all.sort_unstable();
        all
    };
    let old = named(old);
    for pair in named(young) {
        assert!(old.binary_search(&pair).is_ok(), "a component has one number at all ages: {:?}", pair.0);
    }
}

/// A plant grown alone equals the plant grown among others, and the same plant grown twice is the same.
///
/// # Panics
/// At the first difference.
pub fn alone_equals_among_neighbours(model: &dyn GrowthModel, until: Tick, seed: u64) {
    let sowings = [4, 1, 9].map(|number| sowing(seed, number, 0));
    let mut plot = Plot::new(0, vec![model], &sowings);
    super::grow(&mut plot, until);
    for plant in &plot.plants {
        let alone = grown(model, until, &seed_of(seed, plant.id));
        same_plant("a plant does not depend on its neighbours", &alone, plant);
        same_plant("one seed is one plant", &alone, &grown(model, until, &seed_of(seed, plant.id)));
    }
}

/// Plants sown at several ticks of a plot equal the plants sown first at the same age; before the sowing a plant has no
/// component. Grown tick by tick, and ahead to the last tick.
///
/// # Panics
/// At the first difference.
pub fn sown_later_is_the_same_later(model: &dyn GrowthModel, until: Tick, seed: u64) {
    let rule = "a plant sown later is the same plant later";
    let sowings = [(4, 2), (1, 0), (9, until), (5, until + 1)].map(|(number, tick)| sowing(seed, number, tick));
    let mut plot = Plot::new(0, vec![model], &sowings);
    for tick in 1..=until {
        super::grow(&mut plot, tick);
    }
    let mut ahead = Plot::new(0, vec![model], &sowings);
    super::grow(&mut ahead, until);
    for (k, sowing) in sowings.iter().enumerate() {
        let age = plot.members[k].age_at(until);
        assert_eq!(age, until.checked_sub(sowing.sown), "{rule}: its age counts from its sowing");
        let first = match age.filter(|age| *age > 0) {
            Some(age) => grown(model, age, &sowing.seed),
            None => sown(model, &sowing.seed).plants.remove(0),
        };
        same_plant(rule, &first, &ahead.plants[k]);
        assert_same(rule, &components(&first), &components(&plot.plants[k]));
    }
}

fn sowing(run_seed: u64, number: u32, tick: Tick) -> Sowing {
    Sowing { species: 0, seed: seed_of(run_seed, number), place: [0.0; 3], sown: tick }
}

/// A plant sown into the memory of another plant equals one in fresh memory, and so does a plant reset to its seed.
///
/// # Panics
/// At the first difference.
pub fn memory_is_forgotten(model: &dyn GrowthModel, until: Tick, seed: u64) {
    let fresh = grown(model, until, &seed_of(seed, 3));
    let mut used = sown(model, &seed_of(seed, 8));
    super::grow(&mut used, until);
    used.resow(&seed_of(seed, 3));
    super::grow(&mut used, until);
    same_plant("a plant does not depend on the memory that it is sown into", &fresh, &used.plants[0]);
    used.restart();
    super::grow(&mut used, until);
    same_plant("a plant taken back to its seed grows again as it did", &fresh, &used.plants[0]);
}

/// A plant whose axes are shared out among several threads, wherever two axes wait, equals the plant of a single
/// thread, to every place in its columns: grown at once, in two legs, and where it has no room.
///
/// # Panics
/// At the first difference.
pub fn threads_change_nothing(model: &dyn GrowthModel, until: Tick, seed: &Seed) {
    let legs = |threads: usize, ages: &[Tick], component_limit: u32| {
        let mut plot = sown(model, &Seed { component_limit, ..seed.clone() });
        plot.plants[0].budget = ThreadBudget { threads, least_axes: 2 };
        let done = ages.iter().try_for_each(|&age| plot.grow_to(age));
        (plot, done)
    };
    let needs = grown(model, until, seed).components();
    for (threads, ages) in [(2, vec![until]), (3, vec![until]), (7, vec![until.div_ceil(2), until])] {
        let rule = format!("{threads} threads grow the plant that one grows");
        let ((one, _), (many, done)) = (legs(1, &ages, needs), legs(threads, &ages, needs));
        assert_eq!(done, Ok(()), "{rule}: it fits");
        assert!(one.lives == many.lives, "{rule}, to what the model remembers of it");
        let (one, many) = (&one.plants[0], &many.plants[0]);
        assert!(
            one.axes == many.axes && one.nodes == many.nodes && one.organs == many.organs,
            "{rule}, place by place"
        );
        assert!(one.events == many.events, "{rule}, to its events in their order");
        same_plant(&rule, one, many);
        let (one, many) = (legs(1, &ages, needs - 1).1, legs(threads, &ages, needs - 1).1);
        assert_eq!(one, many, "{rule}, and say alike where it has no room");
    }
}

fn same_plant(rule: &str, one: &Plant, other: &Plant) {
    assert_same(rule, &components(one), &components(other));
    assert!(numbered(one) == numbered(other), "{rule}, to the numbers of its components");
    assert_eq!((one.id, one.age, one.death), (other.id, other.age, other.death), "{rule}: number, age and death");
    assert_same(&format!("{rule}, event for event"), &events(one), &events(other));
}

/// A plant with room for its last component grows to `until`. With less room the model returns
/// [`Overgrown`](phytomer_sim::model::Overgrown), ahead or by the clock; a plant that is not overgrown has at most as
/// many components as its limit.
///
/// # Panics
/// Where a plant is overgrown with enough room, or is not with too little.
pub fn limit_holds(model: &dyn GrowthModel, until: Tick, seed: &Seed) {
    let needs = grown(model, until, seed).components();
    let first = sown(model, seed).plants[0].components();
    let limited = |component_limit| Seed { component_limit, ..seed.clone() };
    let done = sown(model, &limited(needs)).grow_to(until);
    assert_eq!(done, Ok(()), "a plant that needs {needs} components grows with a limit of {needs}");
    let between = first + (needs - first) / 2;
    for limit in [first, between, needs - 1].into_iter().filter(|limit| (first..needs).contains(limit)) {
        overgrows(model, until..=until, &limited(limit));
        overgrows(model, 1..=until, &limited(limit));
    }
}

fn overgrows(model: &dyn GrowthModel, ages: std::ops::RangeInclusive<Tick>, seed: &Seed) {
    let limit = seed.component_limit;
    let mut plot = sown(model, seed);
    for age in ages {
        let done = plot.grow_to(age);
        let components = plot.plants[0].components();
        let fits = done.is_err() || components <= limit;
        assert!(fits, "a plant never passes its limit of {limit} unsaid: {components}");
        if let Err(overgrown) = done {
            let named = (overgrown.plant, overgrown.limit, &overgrown.stopped);
            assert_eq!(named, (seed.plant, limit, &None), "an overgrown plant is named with its limit");
            return;
        }
    }
    panic!("a plant that needs more than its limit of {limit} components is overgrown");
}
