//! GMT2 and GMT3 of Aono & Kunii (1984), Table 4: trees held against the printed formulas, which are evaluated here a
//! second time from points, and against numbers computed apart from this program.
//!
//! The numbers are mean tips and total lengths of the figures at growth level 3 with a first branch of 10 and a
//! divergence of 140°. Absent: GMT4 (`tests_changing`), and what is combined (`tests_composed`).

use super::tests::{Point, heading, printed_child, rule, tips};
use super::{Controller, Descriptor, Falloff, GeometricModel, GeometricTree, Rule, TreeType};
use crate::contract;
use crate::fault::Path;
use phytomer_sim::math;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::plant::{ApexFate, EventKind, NodeId, Plant};
use std::f64::consts::PI;

/// A tree with a first branch of 10.
fn tree(rule: Rule, levels: u32) -> GeometricTree {
    Descriptor { first_length_m: 10.0.into(), ..Descriptor::new(rule, levels) }.into()
}

pub(super) fn model(of: TreeType, tree: &GeometricTree) -> GeometricModel {
    tree.compile(of, 60, &Path::root()).unwrap_or_else(|faults| panic!("{faults:?}"))
}

fn grown(of: TreeType, rule: Rule, levels: u32) -> Plant {
    contract::grown(&model(of, &tree(rule, levels)), levels + 1, &contract::seed_of(1, 0))
}

fn controller(factor: f64, at_m: Point) -> Controller {
    Controller { factor: factor.into(), at_m, from_level: None, to_level: None, falloff: Falloff::None }
}

/// The rows of Table 4 for GMT2: h1 = 0, h2 = −45, R1 = 0.9, R2 = 0.8.
fn row_11(deviation_m: Option<Point>, controllers: &[(f64, Point)]) -> Rule {
    let all: Vec<Controller> = controllers.iter().map(|&(factor, at)| controller(factor, at)).collect();
    let controller = (!all.is_empty()).then_some(all);
    Rule { deviation_m, controller, ..rule([0.0, -45.0], [0.9, 0.8], 140.0) }
}

/// The rows of Table 4 for GMT3: h = ±60, R0 = 0.9, R1 = R2 = 0.6.
fn row_12(deviation_m: Option<Point>) -> Rule {
    Rule { r0: Some(0.9.into()), deviation_m, ..rule([60.0, -60.0], [0.6, 0.6], 140.0) }
}

const DOWN_11: Point = [0.3, 0.3, -0.3];
/// Figure, uniform deviation, and controllers with their strengths.
type Row = (&'static str, Option<Point>, &'static [(f64, Point)]);

const TABLE_4: [Row; 4] = [
    ("11a", Some(DOWN_11), &[]),
    ("11c", None, &[(1.6, [30.0, 0.0, 0.0])]),
    ("11d", None, &[(-1.0, [30.0, 0.0, 0.0])]),
    ("11e", None, &[(-0.6, [30.0, 0.0, 0.0]), (-1.6, [-30.0, 15.0, 0.0])]),
];

/// The mean of the tips of the last level, and the total length of all branches.
fn measured(plant: &Plant) -> ([f64; 3], f64) {
    let last = plant.nodes.birth.iter().max().copied().expect("a branch");
    let all = tips(plant);
    let of_last: Vec<Point> = (0..all.len()).filter(|&i| plant.nodes.birth[i] == last).map(|i| all[i]).collect();
    let mean = [0, 1, 2].map(|k| of_last.iter().map(|tip| tip[k]).sum::<f64>() / of_last.len() as f64);
    (mean, plant.nodes.length.iter().map(|&long| f64::from(long)).sum())
}

/// The tip of a child of the branch from `a` to `b` after the move: the printed formula of GMT2.
fn moved(tip: Point, by: Point, controllers: &[(f64, Point)]) -> Point {
    let mut moved = [0, 1, 2].map(|i| tip[i] + by[i]);
    for (factor, at) in controllers {
        let apart = [0, 1, 2].map(|i| at[i] - tip[i]);
        let distance = apart.iter().map(|x| x * x).sum::<f64>().sqrt();
        (0..3).for_each(|i| moved[i] += factor * apart[i] / distance);
    }
    moved
}

/// The tips of all branches, level by level, by the printed formulas: `ways` are ratios and angles, and the place among
/// them that continues the axis.
fn printed((ways, onward): (&[(f64, f64)], usize), levels: u32, by: Point, controllers: &[(f64, Point)]) -> Vec<Point> {
    let mut level = vec![([0.0; 3], [0.0, 0.0, 10.0], 1_u32)];
    let mut all = vec![[0.0, 0.0, 10.0]];
    for _ in 0..levels {
        let children = level.iter().flat_map(|&(a, b, rank)| {
            let turn = f64::from(rank - 1) * 140.0 * PI / 180.0;
            (0..ways.len()).map(move |i| {
                let tip = printed_child(a, b, ways[i].0, ways[i].1 * PI / 180.0, turn);
                (b, moved(tip, by, controllers), if i == onward { rank + 1 } else { 1 })
            })
        });
        level = children.collect();
        all.extend(level.iter().map(|&(_, tip, _)| tip));
    }
    all
}

fn assert_near(name: &str, found: &[Point], expected: &[Point], bound: f64) {
    assert_eq!(found.len(), expected.len(), "{name}");
    for (i, (f, e)) in found.iter().zip(expected).enumerate() {
        assert!((0..3).all(|k| (f[k] - e[k]).abs() < bound), "{name}, branch {i}: {f:?} is not {e:?}");
    }
}

#[test]
fn the_trees_of_table_4_have_the_mean_tips_and_lengths_computed_apart() {
    let expected = [
        ("11a", TreeType::Gmt2, row_11(Some(DOWN_11), &[]), [7.867872, 1.329914, 24.864673], 102.139245),
        ("11c", TreeType::Gmt2, row_11(None, TABLE_4[1].2), [13.332962, -0.829068, 21.148330], 103.042649),
        ("12c", TreeType::Gmt3, row_12(Some([0.0, 0.0, -0.6])), [0.0, 0.0, 16.2], 151.698840),
    ];
    for (name, of, rule, tip, long) in expected {
        let (mean, total) = measured(&grown(of, rule, 3));
        assert!((0..3).all(|k| (mean[k] - tip[k]).abs() < 5e-6), "{name}: {mean:?} is not {tip:?}");
        assert!((total - long).abs() < 2e-5, "{name}: {total} is not {long}");
    }
}

#[test]
fn the_first_children_of_11a_are_moved_by_the_deviation() {
    let tips = tips(&grown(TreeType::Gmt2, row_11(Some(DOWN_11), &[]), 1));
    let expected = [[0.0, 0.0, 10.0], [0.3, 0.3, 18.7], [5.956854, 0.3, 15.356854]];
    assert_near("11a", &tips, &expected, 2e-6);
}

#[test]
fn every_row_of_table_4_stands_where_the_printed_formulas_put_it() {
    for (name, by, controllers) in TABLE_4 {
        let found = tips(&grown(TreeType::Gmt2, row_11(by, controllers), 8));
        let expected = printed((&[(0.9, 0.0), (0.8, -45.0)], 0), 8, by.unwrap_or_default(), controllers);
        assert_near(name, &found, &expected, 1e-4);
    }
    for (name, by) in [("12a", None), ("12c", Some([0.0, 0.0, -0.6]))] {
        let found = tips(&grown(TreeType::Gmt3, row_12(by), 6));
        let expected = printed((&[(0.6, 60.0), (0.9, 0.0), (0.6, -60.0)], 1), 6, by.unwrap_or_default(), &[]);
        assert_near(name, &found, &expected, 1e-4);
    }
}

/// Every column of a plant, to the bit.
pub(super) fn bits(plant: &Plant) -> Vec<u64> {
    let nodes = (0..plant.nodes.len()).flat_map(|i| {
        let [x, y, z] = heading(plant, i).map(f32::to_bits);
        let own = [plant.nodes.length[i], plant.nodes.primary_diameter[i], plant.nodes.azimuth[i]].map(f32::to_bits);
        let key = plant.node_key(NodeId(i as u32)).0;
        [x, y, z].into_iter().chain(own).map(u64::from).chain([key, plant.nodes.birth[i].into()])
    });
    let axes = (0..plant.axes.len()).flat_map(|i| {
        let angles = [plant.axes.azimuth[i], plant.axes.insertion[i]].map(|x| u64::from(x.to_bits()));
        angles.into_iter().chain([plant.axes.key[i].0, plant.axes.order[i].into(), plant.axes.apex_end[i].into()])
    });
    nodes.chain(axes).collect()
}

/// "If (dx, dy, dz) = (0, 0, 0) and Σ factor(i) = 0, then GMT2 is exactly the same as GMT1."
#[test]
fn without_deviators_gmt2_is_gmt1_to_the_bit() {
    for (h, r, divergence) in [([0.0, -45.0], [0.9, 0.8], 140.0), ([35.0, -35.0], [0.9, 0.7], -40.0)] {
        let of_gmt1 = bits(&grown(TreeType::Gmt1, rule(h, r, divergence), 8));
        let nothing = [
            Rule::default(),
            Rule { deviation_m: Some([0.0; 3]), ..Rule::default() },
            Rule {
                deviation_m: Some([0.0, -0.0, 0.0]),
                controller: Some(vec![controller(0.0, [3.0; 3])]),
                ..Rule::default()
            },
        ];
        for none in nothing {
            let of = Rule { deviation_m: none.deviation_m, controller: none.controller, ..rule(h, r, divergence) };
            assert_eq!(bits(&grown(TreeType::Gmt2, of.clone(), 8)), of_gmt1, "{:?}", of.controller);
            assert_eq!(bits(&grown(TreeType::Gmt4, of, 8)), of_gmt1, "an angle that is drawn and constant");
        }
    }
}

/// Two equal and opposite controllers at one place do nothing but for rounding.
#[test]
fn controllers_that_cancel_leave_gmt1_but_for_rounding() {
    let both = row_11(None, &[(1.5, [30.0, 0.0, 0.0]), (-1.5, [30.0, 0.0, 0.0])]);
    let expected = tips(&grown(TreeType::Gmt1, row_11(None, &[]), 6));
    assert_near("cancelled", &tips(&grown(TreeType::Gmt2, both, 6)), &expected, 1e-5);
}

#[test]
fn a_controller_on_the_second_level_moves_that_level_and_what_it_bears_alone() {
    let mut limited = row_11(None, &[(1.6, [30.0, 0.0, 0.0])]);
    let ranged = limited.controller.as_mut().expect("a controller");
    (ranged[0].from_level, ranged[0].to_level) = (Some(2.into()), Some(2.into()));
    let (free, plant) = (grown(TreeType::Gmt1, row_11(None, &[]), 5), grown(TreeType::Gmt2, limited, 5));
    let (before, after) = (tips(&free), tips(&plant));
    // Levels 0 and 1 are branches 0 to 2, level 2 branches 3 to 6, and the children of branch i are 2i + 1 and 2i + 2.
    assert_eq!(before[..3], after[..3]);
    for i in 3..7 {
        let by = [0, 1, 2].map(|k| after[i][k] - before[i][k]);
        let apart = [0, 1, 2].map(|k| [30.0, 0.0, 0.0][k] - before[i][k]);
        let distance = apart.iter().map(|x| x * x).sum::<f64>().sqrt();
        assert!((0..3).all(|k| (by[k] - 1.6 * apart[k] / distance).abs() < 1e-5), "branch {i} moves by {by:?}");
    }
    // What stands on it follows from the moved mother by the formula of GMT1 alone.
    for i in 7..63 {
        let (mother, way) = ((i - 1) / 2, (i - 1) % 2);
        let (a, b) = (if mother > 0 { after[(mother - 1) / 2] } else { [0.0; 3] }, after[mother]);
        let turn = f64::from(plant.nodes.rank[mother] - 1) * 140.0 * PI / 180.0;
        let expected = printed_child(a, b, [0.9, 0.8][way], [0.0, -45.0][way] * PI / 180.0, turn);
        assert!((0..3).all(|k| (after[i][k] - expected[k]).abs() < 2e-5), "branch {i}");
    }
}

#[test]
fn a_tip_on_its_controller_is_not_moved() {
    // The first child of 11a without deviation ends at (0, 0, 19), where the controller is.
    let tips = tips(&grown(TreeType::Gmt2, row_11(None, &[(1.6, [0.0, 0.0, 19.0])]), 1));
    assert_near("on it", &tips[1..2], &[[0.0, 0.0, 19.0]], 1e-6);
    let sideways = tips[2];
    assert!((sideways[0] - 5.656854).abs() > 0.1, "the other child is moved: {sideways:?}");
}

/// A deviation that undoes the straight child: its bud dies as it appears, and its sister grows on.
#[test]
fn a_branch_moved_to_nothing_ends_with_an_event() {
    let gone = Rule { deviation_m: Some([0.0, 0.0, -9.0]), ..rule([0.0, -60.0], [0.9, 0.9], 0.0) };
    let model = model(TreeType::Gmt2, &tree(gone, 3));
    let plant = contract::grown(&model, 4, &contract::seed_of(1, 0));
    assert_eq!(plant.axes.apex_fate[0], ApexFate::Died);
    assert_eq!((plant.axes.apex_end[0], plant.nodes.birth.iter().filter(|&&birth| birth == 2).count()), (2, 1));
    let events = plant.events.as_ref().expect("events are kept");
    let died: Vec<_> = events.iter().filter(|event| event.kind == EventKind::Died).collect();
    assert_eq!((died[0].tick, died[0].axis.0, died[0].count), (2, 0, 1));
    let forecast = model.expectation(4).expect("a forecast");
    assert!(forecast.components(4) >= f64::from(plant.components()) && forecast.least_components(4) == 0.0);
    contract::check(&model, 5, 3);
}

#[test]
fn a_controller_whose_strength_falls_off_is_divided_by_the_distance_once_more() {
    let mut falling = row_11(None, &[(1.6, [30.0, 0.0, 0.0])]);
    falling.controller.as_mut().expect("a controller")[0].falloff = Falloff::Inverse;
    let (before, after) =
        (tips(&grown(TreeType::Gmt1, row_11(None, &[]), 1)), tips(&grown(TreeType::Gmt2, falling, 1)));
    for i in 1..3 {
        let long = |v: Point| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let by = long([0, 1, 2].map(|k| after[i][k] - before[i][k]));
        let distance = long([0, 1, 2].map(|k| [30.0, 0.0, 0.0][k] - before[i][k]));
        assert!((by - 1.6 / distance).abs() < 1e-5, "branch {i} moves by {by}");
    }
}

#[test]
fn a_ternary_tree_has_powers_of_three_and_its_centre_keeps_the_direction() {
    for levels in 0..=7_u32 {
        let plant = grown(TreeType::Gmt3, row_12(None), levels);
        assert_eq!(plant.nodes.len() as u64, (3_u64.pow(levels + 1) - 1) / 2);
        let last = plant.nodes.birth.iter().filter(|&&birth| birth == levels + 1).count() as u64;
        assert_eq!(last, 3_u64.pow(levels));
        assert_eq!(plant.axes.len() as u64, 3_u64.pow(levels), "each tip ends an axis");
        let total: f64 = plant.nodes.length.iter().map(|&long| f64::from(long)).sum();
        let closed: f64 = (0..=levels).map(|k| 10.0 * math::pow(0.9 + 0.6 + 0.6, f64::from(k))).sum();
        assert!((total / closed - 1.0).abs() < 1e-6);
        for i in (0..plant.nodes.len()).filter(|i| 3 * i + 2 < plant.nodes.len()) {
            let (mother, centre) = (heading(&plant, i), heading(&plant, 3 * i + 2));
            assert!((0..3).all(|k| (mother[k] - centre[k]).abs() < 1e-6), "branch {i}: {mother:?}, {centre:?}");
            assert_eq!(plant.nodes.axis[3 * i + 2], plant.nodes.axis[i], "the centre child continues the axis");
            for side in [3 * i + 1, 3 * i + 3] {
                let order = |node: usize| plant.axes.order[plant.nodes.axis[node].index()];
                assert_eq!(order(side), order(i) + 1);
            }
        }
    }
}

#[test]
fn a_centre_ratio_of_0_is_refused() {
    for (r0, expected) in
        [(0.0, "r0: the value is 0"), (-0.5, "r0: the value is -0.5"), (1.01, "r0: the value is 1.01")]
    {
        let bad = Rule { r0: Some(r0.into()), ..row_12(None) };
        let faults: Vec<String> =
            tree(bad, 3).check(TreeType::Gmt3, &Path::root()).iter().map(ToString::to_string).collect();
        assert!(faults.len() == 1 && faults[0].starts_with(expected), "{faults:?}");
    }
    let without = Rule { r0: None, ..row_12(None) };
    let faults = tree(without, 3).check(TreeType::Gmt3, &Path::root());
    assert!(faults.len() == 1 && faults[0].to_string().starts_with("r0: r0 is missing"), "{faults:?}");
}

#[test]
fn deviated_and_ternary_trees_keep_the_contract_of_growth_models() {
    for (_, by, controllers) in TABLE_4 {
        contract::check(&model(TreeType::Gmt2, &tree(row_11(by, controllers), 5)), 7, 11);
    }
    contract::check(&model(TreeType::Gmt3, &tree(row_12(Some([0.0, 0.0, -0.6])), 4)), 6, 11);
}
