//! GMT4 of Aono & Kunii (1984): the angles of grown trees by category, and how they scatter.
//!
//! Seeds are fixed; bounds are 4 standard errors of the stated distribution. Absent: the functions of the categories
//! by themselves (`course`).

use super::tests::{heading, rule};
use super::tests_deviated::{bits, model};
use super::{Curve, Descriptor, GeometricTree, Rule, TreeType};
use crate::contract;
use crate::fault::Path;
use phytomer_sim::math;
use phytomer_sim::plant::Plant;
use serde_json::json;

/// The rows of Table 4 for GMT4: h1 = 0, h2 from −90 to −20, R1 = 0.9, R2 = 0.7.
fn row_13(category: u32) -> Rule {
    let n = |number: f64| Some(number.into());
    Rule {
        h1_deg: None,
        h2_deg: None,
        category: Some(category.into()),
        h1_max_deg: n(0.0),
        h1_min_deg: n(0.0),
        h2_max_deg: n(-90.0),
        h2_min_deg: n(-20.0),
        ..rule([0.0, 0.0], [0.9, 0.7], 140.0)
    }
}

fn tree(rule: Rule, levels: u32) -> GeometricTree {
    Descriptor::new(rule, levels).into()
}

fn grown(rule: Rule, levels: u32) -> Plant {
    contract::grown(&model(TreeType::Gmt4, &tree(rule, levels)), levels + 1, &contract::seed_of(1, 0))
}

/// The angle between a node and its parent, degrees.
fn angle_deg(plant: &Plant, node: usize) -> f64 {
    let below = plant.nodes.parent[node].index();
    let [a, b] = [heading(plant, below), heading(plant, node)].map(|v| v.map(f64::from));
    let dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    math::acos(dot.clamp(-1.0, 1.0)).to_degrees()
}

/// The lateral branches of each growth level, the first of the trunk.
fn laterals(plant: &Plant) -> Vec<Vec<usize>> {
    let last = plant.nodes.birth.iter().max().copied().expect("a branch");
    let is_first = |&i: &usize| plant.nodes.rank[i] == 1 && plant.nodes.birth[i] > 1;
    let of = |birth: u32| (0..plant.nodes.len()).filter(is_first).filter(|&i| plant.nodes.birth[i] == birth).collect();
    (2..=last).map(of).collect()
}

#[test]
fn the_fifth_level_of_figure_13_has_the_angle_of_its_category() {
    let expected = [58.889, 76.173, 41.605, 60.809, 89.136];
    for (category, expected) in (1..).zip(expected) {
        let plant = grown(row_13(category), 10);
        let levels = laterals(&plant);
        assert!(levels[4].len() > 10);
        for &node in &levels[4] {
            let found = angle_deg(&plant, node);
            assert!((found - expected).abs() < 2e-3, "category {category}: {found} is not {expected}");
        }
    }
}

/// Table 4: |h′| at one end and |h″| at the other, whatever the category but the fifth, which has |h″| at both.
#[test]
fn the_first_and_the_last_branching_have_the_ends_of_the_range() {
    for category in 1..=5 {
        let plant = grown(row_13(category), 10);
        let levels = laterals(&plant);
        let [first, last] = [levels[0][0], levels[9][0]].map(|node| angle_deg(&plant, node));
        let expected = if category == 5 { [20.0, 20.0] } else { [90.0, 20.0] };
        assert!((first - expected[0]).abs() < 1e-2 && (last - expected[1]).abs() < 1e-2, "{category}: {first}, {last}");
    }
}

#[test]
fn exponential_curves_lead_between_the_same_ends() {
    let late = Rule { curve: Some(Curve::Exponential), phi_deg: Some(95.0.into()), ..row_13(2) };
    let early = Rule { curve: Some(Curve::Exponential), ..row_13(3) };
    for rule in [late, early] {
        let plant = grown(rule, 6);
        let levels = laterals(&plant);
        let [first, last] = [levels[0][0], levels[5][0]].map(|node| angle_deg(&plant, node));
        assert!((first - 90.0).abs() < 1e-2 && (last - 20.0).abs() < 1e-2, "{first}, {last}");
    }
}

#[test]
fn a_range_of_one_angle_is_gmt1_to_the_bit() {
    let same = Rule { h2_max_deg: Some((-45.0).into()), h2_min_deg: Some((-45.0).into()), ..row_13(1) };
    let gmt1 = model(TreeType::Gmt1, &tree(rule([0.0, -45.0], [0.9, 0.7], 140.0), 7));
    let gmt1 = contract::grown(&gmt1, 8, &contract::seed_of(1, 0));
    assert_eq!(bits(&grown(same, 7)), bits(&gmt1));
}

/// A law of h2 is drawn anew at each branching, and added to the angle of the category.
#[test]
fn the_scatter_has_the_mean_and_the_variance_that_are_stated() {
    let law = |value| serde_json::from_value(value).expect("it reads");
    let with_category = Rule { h2_deg: Some(law(json!({ "normal": { "mean": 0, "sd": 3 } }))), ..row_13(1) };
    let alone = Rule {
        h1_deg: Some(0.0.into()),
        h2_deg: Some(law(json!({ "normal": { "mean": -50, "sd": 3 } }))),
        ..rule([0.0, 0.0], [0.9, 0.7], 140.0)
    };
    for (rule, mean_at) in [(with_category, [90.0, 20.0]), (alone, [50.0, 50.0])] {
        let plant = grown(rule, 13);
        let (mut n, mut sum, mut squares) = (0.0, 0.0, 0.0);
        for (level, nodes) in laterals(&plant).iter().enumerate() {
            let expected = mean_at[0] + (mean_at[1] - mean_at[0]) * level as f64 / 12.0;
            for &node in nodes {
                let off = angle_deg(&plant, node) - expected;
                (n, sum, squares) = (n + 1.0, sum + off, squares + off * off);
            }
        }
        assert!(n > 8000.0, "{n} laterals");
        assert!((sum / n).abs() < 4.0 * 3.0 / f64::sqrt(n), "the mean is off by {}", sum / n);
        // Var (x − μ)² = 2 σ⁴ of a normal law.
        assert!((squares / n - 9.0).abs() < 4.0 * 9.0 * f64::sqrt(2.0 / n), "the variance is {}", squares / n);
    }
}

#[test]
fn two_branchings_draw_apart_and_a_younger_tree_has_the_same_draws() {
    let law = serde_json::from_value(json!({ "uniform": { "min": -60, "max": -30 } })).expect("it reads");
    let rule = Rule { h2_deg: Some(law), ..rule([0.0, 0.0], [0.9, 0.7], 140.0) };
    let model = model(TreeType::Gmt4, &tree(rule, 8));
    let old = contract::grown(&model, 9, &contract::seed_of(4, 2));
    let young = contract::grown(&model, 6, &contract::seed_of(4, 2));
    assert_eq!(bits(&young)[..8 * young.nodes.len()], bits(&old)[..8 * young.nodes.len()]);
    let all: Vec<f64> = laterals(&old).concat().iter().map(|&node| angle_deg(&old, node)).collect();
    let mut sorted = all.clone();
    sorted.sort_by(f64::total_cmp);
    assert!(sorted.windows(2).filter(|pair| pair[1] - pair[0] < 1e-6).count() < 5, "draws of branchings differ");
    contract::check(&model, 9, 5);
}

#[test]
fn faults_of_the_angles_of_a_category_are_told() {
    type Case = (fn(&mut Rule), &'static str);
    let cases: [Case; 12] = [
        (
            |rule| rule.h2_min_deg = Some((-95.0).into()),
            "h2_min_deg: h2_min_deg is -95, and h2_max_deg is -90; expected |h2_min_deg| ≤",
        ),
        (|rule| rule.h2_min_deg = Some(20.0.into()), "h2_min_deg: h2_min_deg is 20, and h2_max_deg is -90; expected"),
        (|rule| rule.h2_min_deg = None, "h2_max_deg: h2_max_deg is given without h2_min_deg"),
        (|rule| rule.category = Some(6.into()), "category: the category is 6; expected a category from 1 to 5"),
        (|rule| rule.category = None, "category: no category is given"),
        (
            |rule| rule.h2_min_deg = Some(0.0.into()),
            "h2_min_deg: the angles of growth level 6 are both 0; expected h1²",
        ),
        (|rule| rule.curve = Some(Curve::Exponential), "curve: the curve is exponential; expected a polynomial"),
        (|rule| rule.peak = Some(0.5.into()), "peak: peak has no use here"),
        (
            |rule| {
                (rule.category, rule.curve, rule.phi_deg) =
                    (Some(2.into()), Some(Curve::Exponential), Some(80.0.into()));
            },
            "phi_deg: phi_deg is 80: the angles cross it; expected an angle above 90",
        ),
        (
            |rule| (rule.category, rule.curve) = (Some(2.into()), Some(Curve::Exponential)),
            "phi_deg: the exponential curve",
        ),
        (|rule| (rule.category, rule.peak) = (Some(5.into()), Some(1.0.into())), "peak: the value is 1; expected"),
        (|rule| rule.h2_deg = Some((-120.0).into()), "h2_deg: with the angle of the category it can be above 180"),
    ];
    for (change, expected) in cases {
        let mut rule = row_13(1);
        change(&mut rule);
        let faults: Vec<String> =
            tree(rule, 6).check(TreeType::Gmt4, &Path::root()).iter().map(ToString::to_string).collect();
        assert!(faults.len() == 1 && faults[0].starts_with(expected), "{faults:?} is not `{expected}`");
    }
}
