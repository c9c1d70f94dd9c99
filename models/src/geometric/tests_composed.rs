//! Trees made of others: growth levels that are combined, trees on one root, cuts, leaves, turns, and growth levels
//! that grow over several ticks (Aono & Kunii 1984, Fig. 10, Fig. 21 and the appendix).
//!
//! Each is held against a plain tree of which it is a part. Absent: the formulas (`tests`, `tests_deviated`).

use super::tests::{heading, printed_child, rule, tips};
use super::tests_deviated::{bits, model};
use super::{CombinedLevels, CutLateral, Descriptor, GeometricTree, GluedTree, Rule, TreeLeaf, TreeType};
use crate::contract;
use crate::fault::Path;
use phytomer_looks::FormName;
use phytomer_sim::clock::Tick;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::plant::{Kind, Origin, Plant};
use phytomer_sim::pose::pose;
use std::f64::consts::PI;

fn binary() -> Rule {
    rule([20.0, -50.0], [0.9, 0.7], 140.0)
}

fn ternary() -> Rule {
    Rule { r0: Some(0.8.into()), ..rule([50.0, -40.0], [0.6, 0.5], 140.0) }
}

fn grown(of: TreeType, tree: &GeometricTree, age: Tick) -> Plant {
    contract::grown(&model(of, tree), age, &contract::seed_of(1, 0))
}

fn plain(of: TreeType, rule: Rule, levels: u32) -> Plant {
    grown(of, &Descriptor::new(rule, levels).into(), levels + 1)
}

fn combined(model: TreeType, [from, to]: [u32; 2], rule: Rule) -> CombinedLevels {
    CombinedLevels { model: Some(model), from_level: from.into(), to_level: to.into(), rule }
}

#[test]
fn levels_of_another_type_branch_as_that_type_does() {
    let mut tree = Descriptor::new(binary(), 4);
    tree.combine = vec![combined(TreeType::Gmt3, [3, 4], ternary())];
    let plant = grown(TreeType::Gmt1, &tree.into(), 5);
    let of_level = |level: u32| plant.nodes.birth.iter().filter(|&&birth| birth == level + 1).count();
    assert_eq!([0, 1, 2, 3, 4].map(of_level), [1, 2, 4, 12, 36]);
    let binary = plain(TreeType::Gmt1, binary(), 2);
    assert_eq!(tips(&plant)[..7], tips(&binary)[..]);
    // A mother of level 2 bears three children by the ratios and the angles of the range.
    let all = tips(&plant);
    for (k, (ratio, h)) in [(0.6, 50.0), (0.8, 0.0), (0.5, -40.0)].into_iter().enumerate() {
        let turn = f64::from(plant.nodes.rank[3] - 1) * 140.0 * PI / 180.0;
        let expected = printed_child(all[1], all[3], ratio, h * PI / 180.0, turn);
        assert!((0..3).all(|i| (all[7 + k][i] - expected[i]).abs() < 1e-5), "child {k}");
    }
}

#[test]
fn a_range_takes_from_the_tree_what_it_does_not_state() {
    let mut tree = Descriptor::new(binary(), 5);
    tree.combine = vec![combined(TreeType::Gmt1, [2, 3], Rule::default())];
    let same = grown(TreeType::Gmt1, &tree.clone().into(), 6);
    assert_eq!(bits(&same), bits(&plain(TreeType::Gmt1, binary(), 5)));
    tree.combine[0].rule.r1 = Some(0.5.into());
    let other = grown(TreeType::Gmt1, &tree.into(), 6);
    let ratios = [1, 3, 7, 15].map(|i: usize| other.nodes.length[i] / other.nodes.length[(i - 1) / 2]);
    let expected = [0.9, 0.5, 0.5, 0.9];
    assert!((0..4).all(|i| (ratios[i] - expected[i] as f32).abs() < 1e-6), "{ratios:?}");
}

#[test]
fn trees_on_one_root_are_the_trees_that_they_are_alone() {
    let mut tree = GeometricTree::from(Descriptor::new(binary(), 4));
    let glued = Descriptor {
        first_direction: Some([0.3, 0.0, 1.0]),
        first_length_m: 2.0.into(),
        ..Descriptor::new(ternary(), 3)
    };
    tree.glue = vec![GluedTree { model: TreeType::Gmt3, tree: glued.clone() }];
    let mut both = grown(TreeType::Gmt1, &tree, 5);
    let alone = [plain(TreeType::Gmt1, binary(), 4), grown(TreeType::Gmt3, &glued.into(), 5)];
    assert_eq!(both.nodes.len(), alone[0].nodes.len() + alone[1].nodes.len());
    assert_eq!(both.axes.origin.iter().filter(|origin| **origin == Origin::Fork).count(), 1);
    // Where each internode begins and ends, as the pose has it: of both trees, and of each alone.
    let posed = |plant: &mut Plant| {
        pose(plant, 5);
        let end = |i: usize| {
            let (base, heading) = (plant.frames.base[i], plant.frames.heading[i]);
            let tip = [0, 1, 2].map(|k| base[k] + heading[k] * plant.nodes.length[i]);
            [base, tip].map(|point| point.map(|x| (f64::from(x) * 1e4).round() as i64))
        };
        let mut all: Vec<_> = (0..plant.nodes.len()).map(end).collect();
        all.sort_unstable();
        all
    };
    let together = posed(&mut both);
    let mut apart = alone.map(|mut plant| posed(&mut plant)).concat();
    apart.sort_unstable();
    let near = |a: &[[i64; 3]; 2], b: &[[i64; 3]; 2]| {
        a.iter().flatten().zip(b.iter().flatten()).all(|(x, y)| (x - y).abs() <= 1)
    };
    assert!(apart.iter().all(|end| together.iter().any(|other| near(end, other))), "each branch stands where it did");
    contract::check(&model(TreeType::Gmt1, &tree), 6, 3);
}

#[test]
fn a_cut_axis_ends_and_its_laterals_grow() {
    let mut tree = Descriptor::new(rule([0.0, -50.0], [0.9, 0.7], 140.0), 6);
    tree.cut_axis = Some(3.into());
    let plant = grown(TreeType::Gmt1, &tree.clone().into(), 7);
    let trunk: Vec<u32> =
        (0..plant.nodes.len()).filter(|&i| plant.nodes.axis[i].0 == 0).map(|i| plant.nodes.rank[i]).collect();
    assert_eq!(trunk, [1, 2, 3], "growth levels 0 to 2");
    // Laterals of the levels 1, 2 and 3, with 2⁶ − 1, 2⁵ − 1 and 2⁴ − 1 branches.
    assert_eq!(plant.nodes.len(), 3 + 63 + 31 + 15);
    contract::check(&model(TreeType::Gmt1, &tree.into()), 8, 3);
}

#[test]
fn cut_laterals_do_not_grow_past_their_level() {
    let mut tree = Descriptor::new(rule([0.0, -50.0], [0.9, 0.7], 140.0), 6);
    tree.cut_lateral =
        vec![CutLateral { level: 1.into(), to_level: None }, CutLateral { level: 2.into(), to_level: Some(3.into()) }];
    let plant = grown(TreeType::Gmt1, &tree.clone().into(), 7);
    // Whole: 127. The lateral of level 1 has 63 branches, that of level 2 31, of which 1 + 2 are left.
    assert_eq!(plant.nodes.len(), 127 - 63 - (31 - 3));
    let whole = plain(TreeType::Gmt1, rule([0.0, -50.0], [0.9, 0.7], 140.0), 6);
    let points =
        |plant: &Plant| tips(plant).into_iter().map(|tip| tip.map(|x| (x * 1e6).round() as i64)).collect::<Vec<_>>();
    let all = points(&whole);
    assert!(points(&plant).iter().all(|tip| all.contains(tip)), "what grows is as it was");
    contract::check(&model(TreeType::Gmt1, &tree.into()), 8, 3);
}

#[test]
fn leaves_stand_at_the_tips_of_the_levels_that_are_stated() {
    let leaf = TreeLeaf {
        form: FormName::Fan,
        number: 3.into(),
        length_cm: 8.0.into(),
        width_cm: 6.0.into(),
        insertion_deg: 40.0.into(),
        from_level: Some(2.into()),
        to_level: Some(3.into()),
        ..TreeLeaf::default()
    };
    let tree = Descriptor { leaf: Some(leaf.clone()), ..Descriptor::new(binary(), 4) };
    let plant = grown(TreeType::Gmt1, &tree.clone().into(), 5);
    assert_eq!(plant.organs.len(), 3 * (4 + 8));
    for i in 0..plant.organs.len() {
        let level = plant.nodes.birth[plant.organs.node[i].index()] - 1;
        assert!((2..=3).contains(&level) && plant.organs.kind[i] == Kind::Leaf);
        assert!((f64::from(plant.organs.length[i]) - 0.08).abs() < 1e-7);
        let area = 0.08 * 0.06 * f64::from(FormName::Fan.area_share());
        assert!((f64::from(plant.organs.area[i]) - area).abs() < 1e-8);
        assert_eq!(plant.organs.form[i], FormName::Fan.form());
    }
    contract::check(&model(TreeType::Gmt1, &tree.into()), 6, 3);
    // By default at the tips of the full-grown tree.
    let tips = Descriptor { leaf: Some(TreeLeaf::default()), ..Descriptor::new(ternary(), 3) };
    assert_eq!(grown(TreeType::Gmt3, &tips.clone().into(), 3).organs.len(), 0);
    assert_eq!(grown(TreeType::Gmt3, &tips.into(), 4).organs.len(), 27);
    // Leaves of one tick: only the newest branches are in leaf.
    let fleeting = TreeLeaf { from_level: Some(0.into()), life: Some(1.into()), ..TreeLeaf::default() };
    let tree: GeometricTree = Descriptor { leaf: Some(fleeting), ..Descriptor::new(binary(), 4) }.into();
    for age in 1..=5 {
        let plant = grown(TreeType::Gmt1, &tree, age);
        assert_eq!(plant.organs.death.iter().filter(|&&death| death > age).count(), 1 << (age - 1), "at age {age}");
    }
    contract::check(&model(TreeType::Gmt1, &tree), 7, 3);
}

#[test]
fn delta_turns_every_branching_and_adds_to_the_divergence() {
    let turned = Rule { delta_deg: Some(30.0.into()), ..binary() };
    let plant = plain(TreeType::Gmt1, turned, 5);
    let all = tips(&plant);
    for i in 1..plant.nodes.len() {
        let (mother, way) = ((i - 1) / 2, (i - 1) % 2);
        let below = if mother == 0 { [0.0; 3] } else { all[(mother - 1) / 2] };
        let turn = (f64::from(plant.nodes.rank[mother] - 1) * 140.0 + 30.0) * PI / 180.0;
        let expected = printed_child(below, all[mother], [0.9, 0.7][way], [20.0, -50.0][way] * PI / 180.0, turn);
        assert!((0..3).all(|k| (all[i][k] - expected[k]).abs() < 1e-5), "branch {i}");
    }
    let none = Rule { delta_deg: Some(0.0.into()), ..binary() };
    assert_eq!(bits(&plain(TreeType::Gmt1, none, 5)), bits(&plain(TreeType::Gmt1, binary(), 5)));
}

#[test]
fn a_fraction_of_a_turn_is_its_degrees() {
    for (name, degrees) in [("2/5", 144.0), ("1/2", 180.0), ("5/13", 360.0 * 5.0 / 13.0)] {
        let named = Rule { divergence: Some(name.to_owned()), divergence_deg: None, ..binary() };
        let stated = Rule { divergence_deg: Some(degrees.into()), ..binary() };
        assert_eq!(bits(&plain(TreeType::Gmt1, named, 6)), bits(&plain(TreeType::Gmt1, stated, 6)), "{name}");
    }
}

/// At the k-th of n ticks the newest branches have k/n of their length, angle, turn and diameter; at the n-th the tree
/// is that of whole growth levels, to the bit but for the ticks.
#[test]
fn a_growth_level_grows_over_its_ticks() {
    let stated = Descriptor::new(binary(), 4);
    let mut slow = GeometricTree::from(stated.clone());
    slow.ticks_per_level = Some(4.into());
    for level in 0..=4_u32 {
        let whole = grown(TreeType::Gmt1, &stated.clone().into(), level + 1);
        let same = grown(TreeType::Gmt1, &slow, 4 * (level + 1));
        assert_eq!(whole.nodes.length, same.nodes.length);
        assert!((0..whole.nodes.len()).all(|i| heading(&whole, i) == heading(&same, i)), "level {level}");
    }
    // Half of growth level 1: angles of 10 and −25 degrees, and ratios of 0.45 and 0.35, of the whole first branch.
    let half = grown(TreeType::Gmt1, &slow, 6);
    let expected = [
        printed_child([0.0; 3], [0.0, 0.0, 1.0], 0.45, 10.0 * PI / 180.0, 0.0),
        printed_child([0.0; 3], [0.0, 0.0, 1.0], 0.35, -25.0 * PI / 180.0, 0.0),
    ];
    let found = tips(&half);
    assert!((0..2).all(|i| (0..3).all(|k| (found[i + 1][k] - expected[i][k]).abs() < 1e-6)), "{found:?}");
    assert!((half.nodes.primary_diameter[1] - 0.035).abs() < 1e-7);
    contract::check(&model(TreeType::Gmt1, &slow), 21, 3);
}

#[test]
fn deviations_grow_with_their_level() {
    let mut slow = GeometricTree::from(Descriptor::new(
        Rule { deviation_m: Some([0.2, 0.1, -0.1]), ..rule([0.0, -45.0], [0.9, 0.8], 140.0) },
        3,
    ));
    slow.ticks_per_level = Some(2.into());
    let half = tips(&grown(TreeType::Gmt2, &slow, 3));
    // Half of 0.9 upright, and half of the deviation.
    assert!((0..3).all(|k| (half[1][k] - [0.1, 0.05, 1.4][k]).abs() < 1e-6), "{:?}", half[1]);
    contract::check(&model(TreeType::Gmt2, &slow), 9, 3);
}

#[test]
fn faults_of_what_is_composed_are_told_with_their_places() {
    type Case = (fn(&mut GeometricTree), &'static str);
    let cases: [Case; 14] = [
        (
            |t| t.tree.combine = vec![combined(TreeType::Gmt3, [2, 3], Rule::default())],
            "combine[0].r0: r0 is missing; expected it: a tree of gmt3 has one",
        ),
        (
            |t| t.tree.combine = vec![combined(TreeType::Gmt1, [2, 3], ternary())],
            "combine[0].r0: a tree of gmt1 takes no r0; expected it in a tree of gmt3",
        ),
        (
            |t| t.tree.combine = vec![combined(TreeType::Gmt1, [3, 7], Rule::default())],
            "combine[0].to_level: the range is from growth level 3 to 7",
        ),
        (
            |t| {
                t.tree.combine = vec![
                    combined(TreeType::Gmt1, [1, 3], Rule::default()),
                    combined(TreeType::Gmt1, [3, 4], Rule::default()),
                ]
            },
            "combine[1].from_level: the growth levels 3 to 4 are in another range too",
        ),
        (
            |t| t.glue = vec![GluedTree { model: TreeType::Gmt3, tree: Descriptor::new(binary(), 3) }],
            "glue[0].r0: r0 is missing",
        ),
        (
            |t| t.glue = vec![GluedTree { model: TreeType::Gmt1, tree: Descriptor::new(ternary(), 3) }],
            "glue[0].r0: a tree of gmt1 takes no r0",
        ),
        (
            |t| t.tree.cut_axis = Some(7.into()),
            "cut_axis: the growth level is 7; expected a growth level of the tree, 1 to 6",
        ),
        (
            |t| t.tree.cut_lateral = vec![CutLateral { level: 0.into(), to_level: None }],
            "cut_lateral[0].level: the growth level is 0",
        ),
        (
            |t| t.tree.cut_lateral = vec![CutLateral { level: 3.into(), to_level: Some(2.into()) }],
            "cut_lateral[0].to_level: to_level is 2; expected a growth level of the branch, 3 to 6",
        ),
        (
            |t| t.tree.leaf = Some(TreeLeaf { from_level: Some(7.into()), ..TreeLeaf::default() }),
            "leaf.from_level: the branches of the growth levels 7 to 6 bear leaves",
        ),
        (|t| t.tree.first_direction = Some([0.0; 3]), "first_direction: the direction has no length"),
        (|t| t.ticks_per_level = Some(0.into()), "ticks_per_level: a growth level takes 0 ticks; expected 1 to 1000"),
        (
            |t| (t.tree.rule.divergence, t.tree.rule.divergence_deg) = (Some("3/7".to_owned()), None),
            "divergence: the divergence is \"3/7\"; expected a Fibonacci fraction",
        ),
        (
            |t| t.tree.rule.divergence = Some("2/5".to_owned()),
            "divergence: divergence and divergence_deg are both given; expected one of the two",
        ),
    ];
    for (change, expected) in cases {
        let mut tree = GeometricTree::from(Descriptor::new(binary(), 6));
        change(&mut tree);
        let faults: Vec<String> = tree.check(TreeType::Gmt1, &Path::root()).iter().map(ToString::to_string).collect();
        assert!(faults.len() == 1 && faults[0].starts_with(expected), "{faults:?} is not `{expected}`");
    }
}

#[test]
fn what_is_expected_of_a_composed_tree_is_what_grows() {
    let leaf = TreeLeaf { from_level: Some(1.into()), number: 2.into(), ..TreeLeaf::default() };
    let mut tree = GeometricTree::from(Descriptor { leaf: Some(leaf), ..Descriptor::new(binary(), 5) });
    tree.tree.combine = vec![combined(TreeType::Gmt3, [2, 3], ternary())];
    tree.tree.cut_lateral = vec![CutLateral { level: 2.into(), to_level: Some(4.into()) }];
    tree.tree.cut_axis = Some(5.into());
    tree.glue = vec![GluedTree { model: TreeType::Gmt3, tree: Descriptor::new(ternary(), 3) }];
    tree.ticks_per_level = Some(3.into());
    let model = model(TreeType::Gmt1, &tree);
    let expected = model.expectation(20).expect("a forecast");
    for age in 0..=20 {
        let plant = contract::grown(&model, age, &contract::seed_of(1, 0));
        assert_eq!(expected.components(age), f64::from(plant.components()), "at age {age}");
        assert_eq!(model.components_at(age), u64::from(plant.components()), "at age {age}");
        for (order, means) in (1..).zip(&expected.orders) {
            let on = |axis: usize| plant.axes.order[axis] == order;
            let axes = (0..plant.axes.len()).filter(|&axis| on(axis)).count();
            let nodes = plant.nodes.axis.iter().filter(|axis| on(axis.index())).count();
            let leaves = plant.organs.node.iter().filter(|node| on(plant.nodes.axis[node.index()].index())).count();
            let found = [&means.axes, &means.nodes, &means.organs].map(|column| column[age as usize]);
            assert_eq!(found, [axes, nodes, leaves].map(|n| n as f64), "order {order} at age {age}");
        }
    }
}
