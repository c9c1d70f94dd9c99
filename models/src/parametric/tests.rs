//! The numbers and lengths of the stems of the paper's trees against what follows from its equations; splits and their
//! error diffusion; radii.
//!
//! Absent: places and turns (`tests_plant`), and parameters that are refused (`tests_faults`).

use super::equations::diffused;
use super::params::Tree;
use super::radius::{flare, radius_at};
use super::specimens::{aspen, bare, clump, level, oak, tupelo, unvaried, willow, with};
use super::{TreeModel, radius};
use crate::contract;
use crate::fault::Path;
use phytomer_sim::model::Grow as _;
use phytomer_sim::plant::{Origin, Plant};

pub(super) fn compiled(tree: &Tree) -> TreeModel {
    tree.compile(30, &Path::root()).unwrap_or_else(|faults| panic!("{faults:?}"))
}

/// Plant `number`, whole.
pub(super) fn grown(tree: &Tree, number: u32) -> Plant {
    let model = compiled(tree);
    let mut plant = contract::grown(&model, 1, &contract::seed_of(7, number));
    model.thicken(1, &mut plant);
    plant
}

/// The stems of each level without clones, and the sum of their lengths, metres; then the clones and the leaves.
fn counts(plant: &Plant) -> (Vec<usize>, Vec<f64>, usize, usize) {
    let axes = &plant.axes;
    let levels = axes.order.iter().copied().max().map_or(0, usize::from);
    let (mut stems, mut lengths, mut clones) = (vec![0; levels], vec![0.0; levels], 0);
    for axis in 0..axes.len() {
        let is_clone = axes.origin[axis] == Origin::Fork;
        stems[usize::from(axes.order[axis]) - 1] += usize::from(!is_clone);
        clones += usize::from(is_clone);
    }
    for node in 0..plant.nodes.len() {
        let axis = plant.nodes.axis[node].index();
        if axes.origin[axis] != Origin::Fork {
            lengths[usize::from(axes.order[axis]) - 1] += f64::from(plant.nodes.length[node]);
        }
    }
    (stems, lengths, clones, plant.organs.len())
}

fn near(found: f64, expected: f64, by: f64) {
    assert!((found - expected).abs() < by, "{found} is not {expected}");
}

/// Table 2 has 240 lines of 30 stems, 5,912 of 739, and 13,312 leaves, which are 13,498 by the equation.
#[test]
fn the_aspen_has_the_stems_and_leaves_of_the_equations() {
    let (stems, lengths, clones, leaves) = counts(&grown(&unvaried(aspen()), 0));
    assert_eq!((stems, clones, leaves), (vec![1, 30, 739], 0, 13_498));
    for (found, expected) in lengths.iter().zip([13.0, 88.324, 937.164]) {
        near(*found, expected, 6e-4);
    }
}

#[test]
fn the_tupelo_has_the_stems_and_leaves_of_the_equations() {
    let (stems, lengths, _, leaves) = counts(&grown(&unvaried(tupelo()), 0));
    assert_eq!((stems, leaves), (vec![1, 40, 820, 7_760], 31_324));
    for (found, expected) in lengths.iter().zip([23.0, 207.338, 1832.062, 5053.611]) {
        near(*found, expected, 2e-3);
    }
}

/// Nothing of what the aspen draws changes a number of stems or leaves.
#[test]
fn the_aspen_has_the_same_numbers_for_every_seed() {
    for number in 0..5 {
        let (stems, _, _, leaves) = counts(&grown(&aspen(), number));
        assert_eq!((stems, leaves), (vec![1, 30, 739], 13_498));
    }
}

/// Splits deal the children to more stems, and change neither their number nor that of leaves.
#[test]
fn splits_change_no_number_of_children() {
    let mut split = unvaried(aspen());
    (split.trunk.seg_splits, split.branches[0].seg_splits) = (1.0.into(), 0.5.into());
    split.branches[1].seg_splits = 0.4.into();
    let (stems, lengths, clones, leaves) = counts(&grown(&split, 0));
    assert_eq!((stems, leaves), (vec![1, 30, 739], 13_498));
    assert!(clones > 600, "{clones}");
    for (found, expected) in lengths.iter().zip([13.0, 88.324, 937.164]) {
        near(*found, expected, 6e-4);
    }
}

/// (nSegSplits + 1) to the power nCurveRes − 1 (§4.2 and Figure 1).
#[test]
fn a_trunk_splits_into_the_stems_that_the_paper_counts() {
    for (splits, segments, stems) in [(1.0, 3, 4), (2.0, 5, 81), (0.0, 9, 1), (3.0, 2, 4)] {
        let mut tree = bare();
        (tree.trunk.seg_splits, tree.trunk.curve_res) = (splits.into(), segments.into());
        let plant = grown(&tree, 0);
        assert_eq!(plant.axes.len(), stems, "{splits} splits, {segments} segments");
    }
}

/// The number at the base is that of the base, and the others go on by their own.
#[test]
fn the_base_of_a_trunk_splits_by_its_own_number() {
    let mut tree = clump(2);
    (tree.trunk.seg_splits, tree.trunk.curve_res) = (1.0.into(), 3.into());
    assert_eq!(grown(&tree, 0).axes.len(), 6, "three stems, each of which splits once");
}

/// At 1.2 four of five segments have one clone and the fifth two, and no two that follow one another have two.
#[test]
fn splits_are_diffused() {
    for splits in [1.2, 0.1, 0.2, 0.4, 0.5, 1.0, 2.7, 1.0 / 3.0] {
        let mut sum = 0;
        for nth in 1..=5000 {
            let now = diffused(splits, nth);
            sum += now;
            let off = f64::from(sum) - splits * nth as f64;
            assert!(off.abs() <= 0.5 + 1e-6, "{splits}: {off} after {nth} segments");
            assert!((f64::from(now) - splits).abs() < 1.0 + 1e-6, "{splits}: {now} at {nth}");
        }
    }
    let ten: Vec<u32> = (1..=10).map(|nth| diffused(1.2, nth)).collect();
    assert_eq!(ten.iter().sum::<u32>(), 12);
    assert!(!ten.windows(2).any(|pair| pair == [2, 2]), "{ten:?}");
}

/// On grown plants, over the stems of the level in the order of creation.
#[test]
fn the_splits_of_a_grown_level_are_diffused() {
    let mut tree = with(level(40.0), bare());
    tree.branches[0].seg_splits = 1.2.into();
    tree.branches[0].curve_res = 3.into();
    let plant = grown(&tree, 0);
    let (mut sum, mut uses) = (0, 0);
    for node in 0..plant.nodes.len() {
        let axis = plant.nodes.axis[node].index();
        if plant.axes.order[axis] != 2 || plant.axes.last_node[axis].index() == node {
            continue;
        }
        let clones = (0..plant.axes.len())
            .filter(|&axis| plant.axes.origin[axis] == Origin::Fork && plant.axes.bearer[axis].index() == node);
        (sum, uses) = (sum + clones.count(), uses + 1);
        assert!((sum as f64 - 1.2 * f64::from(uses)).abs() <= 0.5 + 1e-6, "{sum} of {uses}");
    }
    assert!(uses > 100, "{uses}");
}

#[test]
fn the_aspen_is_as_thick_as_the_equations_say() {
    near(flare(0.6, 0.0), 1.594, 1e-12);
    let plant = grown(&unvaried(aspen()), 0);
    near(f64::from(plant.nodes.diameter[0]), 2.0 * 0.195 * 1.594, 1e-6);
    near(radius::branch_radius(0.195, 3.9 / 13.0, 1.2, 1.0), 0.04598, 5e-6);
    near(flare(0.6, 0.125), 1.0, 1e-12);
    // At a sixteenth of the length y is 1/2.
    near(flare(2.0, 0.0625), 1.0 + 2.0 * 9.0 / 100.0, 1e-12);
}

/// The chart of §4.4: 0 a cylinder, 1 a cone, 2 ends in half a sphere, 3 is a chain of spheres.
#[test]
fn stems_taper_from_a_cylinder_to_a_chain_of_spheres() {
    let (radius, long) = (0.5, 10.0);
    let at = |z, taper| radius_at(z, taper, radius, long);
    for z in [0.0, 0.3, 0.77, 1.0] {
        near(at(z, 0.0), radius, 1e-12);
        near(at(z, 0.4), radius * (1.0 - 0.4 * z), 1e-12);
        near(at(z, 1.0), radius * (1.0 - z), 1e-12);
    }
    // Half a sphere of 0.5 m about a point 9.5 m up.
    for (height, expected) in [(4.0, 0.5), (9.5, 0.5), (9.8, 0.4), (10.0, 0.0)] {
        near(at(height / long, 2.0 - 1e-12), expected, 1e-6);
        near(at(height / long, 2.0), expected, 1e-6);
    }
    // Spheres of 0.5 m, ten of them; at 2.2 they are a fifth as deep, but for the last half.
    for (from_end, full) in [(0.0, 0.0), (0.5, 0.5), (1.0, 0.0), (0.2, 0.4), (2.8, 0.4), (3.5, 0.5), (4.0, 0.0)] {
        let z = 1.0 - from_end / long;
        near(at(z, 3.0), full, 1e-6);
        let shallow = if from_end < 0.5 { full } else { 0.8 * 0.5 + 0.2 * full };
        near(at(z, 2.2), shallow, 1e-6);
    }
    for taper in [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0] {
        assert_eq!(radius_at(0.5, taper, 0.0, 1.0), 0.0);
    }
}

/// The forecast numbers are the numbers made, or bounds or estimates as they are told.
#[test]
fn the_forecast_counts_stems_segments_and_leaves() {
    use phytomer_sim::expectation::Certainty;
    let mut whole = with(level(31.0), clump(2));
    whole.trunk.seg_splits = 1.0.into();
    whole.trunk.curve_res = 4.into();
    let palm: Tree = {
        let mut tree = bare();
        (tree.whole.leaves, tree.whole.quality) = ((-17.0).into(), 2.0.into());
        tree
    };
    for tree in [whole, bare(), aspen(), tupelo(), palm] {
        let foretold = compiled(&tree).expectation(3).expect("a forecast");
        assert_eq!(foretold.certainty(), Certainty::Exact);
        for (number, age) in [(0, 1), (1, 3)] {
            let plant = contract::grown(&compiled(&tree), age, &contract::seed_of(1, number));
            assert_eq!(f64::from(plant.components()), foretold.components(age));
        }
        assert_eq!(foretold.components(0), 1.0);
    }
    let oak = unvaried(oak());
    let foretold = compiled(&oak).expectation(1).expect("a forecast");
    assert_eq!(foretold.certainty(), Certainty::About);
    let made = f64::from(contract::grown(&compiled(&oak), 1, &contract::seed_of(1, 0)).components());
    assert!((made / foretold.components(1) - 1.0).abs() < 0.1, "{made} of {}", foretold.components(1));
    assert!(compiled(&willow()).expectation(1).expect("a forecast").components(1) > 400_000.0);
}

/// Shape 5 comes down to 0 at the base of the crown and at its top: stems under a millimetre are left out, and no
/// other.
#[test]
fn no_stem_is_shorter_than_a_millimetre() {
    let mut tree = with(level(1000.0), bare());
    (tree.whole.shape, tree.whole.base_size) = (5.into(), 0.0.into());
    tree.branches[0].length = 0.002.into();
    let plant = grown(&tree, 0);
    let ratio = |k: u32| 1.0 - f64::from(k) / 1001.0;
    let length = |r: f64| 0.02 * if r <= 0.7 { r / 0.7 } else { (1.0 - r) / 0.3 };
    let expected = (1..=1000).filter(|&k| length(ratio(k)) >= 1e-3).count();
    assert_eq!(plant.axes.len() - 1, expected);
    assert!(expected < 960, "{expected}");
}

/// 0Scale doubles the radius of the trunk once, and that of its branches with it.
#[test]
fn the_factor_of_the_trunk_acts_once() {
    let mut tree = with(level(5.0), bare());
    let one = grown(&tree, 0);
    tree.trunk.scale = 2.0.into();
    let two = grown(&tree, 0);
    for (one, two) in one.nodes.diameter.iter().zip(&two.nodes.diameter) {
        near(f64::from(*two), 2.0 * f64::from(*one), 1e-6);
    }
}

/// Stems of level 4 have the lengths and numbers of level 3, and leaves on the trunk the angles of level 1.
#[test]
fn levels_beyond_the_third_are_like_it() {
    let mut tree = with(level(3.0), bare());
    (tree.whole.levels, tree.whole.base_size) = (6.into(), 0.0.into());
    tree.branches[1] = level(2.0);
    tree.branches[2] = level(2.0);
    let (stems, lengths, _, _) = counts(&grown(&tree, 0));
    // ⌈2 (1 − ½ k/(n + 1))⌉ is 2 for every k.
    assert_eq!(stems, [1, 3, 6, 12, 24, 48]);
    for deep in 3..5 {
        // Of n children at k/(n + 1) each is 0.3 (1 − 0.6 k/(n + 1)) of its parent: of two, 0.42 together.
        near(lengths[deep + 1] / lengths[deep], 0.3 * (2.0 - 0.6), 1e-5);
    }
}
