//! Whole parametric trees against closed forms: where stems end, how clones and branches stand, how long and thick they
//! are.
//!
//! Absent: the equations by themselves (`tests_equations`), and numbers of stems (`tests`).

use super::params::{Branches, Tree};
use super::specimens::{bare, clump, level, with};
use super::tests::grown;
use phytomer_sim::math::{atan2, pow, sincos};
use phytomer_sim::plant::{AxisId, NodeId, Origin, Plant, Rest};
use phytomer_sim::pose::{node_frame, pose};
use std::f64::consts::PI;

/// The tolerance of a place, metres.
const ALIKE: f64 = 1e-5;

/// Plant `number`, whole and posed.
fn posed(tree: &Tree, number: u32) -> Plant {
    let mut plant = grown(tree, number);
    pose(&mut plant, 1);
    plant
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < ALIKE, "{found} is not {expected}");
}

fn nodes_of(plant: &Plant, axis: usize) -> Vec<usize> {
    (0..plant.nodes.len()).filter(|&node| plant.nodes.axis[node].index() == axis).collect()
}

fn axes_of(plant: &Plant, order: u8) -> Vec<usize> {
    (0..plant.axes.len()).filter(|&axis| plant.axes.order[axis] == order).collect()
}

/// The end of an axis.
fn end(plant: &Plant, axis: usize) -> [f64; 3] {
    node_frame(plant, plant.axes.last_node[axis]).base.map(f64::from)
}

/// Σ sin(kα) and Σ cos(kα) for k from 0 to n − 1.
fn sums(n: u32, angle: f64) -> [f64; 2] {
    let (half, n) = (0.5 * angle, f64::from(n));
    let (of_n, of_last) = (sincos(n * half).0, sincos((n - 1.0) * half));
    [of_last.0, of_last.1].map(|of| of * of_n / sincos(half).0)
}

/// On a regular polygon: twelve segments, each turned by a twelfth of nCurve but the first; away from the upper side,
/// which is +X on the ground.
#[test]
fn a_curved_stem_ends_where_the_sum_of_its_segments_says() {
    for deg in [60.0, -135.0, 700.0] {
        let mut tree = bare();
        tree.trunk.curve = deg.into();
        let [x, z] = sums(12, (deg / 12.0).to_radians()).map(|sum| sum * 10.0 / 12.0);
        let found = end(&posed(&tree, 0), 0);
        for (found, expected) in found.iter().zip([-x, 0.0, z]) {
            near(*found, expected);
        }
    }
}

/// By 40° over the first half, of which the first segment does not turn, and back by 40° over the second.
#[test]
fn a_stem_that_curves_back_is_an_s() {
    let mut tree = bare();
    (tree.trunk.curve, tree.trunk.curve_back) = (48.0.into(), (-48.0).into());
    let plant = posed(&tree, 0);
    let leans: Vec<f64> =
        plant.frames.heading.iter().map(|h| atan2(-f64::from(h[0]), f64::from(h[2])).to_degrees()).collect();
    let expected = [0.0, 8.0, 16.0, 24.0, 32.0, 40.0, 32.0, 24.0, 16.0, 8.0, 0.0, -8.0];
    leans.iter().zip(expected).for_each(|(found, expected)| near(*found, expected));
}

/// Each segment makes the angle with the axis, and the stem ends above its base after one turn.
#[test]
fn a_helix_keeps_its_angle_to_its_axis() {
    for angle in [10.0, 30.0, 80.0] {
        let mut tree = bare();
        tree.trunk.curve_v = (-angle).into();
        let plant = posed(&tree, 3);
        let (sin, cos) = sincos(f64::to_radians(angle));
        for (k, heading) in plant.frames.heading.iter().enumerate() {
            near(f64::from(heading[2]), cos);
            let next = plant.frames.heading[(k + 1) % 12];
            let turn = f64::from(heading[0] * next[0] + heading[1] * next[1]) / (sin * sin);
            near(turn, sincos(PI / 6.0).1);
        }
        let found = end(&plant, 0);
        for (found, expected) in found.iter().zip([0.0, 0.0, 10.0 * cos]) {
            near(*found, expected);
        }
    }
}

/// From level 2 on. A twig in the vertical plane of its branch, whose y-axis has the sine of the declination δ as its
/// vertical part, turns by δ sin δ/12 at each of eleven segments: up, and not past the vertical; with −3 down.
#[test]
fn attraction_turns_stems_up_and_down() {
    let mut tree = with(Branches { down_angle: 90.0.into(), curve: 0.0.into(), ..level(12.0) }, bare());
    tree.whole.levels = 3.into();
    let rotate = 180.0.into();
    tree.branches[1] =
        Branches { down_angle: 30.0.into(), rotate, curve: 0.0.into(), curve_res: 12.into(), ..level(6.0) };
    let ups = |attraction: f64, order: u8| -> Vec<f64> {
        let mut tree = tree.clone();
        tree.whole.attraction_up = attraction.into();
        let plant = posed(&tree, 0);
        let last = |axis: usize| plant.axes.last_node[axis].index();
        axes_of(&plant, order).into_iter().map(|axis| f64::from(plant.frames.heading[last(axis)][2])).collect()
    };
    assert_eq!(ups(0.0, 2), ups(1.0, 2), "branches of the trunk are not turned");
    let of = |attraction: f64, declination: f64| {
        let turn = |left: f64, _| left - attraction * left * sincos(left).0 / 12.0;
        sincos((1..12).fold(declination.to_radians(), turn)).1
    };
    for attraction in [0.0, 0.5, 1.0, -3.0] {
        let found = ups(attraction, 3);
        assert!(found.len() > 20, "{}", found.len());
        // The first of each branch leaves it upwards, the second downwards.
        assert!(found.iter().any(|up| (up - of(attraction, 60.0)).abs() < ALIKE));
        for up in found {
            let off = [60.0, 120.0].map(|declination| (up - of(attraction, declination)).abs());
            assert!(off[0].min(off[1]) < ALIKE, "{up} with {attraction}");
        }
    }
    assert!(of(1.0, 60.0) > 0.8 && of(-3.0, 60.0) < -0.5);
}

/// Two splits make three stems, which are one stem turned by thirds; each has turned by the angle of the split and
/// comes back to the vertical, so that its end is where the sum of its segments says. The children of the clump are
/// dealt to the three by turns.
#[test]
fn a_clump_has_the_symmetry_of_its_stems() {
    let tree = with(level(31.0), clump(2));
    let plant = posed(&tree, 0);
    let stems = axes_of(&plant, 1);
    assert_eq!(stems.len(), 3);
    assert!(stems[1..].iter().all(|&stem| plant.axes.origin[stem] == Origin::Fork));
    assert_eq!(stems.iter().map(|&stem| nodes_of(&plant, stem).len()).collect::<Vec<_>>(), [12, 11, 11]);
    // Eleven segments above the split: 24° from the vertical, and a tenth of it less at each.
    let [out, up] = sums(11, 2.4_f64.to_radians()).map(|sum| sum * 10.0 / 12.0);
    for (third, &stem) in (0..).zip(&stems) {
        let (sin, cos) = sincos(2.0 * PI / 3.0 * f64::from(third));
        let found = end(&plant, stem);
        for (found, expected) in found.iter().zip([-out * cos, -out * sin, up + 10.0 / 12.0]) {
            near(*found, expected);
        }
        let last = plant.frames.heading[plant.axes.last_node[stem].index()];
        near(f64::from(last[2]), 1.0);
    }
    // 31 children at k/32 of the length; those up to a tenth are not borne, and none is left below the split.
    let on = |stem: usize| axes_of(&plant, 2).into_iter().filter(|&axis| stands_on(&plant, axis) == stem).count();
    assert_eq!([0, 1, 2].map(on), [10, 9, 9]);
}

/// The axis that bears an axis.
fn stands_on(plant: &Plant, axis: usize) -> usize {
    plant.nodes.axis[plant.axes.bearer[axis].index()].index()
}

/// A stem and its one clone are mirror images, 20° to 110° apart, by 20 + 90 R² either way: 50° in the mean.
#[test]
fn a_stem_and_its_single_clone_lean_to_one_side() {
    let (tree, plants) = (clump(1), 400);
    let apart = |number: u32| {
        let plant = posed(&tree, number);
        let [stem, clone] = [0, 1].map(|axis| end(&plant, axis));
        near(stem[2], clone[2]);
        near(stem[0] * stem[0] + stem[1] * stem[1], clone[0] * clone[0] + clone[1] * clone[1]);
        near(clone[1], 0.0);
        // The clone leans away from the upper side of the ground, towards −X.
        atan2(-stem[1], -stem[0]).to_degrees()
    };
    let found: Vec<f64> = (0..plants).map(apart).collect();
    assert!(found.iter().all(|angle| (20.0..=110.0).contains(&angle.abs())));
    let n = f64::from(plants);
    let mean = found.iter().map(|angle| angle.abs()).sum::<f64>() / n;
    // The variance of R² is 1/5 − 1/9.
    let error = 90.0 * (4.0 / 45.0 / n).sqrt();
    assert!((mean - 50.0).abs() < 4.0 * error, "{mean}");
    let left = found.iter().filter(|angle| **angle > 0.0).count() as f64 / n;
    assert!((left - 0.5).abs() < 4.0 * 0.5 / n.sqrt(), "{left}");
}

/// Number, spacing, place, length and thickness of branches by the equations of §4.3 and §4.4, on a trunk.
#[test]
fn branches_stand_at_their_offsets_on_the_line_of_their_parent() {
    let mut tree = with(level(31.0), bare());
    (tree.whole.shape, tree.trunk.curve, tree.trunk.taper) = (0.into(), 50.0.into(), 0.8.into());
    let plant = posed(&tree, 0);
    let (trunk, segment, radius) = (10.0, 10.0 / 12.0, 0.2);
    let offsets: Vec<f64> = (1..=31).map(|k| trunk * f64::from(k) / 32.0).filter(|offset| *offset > 1.0).collect();
    let branches = axes_of(&plant, 2);
    assert_eq!(branches.len(), offsets.len());
    for (&branch, offset) in branches.iter().zip(offsets) {
        let bearer = plant.axes.bearer[branch].index();
        let below = f64::from(plant.nodes.rank[bearer] - 1) * segment;
        let nodes = nodes_of(&plant, branch);
        for k in 0..3 {
            let (base, heading) = (plant.frames.base[bearer][k], plant.frames.heading[bearer][k]);
            let expected = f64::from(base) + (offset - below) * f64::from(heading);
            near(f64::from(plant.frames.base[nodes[0]][k]), expected);
        }
        let long = trunk * 0.3 * (0.2 + 0.8 * (trunk - offset) / 9.0);
        near(nodes.iter().map(|&node| f64::from(plant.nodes.length[node])).sum(), long);
        let there = radius * (1.0 - 0.8 * offset / trunk);
        let thick = (radius * pow(long / trunk, 1.5)).min(there);
        near(f64::from(plant.nodes.diameter[nodes[0]]), 2.0 * thick);
        let cosine: f64 =
            (0..3).map(|k| f64::from(plant.frames.heading[bearer][k] * plant.frames.heading[nodes[0]][k])).sum();
        near(cosine, sincos(50.0_f64.to_radians()).1);
    }
}

/// All of them above the bare base, where it is asked for; as many as are stated.
#[test]
fn branches_can_be_counted_above_the_base() {
    let mut tree = with(level(31.0), bare());
    tree.whole.base_size = 0.4.into();
    assert_eq!(axes_of(&grown(&tree, 0), 2).len(), 31 - 12, "those of k/32 up to 0.4 are left out");
    tree.whole.children = super::params::Children::AboveBase;
    let plant = posed(&tree, 0);
    let bases: Vec<f64> =
        axes_of(&plant, 2).iter().map(|&axis| f64::from(plant.frames.base[nodes_of(&plant, axis)[0]][2])).collect();
    assert_eq!(bases.len(), 31);
    for (k, height) in (1..).zip(bases) {
        near(height, 4.0 + 6.0 * f64::from(k) / 32.0);
    }
}

/// A branch that splits keeps its children at their places along the stem; every second one above a split stands on
/// the clone.
#[test]
fn children_are_dealt_in_turn() {
    let mut tree = with(level(11.0), clump(1));
    tree.whole.base_size = 0.0.into();
    let plant = grown(&tree, 0);
    // At k/12 of twelve segments, each at the base of a segment: the first at the base of the second, above the split.
    let stems: Vec<usize> = axes_of(&plant, 2).iter().map(|&axis| stands_on(&plant, axis)).collect();
    assert_eq!(stems, [0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1]);
    let offsets = |stem: usize| -> Vec<u32> {
        let on = axes_of(&plant, 2).into_iter().filter(|&axis| stands_on(&plant, axis) == stem);
        on.map(|axis| plant.nodes.rank[plant.axes.bearer[axis].index()]).collect()
    };
    assert_eq!(offsets(0), [2, 4, 6, 8, 10, 12]);
    assert_eq!(offsets(1), [2, 4, 6, 8, 10], "ranks of the clone, one behind those of the stem");
}

/// nTaper at the base and the tip of each segment, on clones too, and without a step from one to the next.
#[test]
fn stems_taper_by_their_equation() {
    let mut tree = with(Branches { taper: 0.5.into(), ..level(12.0) }, clump(2));
    tree.trunk.taper = 0.75.into();
    let plant = grown(&tree, 0);
    for axis in 0..plant.axes.len() {
        let nodes = nodes_of(&plant, axis);
        let (taper, segments) = if plant.axes.order[axis] == 1 { (0.75, 12) } else { (0.5, 5) };
        let of = |nth: usize| 1.0 - taper * nth as f64 / segments as f64;
        let before = segments - nodes.len();
        let base = if plant.axes.order[axis] == 1 { 0.4 } else { f64::from(plant.nodes.diameter[nodes[0]]) };
        for (nth, &node) in (before..).zip(&nodes) {
            near(f64::from(plant.nodes.diameter[node]), base * of(nth));
            near(f64::from(plant.nodes.diameter_tip[node]), base * of(nth + 1));
        }
    }
}

/// The two ways to state where a stem leaves its parent agree: the stated frame, and azimuth with insertion.
#[test]
fn stated_frames_are_those_of_azimuth_and_insertion() {
    for tree in [clump(2), bare()] {
        let stated = posed(&with(Branches { rotate: (-120.0).into(), rotate_v: 30.0.into(), ..level(40.0) }, tree), 3);
        let mut inserted = stated.clone();
        axes_of(&stated, 2).into_iter().for_each(|axis| inserted.state_rest(AxisId(axis as u32), Rest::Follows));
        pose(&mut inserted, 1);
        for node in 0..stated.nodes.len() {
            let [one, other] = [&stated, &inserted].map(|plant| plant.frames.at(NodeId(node as u32)));
            for (a, b) in [(one.base, other.base), (one.heading, other.heading), (one.up, other.up)] {
                (0..3).for_each(|k| near(f64::from(a[k]), f64::from(b[k])));
            }
        }
    }
}

/// A variation is uniform between its ends: sizes of 400 trees, and down angles of 2,000 branches.
#[test]
fn what_varies_is_uniform_in_its_range() {
    let uniform = |found: &[f64], middle: f64, v: f64| {
        let n = found.len() as f64;
        assert!(found.iter().all(|x| (x - middle).abs() <= v + ALIKE));
        let mean = found.iter().sum::<f64>() / n;
        let square = found.iter().map(|x| (x - middle) * (x - middle)).sum::<f64>() / n;
        assert!((mean - middle).abs() < 4.0 * v / (3.0 * n).sqrt(), "the mean is {mean}");
        // The variance of the square of a uniform draw is v⁴ (1/5 − 1/9).
        assert!((square - v * v / 3.0).abs() < 4.0 * v * v * (4.0 / 45.0 / n).sqrt(), "the variance is {square}");
    };
    let mut tree = bare();
    tree.whole.scale_v = 4.0.into();
    let heights: Vec<f64> = (0..400).map(|number| end(&posed(&tree, number), 0)[2]).collect();
    uniform(&heights, 10.0, 4.0);
    let mut tree = with(Branches { down_angle_v: 20.0.into(), ..level(2000.0) }, bare());
    tree.whole.base_size = 0.0.into();
    let angles: Vec<f64> =
        grown(&tree, 0).axes.insertion[1..].iter().map(|angle| f64::from(*angle).to_degrees()).collect();
    uniform(&angles, 50.0, 20.0);
}

/// As of the oak, 10 ± 10: no tree is under a tenth of Scale, and the others are uniform above it.
#[test]
fn a_tree_under_a_tenth_of_its_size_is_drawn_again() {
    let mut tree = bare();
    tree.whole.scale_v = 10.0.into();
    let heights: Vec<f64> = (0..600).map(|number| end(&posed(&tree, number), 0)[2]).collect();
    assert!(heights.iter().all(|height| (1.0..=20.0).contains(height)));
    let (n, middle, half) = (heights.len() as f64, 10.5, 9.5);
    let mean = heights.iter().sum::<f64>() / n;
    assert!((mean - middle).abs() < 4.0 * half / (3.0 * n).sqrt(), "the mean is {mean}");
}
