//! tree-gen's keys.
//!
//! tree-gen (`parametric/gen.py`, `tree_param.py`) has names of its own, lists of four levels of which the first
//! has `-0` where the trunk has no such thing, degrees and metres. Children are counted above the bare base. Its
//! tropism turns a segment by 10° times the sine, which it gauges to the paper's AttractionUp. Absent: reading
//! (`literal`).

use crate::fault::Wrong;
use crate::leaf;
use crate::mapping::{Mapping, Rule};
use crate::paper::{Key, Setting};
use crate::value::Entry;

/// What a key of tree-gen's is.
pub(crate) fn rule(key: &str) -> Option<Rule> {
    let nothing = |why, neutral| Some(Rule::Nothing(why, neutral));
    let is = |name| Some(Rule::Is(name));
    let each = |name| Some(Rule::Each(name));
    match key {
        "shape" => is("Shape"),
        "g_scale" => is("Scale"),
        "g_scale_v" => is("ScaleV"),
        "levels" => is("Levels"),
        "ratio" => is("Ratio"),
        "ratio_power" => is("RatioPower"),
        "flare" => is("Flare"),
        "leaf_blos_num" => is("Leaves"),
        "leaf_scale" => is("LeafScale"),
        "leaf_scale_x" => is("LeafScaleX"),
        "leaf_bend" => is("LeafBend"),
        "prune_ratio" => is("PruneRatio"),
        "prune_width" => is("PruneWidth"),
        "prune_width_peak" => is("PruneWidthPeak"),
        "prune_power_low" => is("PrunePowerLow"),
        "prune_power_high" => is("PrunePowerHigh"),
        "down_angle" => each("DownAngle"),
        "down_angle_v" => each("DownAngleV"),
        "rotate" => each("Rotate"),
        "rotate_v" => each("RotateV"),
        "branches" => each("Branches"),
        "length" => each("Length"),
        "length_v" => each("LengthV"),
        "taper" => each("Taper"),
        "seg_splits" => each("SegSplits"),
        "split_angle_v" => each("SplitAngleV"),
        "curve_res" => each("CurveRes"),
        "curve" => each("Curve"),
        "curve_back" => each("CurveBack"),
        "curve_v" => each("CurveV"),
        "base_splits" => Some(Rule::By(base_splits)),
        "base_size" => Some(Rule::By(base_size)),
        "split_angle" => Some(Rule::By(split_angle)),
        "radius_mod" => Some(Rule::By(radius_mod)),
        "leaf_shape" => Some(Rule::By(leaf_shape)),
        "tropism" => Some(Rule::By(tropism)),
        "floor_splits" => nothing("a tree has one trunk", &[0.0]),
        "bend_v" => nothing("stems bend in one plane", &[0.0]),
        "branch_dist" => nothing("children stand one by one", &[0.0]),
        "blossom_shape" | "blossom_scale" | "blossom_rate" => nothing("the paper's trees have no flowers", &[0.0]),
        _ => None,
    }
}

fn base_splits(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    let splits = mapping.whole(&entry.node)?;
    let note = (splits < 0.0).then_some("tree-gen draws up to so many; here it is always so many");
    mapping.give(entry, &[("0BaseSplits".to_owned(), splits.abs())], note);
    Ok(())
}

fn base_size(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    let sizes = mapping.numbers(&entry.node)?;
    let others = sizes.iter().skip(1).any(|size| *size != 0.0);
    let note = others.then_some("the trunk's alone; branches have no bare base here");
    let Some(trunk) = sizes.first() else { return Err(mapping.wrong(&entry.node, "a number for each level")) };
    mapping.give(entry, &[("BaseSize".to_owned(), *trunk)], note);
    Ok(())
}

fn split_angle(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    let angles = mapping.numbers(&entry.node)?;
    let direct = angles.iter().any(|angle| *angle < 0.0);
    let note = direct.then_some("tree-gen turns by a negative angle in one plane; here it is the angle of the paper");
    let named = angles.iter().enumerate().map(|(level, angle)| (format!("{level}SplitAngle"), angle.abs()));
    mapping.give(entry, &named.collect::<Vec<_>>(), note);
    Ok(())
}

fn radius_mod(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    let factors = mapping.numbers(&entry.node)?;
    let others = factors.iter().skip(1).any(|factor| *factor != 1.0);
    let note = others.then_some("the trunk's alone; the paper has no such factor of branches");
    let Some(trunk) = factors.first() else { return Err(mapping.wrong(&entry.node, "a number for each level")) };
    mapping.give(entry, &[("0Scale".to_owned(), *trunk)], note);
    Ok(())
}

/// The shapes of `leaf_shapes.py`, counted from 1; any other number is 8.
fn leaf_shape(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    let (shape, note) = match mapping.whole(&entry.node)?.abs() as i64 {
        2 => (leaf::OVAL, "tree-gen's linear leaf; LeafScaleX tells how narrow it is"),
        3 => (leaf::OVAL, "tree-gen's heart-shaped leaf; the oval stands for it"),
        4 => (leaf::MAPLE, "tree-gen's leaf of a maple"),
        5 => (leaf::MAPLE, "tree-gen's palmate leaf; the maple's five lobes stand for it"),
        6 | 7 => (leaf::OAK, "tree-gen's leaf of an oak"),
        9 => (leaf::OVAL, "tree-gen's rectangle, meant for a picture; the oval stands for it"),
        10 => (leaf::TRIANGLE, "tree-gen's triangle"),
        1 => (leaf::OVAL, "tree-gen's egg-shaped leaf; the oval stands for it"),
        _ => (leaf::OVAL, "tree-gen's ellipse"),
    };
    leaf::give(mapping, entry, shape, Some(note));
    Ok(())
}

fn tropism(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    let vector = mapping.numbers(&entry.node)?;
    let [x, y, z] = vector[..] else { return Err(mapping.wrong(&entry.node, "three numbers: x, y, z")) };
    let sideways = x != 0.0 || y != 0.0;
    let note = if sideways { "its upward part alone" } else { "tree-gen gauges it to the paper's attraction" };
    mapping.give(entry, &[("AttractionUp".to_owned(), z)], Some(note));
    Ok(())
}

/// What tree-gen takes where a file leaves something out: its aspen.
pub(crate) fn default(key: Key) -> Option<f64> {
    let of_level = |values: [f64; 4]| key.level.map(|level| values[level.min(3)]);
    match key.name() {
        "Shape" => Some(7.0),
        "Scale" => Some(13.0),
        "ScaleV" | "Levels" => Some(3.0),
        "Ratio" => Some(0.015),
        "RatioPower" => Some(1.2),
        "Flare" => Some(0.6),
        "BaseSize" => Some(0.3),
        "Leaves" => Some(25.0),
        "LeafScale" => Some(0.17),
        "LeafScaleX" | "0Scale" | "Taper" => Some(1.0),
        "LeafShape" | "LeafBend" | "PruneRatio" | "BaseSplits" | "RotateV" | "LengthV" | "SegSplits" | "CurveBack" => {
            Some(0.0)
        }
        "AttractionUp" | "PruneWidth" | "PruneWidthPeak" | "PrunePowerLow" | "PrunePowerHigh" => Some(0.5),
        "DownAngle" => of_level([0.0, 60.0, 45.0, 45.0]),
        "DownAngleV" => of_level([0.0, -50.0, 10.0, 10.0]),
        "Rotate" => of_level([0.0, 140.0, 140.0, 77.0]),
        "Branches" => of_level([0.0, 50.0, 30.0, 10.0]),
        "Length" => of_level([1.0, 0.3, 0.6, 0.0]),
        "SplitAngle" => of_level([40.0, 0.0, 0.0, 0.0]),
        "SplitAngleV" => of_level([5.0, 0.0, 0.0, 0.0]),
        "CurveRes" => of_level([5.0, 5.0, 3.0, 1.0]),
        "Curve" => of_level([0.0, -40.0, -40.0, 0.0]),
        "CurveV" => of_level([20.0, 50.0, 75.0, 0.0]),
        _ => None,
    }
}

/// What holds for every tree of tree-gen's.
pub(crate) fn finish(mapping: &mut Mapping<'_>) {
    mapping.set("children", Setting::Word("above_base"), "tree-gen counts branches above the bare base");
}
