//! Pruning: what is within the envelope, what is not changed, and what is drawn again.
//!
//! Absent: the envelope by itself (`tests_equations`).

use super::drawn::Drawn;
use super::envelope::beyond;
use super::numbers::Numbers;
use super::params::Tree;
use super::specimens::{aspen, bare, level, oak, willow, with};
use super::tests::{compiled, grown};
use phytomer_sim::plant::{Plant, key};
use phytomer_sim::pose::pose;
use std::collections::BTreeMap;

fn posed(tree: &Tree, number: u32) -> (Plant, Numbers, f64) {
    let mut plant = grown(tree, number);
    pose(&mut plant, 1);
    let numbers = compiled(tree).numbers().clone();
    let scale = Drawn::of(&numbers, &plant.random).scale;
    (plant, numbers, scale)
}

/// By how much the end of the outermost segment is outside of the envelope, over the size of the tree; the base of the
/// trunk is exempt.
fn outermost(plant: &Plant, tree: &Numbers, scale: f64) -> f64 {
    let mut most = f64::NEG_INFINITY;
    for node in 0..plant.nodes.len() {
        let (base, heading) = (plant.frames.base[node], plant.frames.heading[node]);
        let end = [0, 1, 2].map(|k| f64::from(base[k]) + f64::from(plant.nodes.length[node]) * f64::from(heading[k]));
        let (height, out) = (end[2] / scale, (end[0] * end[0] + end[1] * end[1]).sqrt() / scale);
        let is_trunk = plant.axes.order[plant.nodes.axis[node].index()] == 1;
        if !(is_trunk && height <= tree.base_size + 1e-6) {
            most = most.max(beyond(&tree.envelope, tree.base_size, height, out));
        }
    }
    most
}

/// The willow with fewer twigs, as printed and with other envelopes; and the oak, whose trunks split above their base.
#[test]
fn a_pruned_tree_is_within_its_envelope() {
    let mut small = willow();
    (small.branches[2].branches, small.whole.leaves) = (20.0.into(), 0.0.into());
    let mut cone = small.clone();
    (cone.whole.prune_power_low, cone.whole.prune_power_high, cone.whole.prune_width) =
        (1.0.into(), 1.0.into(), 0.2.into());
    let mut shrub = oak();
    (shrub.whole.prune_ratio, shrub.whole.prune_width, shrub.whole.leaves) = (1.0.into(), 0.3.into(), 0.0.into());
    for tree in [small, cone, shrub] {
        let mut unpruned = tree.clone();
        unpruned.whole.prune_ratio = 0.0.into();
        for number in [0, 1, 2] {
            let (plant, numbers, scale) = posed(&tree, number);
            let found = outermost(&plant, &numbers, scale);
            assert!(found <= 1e-6, "tree {number} is outside by {found} of its size");
            let (plant, numbers, scale) = posed(&unpruned, number);
            assert!(outermost(&plant, &numbers, scale) > 0.05, "the tree without pruning is outside");
        }
    }
}

/// A ratio of 0 leaves every byte as it is, whatever the envelope.
#[test]
fn no_pruning_changes_nothing() {
    let tree = aspen();
    let mut other = tree.clone();
    (other.whole.prune_width, other.whole.prune_power_low) = (0.01.into(), 3.0.into());
    let [one, two] = [&tree, &other].map(|tree| posed(tree, 1).0);
    assert!(one.nodes == two.nodes && one.axes == two.axes && one.organs == two.organs);
    assert!(one.stated == two.stated && one.stated_organs == two.stated_organs);
    assert_eq!(one.frames.base, two.frames.base);
}

/// A child has the same key, the same angles and the same turns whether stems are shortened or not.
#[test]
fn pruning_draws_nothing_again() {
    let mut tree = with(level(60.0), bare());
    tree.branches[0].curve_v = 90.0.into();
    tree.branches[0].down_angle_v = 20.0.into();
    tree.whole.base_size = 0.0.into();
    let mut pruned = tree.clone();
    (pruned.whole.prune_ratio, pruned.whole.prune_width) = (1.0.into(), 0.1.into());
    let [whole, short] = [&tree, &pruned].map(|tree| posed(tree, 3).0);
    let by_key = |plant: &Plant| -> BTreeMap<u64, (u32, Vec<[u32; 3]>, f32)> {
        let of = |axis: usize| {
            let nodes = (0..plant.nodes.len()).filter(|&node| plant.nodes.axis[node].index() == axis);
            let nodes: Vec<usize> = nodes.collect();
            let turns = nodes.iter().map(|&node| plant.frames.heading[node].map(|x| (x * 1e5).round() as i32 as u32));
            (plant.axes.insertion[axis].to_bits(), turns.collect(), plant.nodes.length[nodes[0]])
        };
        (0..plant.axes.len()).map(|axis| (plant.axes.key[axis].0, of(axis))).collect()
    };
    let (whole, short) = (by_key(&whole), by_key(&short));
    let mut shortened = 0;
    for (key, (insertion, turns, length)) in &short {
        let before = whole.get(key).expect("the stem of the tree that is not pruned");
        assert_eq!((insertion, turns), (&before.0, &before.1), "a stem is only shortened");
        shortened += usize::from(*length < 0.99 * before.2);
    }
    assert!(shortened > 20, "{shortened}");
    let first = key::LineageKey::SEED.child(key::Place::Axillary(0).on(0));
    assert!(whole.contains_key(&first.0), "children are named by their number");
}

/// Half of the way from the length without pruning to that with it.
#[test]
fn a_part_of_pruning_is_a_mean_of_lengths() {
    let mut tree = with(level(40.0), bare());
    (tree.whole.prune_width, tree.whole.base_size) = (0.1.into(), 0.0.into());
    let lengths = |ratio: f64| -> Vec<f64> {
        let mut tree = tree.clone();
        tree.whole.prune_ratio = ratio.into();
        let plant = posed(&tree, 0).0;
        (12..plant.nodes.len()).step_by(5).map(|node| f64::from(plant.nodes.length[node])).collect()
    };
    let [none, half, most] = [0.0, 0.5, 0.999_999].map(lengths);
    assert_eq!((none.len(), half.len()), (40, 40));
    assert!(most.iter().zip(&none).all(|(pruned, whole)| *pruned < 0.9 * whole), "all are pruned");
    for ((none, half), most) in none.iter().zip(half).zip(most) {
        assert!((half - 0.5 * (none + most)).abs() < 1e-5, "{none} {half} {most}");
    }
}
