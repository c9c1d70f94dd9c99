//! The clause of cuts: the part above a cut is removed and grows no more, and the rest of the plant grows as if nothing
//! had been cut.
//!
//! It holds for models whose plants keep their past and that do not respond to a cut by growth. Absent on purpose: the
//! components that stand after a cut at each age, which are tested for any plant (`sim::plant`).

use super::component::{Component, assert_same, components};
use super::{grow, grown_by_the_clock, sown};
use phytomer_sim::clock::Tick;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::plant::{AxisId, NodeId, Plant, Seed};

/// Half of the trunk's nodes are cut off, and a whole lateral, at half of the age `until`; the rest grows as without
/// the cut.
///
/// # Panics
/// At the first component that grows above a cut, or that grows otherwise beside it.
pub fn a_cut_takes_what_is_above_it(model: &dyn GrowthModel, until: Tick, seed: &Seed) {
    let whole = grown_by_the_clock(model, until, seed);
    let half = until / 2;
    for lateral in [false, true] {
        let mut plot = sown(model, seed);
        (1..=half).for_each(|age| grow(&mut plot, age));
        let plant = &mut plot.plants[0];
        let last =
            |axis: AxisId| plant.axes.last_node[axis.index()].some().map_or(0, |node| plant.nodes.rank[node.index()]);
        let (axis, rank) = match (lateral, plant.axes.len()) {
            (true, 0 | 1) => continue,
            (true, _) => (AxisId(1), 0),
            (false, _) => (AxisId::TRUNK, last(AxisId::TRUNK) / 2),
        };
        plant.cut(axis, rank, half + 1);
        (half + 1..=until).for_each(|age| grow(&mut plot, age));
        beside_the_cut(&whole, &plot.plants[0], plot.plants[0].axes.key[axis.index()].0, rank, half);
    }
}

/// Compares the plant that was cut with the `whole` plant.
fn beside_the_cut(whole: &Plant, cut: &Plant, key: u64, rank: u32, age: Tick) {
    let rule = "what a cut does not take grows as if nothing had been cut";
    let on_axis = |plant: &Plant, i: usize| plant.axes.key[plant.nodes.axis[i].index()].0 == key;
    for i in (0..cut.nodes.len()).filter(|&i| on_axis(cut, i) && cut.nodes.rank[i] > rank) {
        assert!(cut.nodes.birth[i] <= age, "nothing grows on a cut axis: node {i} at {}", cut.nodes.birth[i]);
        assert!(!cut.stands(NodeId(i as u32), cut.age), "nothing stands above a cut: node {i}");
    }
    assert_same(rule, &left(whole, key, rank), &left(cut, key, rank));
}

/// The components of a plant that are not above the cut, with the values that they had at birth.
fn left(plant: &Plant, key: u64, rank: u32) -> Vec<Component> {
    let nodes = &plant.nodes;
    let mut gone = vec![false; plant.axes.len()];
    let above = |node: usize, gone: &[bool]| {
        let axis = nodes.axis[node].index();
        gone[axis] || (plant.axes.key[axis].0 == key && nodes.rank[node] > rank)
    };
    let mut taken = Vec::new();
    for axis in 0..plant.axes.len() {
        let whole = plant.axes.key[axis].0 == key && rank == 0;
        gone[axis] = whole || plant.axes.bearer[axis].some().is_some_and(|bearer| above(bearer.index(), &gone));
        taken.extend(gone[axis].then_some(plant.axes.key[axis]));
    }
    taken.extend((0..nodes.len()).filter(|&node| above(node, &gone)).map(|node| plant.node_key(NodeId(node as u32))));
    let organs = (0..plant.organs.len()).filter(|&organ| above(plant.organs.node[organ].index(), &gone));
    taken.extend(organs.map(|organ| plant.organ_key(phytomer_sim::plant::OrganId(organ as u32))));
    taken.sort_unstable();
    let mut all = components(plant);
    all.retain(|component| taken.binary_search(&component.key).is_err());
    for component in &mut all {
        (component.death, component.shed) = (0, 0);
        component.state.clear();
    }
    all
}
