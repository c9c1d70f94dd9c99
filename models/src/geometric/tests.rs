//! Every row of Table 1 of Aono & Kunii (1984), grown and compared with the printed equations, which are evaluated here
//! a second time from points and by plain recursion; counts, closed forms, axes and outlines.
//!
//! Absent: drawn parameters (`tests_drawn`) and refused parameters (`tests_parameters`).

use super::{Descriptor, GeometricModel, GeometricTree, Gmt1, Rule};
use crate::contract;
use crate::fault::Path;
use crate::law::{Quantity, Variate};
use phytomer_sim::clock::Tick;
use phytomer_sim::math;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::plant::{NodeId, Origin, Plant, Rest};
use std::f64::consts::PI;

/// Figure, h1, h2, R1, R2, divergence, growth level; R_diam is 0.7 in every row. Rows `5c&e` and `5d&f` are two each.
type Row = (&'static str, f64, f64, f64, f64, f64, u32);

const TABLE_1: [Row; 15] = [
    ("5a", 35.0, -35.0, 0.9, 0.7, 140.0, 9),
    ("5b", 35.0, -35.0, 0.9, 0.7, 140.0, 9),
    ("5c", 20.0, -50.0, 0.9, 0.7, 0.0, 9),
    ("5d", 10.0, -60.0, 0.9, 0.7, 0.0, 9),
    ("5e", 20.0, -50.0, 0.9, 0.7, 140.0, 9),
    ("5f", 10.0, -60.0, 0.9, 0.7, 140.0, 9),
    ("5g", 0.0, -70.0, 0.9, 0.7, 140.0, 9),
    ("6a", 0.0, -25.0, 0.9, 0.7, 140.0, 10),
    ("6b", 0.0, -40.0, 0.9, 0.7, 140.0, 10),
    ("6c", 0.0, -55.0, 0.9, 0.7, 140.0, 10),
    ("6d", 0.0, -70.0, 0.9, 0.7, 140.0, 10),
    ("7a", 0.0, -45.0, 0.9, 0.5, 140.0, 10),
    ("7b", 0.0, -45.0, 0.9, 0.7, 140.0, 10),
    ("7c", 0.0, -45.0, 0.9, 0.9, 140.0, 10),
    ("7d", 0.0, -45.0, 0.7, 0.9, 140.0, 10),
];

fn parameters(&(_, h1_deg, h2_deg, r1, r2, divergence_deg, levels): &Row) -> Gmt1 {
    let rule = rule([h1_deg, h2_deg], [r1, r2], divergence_deg);
    Gmt1::from(GeometricTree::from(Descriptor::new(rule, levels)))
}

/// Two children with these angles and ratios, left and right; R_diam is 0.7.
pub(super) fn rule(h_deg: [f64; 2], r: [f64; 2], divergence_deg: f64) -> Rule {
    let [h1_deg, h2_deg, r1, r2, divergence_deg] =
        [h_deg[0], h_deg[1], r[0], r[1], divergence_deg].map(|number| Some(Variate::from(number)));
    Rule { h1_deg, h2_deg, r1, r2, divergence_deg, diameter_ratio: Some(0.7.into()), ..Rule::default() }
}

fn with_levels(mut tree: Gmt1, levels: u32) -> Gmt1 {
    tree.0.tree.levels = Quantity::from(levels);
    tree
}

/// The components of a tree at an age, from the numbers of the model.
fn components_at(tree: &Gmt1, age: Tick) -> u64 {
    model(tree).components_at(age)
}

fn table_1(name: &str) -> &'static Row {
    TABLE_1.iter().find(|row| row.0 == name).expect("a row of Table 1")
}

fn model(tree: &Gmt1) -> GeometricModel {
    tree.compile(tree.0.tree.levels.value() + 1, &Path::root()).expect("the tree is sound")
}

fn row(name: &str) -> Gmt1 {
    parameters(table_1(name))
}

fn grown(tree: &Gmt1, age: Tick) -> Plant {
    contract::grown(&model(tree), age, &contract::seed_of(1, 0))
}

/// The heading that a node of a plant states; 0 where it states none.
pub(super) fn heading(plant: &Plant, node: usize) -> [f32; 3] {
    match plant.rest_of(NodeId(node as u32), plant.age) {
        Rest::Heading(heading) => heading,
        _ => [0.0; 3],
    }
}

/// The tip of each internode, from the columns: lengths along stated headings.
pub(super) fn tips(plant: &Plant) -> Vec<[f64; 3]> {
    let mut tips: Vec<[f64; 3]> = Vec::new();
    for i in 0..plant.nodes.len() {
        let base = plant.nodes.parent[i].some().map_or([0.0; 3], |parent| tips[parent.index()]);
        let long = f64::from(plant.nodes.length[i]);
        tips.push([0, 1, 2].map(|k| base[k] + long * f64::from(heading(plant, i)[k])));
    }
    tips
}

pub(super) type Point = [f64; 3];

/// The printed equations with the rule for a vertical mother, then a turn about her (Rodrigues' formula).
pub(super) fn printed_child(a: Point, b: Point, ratio: f64, h: f64, turn: f64) -> Point {
    let [u, v, w] = [0, 1, 2].map(|k| b[k] - a[k]);
    let t = (u * u + v * v + w * w).sqrt();
    let horizontal = (u * u + v * v).sqrt();
    let (su, sv) = if horizontal < 1e-9 { (0.0, 1.0) } else { (u / horizontal, v / horizontal) };
    let (sin, cos) = (math::sin(h), math::cos(h));
    let c = [ratio * (u * cos - t * sv * sin), ratio * (v * cos + t * su * sin), ratio * w * cos];
    let k = [u / t, v / t, w / t];
    let along = k[0] * c[0] + k[1] * c[1] + k[2] * c[2];
    let cross = [k[1] * c[2] - k[2] * c[1], k[2] * c[0] - k[0] * c[2], k[0] * c[1] - k[1] * c[0]];
    let (sin, cos) = (math::sin(turn), math::cos(turn));
    [0, 1, 2].map(|i| b[i] + c[i] * cos + cross[i] * sin + k[i] * along * (1.0 - cos))
}

/// The tips of all branches as a recursion makes them, at their places in the order of levels: the children of branch i
/// are branches 2i + 1 and 2i + 2.
fn recursion(tree: &Row, branch: usize, [a, b]: [Point; 2], rank: u32, level: u32, tips: &mut [Point]) {
    tips[branch] = b;
    let &(_, h1_deg, h2_deg, r1, r2, divergence_deg, levels) = tree;
    if level == levels {
        return;
    }
    let turn = f64::from(rank - 1) * divergence_deg * PI / 180.0;
    let main = if h1_deg.abs() <= h2_deg.abs() { 1 } else { 2 };
    for (i, ratio, h) in [(1, r1, h1_deg), (2, r2, h2_deg)] {
        let tip = printed_child(a, b, ratio, h * PI / 180.0, turn);
        let rank = if i == main { rank + 1 } else { 1 };
        recursion(tree, 2 * branch + i, [b, tip], rank, level + 1, tips);
    }
}

#[test]
fn every_row_of_table_1_stands_where_the_printed_equations_put_it() {
    for row in &TABLE_1 {
        let found = tips(&grown(&parameters(row), row.6 + 1));
        let mut expected = vec![[0.0; 3]; found.len()];
        recursion(row, 0, [[0.0; 3], [0.0, 0.0, 1.0]], 1, 0, &mut expected);
        for (i, (f, e)) in found.iter().zip(&expected).enumerate() {
            assert!((0..3).all(|k| (f[k] - e[k]).abs() < 5e-6), "{}, branch {i}: {f:?} is not {e:?}", row.0);
        }
    }
}

#[test]
fn a_tree_of_age_n_has_2_to_the_n_less_1_branches_and_its_lengths_their_closed_form() {
    for row in &TABLE_1 {
        let tree = parameters(row);
        for age in 1..=row.6 + 1 {
            let plant = grown(&tree, age);
            assert_eq!(plant.nodes.len(), (1 << age) - 1, "{} at age {age}", row.0);
            assert_eq!(u64::from(plant.components()), components_at(&tree, age));
            let sum: f64 = plant.nodes.length.iter().map(|&long| f64::from(long)).sum();
            let closed: f64 = (0..age).map(|k| math::pow(row.3 + row.4, f64::from(k))).sum();
            assert!((sum / closed - 1.0).abs() < 1e-6, "{} at age {age}: {sum} is not {closed}", row.0);
        }
    }
}

#[test]
fn what_is_expected_of_a_tree_is_what_grows() {
    let tree = with_levels(row("5f"), 6);
    let expected = model(&tree).expectation(9).expect("counts without chance");
    for age in 0..=9 {
        assert_eq!(expected.components(age), components_at(&tree, age) as f64, "at age {age}");
        let plant = grown(&tree, age);
        for (order, means) in (1..).zip(&expected.orders) {
            let axes = plant.axes.order.iter().filter(|&&o| o == order).count();
            let of_order = |axis: &&phytomer_sim::plant::AxisId| plant.axes.order[axis.index()] == order;
            let nodes = plant.nodes.axis.iter().filter(of_order).count();
            let found = [means.axes[age as usize], means.nodes[age as usize], means.units[age as usize]];
            assert_eq!(found, [axes, nodes, nodes].map(|n| n as f64), "order {order} at age {age}");
        }
    }
}

#[test]
fn diameters_shrink_by_their_ratio_at_each_level_and_the_tree_stops_at_its_largest() {
    let tree = row("5e");
    let plant = grown(&tree, 40);
    assert_eq!(plant.nodes.len(), 1023);
    for i in 0..plant.nodes.len() {
        let expected = 0.1 * math::pow(0.7, f64::from(plant.nodes.birth[i] - 1));
        assert!((f64::from(plant.nodes.primary_diameter[i]) / expected - 1.0).abs() < 1e-6);
    }
    assert!((0..plant.axes.len()).all(|axis| plant.bud_lives(phytomer_sim::plant::AxisId(axis as u32), 40)));
}

/// Fig. 18, Eqs. 1 and 2: the height of a tree with h1 = 0 is H0 (1 + R1 + … + R1ⁿ).
#[test]
fn a_monopodial_tree_has_the_height_of_equation_2() {
    let tree = row("5g");
    let plant = grown(&tree, 10);
    let trunk = (0..plant.nodes.len()).rfind(|&i| plant.nodes.axis[i].0 == 0).expect("a trunk");
    assert_eq!(plant.nodes.rank[trunk], 10);
    let closed: f64 = (0..=9).map(|k| math::pow(0.9, f64::from(k))).sum();
    assert!((tips(&plant)[trunk][2] - closed).abs() < 1e-6);
}

#[test]
fn the_smaller_angle_carries_the_axis_on_and_the_other_begins_the_next_order() {
    for name in ["5a", "5e", "5g", "7d"] {
        let mirrored = |mut tree: Gmt1| {
            let rule = &mut tree.0.tree.rule;
            std::mem::swap(&mut rule.h1_deg, &mut rule.h2_deg);
            std::mem::swap(&mut rule.r1, &mut rule.r2);
            tree
        };
        for (tree, first) in [(row(name), 1), (mirrored(row(name)), if name == "5a" { 1 } else { 2 })] {
            let plant = grown(&tree, 6);
            for i in (0..plant.nodes.len()).filter(|i| 2 * i + 2 < plant.nodes.len()) {
                let (main, lateral) = if first == 1 { (2 * i + 1, 2 * i + 2) } else { (2 * i + 2, 2 * i + 1) };
                assert_eq!(plant.nodes.axis[main], plant.nodes.axis[i]);
                let axis = plant.nodes.axis[lateral].index();
                assert_eq!(plant.axes.bearer[axis], NodeId(i as u32));
                assert_eq!(plant.axes.origin[axis], Origin::Axillary);
                assert_eq!(plant.axes.order[axis], plant.axes.order[plant.nodes.axis[i].index()] + 1);
            }
            assert_eq!(plant.axes.order.iter().max(), Some(&6));
        }
    }
}

/// Fig. 4: seen from above, each lateral of an upright trunk stands a divergence angle further round than the one
/// below, and the first to the right.
#[test]
fn the_kth_lateral_of_an_upright_trunk_stands_at_k_divergence_angles() {
    for name in ["5g", "6a", "7d"] {
        let plant = grown(&row(name), table_1(name).6 + 1);
        let on_trunk = |&axis: &usize| plant.axes.order[axis] == 2;
        for (k, axis) in (0..plant.axes.len()).filter(on_trunk).enumerate() {
            let first = (0..plant.nodes.len()).find(|&i| plant.nodes.axis[i].index() == axis).expect("a branch");
            let [x, y, _] = heading(&plant, first).map(f64::from);
            let expected = (k * 140 % 360) as f64 * PI / 180.0;
            let off = math::sin(math::atan2(y, x) - expected).abs() + 1.0 - math::cos(math::atan2(y, x) - expected);
            assert!(off < 1e-5, "{name}: lateral {k} is off by {off}");
            assert!((f64::from(plant.axes.azimuth[axis]) - expected).abs() < 1e-6, "{name}: azimuth of lateral {k}");
        }
    }
}

/// Without divergence "all the lateral branches develop near the same plane": of an upright trunk, in x–z.
#[test]
fn without_divergence_all_that_a_straight_trunk_bears_first_lies_in_the_front_plane() {
    let mut tree = row("5g");
    tree.0.tree.rule.divergence_deg = None;
    let plant = grown(&tree, 10);
    let laterals = (0..plant.nodes.len()).filter(|&i| plant.nodes.rank[i] == 1 && plant.nodes.birth[i] > 1);
    let of_trunk = |&i: &usize| plant.axes.order[plant.nodes.axis[i].index()] == 2;
    assert!(laterals.filter(of_trunk).all(|i| heading(&plant, i)[1] == 0.0));
}

/// How far a tip stands from the line of the trunk.
fn reach(tip: &Point) -> f64 {
    (tip[0] * tip[0] + tip[1] * tip[1]).sqrt()
}

/// Three shares of a tree's outline: the height of its widest point and the mean height of its branch tips over its
/// height, and the width of its top tenth over its width.
fn outline(name: &str) -> [f64; 3] {
    let tips = tips(&grown(&row(name), table_1(name).6 + 1));
    let top = tips.iter().map(|tip| tip[2]).fold(0.0, f64::max);
    let widest = tips.iter().copied().reduce(|a, b| if reach(&b) > reach(&a) { b } else { a }).expect("a branch");
    let mean = tips.iter().map(|tip| tip[2]).sum::<f64>() / tips.len() as f64;
    let crest = tips.iter().filter(|tip| tip[2] > 0.9 * top).map(reach).fold(0.0, f64::max);
    [widest[2] / top, mean / top, crest / reach(&widest)]
}

/// Table 1, "normal cone" to "reverse cone": from 7a to 7d the branches gather higher and the top becomes broader, from
/// a tip to three quarters of the whole width.
#[test]
fn the_outline_goes_from_the_normal_cone_of_7a_to_the_reverse_cone_of_7d() {
    let outlines = ["7a", "7b", "7c", "7d"].map(outline);
    let [a, .., d] = outlines;
    assert!(a[0] < 0.5 && d[0] > 0.5, "7a is widest at {}, 7d at {}", a[0], d[0]);
    assert!(a[2] < 0.15 && d[2] > 0.7, "the top of 7a is {} of its width, that of 7d {}", a[2], d[2]);
    assert!(outlines.windows(2).all(|pair| pair[0][1] < pair[1][1] && pair[0][2] < pair[1][2]), "{outlines:?}");
}

/// Table 1, "sharp cone" to "flat cone": from 6a to 6d the tree becomes wider for its height.
#[test]
fn the_cone_becomes_flatter_from_6a_to_6d() {
    let spread = |name| {
        let tips = tips(&grown(&row(name), 11));
        let far = tips.iter().map(reach).fold(0.0, f64::max);
        far / tips.iter().map(|tip| tip[2]).fold(0.0, f64::max)
    };
    let spreads: [f64; 4] = ["6a", "6b", "6c", "6d"].map(spread);
    assert!(spreads.windows(2).all(|pair| pair[0] < pair[1]), "{spreads:?}");
}

#[test]
fn every_row_keeps_the_contract_of_growth_models() {
    for row in &TABLE_1 {
        let tree = with_levels(parameters(row), 6);
        contract::check(&model(&tree), 8, 11);
    }
}
