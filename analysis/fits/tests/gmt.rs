//! Geometric trees from measured branches: trees by the printed equations are found again, and intervals of 95 % hold
//! the truth in 93 to 97 % of 4,000 trees that are drawn with scatter.
//!
//! The standard error of such a share is .0034. Absent: tables and species files (`branches`, and the program's tests).

#[path = "gmt/trees.rs"]
mod trees;

use phytomer_fits::draws::Draws;
use phytomer_fits::gmt::{Course, Fitted, TreeModel, Wish, fit};
use trees::{Tree, grown};

fn fitted(tree: &Tree) -> Fitted {
    fit(&grown(tree, &mut Draws::new(1, 1)), &Wish::default()).expect("a fit")
}

/// Angles within 1e-6 degrees, all else within 1e-9.
fn assert_found(name: &str, found: &Fitted, model: TreeModel, expected: &[(&str, f64)]) {
    assert_eq!(found.model, model, "{name}: {}", found.taken().law);
    for (key, truth) in expected {
        let value = found.value(key).unwrap_or_else(|| panic!("{name}: no {key} in {:?}", found.taken().estimates));
        let off = if key.ends_with("_deg") { 1e-6 } else { 1e-9 };
        assert!((value - truth).abs() < off, "{name}: {key} is {value:e}, {truth} was grown");
    }
}

const RATIOS: [(&str, f64); 3] = [("r1", 0.9), ("r2", 0.8), ("diameter_ratio", 0.7)];

fn with(own: &[(&'static str, f64)]) -> Vec<(&'static str, f64)> {
    own.iter().copied().chain(RATIOS).collect()
}

#[test]
fn binary_trees_are_found_again() {
    let plain = Tree::PLAIN;
    let turned = |delta| [("divergence_deg", 140.0), ("delta_deg", delta)];
    type Case = (&'static str, Tree, [(&'static str, f64); 2], f64);
    let cases: [Case; 8] = [
        ("11", plain.clone(), [("h1_deg", 0.0), ("h2_deg", -45.0)], 0.0),
        ("5e", Tree { angles: |_| [20.0, -50.0], ..plain.clone() }, [("h1_deg", 20.0), ("h2_deg", -50.0)], 0.0),
        (
            "the right one goes on",
            Tree { angles: |_| [50.0, -20.0], ..plain.clone() },
            [("h1_deg", 50.0), ("h2_deg", -20.0)],
            0.0,
        ),
        (
            "nearly alike",
            Tree { angles: |_| [27.0, -27.5], ..plain.clone() },
            [("h1_deg", 27.0), ("h2_deg", -27.5)],
            0.0,
        ),
        ("alike", Tree { angles: |_| [35.0, -35.0], ..plain.clone() }, [("h1_deg", 35.0), ("h2_deg", -35.0)], 0.0),
        (
            "δ",
            Tree { angles: |_| [20.0, -50.0], delta: 33.0, ..plain.clone() },
            [("h1_deg", 20.0), ("h2_deg", -50.0)],
            33.0,
        ),
        (
            "−δ",
            Tree { angles: |_| [35.0, -36.0], delta: -70.0, ..plain.clone() },
            [("h1_deg", 35.0), ("h2_deg", -36.0)],
            -70.0,
        ),
        (
            "it leans",
            Tree { angles: |_| [10.0, -60.0], first: [1.0, -2.0, 9.0], ..plain },
            [("h1_deg", 10.0), ("h2_deg", -60.0)],
            0.0,
        ),
    ];
    for (name, tree, angles, delta) in cases {
        let expected: Vec<_> = with(&angles).into_iter().chain(turned(delta)).collect();
        assert_found(name, &fitted(&tree), TreeModel::Gmt1, &expected);
    }
    for divergence in [0.0, -137.5, 180.0, 90.0] {
        let found = fitted(&Tree { angles: |_| [20.0, -50.0], divergence, ..Tree::PLAIN });
        assert_found("turns", &found, TreeModel::Gmt1, &with(&[("h1_deg", 20.0), ("h2_deg", -50.0)]));
        let off = found.value("divergence_deg").expect("a divergence") - divergence;
        assert!(off.abs() < 1e-6 || (off.abs() - 360.0).abs() < 1e-6, "{divergence}: off by {off}");
    }
}

#[test]
fn trees_whose_tips_are_moved_are_found_again() {
    let moved = |d: [f64; 3]| [("deviation_x", d[0]), ("deviation_y", d[1]), ("deviation_z", d[2])];
    for deviation in [[0.3, 0.3, -0.3], [0.0, 0.0, -0.6], [0.02, -0.01, 0.0]] {
        for angles in [|_| [0.0, -45.0], |_| [27.0, -37.0]] {
            let tree = Tree { angles, deviation, levels: 8, ..Tree::PLAIN };
            let [h1, h2] = angles(0.0);
            let mut expected = with(&[("h1_deg", h1), ("h2_deg", h2), ("divergence_deg", 140.0), ("delta_deg", 0.0)]);
            expected.extend(moved(deviation));
            assert_found(&format!("{deviation:?}"), &fitted(&tree), TreeModel::Gmt2, &expected);
        }
    }
    // Table 4, Fig. 12c.
    let ternary = Tree {
        angles: |_| [60.0, -60.0],
        ratios: [0.6, 0.6],
        centre: Some(0.9),
        deviation: [0.0, 0.0, -0.6],
        levels: 5,
        ..Tree::PLAIN
    };
    let mut expected = vec![("h1_deg", 60.0), ("h2_deg", -60.0), ("r0", 0.9), ("r1", 0.6), ("r2", 0.6)];
    expected.extend(moved([0.0, 0.0, -0.6]));
    assert_found("12c", &fitted(&ternary), TreeModel::Gmt3, &expected);
}

#[test]
fn ternary_trees_are_found_again() {
    for delta in [0.0, 20.0] {
        let tree = Tree {
            angles: |_| [50.0, -40.0],
            ratios: [0.7, 0.62],
            centre: Some(0.826),
            delta,
            levels: 5,
            ..Tree::PLAIN
        };
        let expected = [
            ("h1_deg", 50.0),
            ("h2_deg", -40.0),
            ("r0", 0.826),
            ("r1", 0.7),
            ("r2", 0.62),
            ("divergence_deg", 140.0),
            ("delta_deg", delta),
            ("diameter_ratio", 0.7),
        ];
        assert_found("ternary", &fitted(&tree), TreeModel::Gmt3, &expected);
    }
}

#[test]
fn angles_of_each_category_are_found_again() {
    let courses: [fn(f64) -> [f64; 2]; 5] = [
        |s| [0.0, -(90.0 - 70.0 * s)],
        |s| [0.0, -(90.0 - 70.0 * s * s)],
        |s| [0.0, -(20.0 + 70.0 * (1.0 - s) * (1.0 - s))],
        |s| [0.0, -(90.0 - 70.0 * (3.0 * s * s - 2.0 * s * s * s))],
        |s| [0.0, -(90.0 - 70.0 * (2.0 * s - 1.0) * (2.0 * s - 1.0))],
    ];
    for (category, angles) in (1..).zip(courses) {
        for deviation in [[0.0; 3], [0.1, 0.0, -0.1]] {
            let tree = Tree { angles, deviation, levels: 7, ..Tree::PLAIN };
            let found = fitted(&tree);
            let expected =
                with(&[("h1_max_deg", 0.0), ("h1_min_deg", 0.0), ("h2_max_deg", -90.0), ("h2_min_deg", -20.0)]);
            assert_found(&format!("category {category}"), &found, TreeModel::Gmt4, &expected);
            assert_eq!(found.course, Course::Category(category), "{}", found.taken().law);
            if deviation != [0.0; 3] {
                assert!((found.value("deviation_x").expect("a deviation") - 0.1).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn one_branching_is_a_tree() {
    let found = fitted(&Tree { levels: 1, angles: |_| [20.0, -50.0], ..Tree::PLAIN });
    assert_found("one", &found, TreeModel::Gmt1, &with(&[("h1_deg", 20.0), ("h2_deg", -50.0)]));
    let h1 = found.taken().estimate("h1_deg").expect("an angle");
    assert_eq!((h1.error, h1.low, found.value("divergence_deg")), (None, None, None));
    let none = fit(&grown(&Tree { levels: 0, ..Tree::PLAIN }, &mut Draws::new(1, 1)), &Wish::default());
    assert!(none.expect_err("no branching").to_string().starts_with("0 branchings, and at least 1"));
}

/// Trees a case: the standard error of a share of .95 is .0049, so that .93 and .97 are 4 of them away.
const TIMES: u64 = 2000;

/// The share of trees whose interval of each name holds the truth.
fn coverage(tree: &Tree, wish: &Wish, truths: &[(&str, f64)], times: u64) {
    let mut held = vec![0_u64; truths.len()];
    for time in 0..times {
        let found = fit(&grown(tree, &mut Draws::new(84, time)), wish).expect("a fit");
        for (held, (name, truth)) in held.iter_mut().zip(truths) {
            let own = found.taken().estimate(name).unwrap_or_else(|| panic!("no {name}"));
            let [low, high] = [own.low, own.high].map(|limit| limit.expect("a limit"));
            *held += u64::from(low <= *truth && *truth <= high);
        }
    }
    for (held, (name, _)) in held.into_iter().zip(truths) {
        let share = held as f64 / times as f64;
        println!("{name}: {share:.4} of {times}");
        assert!((0.93..=0.97).contains(&share), "{name}: {share}");
    }
}

/// Aucuba with the scatter of real branchings.
#[test]
fn intervals_of_constant_angles_hold_the_truth() {
    let tree = Tree {
        angles: |_| [20.0, -50.0],
        ratios: [0.786, 0.7],
        levels: 5,
        scatter: [4.0, 0.06, 10.0, 0.0],
        ..Tree::PLAIN
    };
    let truths = [
        ("h1_deg", 20.0),
        ("h2_deg", -50.0),
        ("r1", 0.786),
        ("r2", 0.7),
        ("divergence_deg", 140.0),
        ("delta_deg", 0.0),
    ];
    coverage(&tree, &Wish { model: Some(TreeModel::Gmt1), ..Wish::default() }, &truths, TIMES);
}

#[test]
fn intervals_of_angles_of_a_category_hold_the_truth() {
    let tree = Tree { angles: |s| [5.0, -(80.0 - 40.0 * s)], levels: 5, scatter: [3.0, 0.05, 8.0, 0.0], ..Tree::PLAIN };
    let truths = [("h2_max_deg", -80.0), ("h2_min_deg", -40.0), ("r1", 0.9), ("r2", 0.8), ("divergence_deg", 140.0)];
    let mut wish = Wish { model: Some(TreeModel::Gmt4), ..Wish::default() };
    wish.course = Some(Course::Category(1));
    coverage(&tree, &wish, &truths, TIMES);
}

#[test]
fn intervals_of_a_deviation_hold_the_truth() {
    let tree = Tree {
        angles: |_| [10.0, -50.0],
        levels: 5,
        deviation: [0.3, 0.2, -0.4],
        scatter: [2.0, 0.03, 5.0, 3.0],
        ..Tree::PLAIN
    };
    let truths = [
        ("h1_deg", 10.0),
        ("h2_deg", -50.0),
        ("r1", 0.9),
        ("r2", 0.8),
        ("deviation_x", 0.3),
        ("deviation_y", 0.2),
        ("deviation_z", -0.4),
    ];
    coverage(&tree, &Wish { model: Some(TreeModel::Gmt2), ..Wish::default() }, &truths, TIMES);
}
