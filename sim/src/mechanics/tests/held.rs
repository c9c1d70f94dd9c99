//! Wood that bends and is held by a support: it stands where it was trained while the support stays, and sags when it
//! is let go; a wire bears its weight.
//!
//! Absent: the geometry of training, which `management` tests on plants at rest.

use super::*;
use crate::management::{Support, Training};
use crate::math::acos;
use crate::pose::bud_frame;

const LIMB: AxisId = AxisId(1);

/// A stiff upright trunk with a slender limb in its middle, which sags under its weight and a leaf at its tip.
fn tree() -> Plant {
    let mut plant = Rod { insertion: 0.0, weight: 0.5, flexural: 1000.0, ..Rod::level(10) }.plant();
    let limb = add_axis(&mut plant, Some(NodeId(4)), 0.6);
    for _ in 0..10 {
        add_node(&mut plant, limb, 0.05, 0.002);
    }
    add_leaf(&mut plant, NodeId(19), 0.05);
    rank(&mut plant);
    plant
}

/// Rods have no ranks, by which the first node of an axis is known.
fn rank(plant: &mut Plant) {
    let rank = |node: usize| (node % 10) as u32 + 1;
    plant.nodes.rank = (0..plant.nodes.len()).map(rank).collect();
}

fn stand(plant: &mut Plant, ages: std::ops::RangeInclusive<u32>) {
    let mut scratch = Scratch::default();
    for age in ages {
        assert!(bend(plant, age, &unit_gravity(), &mut scratch).settled);
    }
}

/// The angle of the limb to the upward vertical, from its base to its tip.
fn angle(plant: &Plant) -> f64 {
    let base = plant.frames.at(NodeId(10)).base;
    let tip = bud_frame(plant, LIMB).base;
    let [x, y, z] = [0, 1, 2].map(|k| f64::from(tip[k] - base[k]));
    acos(z / (x * x + y * y + z * z).sqrt())
}

fn train(plant: &mut Plant, support: Support, stays: u32) {
    Training { support, stays }.apply(plant, &[LIMB], 4);
}

#[test]
fn a_limb_is_held_at_its_angle_and_sags_when_it_is_let_go() {
    let mut plant = tree();
    stand(&mut plant, 1..=3);
    let free = angle(&plant);
    assert!(free > 0.61, "it sags: {free}");
    let curved = plant.strain.curvature[12];
    train(&mut plant, Support::Spreader { inclination: Some(1.2), azimuth: None }, 3);
    for age in 4..=6 {
        stand(&mut plant, age..=age);
        assert!((angle(&plant) - 1.2).abs() < 1e-4, "held at age {age}: {}", angle(&plant));
        assert_eq!(plant.strain.curvature[12], curved, "it keeps its form");
    }
    stand(&mut plant, 7..=7);
    assert!(angle(&plant) > 1.21, "let go it sags: {}", angle(&plant));
}

/// The moment of the limb's weight turns the trunk, unless a wire bears it. The load at the base of the trunk tells.
#[test]
fn a_wire_bears_the_weight_of_what_is_tied_to_it() {
    let mut free = tree();
    stand(&mut free, 1..=5);
    assert!(free.strain.moment_of(0) > 1e-3);
    let mut tied = tree();
    stand(&mut tied, 1..=3);
    train(&mut tied, Support::Wires { heights: vec![0.5], azimuth: 0.0 }, 100);
    stand(&mut tied, 4..=5);
    assert!(tied.strain.moment_of(0) < 1e-2 * free.strain.moment_of(0), "{}", tied.strain.moment_of(0));
    // Its nodes lie level from where it came to the wire, which is a little off where the trunk has righted itself.
    let level = (14..20).map(|node| f64::from(tied.frames.heading[node][2]));
    assert!(level.into_iter().all(|z| z.abs() < 0.02));
}

#[test]
fn a_staked_trunk_stands_straight() {
    let mut plant = Rod { insertion: 0.3, weight: 1.0, ..Rod::level(10) }.plant();
    rank(&mut plant);
    stand(&mut plant, 1..=3);
    assert!(tip(&plant).0 > 0.3);
    Training { support: Support::Stake(2.0), stays: 100 }.apply(&mut plant, &[], 4);
    stand(&mut plant, 4..=8);
    let (x, z) = tip(&plant);
    assert!(x.abs() < 1e-5 && (z - 1.0).abs() < 1e-5, "{x} {z}");
}
