//! Colours as a species file states them (de Reffye 1988 §6): by kind of place and by order, and each by the age of the
//! component; of leaves also by season.
//!
//! Absent: the colours of components without a stated colour, which `phytomer_meshes::palette` has by kind and form.

use crate::fault::{Fault, Path};
use crate::law::Quantity;
use phytomer_looks::{Bark, Colour, OrganPaint};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A colour: `"#rrggbb"`, six hexadecimal digits of red, green and blue, sRGB.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct ColourText(#[schemars(extend("pattern" = "^#[0-9a-fA-F]{6}$"))] pub String);

impl ColourText {
    /// Red, green and blue; `None` where the text is no colour.
    pub fn rgb(&self) -> Option<Colour> {
        let digits = self.0.strip_prefix('#').filter(|digits| digits.len() == 6 && digits.is_ascii())?;
        let channel = |k: usize| u8::from_str_radix(digits.get(2 * k..2 * k + 2)?, 16).ok();
        let all_hexadecimal = digits.bytes().all(|digit| digit.is_ascii_hexdigit());
        Some([channel(0)?, channel(1)?, channel(2)?]).filter(|_| all_hexadecimal)
    }
}

/// The colour of internodes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum BarkChoice {
    /// One colour at every age; dead wood greys.
    One(ColourText),
    /// Colours by the age of the wood.
    Stages(BarkColours),
}

/// The colours of internodes by their own age; what is left out is by kind.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BarkColours {
    /// Of the shoot, at birth.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shoot: Option<ColourText>,
    /// Of young bark.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub young: Option<ColourText>,
    /// Of old bark.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub old: Option<ColourText>,
    /// Of dead wood that stands.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dead: Option<ColourText>,
    /// The ticks in which a shoot turns halfway to bark.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub forms_in: Option<Quantity>,
    /// The ticks in which young bark turns halfway to old.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub darkens_in: Option<Quantity>,
}

/// The colour of leaves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum LeafChoice {
    /// One colour at every age but in autumn.
    One(ColourText),
    /// Colours by age and season.
    Stages(LeafColours),
}

/// The colours of a leaf; what is left out is by kind and form.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct LeafColours {
    /// At its birth.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub young: Option<ColourText>,
    /// At the end of its life; without a life length it is halfway there after 4 ticks.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub old: Option<ColourText>,
    /// At its last tick before it falls with the season.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub autumn: Option<ColourText>,
    /// The ticks over which it turns to that colour, the last one before the fall in full; 0: it falls as it is. Left
    /// out: a sixth of the year's ticks, rounded; where a year is a tick or two, none, for then the leaf is shown as in
    /// summer.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turns_in: Option<Quantity>,
    /// Of its stalk.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stalk: Option<ColourText>,
}

/// The colour of flowers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum FlowerChoice {
    /// One colour at every age.
    One(ColourText),
    /// Colours by age.
    Stages(FlowerColours),
}

/// The colours of a flower; what is left out is by kind and form.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FlowerColours {
    /// When it opens.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub young: Option<ColourText>,
    /// When it falls.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub old: Option<ColourText>,
    /// Of its stalk, its tube or its middle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stalk: Option<ColourText>,
}

/// The colour of fruits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum FruitChoice {
    /// One colour at every age.
    One(ColourText),
    /// Colours by age.
    Stages(FruitColours),
}

/// The colours of a fruit; what is left out is by kind and form.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FruitColours {
    /// When it sets.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub young: Option<ColourText>,
    /// Half-way through its life.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turning: Option<ColourText>,
    /// When it falls.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ripe: Option<ColourText>,
    /// Of its stalk or its cup.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stalk: Option<ColourText>,
}

impl ColourText {
    /// Red, green and blue, with a fault where the text is no colour.
    pub(crate) fn checked(&self, path: &Path, faults: &mut Vec<Fault>) -> Option<Colour> {
        let colour = self.rgb();
        if colour.is_none() {
            let found = format!("`{}` is no colour", self.0);
            faults.push(Fault::new(path, found, "`#` and six hexadecimal digits, such as \"#7a8646\""));
        }
        colour
    }
}

/// The colour under `key`, where it is stated.
pub(crate) fn stage(of: &Option<ColourText>, path: &Path, key: &str, faults: &mut Vec<Fault>) -> Option<Colour> {
    of.as_ref().and_then(|colour| colour.checked(&path.key(key), faults))
}

impl BarkChoice {
    /// The colours for drawing.
    pub(crate) fn bark(&self, path: &Path, faults: &mut Vec<Fault>) -> Bark {
        match self {
            Self::One(colour) => {
                let colour = colour.checked(path, faults);
                Bark { shoot: colour, young: colour, old: colour, ..Bark::default() }
            }
            Self::Stages(stages) => Bark {
                shoot: stage(&stages.shoot, path, "shoot", faults),
                young: stage(&stages.young, path, "young", faults),
                old: stage(&stages.old, path, "old", faults),
                dead: stage(&stages.dead, path, "dead", faults),
                forms_in: stages.forms_in.as_ref().map(Quantity::value),
                darkens_in: stages.darkens_in.as_ref().map(Quantity::value),
            },
        }
    }
}

impl LeafChoice {
    /// The paint of leaves; `turns_in` are the ticks over which they turn before their fall where none are stated.
    pub(crate) fn paint(stated: Option<&Self>, turns_in: u32, path: &Path, faults: &mut Vec<Fault>) -> OrganPaint {
        match stated {
            None => OrganPaint { turns_in, ..OrganPaint::default() },
            Some(Self::One(colour)) => {
                let colour = colour.checked(path, faults);
                OrganPaint { young: colour, old: colour, turns_in, ..OrganPaint::default() }
            }
            Some(Self::Stages(stages)) => OrganPaint {
                young: stage(&stages.young, path, "young", faults),
                old: stage(&stages.old, path, "old", faults),
                autumn: stage(&stages.autumn, path, "autumn", faults),
                stalk: stage(&stages.stalk, path, "stalk", faults),
                turns_in: stages.turns_in.as_ref().map_or(turns_in, Quantity::value),
                ..OrganPaint::default()
            },
        }
    }
}

/// The ticks over which leaves turn before they fall together, in a year of `year` ticks: a sixth of the year, rounded.
/// 0 where a tick is half a year or more: then the last tick of a leaf is its summer.
pub(crate) fn turning_of(year: u32) -> u32 {
    if year > 2 { (year + 3) / 6 } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_colour_is_six_hexadecimal_digits() {
        let rgb = |text: &str| ColourText(text.to_owned()).rgb();
        assert_eq!(rgb("#0aFf10"), Some([10, 255, 16]));
        for wrong in ["", "#", "0aff10", "#0aff1", "#0aff100", "#0agf10", "#+1+1+1", "#äöü", "red"] {
            assert_eq!(rgb(wrong), None, "{wrong}");
        }
    }
}
