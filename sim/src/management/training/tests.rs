//! Trained plants against geometry: angles, lengths, form, places on wires, and growth that goes on.
//!
//! Absent: wood that bends (`mechanics`), the choice of branches (`management::tests`), and whole models.

use super::*;
use crate::NEVER;
use crate::plant::Trend;
use crate::pose::specimen::{Branch, Growth, Specimen};
use crate::pose::{node_frame, pose};

const TICK: Tick = 40;

/// Straight, upward, and sinking.
fn trends() -> [Trend; 3] {
    [(0.0, 0.0), (0.0, 0.15), (2.0, 0.1)].map(|(inclination, share)| Trend { inclination, share })
}

/// A trunk that leans and rights itself, two curved limbs, a twig on the first and a straight shoot on the twig.
fn tree() -> Vec<Branch> {
    let on = |bearer, azimuth, insertion, trends| Branch {
        bearer: Some(bearer),
        azimuth,
        insertion,
        trends,
        ..Branch::trunk(8, 0.08)
    };
    vec![
        Branch { insertion: 0.5, azimuth: 0.3, trends: [0, 1], ..Branch::trunk(12, 0.1) },
        on((0, 4), 1.0, 0.6, [1, 2]),
        on((0, 9), 4.0, 0.9, [2, 1]),
        on((1, 5), 2.0, 0.7, [1, 1]),
        on((3, 3), 0.5, 1.2, [0, 0]),
    ]
}

fn standing(growth: Growth) -> Plant {
    let mut plant = Specimen::grown(&tree(), &trends(), growth).plant;
    pose(&mut plant, TICK - 1);
    plant
}

fn training(support: Support) -> Training {
    Training { support, stays: NEVER }
}

/// A plant before its training, and after it.
fn trained(support: Support, chosen: &[u32]) -> [Plant; 2] {
    let before = standing(Growth::AxisByAxis);
    let mut after = before.clone();
    let chosen: Vec<AxisId> = chosen.iter().copied().map(AxisId).collect();
    training(support).apply(&mut after, &chosen, TICK);
    let told = after.clone();
    pose(&mut after, TICK);
    let nodes = (0..after.nodes.len()).map(|node| (told.frames.base[node], after.frames.base[node]));
    assert!(nodes.into_iter().all(|(told, posed)| apart(told, posed) < 1e-6), "the next operation finds it so");
    assert_eq!(before.nodes.length, after.nodes.length);
    [before, after]
}

fn apart(a: [f32; 3], b: [f32; 3]) -> f64 {
    let between = Vector::from(a) - Vector::from(b);
    between.dot(between).sqrt()
}

fn nodes_of(plant: &Plant, axes: &[u32]) -> Vec<usize> {
    (0..plant.nodes.len()).filter(|node| axes.contains(&plant.nodes.axis[*node].0)).collect()
}

/// From the base of an axis to its tip: the angle to the upward vertical, and the direction from north to east.
fn line(plant: &Plant, axis: u32) -> [f64; 2] {
    let nodes = nodes_of(plant, &[axis]);
    let tip = node_frame(plant, NodeId(nodes[nodes.len() - 1] as u32)).base;
    let chord = Vector::from(tip) - Vector::from(plant.frames.base[nodes[0]]);
    let chord = chord.unit().expect("a length");
    [acos(chord.z), atan2(chord.x, chord.y)]
}

fn assert_near(found: [f64; 2], expected: [f64; 2]) {
    assert!((0..2).all(|k| (found[k] - expected[k]).abs() < 2e-6), "{found:?} {expected:?}");
}

/// All distances between some nodes are as they were.
fn assert_keep_form(before: &Plant, after: &Plant, nodes: &[usize]) {
    for (a, b) in nodes.iter().flat_map(|a| nodes.iter().map(move |b| (*a, *b))) {
        let distance = |plant: &Plant| apart(plant.frames.base[a], plant.frames.base[b]);
        assert!((distance(before) - distance(after)).abs() < 2e-6, "nodes {a} and {b}");
    }
}

/// All distances between nodes of some axes, and all frames of the others.
fn assert_moves_rigidly(before: &Plant, after: &Plant, moved: &[u32]) {
    let moved = nodes_of(before, moved);
    assert_keep_form(before, after, &moved);
    for node in (0..before.nodes.len()).filter(|node| !moved.contains(node)) {
        let frame = |plant: &Plant| plant.frames.at(NodeId(node as u32));
        assert_eq!(frame(before), frame(after), "node {node} has not moved");
    }
}

#[test]
fn a_limb_turns_at_its_crotch_to_the_stated_angle_and_keeps_its_form() {
    for (inclination, azimuth) in [(Some(1.2), Some(2.0)), (Some(0.4), None), (None, Some(-1.0)), (Some(2.0), None)] {
        let [before, after] = trained(Support::Spreader { inclination, azimuth }, &[1]);
        let was = line(&before, 1);
        assert_near(line(&after, 1), [inclination.unwrap_or(was[0]), azimuth.unwrap_or(was[1])]);
        // The twig on the limb goes along, and so does the shoot on the twig.
        assert_moves_rigidly(&before, &after, &[1, 3, 4]);
    }
}

#[test]
fn a_limb_and_a_twig_on_it_are_trained_at_once() {
    let [before, after] = trained(Support::Spreader { inclination: Some(1.0), azimuth: None }, &[1, 3]);
    assert!((line(&after, 1)[0] - 1.0).abs() < 2e-6 && (line(&after, 3)[0] - 1.0).abs() < 2e-6);
    assert_keep_form(&before, &after, &nodes_of(&after, &[4]));
}

/// What is tied again where it is tied is not stated again.
#[test]
fn a_stake_that_stays_takes_no_more_memory() {
    let mut plant = standing(Growth::AxisByAxis);
    training(Support::Stake(0.75)).apply(&mut plant, &[], TICK);
    pose(&mut plant, TICK);
    let (once, stands) = (plant.stated.clone(), plant.frames.base.clone());
    for tick in TICK + 1..TICK + 9 {
        training(Support::Stake(0.75)).apply(&mut plant, &[], tick);
        pose(&mut plant, tick);
    }
    assert_eq!(plant.stated, once);
    assert!(plant.frames.base.iter().zip(&stands).all(|(now, then)| apart(*now, *then) < 1e-6));
}

#[test]
fn earlier_ages_keep_their_frames() {
    for growth in [Growth::AxisByAxis, Growth::TickByTick] {
        let before = standing(growth);
        let mut plant = before.clone();
        training(Support::Stake(0.7)).apply(&mut plant, &[], TICK);
        training(Support::Spreader { inclination: Some(1.0), azimuth: None }).apply(&mut plant, &[AxisId(1)], TICK);
        let mut at_once = plant.clone();
        for age in [3, 7, TICK - 1, TICK, TICK + 9] {
            pose(&mut plant, age);
        }
        pose(&mut at_once, TICK + 9);
        assert_eq!(plant.frames.heading, at_once.frames.heading);
        assert_eq!(plant.frames.base, at_once.frames.base);
        pose(&mut plant, TICK - 1);
        assert_eq!((plant.frames.base, plant.frames.up), (before.frames.base, before.frames.up));
    }
}

/// Upright up to the height, to which seven internodes of 0.1 m reach; above the trunk keeps its form, and so does what
/// it bears.
#[test]
fn a_staked_trunk_is_upright_up_to_the_height() {
    let [before, after] = trained(Support::Stake(0.75), &[]);
    let trunk = nodes_of(&after, &[0]);
    for (rank, node) in trunk.iter().enumerate() {
        let [x, y, z] = after.frames.base[*node].map(f64::from);
        if rank <= 7 {
            assert!(x.abs() < 1e-6 && y.abs() < 1e-6 && (z - 0.1 * rank as f64).abs() < 1e-6, "{x} {y} {z}");
        }
    }
    assert_keep_form(&before, &after, &[&trunk[7..], &nodes_of(&after, &[2])].concat());
    assert_keep_form(&before, &after, &nodes_of(&after, &[1, 3, 4]));
}

/// Each limb comes to the wire nearest to its base and runs along it, on the side to which it pointed.
#[test]
fn arms_lie_along_their_wires() {
    let wires = Support::Wires { heights: vec![0.5, 0.9], azimuth: 0.6 };
    let [before, after] = trained(wires, &[1, 2]);
    let (sin, cos) = sincos(0.6);
    for (axis, height) in [(1, 0.5), (2, 0.9)] {
        let nodes = nodes_of(&after, &[axis]);
        let side = |plant: &Plant| {
            let [_, azimuth] = line(plant, axis);
            let (x, y) = sincos(azimuth);
            x * sin + y * cos
        };
        assert!(side(&before) * side(&after) > 0.0, "axis {axis} keeps its side");
        let mut reached = false;
        for node in &nodes {
            let [x, y, z] = node_frame(&after, NodeId(*node as u32)).base.map(f64::from);
            let away = ((z - height) * (z - height) + (x * cos - y * sin) * (x * cos - y * sin)).sqrt();
            reached |= away < 1e-6;
            assert!(!reached || away < 2e-6, "node {node} lies {away} from its wire");
        }
        assert!(reached, "axis {axis} comes to its wire");
    }
}

/// What grows after the training leaves the tip of the trained limb and follows its trend: (1 − q)ⁿ of the angle is
/// left after n internodes.
#[test]
fn later_growth_follows_its_trend_from_where_it_was_tied() {
    let limb = Branch { azimuth: 0.4, insertion: 0.5, nodes: 30, trends: [1, 1], ..Branch::on(0, 2) };
    let mut specimen = Specimen::new(&[Branch::trunk(8, 0.1), limb], &trends());
    (0..10).for_each(|_| _ = specimen.tick());
    pose(&mut specimen.plant, 10);
    let wires = training(Support::Wires { heights: vec![0.2], azimuth: 1.0 });
    wires.apply(&mut specimen.plant, &[AxisId(1)], 11);
    let tied = nodes_of(&specimen.plant, &[1]).len();
    (0..10).for_each(|_| _ = specimen.tick());
    pose(&mut specimen.plant, 20);
    let nodes = nodes_of(&specimen.plant, &[1]);
    assert!(tied > 5 && nodes.len() > tied + 5);
    for (rank, node) in nodes.iter().enumerate().skip(tied - 1) {
        let angle = acos(f64::from(specimen.plant.frames.heading[*node][2]));
        let grown = (rank + 1 - tied) as f64;
        let expected = std::f64::consts::FRAC_PI_2 * crate::math::pow(0.85, grown);
        assert!((angle - expected).abs() < 1e-6, "{grown} internodes later: {angle} {expected}");
    }
}

#[test]
fn a_branch_without_length_and_a_wire_beside_the_trunk_give_numbers() {
    let mut plant = standing(Growth::AxisByAxis);
    plant.nodes.length.fill(0.0);
    plant.frames.clear();
    pose(&mut plant, TICK - 1);
    for support in [
        Support::Spreader { inclination: Some(0.0), azimuth: None },
        Support::Wires { heights: vec![0.0, 5.0], azimuth: 0.0 },
        Support::Wires { heights: Vec::new(), azimuth: 0.0 },
        Support::Stake(0.0),
    ] {
        let mut plant = plant.clone();
        training(support).apply(&mut plant, &[AxisId(1), AxisId(2)], TICK);
        pose(&mut plant, TICK);
        let numbers = plant.frames.heading.iter().chain(&plant.frames.up).flatten();
        assert!(numbers.into_iter().all(|number| number.is_finite()));
    }
}
