//! Measures of form on grown plants: axiality and cone of the rows of Table 1 (Aono & Kunii 1984), and the effective
//! leaf area of Aucuba by its angles and of coffee trees.
//!
//! Absent: the union of discs against closed forms (`analysis/measures/src/cover/tests.rs`), and that of grown leaves
//! against another program (`external_readers`).

mod program;

use phytomer::models::geometric::child;
use phytomer_measures::cover::{Direction, Disc, area};
use program::run;
use serde_json::Value;
use std::path::Path;
use tempfile::tempdir;

/// A number of the first row of a measure, by the name of its column.
fn number(folder: &Path, words: &[&str], column: &str) -> f64 {
    let told = run(folder, &[&["measure"], words, &["--json"]].concat()).ending(0).json();
    let table = told["tables"].as_object().and_then(|tables| tables.values().next()).expect("a table");
    table["rows"][0][column].as_f64().unwrap_or_else(|| panic!("{column} in {told}"))
}

/// Figs. 5a, 5c, 5d and 5g have axialities of 0, 3/7, 5/7 and 1 as grown, in the order of Table 1. From 6a to 6d and
/// from 7a to 7d the cone becomes wider, and of all only the reverse cone of 7d is widest above its middle among 7a to
/// 7d.
#[test]
fn axiality_and_cone_of_table_1() {
    let home = tempdir().expect("a temporary folder");
    let folder = home.path();
    let grown = |row: &str| {
        run(folder, &["grow", &format!("gmt1/{row}"), "--out", row, "--quiet"]).ending(0);
        row.to_owned()
    };
    for (row, expected) in [("5a", 0.0), ("5c", 3.0 / 7.0), ("5d", 5.0 / 7.0), ("5g", 1.0)] {
        let found = number(folder, &[&grown(row), "axiality"], "mean");
        assert!((found - expected).abs() < 1e-5, "{row}: {found}, expected {expected}");
    }
    let cones = |rows: [&str; 4]| rows.map(|row| number(folder, &[&grown(row), "crown-cone"], "mean"));
    for cones in [cones(["6a", "6b", "6c", "6d"]), cones(["7a", "7b", "7c", "7d"])] {
        assert!(cones.is_sorted() && cones[3] > cones[0] + 10.0, "{cones:?}");
    }
    // A trunk of .9^k: 6.861894 high; the widest place of 6a is 2.31 from it.
    let cone = number(folder, &["6a", "crown-cone"], "mean");
    assert!((cone - 18.6).abs() < 0.1, "{cone}");
    let widest = ["7a", "7b", "7c", "7d"].map(|row| number(folder, &[row, "widest-place"], "mean"));
    assert!(widest[..3].iter().all(|share| *share < 0.5) && widest[3] > 0.5, "{widest:?}");
}

/// Discs at the tips of GMT1 without a divergence, ratio .786, level 6, first branch 1.
fn aucuba(h1: f64, h2: f64, radius: f64) -> f64 {
    let mut branches = vec![([0.0, 0.0, 1.0], [0.0, 0.0, 1.0])];
    for _ in 0..6 {
        let children = |(tip, mother): ([f64; 3], [f64; 3])| {
            [h1, h2].map(|angle| {
                let own = child(mother, 0.786, angle.to_radians(), 0.0);
                ([0, 1, 2].map(|i| tip[i] + own[i]), own)
            })
        };
        branches = branches.into_iter().flat_map(children).collect();
    }
    let discs: Vec<Disc> = branches.into_iter().map(|(tip, _)| Direction::ABOVE.disc(tip, radius)).collect();
    area(&discs)
}

/// The share of the greatest area by |h2| that (27°, −37°) has: the paper's claim holds where leaves hardly overlap.
#[test]
fn the_measured_angles_are_near_the_greatest_area_for_small_discs_alone() {
    assert!((aucuba(27.0, -37.0, 0.2) - 5.322_764).abs() < 5e-7);
    let share = |radius: f64| {
        let greatest = (0..=90).map(|h2| aucuba(27.0, -f64::from(h2), radius)).fold(0.0, f64::max);
        aucuba(27.0, -37.0, radius) / greatest
    };
    for (radius, expected) in [(0.1, 0.92), (0.2, 0.70), (0.4, 0.66)] {
        let share = share(radius);
        assert!((share - expected).abs() < 0.01, "radius {radius}: {share}");
    }
}

/// `describe` tells the mean that `measure` has; the sun shines under leaves at an altitude of 90° as from above, and
/// from its side leaves hide one another in other places.
#[test]
fn describe_tells_the_effective_leaf_area() {
    let home = tempdir().expect("a temporary folder");
    let folder = home.path();
    run(folder, &["grow", "coffee", "--plants", "3", "--out", "trees", "--quiet"]).ending(0);
    let described = run(folder, &["describe", "trees", "--json"]).ending(0).json();
    let ages = described["population"].as_array().expect("ages");
    let grown = ages.iter().find(|of| of["age"] == 48).expect("the age 48").clone();
    let told = grown["effective_leaf_area_m2"].as_f64().expect("an area");
    let measured = |words: &[&str], column| {
        number(folder, &[&["trees", "effective-leaf-area", "--age", "48"], words].concat(), column)
    };
    let (mean, whole) = (measured(&[], "mean"), measured(&[], "leaf_area"));
    assert!((told - mean).abs() < 1e-9 * mean, "{told} {mean}");
    let of_summary = grown["leaf_area_m2"]["mean"].as_f64().expect("an area");
    assert!((whole - of_summary).abs() < 1e-5 * whole && mean < whole, "{mean} of {whole}, {of_summary}");
    // The dead of the last age have no area; their leaves are gone.
    assert_eq!(ages.last().expect("an age")["effective_leaf_area_m2"], Value::Null);
    assert!((measured(&["--sun", "90,0"], "mean") - mean).abs() < 1e-6 * mean);
    let side = measured(&["--sun", "20,135"], "mean");
    assert!(side < whole && (side - mean).abs() > 1e-3 * mean, "{side} {mean}");
    let text = run(folder, &["describe", "trees"]).ending(0).stdout;
    assert!(text.contains("effective, m2") && text.contains(&format!("{mean:.2}")), "{text}");
    let quick = run(folder, &["describe", "trees", "--quick", "--json"]).ending(0).json();
    assert_eq!(quick["population"][0]["effective_leaf_area_m2"], Value::Null);
    for sun in ["91,0", "-1,0", "30,400", "nan,0", "30"] {
        let told = run(folder, &["measure", "trees", "effective-leaf-area", "--sun", sun]).ending(2);
        assert!(told.stderr.contains("such as 30,180"), "{sun}: {}", told.stderr);
    }
}
