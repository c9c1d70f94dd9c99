//! The clauses that are tested on one plant by itself: topology, ticks, keys, events, diameters and pose.
//!
//! They are the invariants of `sim::plant`, each an assertion that names its rule. Absent on purpose: clauses that
//! compare two plants (`growth`).

use std::collections::BTreeSet;

use phytomer_sim::clock::{NEVER, Tick};
use phytomer_sim::model::{Growth, GrowthModel};
use phytomer_sim::plant::{ApexFate, Cause, Class, EventKind, Kind, NodeId, OrganId, Origin, Plant, Rest};
use phytomer_sim::pose::{organ_frame, pose};

/// Topology, ticks, keys and rest geometry of a plant grown to `until` and shed.
///
/// # Panics
/// At the first rule that is broken.
pub fn structure(plant: &Plant, growth: Growth, until: Tick) {
    assert_eq!(plant.age, until, "a plant grown to an age has that age");
    assert!(!plant.axes.is_empty(), "a plant has the axis of its seed");
    numbers(plant);
    keys(plant);
    ledger(plant, growth, until);
    bearers_at_birth(plant);
    (0..plant.axes.len()).for_each(|i| axis(plant, i, growth, until));
    (0..plant.nodes.len()).for_each(|i| node(plant, i, growth, until));
    if growth != Growth::Rewrites {
        (0..plant.axes.len()).for_each(|i| axis_comes_after(plant, i));
        (0..plant.nodes.len()).for_each(|i| node_comes_after(plant, i));
    }
    (0..plant.organs.len()).for_each(|i| organ(plant, i, growth, until));
    ranks(plant);
    headings(plant);
}

/// Component numbers are 0, 1, 2 … without a gap, over the columns and the ledger.
fn numbers(plant: &Plant) {
    let columns = [&plant.axes.component, &plant.nodes.component, &plant.organs.component];
    let gone = plant.ledger.iter().map(|gone| gone.component);
    let mut numbers: Vec<u32> = columns.into_iter().flatten().copied().chain(gone).collect();
    numbers.sort_unstable();
    let dense = numbers.iter().zip(0..).all(|(&number, expected)| number == expected);
    assert!(dense, "component numbers are dense and unique over axes, nodes, organs and the ledger");
    assert_eq!(numbers.len(), plant.components() as usize, "a plant counts its components");
    assert!(plant.components() <= plant.component_limit(), "a plant keeps to its limit of components");
}

fn keys(plant: &Plant) {
    let mut keys = BTreeSet::new();
    for i in 0..plant.axes.len() {
        assert!(keys.insert(plant.axes.key[i]), "lineage keys are unique: axis {i}");
    }
    for i in 0..plant.nodes.len() {
        assert!(keys.insert(plant.node_key(NodeId(i as u32))), "lineage keys are unique: node {i}");
    }
    for i in 0..plant.organs.len() {
        assert!(keys.insert(plant.organ_key(OrganId(i as u32))), "lineage keys are unique: organ {i}");
    }
    for gone in &plant.ledger {
        assert!(keys.insert(gone.key), "lineage keys are unique: component {} of the ledger", gone.component);
    }
}

/// Only a model that rewrites takes components out of the columns; each stood for a tick at least, by the age of the
/// plant, and with a cause. An axis may never have had an apex of its own: its bud then ends as it appears.
fn ledger(plant: &Plant, growth: Growth, until: Tick) {
    assert!(growth == Growth::Rewrites || plant.ledger.is_empty(), "only what is rewritten has a ledger");
    let gone_axes = plant.ledger.iter().filter(|gone| gone.kind == Kind::ApicalBud).map(|gone| gone.component);
    let axes: BTreeSet<u32> = plant.axes.component.iter().copied().chain(gone_axes).collect();
    for gone in &plant.ledger {
        let number = gone.component;
        let is_bud = gone.kind == Kind::ApicalBud;
        assert!(gone.birth < gone.left, "a component stands before it goes: component {number}");
        assert!(
            gone.death == gone.left || is_bud && gone.death < gone.left,
            "it ends when it goes: component {number}"
        );
        assert!(gone.birth < gone.death || is_bud, "a component has lived for a tick: component {number}");
        assert!(gone.left <= until, "a component of the ledger is gone by age {until}: component {number}");
        let causes = [Cause::Rewritten, Cause::Pruned, Cause::Flowered];
        assert!(causes.contains(&gone.cause), "a component of the ledger has a cause: component {number}");
        assert!(axes.contains(&gone.axis), "its axis is one of the plant: component {number}");
    }
}

/// Where a plant keeps what bore each component at its birth, that has a smaller number.
fn bearers_at_birth(plant: &Plant) {
    for number in 0..plant.components() {
        if let Some(Some(bearer)) = plant.bearer_at_birth(number) {
            assert!(bearer < number, "what bears a component at its birth has a smaller number: component {number}");
        }
    }
}

/// The first tick at which a component may appear: the axiom of a model that rewrites is there with the seed.
fn first_tick(growth: Growth) -> Tick {
    if growth == Growth::Rewrites { 0 } else { 1 }
}

/// An axis comes after its bearing node, in number and in time; but a model that rewrites may add nodes below it later.
fn axis_comes_after(plant: &Plant, i: usize) {
    let (axes, nodes) = (&plant.axes, &plant.nodes);
    if let Some(bearer) = axes.bearer[i].some() {
        let b = bearer.index();
        assert!(nodes.component[b] < axes.component[i], "a bearing node's number comes before its axis's: axis {i}");
        assert!(nodes.birth[b] <= axes.appearance[i], "an axis appears no sooner than its bearing node: axis {i}");
    }
}

/// A node comes after its parent, in number and in time, as axes do.
fn node_comes_after(plant: &Plant, i: usize) {
    let nodes = &plant.nodes;
    if let Some(parent) = nodes.parent[i].some() {
        let p = parent.index();
        assert!(nodes.component[p] < nodes.component[i], "a parent's number is smaller than its child's: node {i}");
        assert!(nodes.birth[p] <= nodes.birth[i], "a node appears no sooner than its parent: node {i}");
    }
}

fn axis(plant: &Plant, i: usize, growth: Growth, until: Tick) {
    let first = first_tick(growth);
    let (axes, nodes) = (&plant.axes, &plant.nodes);
    assert_eq!(axes.bearer[i].some().is_none(), i == 0, "the first axis, and it alone, has no bearer: axis {i}");
    assert_eq!(axes.origin[i] == Origin::Seed, i == 0, "the first axis, and it alone, comes out of the seed: axis {i}");
    if let Some(bearer) = axes.bearer[i].some() {
        let b = bearer.index();
        assert!(nodes.axis[b].index() < i, "a bearing axis comes before the axis that it bears: axis {i}");
        assert!((first..=until).contains(&axes.appearance[i]), "an axis appears in {first}..={until}: axis {i}");
    }
    order(plant, i);
    assert!(i > 0 || axes.appearance[i] <= 1, "the bud of the seed is there at the first tick");
    assert!(axes.appearance[i] <= axes.birth[i], "the life of an axis begins no sooner than its bud: axis {i}");
    assert_eq!(axes.apex_end[i] == NEVER, axes.apex_fate[i] == ApexFate::Alive, "an apex ends with a fate: axis {i}");
    let ends = axes.appearance[i].max(1)..=until;
    assert!(axes.apex_end[i] == NEVER || ends.contains(&axes.apex_end[i]), "an apex ends in {ends:?}: axis {i}");
    assert!(axes.spent[i] >= axes.apex_end[i], "an apex is spent no sooner than it ends: axis {i}");
    assert!(axes.shed[i] == NEVER || axes.shed[i] >= axes.appearance[i], "an axis falls after its birth: axis {i}");
    finite(&[axes.azimuth[i], axes.insertion[i]], "the angles of axis", i);
}

fn order(plant: &Plant, i: usize) {
    let order = plant.axes.order[i];
    let bearing = plant.axes.bearer[i].some().map_or(0, |b| plant.axes.order[plant.nodes.axis[b.index()].index()]);
    let right = match plant.axes.origin[i] {
        Origin::Seed | Origin::Adaptive => order >= 1,
        Origin::Axillary => order == bearing + 1,
        Origin::Relay | Origin::Traumatic | Origin::Fork => order == bearing,
    };
    let origin = plant.axes.origin[i].tag();
    assert!(right, "the order of an axis follows from its origin: axis {i}, {origin}, has {order} on {bearing}");
}

fn node(plant: &Plant, i: usize, growth: Growth, until: Tick) {
    let first = first_tick(growth);
    let (axes, nodes) = (&plant.axes, &plant.nodes);
    let axis = nodes.axis[i].index();
    assert!(axis < axes.len(), "a node stands on an axis of its plant: node {i}");
    assert!((first..=until).contains(&nodes.birth[i]), "a node appears in {first}..={until}: node {i}");
    assert!(axes.birth[axis] <= nodes.birth[i], "a node appears no sooner than its axis: node {i}");
    // A node that a model inserts in mid-axis may appear after the end of the apex.
    let lives = growth == Growth::Rewrites || nodes.birth[i] <= axes.apex_end[axis];
    assert!(lives, "a node appears while its apex lives: node {i}");
    assert!(axes.component[axis] < nodes.component[i], "a bud's number comes before its nodes': node {i}");
    if let Some(parent) = nodes.parent[i].some() {
        let p = parent.index();
        assert!(p < i, "a parent's index is smaller than its child's: node {i} on {p}");
    }
    let measures = [nodes.length[i], nodes.primary_diameter[i]];
    finite(&measures, "the measures of node", i);
    assert!(measures.iter().all(|&x| x >= 0.0), "lengths and diameters are not negative: node {i}");
    finite(&[nodes.azimuth[i]], "the azimuth of node", i);
    assert!(
        usize::from(nodes.trend[i]) < plant.trends_of(nodes.axis[i]).len(),
        "a node's trend is one of its axis or its habit: node {i}"
    );
}

fn organ(plant: &Plant, i: usize, growth: Growth, until: Tick) {
    let organs = &plant.organs;
    let node = organs.node[i].index();
    assert!(node < plant.nodes.len(), "an organ stands on a node of its plant: organ {i}");
    // A model that rewrites may put a node below an organ later.
    if growth != Growth::Rewrites {
        let number = plant.nodes.component[node];
        assert!(number < organs.component[i], "a node's number comes before its organs': organ {i}");
        assert!(plant.nodes.birth[node] <= organs.birth[i], "an organ appears no sooner than its node: organ {i}");
    }
    assert!(plant.nodes.birth[node] <= until, "an organ's node appears by age {until}: organ {i}");
    let measures = [organs.length[i], organs.width[i], organs.area[i]];
    finite(&measures, "the measures of organ", i);
    assert!(measures.iter().all(|&x| x >= 0.0), "lengths and areas are not negative: organ {i}");
    finite(&[organs.azimuth[i], organs.insertion[i]], "the angles of organ", i);
}

/// Ranks along an axis are 1, 2, 3 …; each node stands on the one before it, the first on the bearer of its axis.
fn ranks(plant: &Plant) {
    let mut last = plant.axes.bearer.clone();
    let mut next = vec![1; plant.axes.len()];
    for i in 0..plant.nodes.len() {
        let axis = plant.nodes.axis[i].index();
        assert_eq!(plant.nodes.rank[i], next[axis], "ranks along an axis are 1, 2, 3 …: node {i} of axis {axis}");
        assert_eq!(plant.nodes.parent[i], last[axis], "a node stands on the node before it on its axis: node {i}");
        last[axis] = NodeId(i as u32);
        next[axis] += 1;
    }
    for (axis, &rank) in next.iter().enumerate() {
        let expected = if rank == 1 { NodeId::NONE } else { last[axis] };
        assert_eq!(plant.axes.last_node[axis], expected, "an axis knows its last node: axis {axis}");
    }
}

/// The numbers stated of rest frames are finite, and a heading is a unit vector.
fn headings(plant: &Plant) {
    for i in 0..plant.nodes.len() {
        let node = NodeId(i as u32);
        if let Rest::Heading([x, y, z]) = plant.rest_of(node, plant.age) {
            assert!((x * x + y * y + z * z - 1.0).abs() < 1e-5, "a stated heading is a unit vector: node {i}");
        }
        finite(&plant.start_of(node), "the start of node", i);
    }
}

/// The events report each node and each axis once: `Grew` counts the nodes of its axis, and an axis appears with an
/// event of its origin.
///
/// # Panics
/// Where the events and the plant disagree.
pub fn events_tell_the_plant(plant: &Plant, until: Tick) {
    let Some(events) = &plant.events else { return };
    let mut nodes = vec![0; plant.axes.len()];
    let mut appeared = vec![0; plant.axes.len()];
    for event in events {
        let axis = event.axis.index();
        let known = axis < plant.axes.len() || plant.bud_number(event.axis) > 0;
        assert!(known, "an event happens on an axis of its plant, or on one that is gone: {event:?}");
        let past = event.kind == EventKind::Shed || event.tick <= until;
        assert!(event.tick >= 1 && past, "events other than a fall lie in 1..={until}: {event:?}");
        if axis >= plant.axes.len() {
            continue;
        }
        match event.kind {
            EventKind::Grew => nodes[axis] += event.count,
            EventKind::Branched | EventKind::Relayed | EventKind::Reiterated | EventKind::Forked => {
                appeared[axis] += 1;
                assert_eq!(Some(event.kind), appearance_of(plant.axes.origin[axis]), "an axis appears by its origin");
                assert_eq!(event.tick, plant.axes.appearance[axis], "an axis appears when it does: {event:?}");
            }
            _ => {}
        }
    }
    let mut gone = vec![0; plant.axes.len()];
    for departed in plant.ledger.iter().filter(|gone| gone.kind.class() == Class::Internode) {
        let axis = plant.axes.component.iter().position(|bud| *bud == departed.axis);
        axis.into_iter().for_each(|axis| {
            gone[axis] += 1;
            nodes[axis] += u32::from(departed.birth == 0);
        });
    }
    // Components that are there with the seed have no event.
    (0..plant.nodes.len()).filter(|&i| plant.nodes.birth[i] == 0).for_each(|i| nodes[plant.nodes.axis[i].index()] += 1);
    for i in 0..plant.axes.len() {
        let last = plant.axes.last_node[i].some().map_or(0, |node| plant.nodes.rank[node.index()]);
        assert_eq!(nodes[i], last + gone[i], "the events of growth count the nodes of an axis: axis {i}");
        let once = u32::from(plant.axes.appearance[i] > 0);
        assert!(i == 0 || appeared[i] == once, "an axis appears in one event, what is in the seed in none: axis {i}");
        assert!(i > 0 || appeared[i] == 0, "the axis of the seed appears in no event");
    }
}

fn appearance_of(origin: Origin) -> Option<EventKind> {
    match origin {
        Origin::Seed => None,
        Origin::Axillary => Some(EventKind::Branched),
        Origin::Relay => Some(EventKind::Relayed),
        Origin::Traumatic | Origin::Adaptive => Some(EventKind::Reiterated),
        Origin::Fork => Some(EventKind::Forked),
    }
}

/// Thickening gives every internode that stands at an age up to `until` finite diameters that are not negative.
///
/// # Panics
/// At the first diameter that is negative or not finite.
pub fn diameters(model: &dyn GrowthModel, plant: &mut Plant, until: Tick) {
    let ages = if model.growth().keeps_its_past() { 1..=until } else { until..=until };
    for age in ages {
        model.thicken(age, plant);
        for i in standing(plant, age) {
            let diameters = [plant.nodes.diameter[i], plant.nodes.diameter_tip[i]];
            finite(&diameters, "the diameters of node", i);
            assert!(diameters.iter().all(|&x| x >= 0.0), "diameters are not negative: node {i} at age {age}");
        }
    }
}

/// The internodes that stand at `age`.
pub(super) fn standing(plant: &Plant, age: Tick) -> impl Iterator<Item = usize> + use<> {
    let stands: Vec<usize> = (0..plant.nodes.len()).filter(|&i| plant.stands(NodeId(i as u32), age)).collect();
    stands.into_iter()
}

/// The pose gives every internode and organ a finite base point, a unit heading and a unit direction across it.
///
/// # Panics
/// At the first frame that is not so.
pub fn poses(plant: &mut Plant) {
    pose(plant, plant.age);
    let frames = &plant.frames;
    for column in [&frames.base, &frames.heading, &frames.up] {
        assert_eq!(column.len(), plant.nodes.len(), "the pose has a frame for each internode");
    }
    for i in 0..plant.nodes.len() {
        frame(frames.base[i], frames.heading[i], frames.up[i], "the frame of node", i);
    }
    for i in 0..plant.organs.len() {
        for age in [plant.organs.birth[i], plant.age.max(plant.organs.birth[i])] {
            let posed = organ_frame(plant, OrganId(i as u32), age);
            frame(posed.base, posed.heading, posed.up, "the frame of organ", i);
        }
    }
}

fn frame(base: [f32; 3], heading: [f32; 3], up: [f32; 3], what: &str, i: usize) {
    finite(&base, what, i);
    let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let unit = |a| (dot(a, a) - 1.0).abs() < 1e-4;
    assert!(unit(heading) && unit(up), "{what} {i} has unit directions: {heading:?}, {up:?}");
    assert!(dot(heading, up).abs() < 1e-3, "{what} {i} has its upper side across its heading: {heading:?}, {up:?}");
}

fn finite(numbers: &[f32], what: &str, i: usize) {
    assert!(numbers.iter().all(|x| x.is_finite()), "{what} {i} are finite numbers: {numbers:?}");
}
