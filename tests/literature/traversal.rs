//! The prefix traversal of de Reffye 1988 §4 against growth by the clock: at each node the trees of the axillary buds
//! 1 … k one after another, then the apical bud's. Both give the same plant, component for component, for every shipped
//! species of the bud model.

use crate::grown::compiled;
use phytomer_config::{Kind, Model, presets};
use phytomer_models::buds::{ApicalBud, BudModel, LivingBuds};
use phytomer_sim::plant::{AxisId, EventKind, LineageKey, NodeId, OrganId, Seed, ThreadBudget};
use phytomer_sim::{GrowthModel, Plant, Plot, Tick};
use std::collections::BTreeMap;

/// The values of a component that are compared: everything but its place in the columns.
type Facts = (Option<LineageKey>, Vec<u32>);

fn seed() -> Seed {
    Seed { plant: 5, draws: 5, run_seed: 88, component_limit: 2_000_000, keep_events: true }
}

/// The tree of one bud, each axis through all its ticks, its laterals' trees as soon as they appear.
fn traverse(model: &BudModel, plant: &mut Plant, mut bud: ApicalBud, until: Tick) {
    for age in bud.age + 1..=until {
        let first = plant.axes.len();
        let grown = model.grow_axis(plant, bud, age).expect("within the limit");
        for axis in first..plant.axes.len() {
            let lateral = model.first_bud(plant, AxisId(axis as u32));
            traverse(model, plant, lateral, until);
        }
        match grown {
            Some(next) => bud = next,
            None => return,
        }
    }
}

fn by_traversal(model: &BudModel, until: Tick) -> Plant {
    let mut plot = Plot::of_one(model, &seed());
    let LivingBuds(buds) = plot.lives[0].get();
    let (bud, mut plant) = (buds[0], plot.plants.remove(0));
    traverse(model, &mut plant, bud, until);
    phytomer_sim::shed::shed(&mut plant);
    plant
}

fn by_the_clock(model: &BudModel, until: Tick) -> Plant {
    let mut plot = Plot::of_one(model, &seed());
    for age in 1..=until {
        plot.site.begin(age);
        plot.grow_to(age).expect("within the limit");
    }
    plot.plants.remove(0)
}

/// Growth ahead, with axes shared out among three threads wherever two axes wait.
fn ahead(model: &BudModel, until: Tick) -> Plant {
    let mut plot = Plot::of_one(model, &seed());
    plot.plants[0].budget = ThreadBudget { threads: 3, least_axes: 2 };
    plot.grow_to(until).expect("within the limit");
    plot.plants.remove(0)
}

fn facts(plant: &Plant) -> BTreeMap<LineageKey, Facts> {
    let Plant { axes, nodes, organs, .. } = plant;
    let mut facts = BTreeMap::new();
    let key_of = |node: NodeId| node.some().map(|node| plant.node_key(node));
    for a in 0..axes.len() {
        let mut of = vec![u32::from(axes.order[a]), axes.origin[a] as u32, u32::from(axes.position[a])];
        of.extend([u32::from(axes.state[a]), axes.appearance[a], axes.birth[a], axes.apex_end[a]]);
        of.extend([axes.apex_fate[a] as u32, axes.spent[a], axes.death[a], axes.shed[a]]);
        of.extend([axes.azimuth[a].to_bits(), axes.insertion[a].to_bits(), axes.shed_after[a]]);
        let own_trends = plant.own_trends.of(AxisId(a as u32)).unwrap_or_default();
        of.extend(own_trends.iter().flat_map(|t| [t.inclination as f32, t.share as f32].map(f32::to_bits)));
        facts.insert(axes.key[a], (key_of(axes.bearer[a]), of));
    }
    for n in 0..nodes.len() {
        let mut of = vec![nodes.birth[n], nodes.rank[n], u32::from(nodes.unit_rank[n])];
        of.extend([u32::from(nodes.formation[n].is_short()), u32::from(nodes.formation[n].is_neoformed())]);
        of.extend([u32::from(nodes.trend[n]), nodes.length[n].to_bits(), nodes.primary_diameter[n].to_bits()]);
        of.push(nodes.azimuth[n].to_bits());
        facts.insert(plant.node_key(NodeId(n as u32)), (key_of(nodes.parent[n]), of));
    }
    for o in 0..organs.len() {
        let mut of = vec![organs.kind[o] as u32, u32::from(organs.position[o]), organs.birth[o], organs.death[o]];
        of.extend([
            organs.cause[o] as u32,
            u32::from(organs.form[o].0),
            organs.length[o].to_bits(),
            organs.width[o].to_bits(),
        ]);
        of.extend([organs.area[o].to_bits(), organs.azimuth[o].to_bits(), organs.insertion[o].to_bits()]);
        facts.insert(plant.organ_key(OrganId(o as u32)), (key_of(organs.node[o]), of));
    }
    let components = axes.len() + nodes.len() + organs.len();
    assert_eq!(facts.len(), components, "every component has a lineage key of its own");
    facts
}

/// The fates of the buds, in an order that does not depend on that of growth.
fn events(plant: &Plant) -> Vec<(Tick, LineageKey, EventKind, u32)> {
    let events = plant.events.as_ref().expect("events are kept");
    let mut told: Vec<_> =
        events.iter().map(|event| (event.tick, plant.axes.key[event.axis.index()], event.kind, event.count)).collect();
    told.sort();
    told
}

/// The last age at which the plant has at most some 60,000 components.
fn affordable(model: &BudModel, most: Tick) -> Tick {
    let expected = model.expectation(most);
    (1..=most).rev().find(|&age| expected.as_ref().is_some_and(|e| e.components(age) < 60_000.0)).unwrap_or(8)
}

fn assert_one_plant(name: &str, model: &BudModel, until: Tick) {
    let clocked = by_the_clock(model, until);
    for (way, other) in [("traversal", by_traversal(model, until)), ("growth ahead", ahead(model, until))] {
        assert!(facts(&clocked) == facts(&other), "{name}: {way} differs at age {until}");
        assert!(events(&clocked) == events(&other), "{name}: the events of {way} differ at age {until}");
    }
}

/// The draws of an axis, a unit, a set of relays or a leaf are the same in whatever order the axes grow.
#[test]
fn clocked_traversed_and_grown_ahead_are_one_plant_where_every_number_is_drawn() {
    let (name, until) = ("config/tests/good/drawn.toml", 30);
    let species = phytomer_config::validate_species(name, until).unwrap_or_else(|report| panic!("{report}"));
    let Model::Buds(buds) = species.species.model else {
        panic!("{name} is of the bud model");
    };
    let model = compiled(&buds, until);
    let orders = by_the_clock(&model, until).axes.order;
    let enough = (1..=3).all(|order| orders.iter().filter(|&&of| of == order).count() > 5);
    assert!(enough, "the plant has axes of every order: {orders:?}");
    assert_one_plant(name, &model, until);
}

#[test]
fn clocked_traversed_and_grown_ahead_are_one_plant_for_every_shipped_species() {
    let mut compared = 0;
    for (name, _) in presets(Kind::Species) {
        let species = phytomer_config::validate_species(name, 60).unwrap_or_else(|report| panic!("{name}: {report}"));
        let Model::Buds(buds) = species.species.model else {
            continue;
        };
        let until = affordable(&compiled(&buds, 60), 60);
        assert_one_plant(name, &compiled(&buds, until), until);
        compared += 1;
    }
    assert!(compared >= 10, "only {compared} species of the bud model are shipped");
}
