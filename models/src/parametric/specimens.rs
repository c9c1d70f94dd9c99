//! Trees for tests: the four of the appendix of Weber & Penn 1995, and some of few parameters.
//!
//! Absent: anything that is not a test.

use super::Tree;
use super::params::Branches;

fn tree(keys: &str) -> Tree {
    serde_json::from_str(keys).unwrap_or_else(|error| panic!("{error}"))
}

/// The Quaking Aspen: all numbers that are not 0.
pub(super) fn aspen() -> Tree {
    tree(
        r#"{
        "Shape": 7, "BaseSize": 0.4, "Scale": 13, "ScaleV": 3, "Levels": 3, "Ratio": 0.015, "RatioPower": 1.2,
        "Lobes": 5, "LobeDepth": 0.07, "Flare": 0.6, "Leaves": 25, "LeafShape": 0, "LeafScale": 0.17,
        "LeafScaleX": 1, "AttractionUp": 0.5, "PruneWidth": 0.5, "PruneWidthPeak": 0.5, "PrunePowerLow": 0.5,
        "PrunePowerHigh": 0.5,
        "0Scale": 1, "0Length": 1, "0Taper": 1, "0CurveRes": 3, "0CurveV": 20,
        "1DownAngle": 60, "1DownAngleV": -50, "1Rotate": 140, "1Branches": 50, "1Length": 0.3, "1Taper": 1,
        "1CurveRes": 5, "1Curve": -40, "1CurveV": 50,
        "2DownAngle": 45, "2DownAngleV": 10, "2Rotate": 140, "2Branches": 30, "2Length": 0.6, "2Taper": 1,
        "2CurveRes": 3, "2Curve": -40, "2CurveV": 75,
        "3DownAngle": 45, "3DownAngleV": 10, "3Rotate": 77, "3Branches": 10, "3Taper": 1, "3CurveRes": 1
    }"#,
    )
}

/// The Black Tupelo: all numbers that are not 0.
pub(super) fn tupelo() -> Tree {
    tree(
        r#"{
        "Shape": 4, "BaseSize": 0.2, "Scale": 23, "ScaleV": 5, "Levels": 4, "Ratio": 0.015, "RatioPower": 1.3,
        "Lobes": 3, "LobeDepth": 0.1, "Flare": 1, "Leaves": 6, "LeafShape": 0, "LeafScale": 0.3, "LeafScaleX": 0.5,
        "AttractionUp": 0.5, "PruneWidth": 0.5, "PruneWidthPeak": 0.5, "PrunePowerLow": 0.5, "PrunePowerHigh": 0.5,
        "0Scale": 1, "0Length": 1, "0Taper": 1.1, "0CurveRes": 10, "0CurveV": 40,
        "1DownAngle": 60, "1DownAngleV": -40, "1Rotate": 140, "1Branches": 50, "1Length": 0.3, "1LengthV": 0.05,
        "1Taper": 1, "1CurveRes": 10, "1CurveV": 90,
        "2DownAngle": 30, "2DownAngleV": 10, "2Rotate": 140, "2Branches": 25, "2Length": 0.6, "2LengthV": 0.1,
        "2Taper": 1, "2CurveRes": 10, "2Curve": -10, "2CurveV": 150,
        "3DownAngle": 45, "3DownAngleV": 10, "3Rotate": 140, "3Branches": 12, "3Length": 0.4, "3Taper": 1,
        "3CurveRes": 1
    }"#,
    )
}

/// The Weeping Willow: all numbers that are not 0.
pub(super) fn willow() -> Tree {
    tree(
        r#"{
        "Shape": 3, "BaseSize": 0.05, "Scale": 15, "ScaleV": 5, "Levels": 4, "Ratio": 0.03, "RatioPower": 2,
        "Lobes": 9, "LobeDepth": 0.03, "Flare": 0.75, "Leaves": 15, "LeafShape": 0, "LeafScale": 0.12,
        "LeafScaleX": 0.2, "AttractionUp": -3, "PruneRatio": 1, "PruneWidth": 0.4, "PruneWidthPeak": 0.6,
        "PrunePowerLow": 0.001, "PrunePowerHigh": 0.5,
        "0Scale": 1, "0Length": 0.8, "0Taper": 1, "0BaseSplits": 2, "0SegSplits": 0.1, "0SplitAngle": 3,
        "0CurveRes": 8, "0CurveBack": 20, "0CurveV": 120,
        "1DownAngle": 20, "1DownAngleV": 10, "1Rotate": -120, "1RotateV": 30, "1Branches": 25, "1Length": 0.5,
        "1LengthV": 0.1, "1Taper": 1, "1SegSplits": 0.2, "1SplitAngle": 30, "1SplitAngleV": 10, "1CurveRes": 16,
        "1Curve": 40, "1CurveBack": 80, "1CurveV": 90,
        "2DownAngle": 30, "2DownAngleV": 10, "2Rotate": -120, "2RotateV": 30, "2Branches": 10, "2Length": 1.5,
        "2Taper": 1, "2SegSplits": 0.2, "2SplitAngle": 45, "2SplitAngleV": 20, "2CurveRes": 12,
        "3DownAngle": 20, "3DownAngleV": 10, "3Rotate": 140, "3Branches": 300, "3Length": 0.1, "3Taper": 1,
        "3CurveRes": 1
    }"#,
    )
}

/// The CA Black Oak: all numbers that are not 0.
pub(super) fn oak() -> Tree {
    tree(
        r#"{
        "Shape": 2, "BaseSize": 0.05, "Scale": 10, "ScaleV": 10, "Levels": 3, "Ratio": 0.018, "RatioPower": 1.3,
        "Lobes": 5, "LobeDepth": 0.1, "Flare": 1.2, "Leaves": 25, "LeafShape": 0, "LeafScale": 0.12,
        "LeafScaleX": 0.66, "AttractionUp": 0.8, "PruneWidth": 0.5, "PruneWidthPeak": 0.5, "PrunePowerLow": 0.5,
        "PrunePowerHigh": 0.5,
        "0Scale": 1, "0Length": 1, "0Taper": 0.95, "0BaseSplits": 2, "0SegSplits": 0.4, "0SplitAngle": 10,
        "0CurveRes": 8, "0CurveV": 90,
        "1DownAngle": 30, "1DownAngleV": -30, "1Rotate": 80, "1Branches": 40, "1Length": 0.8, "1LengthV": 0.1,
        "1Taper": 1, "1SegSplits": 0.2, "1SplitAngle": 10, "1SplitAngleV": 10, "1CurveRes": 10, "1Curve": 40,
        "1CurveBack": -70, "1CurveV": 150,
        "2DownAngle": 45, "2DownAngleV": 10, "2Rotate": 140, "2Branches": 120, "2Length": 0.2, "2LengthV": 0.05,
        "2Taper": 1, "2SegSplits": 0.1, "2SplitAngle": 10, "2SplitAngleV": 10, "2CurveRes": 3, "2CurveV": -30,
        "3DownAngle": 45, "3DownAngleV": 10, "3Rotate": 140, "3Length": 0.4, "3Taper": 1, "3CurveRes": 1
    }"#,
    )
}

/// A bare trunk of 10 m in twelve segments.
pub(super) fn bare() -> Tree {
    tree(
        r#"{
        "Shape": 3, "BaseSize": 0.1, "Scale": 10, "Levels": 1, "Ratio": 0.02, "RatioPower": 1.5, "0CurveRes": 12
    }"#,
    )
}

/// Branches of five segments, without variation.
pub(super) fn level(number: f64) -> Branches {
    Branches {
        branches: number.into(),
        down_angle: 50.0.into(),
        rotate: 140.0.into(),
        length: 0.3.into(),
        curve_res: 5.into(),
        curve: (-40.0).into(),
        ..Branches::default()
    }
}

pub(super) fn with(branches: Branches, mut tree: Tree) -> Tree {
    tree.whole.levels = 2.into();
    tree.branches[0] = branches;
    tree
}

/// A trunk that splits into itself and `splits` clones, 24° from the vertical.
pub(super) fn clump(splits: u32) -> Tree {
    let mut tree = bare();
    tree.trunk.base_splits = splits.into();
    tree.trunk.split_angle = 24.0.into();
    tree
}

/// The tree without any variation.
pub(super) fn unvaried(mut tree: Tree) -> Tree {
    tree.whole.scale_v = 0.0.into();
    let trunk = &mut tree.trunk;
    for v in [&mut trunk.scale_v, &mut trunk.length_v, &mut trunk.split_angle_v, &mut trunk.curve_v] {
        *v = 0.0.into();
    }
    for level in tree.branches.iter_mut() {
        for v in [&mut level.rotate_v, &mut level.length_v, &mut level.split_angle_v, &mut level.curve_v] {
            *v = 0.0.into();
        }
        if level.down_angle_v.value() > 0.0 {
            level.down_angle_v = 0.0.into();
        }
    }
    tree
}
