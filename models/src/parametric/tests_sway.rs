//! Whole trees in the wind (Weber & Penn 1995 §4.7): at rest to the bit, continuous, and again as they were after 20 π;
//! clones as parts of their stems.
//!
//! Absent: the angles of a segment, which are tested beside the formulas (`sway`).

use super::TreeModel;
use super::params::Sway;
use super::specimens::{aspen, bare, clump, unvaried};
use super::tests::{compiled, grown};
use phytomer_sim::gusts::Gusts;
use phytomer_sim::model::Grow as _;
use phytomer_sim::plant::{NodeId, Origin, Plant};
use phytomer_sim::pose::{node_frame, pose};
use std::f64::consts::PI;

const AGE: u32 = 1;

fn gusts(speed: f64, gust: f64, time: f64) -> Gusts {
    Gusts { speed, gust, time, closes: None }
}

/// The tips of all segments of a plant in the wind, metres.
fn tips(model: &TreeModel, plant: &Plant, gusts: &Gusts) -> Vec<[f32; 3]> {
    let mut plant = plant.clone();
    model.sway(&mut plant, gusts);
    pose(&mut plant, AGE);
    (0..plant.nodes.len()).map(|node| node_frame(&plant, NodeId(node as u32)).base).collect()
}

/// The greatest distance between two lists of places.
fn farthest(one: &[[f32; 3]], other: &[[f32; 3]]) -> f32 {
    let apart = |(one, other): (&[f32; 3], &[f32; 3])| {
        (0..3).map(|k| (one[k] - other[k]) * (one[k] - other[k])).sum::<f32>().sqrt()
    };
    one.iter().zip(other).map(apart).fold(0.0, f32::max)
}

#[test]
fn air_at_rest_leaves_the_tree_as_it_is_to_the_bit() {
    let (model, mut plant) = (compiled(&aspen()), grown(&aspen(), 3));
    let before = plant.clone();
    model.sway(&mut plant, &gusts(0.0, 0.0, 1.7));
    assert_eq!(plant.stated, before.stated);
    let mut posed = before;
    pose(&mut posed, AGE);
    let rest: Vec<[f32; 3]> = (0..posed.nodes.len()).map(|node| node_frame(&posed, NodeId(node as u32)).base).collect();
    let calm = tips(&model, &plant, &gusts(0.0, 0.0, 1.7));
    assert!(rest.iter().zip(&calm).all(|(one, other)| one.map(f32::to_bits) == other.map(f32::to_bits)));
    assert!(farthest(&rest, &tips(&model, &plant, &gusts(5.0, 0.0, 1.7))) > 0.05, "a wind moves it");
}

/// A trunk alone: its b grows by length/radius/15 a second.
#[test]
fn a_tree_is_as_it_was_when_b_has_gone_20_pi() {
    for law in [Sway::LengthOverRadius, Sway::Printed] {
        let mut tree = unvaried(bare());
        tree.whole.sway = law;
        let (model, plant) = (compiled(&tree), grown(&tree, 0));
        let [swing] = model.swings(&plant)[..] else { panic!("a trunk alone") };
        assert!((swing.length - 10.0).abs() < 1e-4 && (swing.radius - 0.2).abs() < 1e-6, "{swing:?}");
        let slender = if law == Sway::Printed { 0.02 } else { 50.0 };
        assert!((swing.rate - slender / 15.0).abs() < 1e-6, "{swing:?}");
        let period = 20.0 * PI / swing.rate;
        let at = |time: f64| tips(&model, &plant, &gusts(6.0, 3.0, time));
        for share in [0.0, 0.13, 0.77] {
            assert!(farthest(&at(share * period), &at((share + 1.0) * period)) < 1e-4);
        }
        assert!((1..10).all(|tenth| farthest(&at(0.0), &at(0.1 * f64::from(tenth) * period)) > 1e-2));
    }
}

/// In a thousandth of a second no tip of the aspen goes farther than a tenth of what it goes in a hundredth at most.
#[test]
fn a_tree_sways_without_a_jump() {
    let (model, plant) = (compiled(&aspen()), grown(&aspen(), 3));
    let at = |time: f64| tips(&model, &plant, &gusts(3.0, 2.0, time));
    for time in [0.0, 0.9, 40.0] {
        let far = |by: f64| farthest(&at(time), &at(time + by));
        let [small, large] = [far(1e-4), far(1e-3)];
        assert!(small > 0.0 && small < 0.2 * large, "{small} m in 0.1 ms, {large} m in 1 ms");
    }
}

/// A clone is a part of the stem from which it parts: with its length and its rate, and the segments below the split.
#[test]
fn clones_sway_as_parts_of_their_stem() {
    let (model, plant) = (compiled(&clump(2)), grown(&clump(2), 1));
    let swings = model.swings(&plant);
    assert_eq!(swings.len(), plant.axes.len());
    for (axis, swing) in swings.iter().enumerate() {
        let clone = plant.axes.origin[axis] == Origin::Fork;
        assert_eq!((swing.before, swing.segments), (u32::from(clone), 12), "axis {axis}");
        assert_eq!((swing.length, swing.rate), (swings[0].length, swings[0].rate));
        assert!(axis == 0 || swing.phases != swings[0].phases, "each has phases of its own");
    }
    assert_eq!([swings[1].place(1, 0.0), swings[1].place(11, 1.0)], [1.0 / 12.0, 1.0]);
}

/// The trunk has the radius of §4.4, 0.195 m, without its flare, and swings once in 1.4 s.
#[test]
fn the_flare_does_not_stiffen_the_aspen() {
    let (model, plant) = (compiled(&unvaried(aspen())), grown(&unvaried(aspen()), 0));
    let trunk = model.swings(&plant)[0];
    assert!((trunk.radius - 0.195).abs() < 1e-6, "{trunk:?}");
    assert!((2.0 * PI / trunk.rate - 1.414).abs() < 1e-3, "{trunk:?}");
}
