//! Parameters that are refused, each at its key; keys that are read and written again.
//!
//! Absent: the reports of files (`config/tests/bad`).

use super::params::{Growing, LeafSeason, Tree};
use super::specimens::{aspen, bare, level, oak, tupelo, willow, with};
use super::tests::compiled;
use crate::fault::Path;
use crate::law::{Law, LawForm};
use phytomer_sim::clock::Tick;
use phytomer_sim::expectation::Certainty;
use phytomer_sim::model::Grow as _;

fn told(tree: &Tree, until: Tick) -> Vec<String> {
    let faults = tree.compile(until, &Path::root()).err().unwrap_or_default();
    faults.iter().map(|fault| fault.path.to_string()).collect()
}

#[test]
fn every_number_out_of_its_range_is_told() {
    for tree in [aspen(), tupelo(), willow(), oak(), bare()] {
        assert_eq!(told(&tree, 65_535), [""; 0]);
    }
    let mut wrong = with(level(2001.0), bare());
    let whole = &mut wrong.whole;
    (whole.scale_v, whole.ratio, whole.shape, whole.levels) = (11.0.into(), f64::NAN.into(), 9.into(), 9.into());
    (whole.lobe_depth, whole.prune_width_peak, whole.leaf_bend) = (1.0.into(), 1.0.into(), 1.1.into());
    (whole.z_scale, whole.z_scale_v, whole.quality) = (2.0.into(), 0.5.into(), 0.0.into());
    (wrong.trunk.curve_res, wrong.trunk.base_splits, wrong.trunk.taper) = (0.into(), 21.into(), 3.1.into());
    (wrong.trunk.scale_v, wrong.trunk.length) = (1.0.into(), 0.0.into());
    (wrong.branches[0].length, wrong.branches[0].down_angle_v) = (0.0.into(), (-181.0).into());
    (wrong.branches[1].curve_v, wrong.branches[1].curve_res) = ((-90.0).into(), 101.into());
    let expected = [
        "",
        "ZScale",
        "ZScaleV",
        "LobeDepth",
        "Shape",
        "ScaleV",
        "Levels",
        "Ratio",
        "LeafBend",
        "quality",
        "PruneWidthPeak",
        "0ScaleV",
        "0BaseSplits",
        "0Length",
        "0Taper",
        "0CurveRes",
        "1Branches",
        "1Length",
        "1DownAngleV",
        "2CurveRes",
        "2CurveV",
    ];
    assert_eq!(told(&wrong, 70_000), expected);
}

#[test]
fn single_faults_are_told_at_their_keys() {
    let with_bad = |change: &dyn Fn(&mut Tree)| {
        let mut tree = with(level(3.0), bare());
        change(&mut tree);
        told(&tree, 5)
    };
    let low = |tree: &mut Tree| {
        tree.whole.base_size = 0.5.into();
        (tree.trunk.length, tree.trunk.length_v) = (0.7.into(), 0.2.into());
    };
    assert_eq!(with_bad(&low), ["BaseSize"]);
    assert_eq!(with_bad(&|tree| tree.whole.levels = 0.into()), ["Levels"]);
    assert_eq!(with_bad(&|tree| tree.whole.prune_width_peak = 0.0.into()), ["PruneWidthPeak"]);
    assert_eq!(with_bad(&|tree| tree.branches[0].curve_v = (-89.9).into()), [""; 0]);
    assert_eq!(with_bad(&|tree| tree.branches[0].curve_v = (-900.0).into()), ["1CurveV"]);
    assert_eq!(with_bad(&|tree| tree.branches[0].curve_v = 3601.0.into()), ["1CurveV"]);
    assert_eq!(with_bad(&|tree| tree.whole.leaf_shape = super::LeafShape::Number(6.into())), ["LeafShape"]);
    let bad = |text: &str| Some(serde_json::from_value(serde_json::json!(text)).expect("a colour as it is typed"));
    assert_eq!(with_bad(&|tree| tree.whole.leaf_colour = bad("#12345")), ["leaf_colour"]);
    let leafy = |tree: &mut Tree| {
        tree.whole.leaves = 10_000.0.into();
        tree.whole.quality = 10.0.into();
    };
    assert_eq!(with_bad(&leafy), ["Leaves"]);
}

#[test]
fn laws_of_growth_and_seasons_are_checked() {
    let growing = |scale: &str, levels: &str| {
        let law = |text: &str| Law::from(LawForm { expression: Some(text.to_owned()), ..LawForm::default() });
        let mut tree = with(level(3.0), bare());
        tree.whole.growth = Some(Growing { scale: law(scale), levels: Some(law(levels)) });
        told(&tree, 20)
    };
    assert_eq!(growing("min(1, 0.1 * age)", "1 + age / 5"), [""; 0]);
    assert_eq!(growing("0.1 * age", "1"), ["growth.scale"]);
    assert_eq!(growing("1", "3 - min(2, 0.1 * age)"), ["growth.levels"]);
    assert_eq!(growing("1", "0.5 * age"), ["growth.levels"]);
    let season = |year: u32, out: u32, fall: u32| {
        let mut tree = with(level(3.0), bare());
        let season = LeafSeason { ticks_per_year: year.into(), leaf_out: out.into(), leaf_fall: fall.into() };
        tree.whole.season = Some(season);
        told(&tree, 20)
    };
    assert_eq!(season(4, 0, 3), [""; 0]);
    assert_eq!(season(4, 1, 4), [""; 0]);
    assert_eq!(season(1, 0, 1), ["season.ticks_per_year"]);
    assert_eq!(season(4, 3, 3), ["season.leaf_fall"]);
    assert_eq!(season(4, 0, 5), ["season.leaf_fall"]);
}

/// 6¹⁵ stems of the trunk alone: told before the first of them grows.
#[test]
fn an_explosion_of_clones_is_foretold() {
    let mut tree = bare();
    (tree.trunk.seg_splits, tree.trunk.curve_res) = (5.0.into(), 16.into());
    let foretold = compiled(&tree).expectation(1).expect("a forecast");
    assert_eq!(foretold.certainty(), Certainty::Exact);
    assert!(foretold.least_components(1) > 5e11);
    (tree.trunk.seg_splits, tree.trunk.curve_res) = (20.0.into(), 100.into());
    tree.whole.levels = 8.into();
    *tree.branches = [(); 3].map(|()| level(2000.0));
    let most = compiled(&tree).expectation(1).expect("a forecast").components(1);
    assert!(most.is_finite() && most >= 1e30, "{most}");
}

/// Every key comes back as it was, and a key of no level or of another is refused.
#[test]
fn keys_are_read_and_written_by_their_names() {
    for tree in [aspen(), tupelo(), willow(), oak(), bare()] {
        let text = serde_json::to_string(&tree).expect("keys");
        assert!(text.contains("\"0CurveRes\":") && text.contains("\"3DownAngle\":") && text.contains("\"Shape\":"));
        let back: Tree = serde_json::from_str(&text).expect("the same keys");
        assert_eq!(back, tree);
    }
    let refused = |key: &str| {
        let mut keys = serde_json::to_value(bare()).expect("keys");
        keys[key] = 1.into();
        serde_json::from_value::<Tree>(keys).expect_err("no such key").to_string()
    };
    for key in ["4Length", "1BaseSplits", "0DownAngle", "1Scale", "shape", "Leaf"] {
        let error = refused(key);
        assert!(error.contains("unknown field"), "{key}: {error}");
    }
    assert!(refused("1BaseSplits").starts_with("among the keys of level 1: "));
    let twice = serde_json::from_str::<Tree>(r#"{"Shape": 1, "Shape": 2}"#).expect_err("a key twice");
    assert!(twice.to_string().contains("given twice"));
}

/// The schema lists the keys of all levels and those that must be there.
#[test]
fn the_schema_has_the_keys_of_all_levels() {
    let schema = serde_json::to_value(schemars::schema_for!(Tree)).expect("a schema");
    let keys = schema["properties"].as_object().expect("keys");
    let all = serde_json::to_value(aspen()).expect("keys");
    for key in all.as_object().expect("keys").keys() {
        assert!(keys.contains_key(key), "{key}");
    }
    let required: Vec<&str> =
        schema["required"].as_array().expect("keys").iter().filter_map(|key| key.as_str()).collect();
    assert_eq!(required, ["Shape", "Scale", "Levels", "Ratio", "0CurveRes"]);
    assert!(!keys.contains_key("0DownAngle") && !keys.contains_key("1BaseSplits") && !keys.contains_key("4Length"));
}
