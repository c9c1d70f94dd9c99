//! Arbaro's keys: those of the paper, and a few of its own.
//!
//! Arbaro (`params/Params.java`) has the paper's names, angles in degrees and lengths in metres. Its numbers of
//! children are those above the bare base of the trunk, which is `children = "above_base"` here. What it does otherwise
//! than the paper is said at the key. Absent: reading (`xml`).

use crate::fault::Wrong;
use crate::leaf;
use crate::mapping::{Mapping, Rule};
use crate::paper::{Key, Setting};
use crate::value::{Entry, Value};

/// What a key of Arbaro's is.
pub(crate) fn rule(key: &str) -> Option<Rule> {
    let nothing = |why, neutral| Some(Rule::Nothing(why, neutral));
    match key {
        "Species" => nothing("it is the name of the tree", &[]),
        "Shape" => Some(Rule::By(shape)),
        "LeafShape" => Some(Rule::By(leaf_shape)),
        "0Scale" => Some(Rule::By(trunk_scale)),
        "0ScaleV" => nothing("Arbaro makes the surface of the trunk rough by it", &[0.0]),
        "Smooth" | "LeafQuality" => nothing("it is a setting of the mesh and not of the tree", &[]),
        "LeafStemLen" => nothing("leaves have no stalk in the paper", &[0.0]),
        "LeafDistrib" => nothing("the paper spreads leaves by shape 4", &[4.0]),
        "0DownAngle" | "0DownAngleV" | "0Rotate" | "0RotateV" => nothing("the trunk has no such angle", &[0.0]),
        "0Branches" => nothing("there is one trunk", &[1.0]),
        "0BranchDist" => nothing("the trunk is no child", &[0.0, 1.0]),
        "1BranchDist" | "2BranchDist" | "3BranchDist" => nothing("the paper spreads children evenly", &[1.0]),
        "ZScale" | "ZScaleV" | "children" => None,
        _ => Key::named(key).map(|_| Rule::Same),
    }
}

/// Arbaro's words of crowns, beside the numbers.
const CROWNS: [&str; 9] = [
    "conical",
    "spherical",
    "hemispherical",
    "cylindrical",
    "tapered cylindrical",
    "flame",
    "inverse conical",
    "tend flame",
    "envelope",
];

fn shape(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    let word = match &entry.node.value {
        Value::Text(word) => CROWNS.iter().position(|crown| crown.eq_ignore_ascii_case(word)),
        _ => None,
    };
    let number = word.map_or_else(|| mapping.whole(&entry.node), |number| Ok(number as f64))?;
    let cone = (number == 0.0).then_some("Arbaro's cone ends in a point, where the paper's keeps a fifth of the width");
    let note = cone.or(word.map(|_| "the paper numbers the shapes"));
    mapping.give(entry, &[("Shape".to_owned(), number)], note);
    Ok(())
}

fn trunk_scale(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    let scale = mapping.number(&entry.node)?;
    let note = (scale != 1.0).then_some("branches take the scaled radius here, in Arbaro the one before");
    mapping.give(entry, &[("0Scale".to_owned(), scale)], note);
    Ok(())
}

fn leaf_shape(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    let word = match &entry.node.value {
        Value::Text(word) => word.clone(),
        _ => mapping.whole(&entry.node)?.to_string(),
    };
    match word.as_str() {
        "0" | "" => leaf::give(mapping, entry, leaf::OVAL, None),
        word if word.starts_with("disc") => {
            leaf::give(mapping, entry, leaf::OVAL, Some("a disc of Arbaro's is an oval"))
        }
        "sphere" => leaf::give(mapping, entry, leaf::OVAL, Some("a ball of Arbaro's; the flat oval stands for it")),
        "palm" => {
            leaf::give(mapping, entry, leaf::OVAL, Some("a folded disc of Arbaro's; the flat oval stands for it"))
        }
        _ => leaf::give(mapping, entry, leaf::OVAL, Some("Arbaro draws any other shape as a disc")),
    }
    Ok(())
}

/// What Arbaro takes where a file leaves something out.
pub(crate) fn default(key: Key) -> Option<f64> {
    let of_level = |values: [f64; 4]| key.level.map(|level| values[level.min(3)]);
    match key.name() {
        "Shape" | "ScaleV" | "Lobes" | "LobeDepth" | "Leaves" | "LeafShape" | "AttractionUp" | "PruneRatio" => {
            Some(0.0)
        }
        "Levels" => Some(3.0),
        "Scale" if key.level.is_none() => Some(10.0),
        "BaseSize" => Some(0.25),
        "Ratio" => Some(0.05),
        "RatioPower" | "0Scale" => Some(1.0),
        "Flare" | "LeafScaleX" | "PruneWidth" | "PruneWidthPeak" | "PrunePowerLow" | "PrunePowerHigh" => Some(0.5),
        "LeafScale" => Some(0.2),
        "LeafBend" => Some(0.3),
        "Length" => of_level([1.0, 0.5, 0.5, 0.5]),
        "CurveRes" => of_level([3.0, 3.0, 1.0, 1.0]),
        "DownAngle" => Some(30.0),
        "Rotate" => Some(120.0),
        "Branches" => of_level([1.0, 10.0, 5.0, 5.0]),
        "Taper" => Some(1.0),
        "LengthV" | "SegSplits" | "SplitAngle" | "SplitAngleV" | "Curve" | "CurveV" | "CurveBack" | "DownAngleV"
        | "RotateV" | "BaseSplits" => Some(0.0),
        _ => None,
    }
}

/// What holds for every tree of Arbaro's.
pub(crate) fn finish(mapping: &mut Mapping<'_>) {
    mapping.set("children", Setting::Word("above_base"), "Arbaro counts branches above the bare base");
}
