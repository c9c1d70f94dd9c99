//! The keys of Helios' library of Weber–Penn trees.
//!
//! Helios (`plugins/weberpenntree/src/WeberPennTree.cpp`) has lists of four levels under the paper's names. It reads
//! them in a way of its own: variations have no sign, turns may be negative, the trunk is as wide as `ZScale` says, and
//! a split takes the angle of the next level. Every key must be stated, so there are no defaults. Absent: reading
//! (`xml`).

use crate::fault::Wrong;
use crate::mapping::{Mapping, Rule};
use crate::paper::{Key, LEVELS};
use crate::value::Entry;

/// What a key of Helios' is.
pub(crate) fn rule(key: &str) -> Option<Rule> {
    let nothing = |why, neutral| Some(Rule::Nothing(why, neutral));
    match key {
        "BaseSplits" => Some(Rule::Is("0BaseSplits")),
        "ZScale" => Some(Rule::By(z_scale)),
        "Leaves" => Some(Rule::By(leaves)),
        "ZScaleV" => nothing("Helios does not read it", &[]),
        "BaseSplitSize" => nothing("the paper splits the trunk at the end of its first segment", &[]),
        "BaseSizeV" | "BaseSplitsV" | "BaseSplitSizeV" => nothing("it is Helios' own", &[0.0]),
        "LeafFile" | "WoodFile" | "WoodColor" => nothing("it is a picture or a colour of Helios'", &[]),
        "LeafAngleDist" | "LeafAngleCDF" | "LeafAngle" => nothing("leaves have the angles of their level", &[]),
        "nSegSplits" => Some(Rule::By(|m, e| each(m, e, "SegSplits", None, |number| number))),
        "nSplitAngle" => Some(Rule::By(|m, e| split(m, e, "SplitAngle"))),
        "nSplitAngleV" => Some(Rule::By(|m, e| split(m, e, "SplitAngleV"))),
        "nCurveRes" => Some(Rule::Each("CurveRes")),
        "nCurve" => Some(Rule::Each("Curve")),
        "nCurveBack" => nothing("Helios does not read it", &[0.0]),
        "nCurveV" => Some(Rule::By(|m, e| each(m, e, "CurveV", UNSIGNED, f64::abs))),
        "nLength" => Some(Rule::Each("Length")),
        "nLengthV" => Some(Rule::By(|m, e| each(m, e, "LengthV", UNSIGNED, f64::abs))),
        "nTaper" => Some(Rule::Each("Taper")),
        "nDownAngle" => Some(Rule::By(down_angle)),
        "nDownAngleV" => Some(Rule::By(|m, e| each(m, e, "DownAngleV", UNSIGNED, f64::abs))),
        "nRotate" => Some(Rule::By(|m, e| each(m, e, "Rotate", TURNED, |angle| angle.rem_euclid(360.0)))),
        "nRotateV" => Some(Rule::By(|m, e| each(m, e, "RotateV", UNSIGNED, f64::abs))),
        "nBranches" => Some(Rule::Each("Branches")),
        "Shape" | "BaseSize" | "Scale" | "ScaleV" | "Ratio" | "RatioPower" | "Lobes" | "LobeDepth" | "Flare"
        | "Levels" | "LeafScale" | "LeafScaleX" => Some(Rule::Same),
        _ => None,
    }
}

/// A sign has a meaning in the paper and none in Helios.
const UNSIGNED: Option<&str> = Some("its sign has no meaning in Helios");
const TURNED: Option<&str> = Some("Helios turns the other way; the paper would put children on two sides");

/// A list of levels, of which each number is changed.
fn each(
    mapping: &mut Mapping<'_>,
    entry: &Entry,
    name: &str,
    note: Option<&str>,
    change: fn(f64) -> f64,
) -> Result<(), Wrong> {
    let stated = mapping.numbers(&entry.node)?;
    let changed: Vec<f64> = stated.iter().map(|number| change(*number)).collect();
    let note = note.filter(|_| stated != changed);
    let named = changed.iter().enumerate().map(|(level, number)| (format!("{level}{name}"), *number));
    mapping.give(entry, &named.collect::<Vec<_>>(), note);
    Ok(())
}

/// Helios splits the base of the trunk by the angle of level 0, and segments by that of the next level.
fn split(mapping: &mut Mapping<'_>, entry: &Entry, name: &str) -> Result<(), Wrong> {
    let stated = mapping.each_of(&entry.key, [0.0; LEVELS])?;
    let base = mapping.number_of("BaseSplits", 0.0)? > 0.0;
    let of_level = |level: usize| if level == 0 && base { stated[0] } else { stated[(level + 1).min(LEVELS - 1)] };
    let named: Vec<_> = (0..LEVELS).map(|level| (format!("{level}{name}"), of_level(level))).collect();
    let moved = named.iter().zip(stated).any(|((_, angle), stated)| *angle != stated);
    mapping.give(entry, &named, moved.then_some("Helios splits a segment by the angle of the next level"));
    Ok(())
}

fn z_scale(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    let scale = mapping.number(&entry.node)?;
    if mapping.number_of("BaseSplits", 0.0)? > 0.0 {
        mapping.without(entry, "Helios reads it of a trunk that does not split at its base");
    } else {
        mapping.give(entry, &[("0Scale".to_owned(), scale)], Some("Helios widens the trunk by it"));
    }
    Ok(())
}

fn leaves(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    let leaves = mapping.whole(&entry.node)?;
    let note = "Helios bears ten times so many on a stem as long as the tree; the paper's number is of a twig";
    mapping.give(entry, &[("Leaves".to_owned(), leaves)], Some(note));
    Ok(())
}

fn down_angle(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    let mut angles = mapping.each_of(&entry.key, [0.0; LEVELS])?;
    let turned = angles.get_mut(mapping.levels).filter(|angle| **angle < 0.0).map(|angle| *angle += 180.0);
    let note = turned.map(|()| "Helios adds half a turn to a negative angle of leaves");
    let named: Vec<_> = angles.iter().enumerate().map(|(level, angle)| (format!("{level}DownAngle"), *angle)).collect();
    mapping.give(entry, &named, note);
    Ok(())
}

/// What Helios has no key for.
pub(crate) fn default(key: Key) -> Option<f64> {
    match key.name() {
        "0Scale" => Some(1.0),
        "LeafShape" | "LeafBend" | "AttractionUp" | "PruneRatio" | "CurveBack" => Some(0.0),
        _ => None,
    }
}
