//! Sapling's keys, of its first and of its third generation.
//!
//! Sapling (Blender's `add_curve_sapling`, `utils.py`) has the paper's parameters in camel case, tuples of four
//! levels, degrees and metres, and choices as texts. Its third generation, known by keys that the first has not, adds
//! nCurveBack to nCurve, states the angles of leaves by themselves and flares the trunk by `rootFlare`. Absent: reading
//! (`literal`).

use crate::fault::Wrong;
use crate::leaf;
use crate::mapping::{Mapping, Rule};
use crate::paper::{Key, LEVELS};
use crate::value::{Entry, Value};

const DRAWING: &str = "it is a setting of the drawing and not of the tree";
const MOTION: &str = "it is a setting of the motion and not of the tree";
/// Where it tells something, nothing of the paper tells it.
const OWN: &str = "it is Sapling's own";

/// What a key of Sapling's is.
pub(crate) fn rule(key: &str) -> Option<Rule> {
    let nothing = |why, neutral| Some(Rule::Nothing(why, neutral));
    growth(key).or_else(|| match key {
        "seed" => nothing("a run has the seed (`--seed`)", &[]),
        "showLeaves" => nothing("it is a switch of the view; the leaves are kept", &[]),
        "prune" => nothing("it is told by PruneRatio", &[]),
        "bevel" | "bevelRes" | "resU" | "handleType" | "chooseSet" | "presetName" | "limitImport" | "do_update"
        | "makeMesh" | "overwrite" | "matIndex" => nothing(DRAWING, &[]),
        "useArm" | "armAnim" | "previewArm" | "leafAnim" | "frameRate" | "windSpeed" | "windGust" | "loopFrames"
        | "wind" | "gust" | "gustF" | "af1" | "af2" | "af3" | "armLevels" | "boneStep" => nothing(MOTION, &[]),
        "startCurv" => nothing("the trunk stands upright", &[0.0]),
        "leafDist" => nothing("the paper spreads leaves by shape 4", &[4.0]),
        "branchDist" | "taperFactor" => nothing(OWN, &[1.0]),
        "radiusTweak" | "splitHeight" => nothing(OWN, &[1.0]),
        "nrings" | "attractOut" | "taperCrown" | "minRadius" | "closeTip" | "splitBias" | "baseSize_s"
        | "leafangle" | "leafScaleT" | "leafScaleV" | "splitStraight" | "splitByLen" => nothing(OWN, &[0.0]),
        "shapeS" | "customShape" | "autoTaper" | "rMode" | "useOldDownAngle" | "useParentAngle" | "horzLeaves"
        | "pruneBase" | "splitLength" | "lengthStraight" | "splitRadiusRatio" | "noTip" | "leafType"
        | "leafBaseSize" | "leafObjZ" | "leafObjY" | "leafObjX" | "leafDupliObj" => nothing(OWN, &[]),
        _ => None,
    })
}

/// The keys that grow the tree.
fn growth(key: &str) -> Option<Rule> {
    let is = |name| Some(Rule::Is(name));
    let each = |name| Some(Rule::Each(name));
    match key {
        "shape" => Some(Rule::By(shape)),
        "levels" => is("Levels"),
        "scale" => is("Scale"),
        "scaleV" => is("ScaleV"),
        "baseSize" => is("BaseSize"),
        "baseSplits" => is("0BaseSplits"),
        "ratio" => is("Ratio"),
        "ratioPower" => is("RatioPower"),
        "scale0" => is("0Scale"),
        "scaleV0" => is("0ScaleV"),
        "rootFlare" => Some(Rule::By(root_flare)),
        "leaves" => is("Leaves"),
        "leafScale" => is("LeafScale"),
        "leafScaleX" => is("LeafScaleX"),
        "leafShape" => Some(Rule::By(leaf_shape)),
        "bend" => is("LeafBend"),
        "attractUp" => Some(Rule::By(attract_up)),
        "pruneRatio" => Some(Rule::By(prune_ratio)),
        "pruneWidth" => is("PruneWidth"),
        "pruneWidthPeak" => is("PruneWidthPeak"),
        "prunePowerLow" => is("PrunePowerLow"),
        "prunePowerHigh" => is("PrunePowerHigh"),
        "downAngle" => each("DownAngle"),
        "downAngleV" => each("DownAngleV"),
        "rotate" => each("Rotate"),
        "rotateV" => each("RotateV"),
        "branches" => each("Branches"),
        "length" => each("Length"),
        "lengthV" => each("LengthV"),
        "taper" => each("Taper"),
        "segSplits" => each("SegSplits"),
        "splitAngle" => each("SplitAngle"),
        "splitAngleV" => each("SplitAngleV"),
        "curveRes" => each("CurveRes"),
        "curve" => Some(Rule::By(curve)),
        "curveBack" => Some(Rule::By(curve_back)),
        "curveV" => each("CurveV"),
        "leafDownAngle" => Some(Rule::By(leaf_down_angle)),
        "leafDownAngleV" => Some(Rule::By(leaf_down_angle_v)),
        "leafRotate" => Some(Rule::By(leaf_rotate)),
        "leafRotateV" => Some(Rule::By(leaf_rotate_v)),
        _ => None,
    }
}

/// Whether the file is of the third generation.
fn is_third(mapping: &Mapping<'_>) -> bool {
    ["splitHeight", "useOldDownAngle", "leafDownAngle", "attractOut"].iter().any(|key| mapping.entry(key).is_some())
}

fn shape(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    let shape = mapping.whole(&entry.node)?;
    if shape > 7.0 {
        mapping.give(entry, &[("Shape".to_owned(), 7.0)], Some("a curve of the user's; the tend flame stands for it"));
    } else {
        mapping.give(entry, &[("Shape".to_owned(), shape)], None);
    }
    Ok(())
}

fn root_flare(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    let wider = mapping.number(&entry.node)?;
    let note = "Sapling tells how many times as wide the foot is, the paper by how much it is wider";
    mapping.give(entry, &[("Flare".to_owned(), wider - 1.0)], Some(note));
    Ok(())
}

fn leaf_shape(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    let word = match &entry.node.value {
        Value::Text(word) => word.as_str(),
        _ => "",
    };
    let note = match word {
        "hex" => "Sapling's hexagon is the paper's oval",
        "rect" => "a rectangle, meant for a picture; the oval stands for it",
        _ => "an object of the user's scene; the oval stands for it",
    };
    leaf::give(mapping, entry, leaf::OVAL, Some(note));
    Ok(())
}

fn attract_up(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    let numbers = mapping.numbers(&entry.node)?;
    let (number, note) = match numbers[..] {
        [one] => (one, None),
        [_, _, second, ..] => (second, Some("that of level 2; the paper has one for all levels from there on")),
        _ => return Err(mapping.wrong(&entry.node, "a number, or one for each level")),
    };
    mapping.give(entry, &[("AttractionUp".to_owned(), number)], note);
    Ok(())
}

fn prune_ratio(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    let on = mapping.entry("prune").is_some_and(|prune| prune.node.value == Value::Bool(true));
    let stated = mapping.number(&entry.node)?;
    let note = (!on).then_some("`prune` is off");
    mapping.give(entry, &[("PruneRatio".to_owned(), if on { stated } else { 0.0 })], note);
    Ok(())
}

/// The curves of both halves as the paper has them, each as if the whole stem had it.
fn curves(mapping: &Mapping<'_>) -> Result<([f64; LEVELS], [f64; LEVELS]), Wrong> {
    let mut first = mapping.each_of("curve", [0.0, -40.0, -40.0, 0.0])?;
    let mut second = mapping.each_of("curveBack", [0.0; LEVELS])?;
    if is_third(mapping) {
        for (first, second) in first.iter_mut().zip(&mut second).filter(|(_, second)| **second != 0.0) {
            *first /= 2.0;
            *second += *first;
        }
    }
    Ok((first, second))
}

fn named(name: &str, numbers: [f64; LEVELS]) -> Vec<(String, f64)> {
    numbers.iter().enumerate().map(|(level, number)| (format!("{level}{name}"), *number)).collect()
}

fn curve(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    let (first, _) = curves(mapping)?;
    let halved = first != mapping.each_of("curve", first)?;
    let note = halved.then_some("Sapling spreads it over the whole stem, the paper over the first half");
    mapping.give(entry, &named("Curve", first), note);
    Ok(())
}

fn curve_back(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    let (_, second) = curves(mapping)?;
    let added = second != mapping.each_of("curveBack", second)?;
    let note = added.then_some("Sapling adds it to `curve` in the second half, in the paper it stands alone");
    mapping.give(entry, &named("CurveBack", second), note);
    Ok(())
}

fn of_leaves(mapping: &mut Mapping<'_>, entry: &Entry, name: &str) -> Result<(), Wrong> {
    let angle = mapping.number(&entry.node)?;
    if mapping.levels >= LEVELS {
        mapping.without(entry, "leaves of a tree of four levels have the angles of level 3");
    } else {
        let key = format!("{}{name}", mapping.levels);
        mapping.give(entry, &[(key, angle)], Some("leaves have the angles of the level above the last"));
    }
    Ok(())
}

fn leaf_down_angle(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    of_leaves(mapping, entry, "DownAngle")
}

fn leaf_down_angle_v(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    of_leaves(mapping, entry, "DownAngleV")
}

fn leaf_rotate(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    of_leaves(mapping, entry, "Rotate")
}

fn leaf_rotate_v(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    of_leaves(mapping, entry, "RotateV")
}

/// What Sapling takes where a file leaves something out: its aspen.
pub(crate) fn default(key: Key) -> Option<f64> {
    let of_level = |values: [f64; 4]| key.level.map(|level| values[level.min(3)]);
    match key.name() {
        "Shape" => Some(7.0),
        "Scale" => Some(13.0),
        "ScaleV" | "Levels" => Some(3.0),
        "BaseSize" | "PruneWidth" => Some(0.4),
        "Ratio" => Some(0.015),
        "RatioPower" => Some(1.2),
        "0Scale" | "Taper" | "LeafScaleX" => Some(1.0),
        "0ScaleV" => Some(0.2),
        "Leaves" => Some(25.0),
        "LeafScale" => Some(0.17),
        "LeafShape" | "LeafBend" | "AttractionUp" | "PruneRatio" | "BaseSplits" | "Flare" | "LengthV" | "SegSplits"
        | "SplitAngle" | "SplitAngleV" | "CurveBack" | "RotateV" => Some(0.0),
        "PruneWidthPeak" => Some(0.6),
        "PrunePowerHigh" => Some(0.5),
        "PrunePowerLow" => Some(0.001),
        "DownAngle" => of_level([90.0, 60.0, 45.0, 45.0]),
        "DownAngleV" => of_level([0.0, -50.0, 10.0, 10.0]),
        "Rotate" => of_level([140.0, 140.0, 140.0, 77.0]),
        "Branches" => of_level([50.0, 30.0, 10.0, 10.0]),
        "Length" => of_level([1.0, 0.3, 0.6, 0.45]),
        "CurveRes" => of_level([3.0, 5.0, 3.0, 1.0]),
        "Curve" => of_level([0.0, -40.0, -40.0, 0.0]),
        "CurveV" => of_level([20.0, 50.0, 75.0, 0.0]),
        _ => None,
    }
}
