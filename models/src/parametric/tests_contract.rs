//! Parametric trees as plants of the program: the contract of growth models, their age, bending, and room.
//!
//! Absent: closed forms of single trees (`tests_plant`).

use super::TreeModel;
use super::params::{Branches, Growing, LeafSeason, Tree};
use super::specimens::{aspen, bare, clump, level, willow, with};
use super::tests::{compiled, grown};
use crate::contract;
use crate::fault::Path;
use crate::law::{Law, LawForm};
use phytomer_sim::mechanics::{OrganMass, Scratch, Tissue, Uprighting, Wood, bend};
use phytomer_sim::plant::{Habit, NodeId};
use phytomer_sim::pose::pose;
use phytomer_sim::site::Site;
use std::sync::Arc;

/// The tolerance of a place, metres.
const ALIKE: f64 = 1e-5;

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < ALIKE, "{found} is not {expected}");
}

/// A tree that uses most features, with every variation.
fn varied() -> Tree {
    let mut tree = clump(2);
    let whole = &mut tree.whole;
    (whole.shape, whole.scale_v, whole.base_size) = (7.into(), 3.0.into(), 0.05.into());
    (whole.lobes, whole.lobe_depth, whole.flare, whole.levels) = (5.into(), 0.1.into(), 0.6.into(), 3.into());
    (whole.leaves, whole.leaf_bend, whole.attraction_up) = (4.0.into(), 0.5.into(), 0.7.into());
    let trunk = &mut tree.trunk;
    (trunk.length_v, trunk.split_angle_v, trunk.taper) = (0.2.into(), 8.0.into(), 1.1.into());
    (trunk.curve, trunk.curve_back, trunk.curve_v) = (30.0.into(), (-40.0).into(), 90.0.into());
    (trunk.seg_splits, trunk.scale_v) = (0.1.into(), 0.3.into());
    let branches = Branches { rotate_v: 30.0.into(), length_v: 0.1.into(), down_angle_v: 10.0.into(), ..level(15.0) };
    tree.branches[0] = Branches { curve_back: 20.0.into(), curve_v: 60.0.into(), ..branches };
    let twigs = Branches { curve_v: (-25.0).into(), curve_res: 3.into(), seg_splits: 0.3.into(), ..level(4.0) };
    tree.branches[1] = twigs;
    tree
}

/// The tree grown by its own law, with leaves of a season.
fn growing() -> Tree {
    let mut tree = varied();
    let expression = |text: &str| Law::from(LawForm { expression: Some(text.to_owned()), ..LawForm::default() });
    tree.whole.growth =
        Some(Growing { scale: expression("min(1, 0.2 * age)"), levels: Some(expression("1 + floor(age / 2)")) });
    tree.whole.season = Some(LeafSeason { ticks_per_year: 3.into(), leaf_out: 0.into(), leaf_fall: 2.into() });
    tree
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

/// Ours: levels appear by their law, stems have the share of their full length, leaves come when all levels stand and
/// fall with the season.
#[test]
fn a_tree_grows_by_its_laws() {
    let model = compiled(&growing());
    let whole = compiled(&varied());
    let seed = contract::seed_of(7, 2);
    let full = contract::grown(&whole, 1, &seed);
    for (age, levels, share, leaves) in [
        (1, 1, 0.2, false),
        (2, 2, 0.4, false),
        (3, 2, 0.6, false),
        (4, 3, 0.8, true),
        (5, 3, 1.0, false),
        (6, 3, 1.0, true),
    ] {
        let plant = contract::grown(&model, age, &seed);
        assert_eq!(plant.axes.order.iter().max(), Some(&levels), "levels at age {age}");
        for node in 0..plant.nodes.len() {
            near(f64::from(plant.nodes.length[node]), share * f64::from(full.nodes.length[node]));
            near(f64::from(plant.nodes.diameter[node]), share * f64::from(full.nodes.diameter[node]));
        }
        let standing = (0..plant.organs.len()).filter(|&organ| plant.organs.death[organ] > age).count();
        assert_eq!(standing, if leaves { full.organs.len() } else { 0 }, "leaves at age {age}");
    }
}

#[test]
fn trees_keep_the_contract_of_growth_models() {
    let single = Branches { curve_res: 1.into(), rotate: (-100.0).into(), ..level(7.0) };
    let mut stump = with(single, clump(3));
    (stump.trunk.curve_res, stump.whole.leaves) = (1.into(), (-3.0).into());
    let mut pruned = varied();
    (pruned.whole.prune_ratio, pruned.whole.prune_width) = (0.9.into(), 0.15.into());
    for tree in [bare(), with(level(9.0), clump(1)), varied(), stump, pruned, growing()] {
        contract::check(&compiled(&tree), 7, 3);
        let longer = tree.compile(9, &Path::root()).expect("a sound tree");
        contract::the_length_of_the_run_leaves_no_trace(&compiled(&tree), &longer, 7, &contract::seed_of(3, 0));
    }
    let (one, other): (TreeModel, _) = (compiled(&varied()), contract::sound());
    contract::two_species_share_a_plot([&one, &other], 8, 6, 0.5);
}

/// A tree of wood bends as any plant does: a branch that leaves the middle of a segment stays on its bent parent.
#[test]
fn branches_in_mid_segment_stay_on_a_parent_that_bends() {
    let mut rest = grown(&with(level(31.0), clump(2)), 0);
    pose(&mut rest, 1);
    let tissue = Tissue { modulus: vec![2e8], density: vec![900.0], uprighting: Uprighting::default() };
    let wood = Wood { tissues: vec![tissue], bends: true, organs: OrganMass::default(), ..Wood::default() };
    let mut bent = rest.clone();
    bent.habit = Arc::new(Habit { wood: Some(wood), ..(*rest.habit).clone() });
    bend(&mut bent, 1, &Site::default(), &mut Scratch::default());
    let apart = |a: [f32; 3], b: [f32; 3]| (0..3).map(|k| f64::from(a[k] - b[k]).abs()).fold(0.0, f64::max);
    let moved = rest.frames.base.iter().zip(&bent.frames.base).map(|(a, b)| apart(*a, *b)).fold(0.0, f64::max);
    assert!(moved > 0.02, "it does bend: by {moved} m");
    for axis in (0..rest.axes.len()).filter(|&axis| rest.axes.order[axis] == 2) {
        let first = (0..rest.nodes.len()).find(|&node| rest.nodes.axis[node].index() == axis).expect("a node");
        let bearer = rest.axes.bearer[axis].index();
        let from = rest.nodes.length[bearer] + rest.start_of(NodeId(first as u32))[0];
        let (base, heading) = (bent.frames.base[bearer], bent.frames.heading[bearer]);
        let on_line = [0, 1, 2].map(|k| base[k] + from * heading[k]);
        assert!(apart(bent.frames.base[first], on_line) < ALIKE, "branch {axis}");
    }
}

#[test]
fn a_tree_that_has_no_room_is_told() {
    let mut explodes = bare();
    (explodes.trunk.seg_splits, explodes.trunk.curve_res) = (5.0.into(), 16.into());
    for tree in [with(level(2000.0), clump(20)), explodes, aspen(), willow()] {
        let seed = phytomer_sim::plant::Seed { component_limit: 5_000, ..contract::seed_of(1, 0) };
        assert!(contract::sown(&compiled(&tree), &seed).grow_to(1).is_err());
    }
}
