//! The faults of GMT1's parameters, and the values that a file gives.
//!
//! Each fault is compared with its path and its text. Absent: trees (`tests`).

use super::tests::rule;
use super::{Descriptor, GeometricTree, Gmt1, MOST_LEVELS};
use crate::fault::Path;
use crate::law::Variate;
use serde_json::json;

fn sound() -> Descriptor {
    Descriptor {
        first_length_m: 1.0.into(),
        first_diameter_m: 0.1.into(),
        ..Descriptor::new(rule([20.0, -50.0], [0.9, 0.7], 140.0), 9)
    }
}

fn n(number: f64) -> Option<Variate> {
    Some(number.into())
}

fn gmt1(tree: Descriptor) -> Gmt1 {
    GeometricTree::from(tree).into()
}

/// A parameter as a file states it.
fn read<T: serde::de::DeserializeOwned>(stated: serde_json::Value) -> T {
    serde_json::from_value(stated).expect("it reads")
}

fn faults(change: fn(&mut Descriptor)) -> Vec<String> {
    let mut tree = sound();
    change(&mut tree);
    let tree = gmt1(tree);
    let path = Path::root().key("gmt1");
    let faults: Vec<String> = tree.check(&path).iter().map(ToString::to_string).collect();
    assert_eq!(tree.compile(10, &path).is_err(), !faults.is_empty(), "what is checked is what compiles");
    faults
}

#[test]
fn sound_parameters_have_no_fault() {
    assert!(faults(|_| ()).is_empty());
    assert!(faults(|tree| tree.levels = MOST_LEVELS.into()).is_empty());
    assert!(faults(|tree| (tree.rule.h1_deg, tree.levels) = (n(0.0), 0.into())).is_empty());
    assert!(faults(|tree| tree.levels = read(json!({ "value": 9, "source": "Table 1" }))).is_empty());
    assert!(
        faults(|tree| tree.rule.h1_deg = read(json!({ "normal": { "mean": 0, "sd": 5 }, "source": "a field book" })))
            .is_empty()
    );
    assert!(faults(|tree| tree.first_length_m = read(json!({ "empirical": [0.9, 1.1], "assumed": true }))).is_empty());
}

#[test]
fn each_fault_names_its_key_its_value_and_what_was_expected() {
    type Case = (fn(&mut Descriptor), &'static str);
    let cases: [Case; 16] = [
        (
            |tree| (tree.rule.h1_deg, tree.rule.h2_deg) = (n(0.0), n(-0.0)),
            "gmt1.h2_deg: h1_deg and h2_deg are both 0; expected h1²",
        ),
        (
            |tree| {
                (tree.rule.h1_deg, tree.rule.h2_deg) =
                    (read(json!({ "normal": { "mean": 0, "sd": 5 }, "min": 0 })), n(0.0))
            },
            "gmt1.h2_deg: h1_deg and h2_deg can both be 0; expected h1²",
        ),
        (
            |tree| (tree.rule.h1_deg, tree.rule.h2_deg) = (n(0.0), read(json!({ "empirical": [-40, 0, -50] }))),
            "gmt1.h2_deg: h1_deg and h2_deg can both be 0; expected h1²",
        ),
        (
            |tree| tree.rule.h1_deg = n(181.0),
            "gmt1.h1_deg: the value is 181; expected an angle in degrees in [-180, 180]",
        ),
        (
            |tree| tree.rule.h1_deg = read(json!({ "uniform": { "min": -181, "max": 0 } })),
            "gmt1.h1_deg.uniform.min: the value is -181; expected an angle in degrees in [-180, 180]",
        ),
        (
            |tree| tree.rule.h1_deg = read(json!({ "normal": { "mean": { "expression": "2 * age" }, "sd": 1 } })),
            "gmt1.h1_deg.normal.mean: the law depends on age, which does not apply here; expected a number, or a formula",
        ),
        (
            |tree| tree.rule.h1_deg = read(json!({ "value": { "expression": "order" } })),
            "gmt1.h1_deg.value: the law depends on order, which does not apply here; expected a number, or a formula",
        ),
        (
            |tree| tree.rule.h1_deg = read(json!({ "value": { "by_state": { "young": 3 } } })),
            "gmt1.h1_deg.value.by_state: the species has no states; expected a law without by_state",
        ),
        (
            |tree| tree.rule.divergence_deg = n(f64::NAN),
            "gmt1.divergence_deg: the value is NaN; expected an angle in degrees in [-360, 360]",
        ),
        (|tree| tree.rule.r1 = n(0.0), "gmt1.r1: the value is 0; expected a ratio above 0 and at most 1"),
        (|tree| tree.rule.r2 = n(1.5), "gmt1.r2: the value is 1.5; expected a ratio above 0 and at most 1"),
        (
            |tree| tree.first_length_m = (-1.0).into(),
            "gmt1.first_length_m: the value is -1; expected metres above 0 and at most 1000",
        ),
        (|tree| tree.levels = 30.into(), "gmt1.levels: levels is 30: a tree of 2^31 branches; expected at most 28"),
        (
            |tree| tree.levels = read(json!({ "value": 30 })),
            "gmt1.levels.value: levels is 30: a tree of 2^31 branches; expected at most 28",
        ),
        (
            |tree| tree.rule.r2 = n(1e-3),
            "gmt1.r2: after 9 levels a branch is 1.0e-27 m long; expected branches of at least",
        ),
        (
            |tree| tree.rule.diameter_ratio = read(json!({ "uniform": { "min": 0.01, "max": 0.9 } })),
            "gmt1.diameter_ratio: after 9 levels a branch can be 1.0e-19 m thick",
        ),
    ];
    for (change, expected) in cases {
        let found = faults(change);
        assert!(found.len() == 1 && found[0].starts_with(expected), "{found:?} is not `{expected}`");
    }
}

#[test]
fn all_faults_are_told_at_once() {
    let found = faults(|tree| {
        (tree.rule.h1_deg, tree.rule.h2_deg, tree.rule.r1, tree.rule.r2) = (n(0.0), n(0.0), n(-1.0), n(f64::INFINITY));
        (tree.rule.diameter_ratio, tree.levels) = (n(2.0), u32::MAX.into());
    });
    assert_eq!(found.len(), 5, "{found:?}");
}

#[test]
fn an_age_past_the_last_tick_does_not_compile() {
    assert!(gmt1(sound()).compile(65_536, &Path::root()).is_err());
}

#[test]
fn components_are_branches_and_apical_buds() {
    let model = gmt1(sound()).compile(60_000, &Path::root()).expect("it is sound");
    assert_eq!([0, 1, 2, 3, 10, 60_000].map(|age| model.components_at(age)), [1, 2, 5, 11, 1535, 1535]);
}

#[test]
fn the_schema_has_the_bounds_of_the_check() {
    let schema = schemars::schema_for!(Gmt1);
    let bound = |key: &str, keyword: &str| schema.pointer(&format!("/properties/{key}/{keyword}")).cloned();
    assert_eq!(bound("levels", "maximum"), Some(MOST_LEVELS.into()));
    assert_eq!(bound("r1", "exclusiveMinimum"), Some(0.into()));
    assert_eq!(bound("h1_deg", "minimum"), Some((-180).into()));
    assert_eq!(bound("first_length_m", "default"), Some(json!({ "value": 1.0, "assumed": true })));
    assert_eq!(schema.get("additionalProperties"), Some(&false.into()));
}
