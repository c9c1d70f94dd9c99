//! Leaves: where they stand, how they are turned, and that neither they nor pruning move a stem.
//!
//! Absent: their numbers (`tests`).

use super::leaves::bent;
use super::params::Tree;
use super::specimens::{aspen, bare, level, unvaried, with};
use super::tests::grown;
use phytomer_sim::math::{acos, cos, sin};
use phytomer_sim::plant::{OrganId, Plant};
use phytomer_sim::pose::{organ_frame, pose};
use phytomer_sim::rotation::Rotation;
use std::f64::consts::{FRAC_PI_2, PI};

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-5, "{found} is not {expected}");
}

fn posed(tree: &Tree, number: u32) -> Plant {
    let mut plant = grown(tree, number);
    pose(&mut plant, 1);
    plant
}

/// A trunk of 10 m with leaves straight on it.
fn leafy(leaves: f64) -> Tree {
    let mut tree = bare();
    (tree.whole.leaves, tree.whole.base_size) = (leaves.into(), 0.0.into());
    (tree.branches[0].down_angle, tree.branches[0].rotate) = (50.0.into(), 90.0.into());
    tree
}

/// Nine leaves at k/10 of the trunk, 50° from it, each a quarter of a turn after the one before.
#[test]
fn leaves_stand_at_their_places_along_a_stem() {
    let plant = posed(&leafy(9.0), 0);
    assert_eq!(plant.organs.len(), 9);
    for k in 0..9 {
        let frame = organ_frame(&plant, OrganId(k), 1);
        let [x, y, z] = frame.base.map(f64::from);
        near(x, 0.0);
        near(y, 0.0);
        near(z, f64::from(k) + 1.0);
        near(f64::from(frame.heading[2]), cos(50_f64.to_radians()));
        // The first is turned by 90° about the upright, from the direction away from +X, which is the upper side.
        let around = (f64::from(k + 1) * 90.0 + 180.0).to_radians();
        near(f64::from(frame.heading[0]), sin(50_f64.to_radians()) * cos(around));
        near(f64::from(frame.heading[1]), sin(50_f64.to_radians()) * sin(around));
    }
}

/// The azimuth and the insertion that tables have are those of the frame that is stated, bent or not.
#[test]
fn leaves_have_the_angles_of_their_frames() {
    for (bend, down, number) in [(0.0, 50.0, 9.0), (0.0, -30.0, 9.0), (0.6, 50.0, 9.0), (0.0, 20.0, -5.0)] {
        let mut tree = leafy(number);
        (tree.whole.leaf_bend, tree.trunk.curve) = (bend.into(), 40.0.into());
        (tree.branches[0].down_angle, tree.branches[0].rotate) = (down.into(), 100.0.into());
        let plant = posed(&tree, 0);
        for organ in 0..plant.organs.len() {
            let (frame, node) = (organ_frame(&plant, OrganId(organ as u32), 1), plant.organs.node[organ].index());
            let along = |of: [f32; 3]| (0..3).map(|k| f64::from(of[k] * frame.heading[k])).sum::<f64>();
            let (heading, up) = (plant.frames.heading[node], plant.frames.up[node]);
            let left = [1, 2, 0].map(|k| up[k] * heading[(k + 1) % 3] - up[(k + 1) % 3] * heading[k]);
            let [a, b] = [plant.organs.azimuth[organ], plant.organs.insertion[organ]].map(f64::from);
            near(along(heading), cos(b));
            near(along(up), sin(b) * cos(a));
            near(along(left), -sin(b) * sin(a));
        }
    }
}

/// Five leaves at the end of the trunk, over half a turn, in one plane.
#[test]
fn leaves_stand_in_a_fan_at_the_end_of_a_stem() {
    let mut tree = leafy(-5.0);
    (tree.branches[0].down_angle, tree.branches[0].rotate) = (0.0.into(), 180.0.into());
    let plant = posed(&tree, 0);
    assert_eq!(plant.organs.len(), 5);
    for (k, turn) in [-90.0, -45.0, 0.0, 45.0, 90.0_f64].into_iter().enumerate() {
        let frame = organ_frame(&plant, OrganId(k as u32), 1);
        near(f64::from(frame.base[2]), 10.0);
        near(f64::from(frame.heading[2]), cos(turn.to_radians()));
        near(f64::from(frame.heading[1]).abs(), sin(turn.to_radians()).abs());
        near(f64::from(frame.up[0]), 1.0);
    }
}

/// Branches in a fan stand at the end of their parent too.
#[test]
fn branches_stand_in_a_fan_at_the_end_of_a_stem() {
    let mut branches = level(-7.0);
    (branches.down_angle, branches.rotate, branches.curve) = (0.0.into(), 120.0.into(), 0.0.into());
    let mut tree = with(branches, bare());
    tree.trunk.taper = 0.0.into();
    let plant = posed(&tree, 0);
    assert_eq!(plant.axes.len(), 8);
    for (k, axis) in (1..8).enumerate() {
        let first = (0..plant.nodes.len()).find(|&node| plant.nodes.axis[node].index() == axis).expect("a node");
        near(f64::from(plant.frames.base[first][2]), 10.0);
        near(f64::from(plant.frames.heading[first][2]), cos((-60.0 + 20.0 * k as f64).to_radians()));
    }
}

/// The size of leaves, and with more quality more and smaller ones of the same area together.
#[test]
fn quality_keeps_the_area_of_all_leaves() {
    let mut tree = leafy(10.0);
    (tree.whole.leaf_scale, tree.whole.leaf_scale_x) = (0.17.into(), 0.5.into());
    let of = |tree: &Tree| {
        let organs = &grown(tree, 0).organs;
        let area: f64 = organs.area.iter().map(|area| f64::from(*area)).sum();
        (organs.len(), f64::from(organs.length[0]), f64::from(organs.width[0]), area)
    };
    let (number, long, wide, area) = of(&tree);
    assert_eq!(number, 10);
    near(long, 0.17);
    near(wide, 0.085);
    near(area, 10.0 * 0.75 * 0.17 * 0.085);
    tree.whole.quality = 4.0.into();
    let (number, long, wide, more) = of(&tree);
    assert_eq!(number, 40);
    near(long, 0.085);
    near(wide, 0.0425);
    near(more, area);
}

/// §4.9: at 1 every normal points straight up; at ½ it has gone half of the way to the vertical.
#[test]
fn bend_turns_leaves_to_the_light() {
    let mut tree = unvaried(aspen());
    let normals = |tree: &Tree| -> Vec<[f32; 3]> {
        let plant = posed(tree, 4);
        (0..plant.organs.len()).map(|organ| organ_frame(&plant, OrganId(organ as u32), 1).up).collect()
    };
    let lean = |up: f32| acos(f64::from(up.clamp(-1.0, 1.0)));
    let unbent = normals(&tree);
    tree.whole.leaf_bend = 1.0.into();
    assert!(normals(&tree).iter().all(|up| up[2] > 1.0 - 1e-6));
    tree.whole.leaf_bend = 0.5.into();
    for (bent, before) in normals(&tree).iter().zip(unbent) {
        assert!((lean(bent[2]) - 0.5 * lean(before[2])).abs() < 1e-3, "{bent:?} {before:?}");
    }
}

/// Whatever the leaf and the place, also where a direction is missing; a bend of 0 turns nothing.
#[test]
fn a_leaf_is_bent_from_any_position() {
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.3, -0.5, 0.2], [-1.0, 1.0, 1.0]];
    let turned = axes.iter().flat_map(|axis| [0.0, 0.5, FRAC_PI_2, PI, -2.0].map(|a| (*axis, a)));
    for (axis, angle) in turned {
        for at in [[3.0, 0.0, 0.0], [1.0, 2.0, -1.0], [0.0, -1.0, 0.0]] {
            let leaf = Rotation::about(axis, angle);
            let up = bent(leaf, at, 1.0).turned([0.0, 0.0, 1.0]);
            assert!(up[0] > 1.0 - 1e-9, "{axis:?} {angle} {at:?}: {up:?}");
            let same = bent(leaf, at, 0.0).turned([0.2, -0.4, 0.9]);
            let before = leaf.turned([0.2, -0.4, 0.9]);
            assert!((0..3).all(|k| (same[k] - before[k]).abs() < 1e-12));
        }
    }
}

/// Stems of a plant as they stand, bit for bit.
fn stems(plant: &Plant) -> Vec<u32> {
    let frames = &plant.frames;
    let vectors = frames.base.iter().chain(&frames.heading).chain(&frames.up).flatten().map(|x| x.to_bits());
    vectors.chain(plant.nodes.length.iter().chain(&plant.nodes.diameter).map(|x| x.to_bits())).collect()
}

/// Leaves have streams of their own.
#[test]
fn other_leaves_move_no_branch() {
    let tree = aspen();
    let mut other = tree.clone();
    let whole = &mut other.whole;
    (whole.leaves, whole.leaf_bend, whole.leaf_scale, whole.quality) = (3.0.into(), 0.7.into(), 0.3.into(), 2.0.into());
    (other.branches[2].down_angle, other.branches[2].rotate_v) = (80.0.into(), 40.0.into());
    let [one, two] = [&tree, &other].map(|tree| posed(tree, 5));
    assert_ne!(one.organs.len(), two.organs.len());
    assert!(stems(&one) == stems(&two), "the stems are the same to the bit");
}
