//! Whole parametric trees against closed forms: where stems end, how clones and branches stand, how long and thick they
//! are; the contract of growth models; forecasts, bending, and parameters that are refused.
//!
//! Absent: the equations by themselves (`tests`).

use super::{Branches, Crown, Tree, TreeModel, Trunk};
use crate::contract;
use crate::fault::Path;
use phytomer_sim::clock::Tick;
use phytomer_sim::math::{atan2, pow, sincos};
use phytomer_sim::mechanics::{OrganMass, Scratch, Tissue, Uprighting, Wood, bend};
use phytomer_sim::model::Grow as _;
use phytomer_sim::plant::{AxisId, Habit, NodeId, Origin, Plant, Rest};
use phytomer_sim::pose::{node_frame, pose};
use phytomer_sim::site::Site;
use std::f64::consts::PI;
use std::sync::Arc;

/// The tolerance of a place, metres.
const ALIKE: f64 = 1e-5;

/// A bare trunk of 10 m in twelve segments.
fn bare() -> Tree {
    Tree {
        shape: Crown::Cylindrical,
        base_size: 0.1.into(),
        scale_m: 10.0.into(),
        scale_v_m: 0.0.into(),
        ratio: 0.02.into(),
        ratio_power: 1.5.into(),
        trunk: Trunk {
            length: 1.0.into(),
            length_v: 0.0.into(),
            taper: 1.0.into(),
            base_splits: 0.into(),
            split_angle_deg: 0.0.into(),
            split_angle_v_deg: 0.0.into(),
            curve_res: 12.into(),
            curve_deg: 0.0.into(),
            curve_back_deg: 0.0.into(),
            curve_v_deg: 0.0.into(),
        },
        branches: Vec::new(),
    }
}

/// Branches of five segments, without variation.
fn level(number: u32) -> Branches {
    Branches {
        number: number.into(),
        down_angle_deg: 50.0.into(),
        down_angle_v_deg: 0.0.into(),
        rotate_deg: 140.0.into(),
        rotate_v_deg: 0.0.into(),
        length: 0.3.into(),
        length_v: 0.0.into(),
        taper: 1.0.into(),
        curve_res: 5.into(),
        curve_deg: (-40.0).into(),
        curve_back_deg: 0.0.into(),
        curve_v_deg: 0.0.into(),
    }
}

/// A trunk that splits into itself and `splits` clones, 24° from the vertical.
fn clump(splits: u32) -> Tree {
    let mut tree = bare();
    tree.trunk.base_splits = splits.into();
    tree.trunk.split_angle_deg = 24.0.into();
    tree
}

/// A tree that uses every feature, with every variation.
fn varied() -> Tree {
    let mut tree = clump(2);
    (tree.shape, tree.scale_v_m, tree.base_size) = (Crown::TendFlame, 3.0.into(), 0.05.into());
    let trunk = &mut tree.trunk;
    (trunk.length_v, trunk.split_angle_v_deg, trunk.taper) = (0.2.into(), 8.0.into(), 0.9.into());
    (trunk.curve_deg, trunk.curve_back_deg, trunk.curve_v_deg) = (30.0.into(), (-40.0).into(), 90.0.into());
    let branches =
        Branches { rotate_v_deg: 30.0.into(), length_v: 0.1.into(), down_angle_v_deg: 10.0.into(), ..level(25) };
    tree.branches = vec![Branches { curve_back_deg: 20.0.into(), curve_v_deg: 60.0.into(), ..branches }];
    tree
}

fn with(branches: Branches, tree: Tree) -> Tree {
    Tree { branches: vec![branches], ..tree }
}

fn compiled(tree: &Tree) -> TreeModel {
    tree.compile(30, &Path::root()).unwrap_or_else(|faults| panic!("{faults:?}"))
}

/// Plant `number`, whole and posed.
fn grown(tree: &Tree, number: u32) -> Plant {
    let model = compiled(tree);
    let mut plant = contract::grown(&model, 1, &contract::seed_of(7, number));
    model.thicken(1, &mut plant);
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
        tree.trunk.curve_deg = deg.into();
        let [x, z] = sums(12, (deg / 12.0).to_radians()).map(|sum| sum * 10.0 / 12.0);
        let found = end(&grown(&tree, 0), 0);
        for (found, expected) in found.iter().zip([-x, 0.0, z]) {
            near(*found, expected);
        }
    }
}

/// By 40° over the first half, of which the first segment does not turn, and back by 40° over the second.
#[test]
fn a_stem_that_curves_back_is_an_s() {
    let mut tree = bare();
    (tree.trunk.curve_deg, tree.trunk.curve_back_deg) = (48.0.into(), (-48.0).into());
    let plant = grown(&tree, 0);
    let leans: Vec<f64> =
        plant.frames.heading.iter().map(|h| atan2(-f64::from(h[0]), f64::from(h[2])).to_degrees()).collect();
    let expected = [0.0, 8.0, 16.0, 24.0, 32.0, 40.0, 32.0, 24.0, 16.0, 8.0, 0.0, -8.0];
    leans.iter().zip(expected).for_each(|(found, expected)| near(*found, expected));
}

/// Two splits make three stems, which are one stem turned by thirds; each has turned by the angle of the split and
/// comes back to the vertical, so that its end is where the sum of its segments says. Their branches are turned alike.
#[test]
fn a_clump_has_the_symmetry_of_its_stems() {
    let tree = with(level(10), clump(2));
    let plant = grown(&tree, 0);
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
    let branches = axes_of(&plant, 2);
    assert_eq!(branches.len(), 30, "ten a stem, none on the first segment");
    let (sin, cos) = sincos(2.0 * PI / 3.0);
    for (of_one, of_next) in branches.iter().zip(&branches[10..]) {
        let [[x, y, z], next] = [of_one, of_next].map(|&branch| end(&plant, branch));
        for (found, expected) in next.iter().zip([x * cos - y * sin, x * sin + y * cos, z]) {
            near(*found, expected);
        }
    }
}

/// A stem and its one clone are mirror images, 20° to 110° apart, by 20 + 90 R² either way: 50° in the mean.
#[test]
fn a_stem_and_its_single_clone_lean_to_one_side() {
    let (tree, plants) = (clump(1), 400);
    let apart = |number: u32| {
        let plant = grown(&tree, number);
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

/// Number, spacing, place, length and thickness of branches by the equations of §4.3 and §4.4, on a trunk and on
/// clones.
#[test]
fn branches_stand_at_their_offsets_on_the_line_of_their_parent() {
    let mut tree = with(level(31), clump(2));
    (tree.shape, tree.trunk.curve_deg, tree.trunk.taper) = (Crown::Conical, 50.0.into(), 0.8.into());
    let plant = grown(&tree, 0);
    let (trunk, segment, radius) = (10.0, 10.0 / 12.0, 0.2);
    for (stem, first) in [(0, 0), (1, 1), (2, 1)] {
        let on = |axis: &usize| plant.nodes.axis[plant.axes.bearer[*axis].index()].index() == stem;
        let branches: Vec<usize> = axes_of(&plant, 2).into_iter().filter(on).collect();
        let offsets = (0..31).map(|nth| 1.0 + 9.0 * (f64::from(nth) + 0.5) / 31.0);
        let offsets: Vec<f64> = offsets.filter(|offset| *offset > f64::from(first) * segment).collect();
        assert_eq!(branches.len(), offsets.len(), "the branches of stem {stem}");
        for (&branch, offset) in branches.iter().zip(offsets) {
            let bearer = plant.axes.bearer[branch].index();
            let below = f64::from(plant.nodes.rank[bearer] - 1 + first) * segment;
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
}

/// nTaper at the base and the tip of each segment, on clones too, and without a step from one to the next.
#[test]
fn stems_taper_by_their_equation() {
    let mut tree = with(Branches { taper: 0.5.into(), ..level(12) }, clump(2));
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
    for (branches, tree) in [(level(40), clump(2)), (level(40), varied())] {
        let stated = grown(&with(Branches { rotate_deg: (-120.0).into(), ..branches }, tree), 3);
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

/// A variation is uniform between its ends: sizes of 400 trees, and down angles of 4,000 branches.
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
    let tree = Tree { scale_v_m: 4.0.into(), ..bare() };
    let heights: Vec<f64> = (0..400).map(|number| end(&grown(&tree, number), 0)[2]).collect();
    uniform(&heights, 10.0, 4.0);
    let branches = Branches { down_angle_v_deg: 20.0.into(), ..level(4000) };
    let plant = grown(&with(branches, bare()), 0);
    let angles: Vec<f64> = plant.axes.insertion[1..].iter().map(|angle| f64::from(*angle).to_degrees()).collect();
    uniform(&angles, 50.0, 20.0);
}

/// The paper's trees have no age: a seed, and from age 1 on the whole tree.
#[test]
fn a_tree_is_whole_from_its_first_age_on() {
    let model = compiled(&varied());
    let seed = contract::seed_of(1, 0);
    let young = contract::grown(&model, 1, &seed);
    assert_eq!(contract::components(&young), contract::components(&contract::grown(&model, 30, &seed)));
    let unsown = contract::sown(&model, &seed);
    assert_eq!((unsown.plants[0].axes.len(), unsown.plants[0].nodes.len()), (1, 0));
}

#[test]
fn trees_keep_the_contract_of_growth_models() {
    let single = Branches { curve_res: 1.into(), rotate_deg: (-100.0).into(), ..level(7) };
    let mut stump = with(single, clump(3));
    stump.trunk.curve_res = 1.into();
    for tree in [bare(), with(level(9), clump(1)), varied(), stump] {
        contract::check(&compiled(&tree), 4, 3);
        let longer = tree.compile(9, &Path::root()).expect("a sound tree");
        contract::the_length_of_the_run_leaves_no_trace(&compiled(&tree), &longer, 4, &contract::seed_of(3, 0));
    }
    let (one, other) = (compiled(&varied()), contract::sound());
    contract::two_species_share_a_plot([&one, &other], 8, 6, 0.5);
}

/// The forecast numbers are the numbers made, or bounds from above where the length of the trunk is drawn.
#[test]
fn the_forecast_counts_stems_and_segments() {
    let low = Tree { base_size: 0.0.into(), ..clump(2) };
    for (tree, exact) in [(with(level(31), low), true), (bare(), true), (varied(), false)] {
        let foretold = compiled(&tree).expectation(3).expect("a forecast");
        for (number, age) in [(0, 0), (0, 1), (1, 3), (2, 3)] {
            let plant = contract::grown(&compiled(&tree), age.max(1), &contract::seed_of(1, number));
            let made = if age == 0 { 1.0 } else { f64::from(plant.components()) };
            let expected = foretold.components(age);
            assert!(if exact { made == expected } else { made <= expected }, "{made} of {expected} at age {age}");
        }
    }
}

/// A tree of wood bends as any plant does: a branch that leaves the middle of a segment stays on its bent parent.
#[test]
fn branches_in_mid_segment_stay_on_a_parent_that_bends() {
    let rest = grown(&with(level(31), clump(2)), 0);
    let tissue = Tissue { modulus: vec![2e8], density: vec![900.0], uprighting: Uprighting::default() };
    let wood = Wood { tissues: vec![tissue], bends: true, organs: OrganMass::default(), ..Wood::default() };
    let mut bent = rest.clone();
    bent.habit = Arc::new(Habit { wood: Some(wood), ..(*rest.habit).clone() });
    bend(&mut bent, 1, &Site::default(), &mut Scratch::default());
    let apart = |a: [f32; 3], b: [f32; 3]| (0..3).map(|k| f64::from(a[k] - b[k]).abs()).fold(0.0, f64::max);
    let moved = rest.frames.base.iter().zip(&bent.frames.base).map(|(a, b)| apart(*a, *b)).fold(0.0, f64::max);
    assert!(moved > 0.05, "it does bend: by {moved} m");
    for axis in axes_of(&rest, 2) {
        let (bearer, first) = (rest.axes.bearer[axis].index(), nodes_of(&rest, axis)[0]);
        let from = rest.nodes.length[bearer] + rest.start_of(NodeId(first as u32))[0];
        assert!(from < rest.nodes.length[bearer], "branch {axis} leaves its parent below a tip");
        let (base, heading) = (bent.frames.base[bearer], bent.frames.heading[bearer]);
        let on_line = [0, 1, 2].map(|k| base[k] + from * heading[k]);
        assert!(apart(bent.frames.base[first], on_line) < ALIKE, "branch {axis}");
    }
}

#[test]
fn a_tree_that_has_no_room_is_told() {
    let model = compiled(&with(level(10_000), clump(20)));
    let seed = phytomer_sim::plant::Seed { component_limit: 50_000, ..contract::seed_of(1, 0) };
    assert!(contract::sown(&model, &seed).grow_to(1).is_err());
}

#[test]
fn every_number_out_of_its_range_is_told() {
    let told = |tree: &Tree, until: Tick| -> Vec<String> {
        let faults = tree.compile(until, &Path::root()).err().unwrap_or_default();
        faults.iter().map(|fault| fault.path.to_string()).collect()
    };
    assert!(told(&varied(), 65_535).is_empty());
    let mut wrong = with(level(10_001), bare());
    (wrong.scale_v_m, wrong.ratio) = (11.0.into(), f64::NAN.into());
    (wrong.trunk.curve_res, wrong.trunk.base_splits, wrong.trunk.taper) = (0.into(), 21.into(), 1.1.into());
    (wrong.branches[0].length, wrong.branches[0].down_angle_v_deg) = (0.0.into(), (-181.0).into());
    wrong.branches.push(level(1));
    let expected = [
        "",
        "scale_v_m",
        "ratio",
        "trunk.taper",
        "trunk.base_splits",
        "trunk.curve_res",
        "branches",
        "branches[0].down_angle_v_deg",
        "branches[0].length",
        "branches[0].number",
    ];
    assert_eq!(told(&wrong, 70_000), expected);
    let mut low = with(level(3), Tree { base_size: 0.5.into(), ..bare() });
    (low.trunk.length, low.trunk.length_v) = (0.7.into(), 0.2.into());
    assert_eq!(told(&low, 5), ["base_size"]);
}
