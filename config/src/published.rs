//! What has been published about a species' size and life at one age, in ranges that grown plants must fall into.
//!
//! Floras and yield tables say how tall and wide a plant of an age is, how many leaves it carries and how many of those
//! sown still live. A species file states such ranges in `[[published]]`; `validate` grows a sample and holds it
//! against them. Absent: the growing and the measuring, which the root package does (`phytomer::sample`).

use phytomer_law::fault::{Fault, Path};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The key of the list in a species file.
pub const PUBLISHED: &str = "published";

/// The least and the largest of what was published.
pub type Range = [f64; 2];

/// Published ranges of plants of one age. A range is of the mean over the living plants of a sample, but for `living`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Published {
    /// The age that the ranges are of, ticks since the seed.
    #[schemars(range(min = 1, max = 65_535))]
    pub at_age: u32,
    /// Height, m: the least and the largest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0)))]
    pub height_m: Option<Range>,
    /// The mean of the crown's two widths, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0)))]
    pub crown_width_m: Option<Range>,
    /// Leaves on the plant.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0)))]
    pub leaves: Option<Range>,
    /// The area of one side of all its leaves, m².
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0)))]
    pub leaf_area_m2: Option<Range>,
    /// The share of the plants sown that live, in [0, 1].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0, max = 1)))]
    pub living: Option<Range>,
    /// Where the ranges come from.
    #[schemars(length(min = 1))]
    pub source: String,
}

/// What a range is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// Height, m.
    Height,
    /// Crown width, m.
    CrownWidth,
    /// Leaves.
    Leaves,
    /// Leaf area, m².
    LeafArea,
    /// The share that lives.
    Living,
}

impl Measure {
    /// The key of its range in a species file.
    pub fn key(self) -> &'static str {
        match self {
            Self::Height => "height_m",
            Self::CrownWidth => "crown_width_m",
            Self::Leaves => "leaves",
            Self::LeafArea => "leaf_area_m2",
            Self::Living => "living",
        }
    }

    /// What people call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Height => "height",
            Self::CrownWidth => "crown width",
            Self::Leaves => "number of leaves",
            Self::LeafArea => "leaf area",
            Self::Living => "share that lives",
        }
    }

    /// Its unit with a space before it; nothing where it has none.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Height | Self::CrownWidth => " m",
            Self::LeafArea => " m²",
            Self::Leaves | Self::Living => "",
        }
    }
}

impl Published {
    /// The ranges that are stated.
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

    /// What the schema cannot say: ranges are the right way round, and there is one.
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
