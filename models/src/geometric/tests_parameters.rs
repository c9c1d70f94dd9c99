//! What GMT1 refuses, and what a file gives it.

use super::{Gmt1, MOST_LEVELS};
use crate::fault::Path;

fn sound() -> Gmt1 {
    Gmt1 {
        h1_deg: 20.0,
        h2_deg: -50.0,
        r1: 0.9,
        r2: 0.7,
        diameter_ratio: 0.7,
        divergence_deg: 140.0,
        levels: 9,
        first_length_m: 1.0,
        first_diameter_m: 0.1,
    }
}

fn faults(change: fn(&mut Gmt1)) -> Vec<String> {
    let mut tree = sound();
    change(&mut tree);
    let path = Path::root().key("gmt1");
    let faults: Vec<String> = tree.check(&path).iter().map(ToString::to_string).collect();
    assert_eq!(tree.compile(10, &path).is_err(), !faults.is_empty(), "what is checked is what compiles");
    faults
}

#[test]
fn sound_parameters_have_no_fault() {
    assert!(faults(|_| ()).is_empty());
    assert!(faults(|tree| tree.levels = MOST_LEVELS).is_empty());
    assert!(faults(|tree| (tree.h1_deg, tree.levels) = (0.0, 0)).is_empty());
}

#[test]
fn each_fault_names_its_key_its_value_and_what_was_expected() {
    type Case = (fn(&mut Gmt1), &'static str);
    let cases: [Case; 9] = [
        (|tree| (tree.h1_deg, tree.h2_deg) = (0.0, -0.0), "gmt1.h2_deg: h1_deg and h2_deg are both 0; expected h1²"),
        (|tree| tree.h1_deg = 181.0, "gmt1.h1_deg: h1_deg is 181; expected an angle in [-180, 180] degrees"),
        (|tree| tree.divergence_deg = f64::NAN, "gmt1.divergence_deg: divergence_deg is NaN; expected an angle in"),
        (|tree| tree.r1 = 0.0, "gmt1.r1: r1 is 0; expected a ratio above 0, at most 1"),
        (|tree| tree.r2 = 1.5, "gmt1.r2: r2 is 1.5; expected a ratio above 0, at most 1"),
        (|tree| tree.first_length_m = -1.0, "gmt1.first_length_m: first_length_m is -1; expected metres above 0"),
        (|tree| tree.levels = 30, "gmt1.levels: levels is 30: a tree of 2^31 branches; expected at most 28"),
        (|tree| tree.r2 = 1e-3, "gmt1.r2: after 9 levels a branch is 1.0e-27 m long; expected branches of at least"),
        (|tree| tree.diameter_ratio = 0.01, "gmt1.diameter_ratio: after 9 levels a branch is 1.0e-19 m thick"),
    ];
    for (change, expected) in cases {
        let found = faults(change);
        assert!(found.len() == 1 && found[0].starts_with(expected), "{found:?} is not `{expected}`");
    }
}

#[test]
fn all_faults_are_told_at_once() {
    let found = faults(|tree| {
        (tree.h1_deg, tree.h2_deg, tree.r1, tree.r2) = (0.0, 0.0, -1.0, f64::INFINITY);
        (tree.diameter_ratio, tree.levels) = (2.0, u32::MAX);
    });
    assert_eq!(found.len(), 5, "{found:?}");
}

#[test]
fn an_age_past_the_last_tick_does_not_compile() {
    assert!(sound().compile(65_536, &Path::root()).is_err());
}

#[test]
fn components_are_branches_and_apical_buds() {
    let tree = sound();
    assert_eq!([0, 1, 2, 3, 10, 60_000].map(|age| tree.components_at(age)), [1, 2, 5, 11, 1535, 1535]);
}

#[test]
fn the_schema_has_the_bounds_of_the_check() {
    let schema = schemars::schema_for!(Gmt1);
    let bound = |key: &str, keyword: &str| schema.pointer(&format!("/properties/{key}/{keyword}")).cloned();
    assert_eq!(bound("levels", "maximum"), Some(MOST_LEVELS.into()));
    assert_eq!(bound("r1", "exclusiveMinimum"), Some(0.0.into()));
    assert_eq!(bound("first_length_m", "default"), Some(1.0.into()));
    assert_eq!(schema.get("additionalProperties"), Some(&false.into()));
}
