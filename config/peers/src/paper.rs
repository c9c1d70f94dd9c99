//! The keys of Weber & Penn 1995 (appendix), in the order in which a species file has them, and their values.
//!
//! A key of a level has the number of the level before its name, as the paper's table has it. Absent: what they mean
//! (the parametric model).

use std::fmt;

/// The keys without a level.
pub(crate) const GENERAL: [&str; 26] = [
    "Shape",
    "BaseSize",
    "Scale",
    "ScaleV",
    "ZScale",
    "ZScaleV",
    "Levels",
    "Ratio",
    "RatioPower",
    "Lobes",
    "LobeDepth",
    "Flare",
    "children",
    "Leaves",
    "LeafShape",
    "LeafScale",
    "LeafScaleX",
    "LeafBend",
    "AttractionUp",
    "PruneRatio",
    "PruneWidth",
    "PruneWidthPeak",
    "PrunePowerLow",
    "PrunePowerHigh",
    "0Scale",
    "0ScaleV",
];
/// The keys of a level, without its number. The first four are those of leaves too.
pub(crate) const OF_LEVEL: [&str; 16] = [
    "DownAngle",
    "DownAngleV",
    "Rotate",
    "RotateV",
    "Branches",
    "Length",
    "LengthV",
    "Taper",
    "BaseSplits",
    "SegSplits",
    "SplitAngle",
    "SplitAngleV",
    "CurveRes",
    "Curve",
    "CurveBack",
    "CurveV",
];
/// So many of them are also stated of the level above the last, which is that of the leaves.
pub(crate) const ANGLES: usize = 4;
/// The keys whose values are whole numbers.
const WHOLE: [&str; 7] = ["Shape", "Levels", "Lobes", "Leaves", "LeafShape", "Branches", "CurveRes"];
/// Levels from this on have the numbers of the last one that is stated.
pub(crate) const LEVELS: usize = 4;

/// A key of the paper.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Key {
    /// The level, and none for what holds for the tree.
    pub level: Option<usize>,
    /// Its place in its list.
    index: usize,
}

impl Key {
    /// A key by the paper's name, such as `Scale`, `0Scale` or `2DownAngle`.
    pub fn named(name: &str) -> Option<Self> {
        if let Some(index) = GENERAL.iter().position(|key| *key == name) {
            return Some(Self { level: None, index });
        }
        let level = name.chars().next()?.to_digit(10)? as usize;
        (level < LEVELS).then(|| Self::of_level(level, &name[1..]))?
    }

    /// A key of a level.
    pub fn of_level(level: usize, name: &str) -> Option<Self> {
        let index = OF_LEVEL.iter().position(|key| *key == name)?;
        let trunk_alone = name == "BaseSplits";
        let above_alone = index < ANGLES || name == "Branches";
        let is = level < LEVELS && (level == 0 || !trunk_alone) && (level > 0 || !above_alone);
        is.then_some(Self { level: Some(level), index })
    }

    /// Its name without the level.
    pub fn name(self) -> &'static str {
        if self.level.is_some() { OF_LEVEL[self.index] } else { GENERAL[self.index] }
    }

    /// Whether a tree of so many levels, with or without leaves, asks for it.
    pub fn is_used(self, levels: usize, leaves: bool) -> bool {
        match self.level {
            None => true,
            Some(level) => level < levels || (leaves && level == levels && self.index < ANGLES),
        }
    }

    /// Whether its values are whole numbers.
    pub fn is_whole(self) -> bool {
        WHOLE.contains(&self.name()) || self.name() == "BaseSplits"
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.level {
            Some(level) => write!(f, "{level}{}", self.name()),
            None => f.write_str(self.name()),
        }
    }
}

/// What a key is given.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Setting {
    /// A number.
    Number(f64),
    /// A word.
    Word(&'static str),
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Word(word) => write!(f, "\"{word}\""),
            Self::Number(number) => f.write_str(&shortest(*number)),
        }
    }
}

/// The number as a person would write it: one that is a single-precision number has the digits of that alone.
fn shortest(number: f64) -> String {
    let single = number as f32;
    let plain = number + 0.0;
    let text = if f64::from(single) == number { (single + 0.0).to_string() } else { plain.to_string() };
    // Display writes no exponent, and numbers that need one for their size are no sizes of trees.
    if text.len() > 25 { format!("{plain:e}") } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_have_the_papers_names() {
        for name in ["Shape", "0Scale", "0BaseSplits", "1DownAngleV", "3CurveRes", "0Curve", "2Branches"] {
            assert_eq!(Key::named(name).map(|key| key.to_string()).as_deref(), Some(name));
        }
        for name in ["", "é", "0DownAngle", "1BaseSplits", "4Length", "Length", "0Branches", "1Scale"] {
            assert_eq!(Key::named(name), None, "{name}");
        }
        let leaf = Key::named("3Rotate").unwrap();
        assert!(leaf.is_used(3, true) && !leaf.is_used(3, false) && leaf.is_used(4, false));
        assert!(!Key::named("3Length").unwrap().is_used(3, true));
    }

    #[test]
    fn numbers_have_the_digits_that_were_meant() {
        let written = |number| Setting::Number(number).to_string();
        assert_eq!(written(0.400_000_005_960_464_5), "0.4");
        assert_eq!(written(0.4), "0.4");
        assert_eq!([written(-0.0), written(50.0), written(-2.5)], ["0", "50", "-2.5"]);
        assert_eq!(written(1e300), "1e300");
    }
}
