//! Published sizes and survival of a species at one age, as ranges that grown plants must fall into.
//!
//! Floras and yield tables tell how tall and wide a plant of an age is, how many leaves it carries, and how many of the
//! plants that were sown still live. A species file states such ranges in `[[published]]`; `validate` grows a sample
//! and compares it with them. Absent: growing and measuring the sample (`phytomer::sample` in the root package).

use phytomer_law::fault::{Fault, Path};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The key of the list in a species file.
pub const PUBLISHED: &str = "published";

/// The smallest and the largest published value.
pub type Range = [f64; 2];

/// Published ranges for plants of one age. Each is a range of the mean over the living plants of a sample; `living` is
/// a share of all plants.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Published {
    /// The age of the plants, ticks since the seed.
    #[schemars(range(min = 1, max = 65_535))]
    pub at_age: u32,
    /// Height, m: the smallest and the largest value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0)))]
    pub height_m: Option<Range>,
    /// Crown width, m, the mean of the crown's two widths: the smallest and the largest value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0)))]
    pub crown_width_m: Option<Range>,
    /// Number of leaves on the plant: the smallest and the largest value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0)))]
    pub leaves: Option<Range>,
    /// Area of one side of all leaves of the plant, m²: the smallest and the largest value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0)))]
    pub leaf_area_m2: Option<Range>,
    /// Share of the sown plants that live, in [0, 1]: the smallest and the largest value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0, max = 1)))]
    pub living: Option<Range>,
    /// The publication that the ranges come from.
    #[schemars(length(min = 1))]
    pub source: String,
}

/// A measured quantity with a published range.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// Height, m.
    Height,
    /// Crown width, m.
    CrownWidth,
    /// Number of leaves.
    Leaves,
    /// Leaf area, m².
    LeafArea,
    /// The share of the sown plants that live.
    Living,
}

impl Measure {
    /// The key of the quantity in a species file.
    pub fn key(self) -> &'static str {
        match self {
            Self::Height => "height_m",
            Self::CrownWidth => "crown_width_m",
            Self::Leaves => "leaves",
            Self::LeafArea => "leaf_area_m2",
            Self::Living => "living",
        }
    }

    /// The name of the quantity in messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Height => "height",
            Self::CrownWidth => "crown width",
            Self::Leaves => "number of leaves",
            Self::LeafArea => "leaf area",
            Self::Living => "share that lives",
        }
    }

    /// The unit with a space before it; empty for a number or a share.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Height | Self::CrownWidth => " m",
            Self::LeafArea => " m²",
            Self::Leaves | Self::Living => "",
        }
    }
}

impl Published {
    /// The stated ranges, each with its quantity.
    pub fn ranges(&self) -> impl Iterator<Item = (Measure, Range)> + use<> {
        let all = [
            (Measure::Height, self.height_m),
            (Measure::CrownWidth, self.crown_width_m),
            (Measure::Leaves, self.leaves),
            (Measure::LeafArea, self.leaf_area_m2),
            (Measure::Living, self.living),
        ];
        all.into_iter().filter_map(|(measure, range)| Some((measure, range?)))
    }

    /// The faults that the schema cannot state: a range that is the wrong way round, or no range at all.
    pub(crate) fn faults(&self, path: &Path) -> Vec<Fault> {
        let mut faults = Vec::new();
        for (measure, [least, most]) in self.ranges().filter(|(_, [least, most])| least > most) {
            let problem = format!("the least, {least}, is above the largest, {most}");
            faults.push(Fault::new(&path.key(measure.key()), problem, "the least, then the largest"));
        }
        if self.ranges().next().is_none() {
            let problem = "it states no range";
            faults.push(Fault::new(path, problem, "one of height_m, crown_width_m, leaves, leaf_area_m2, living"));
        }
        faults
    }
}
