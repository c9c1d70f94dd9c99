//! What a species file says of the species beside its growth model's parameters: names, sources, its tick and its year,
//! what was published of it.
//!
//! Absent: the model (`models`), and the two together (`species`).

use phytomer_law::fault::{Fault, Path};
use phytomer_law::{Constant, ValueRange};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::architectural_model::ArchitecturalModel;
use crate::published::{PUBLISHED, Published};

/// What a species file says beside the model's parameters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct About {
    /// The name of the species in this program: `coffee`.
    #[schemars(length(min = 1, max = 200))]
    pub name: String,
    /// The botanical name: *Coffea canephora* Pierre ex A.Froehner.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scientific_name: Option<String>,
    /// What people call it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub common_name: Option<String>,
    /// The architectural model that it follows (Hallé & Oldeman 1970).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub architectural_model: Option<ArchitecturalModel>,
    /// What the file describes, and how far it can be trusted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub description: Option<String>,
    /// Where the parameters come from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<String>,
    /// Another species whose keys hold where this file has none: a name, or a path as seen from this file.
    #[serde(default, skip_serializing)]
    #[schemars(length(min = 1))]
    pub inherits: Option<String>,
    /// What one tick of the clock is: "one month", "one growth season".
    #[schemars(length(min = 1))]
    pub tick: String,
    /// How many ticks make a year, where they do. Not drawn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Constant", extend("exclusiveMinimum" = 0, "maximum" = 100_000))]
    pub ticks_per_year: Option<Constant>,
    /// What has been published about the size and the life of such plants; `validate` grows a sample and holds it
    /// against the ranges. A species that inherits and states its own has none of its ancestors'.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub published: Vec<Published>,
    /// The age, in ticks, at which a plant shows its architecture: to which a species is grown that is named without a
    /// scenario, and at which `validate` looks at a sample of it. Left out: 100, or as much earlier as keeps a plant
    /// small.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 65_535))]
    pub shown_at: Option<u32>,
}

/// The ticks of a year.
const YEAR: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: 100_000.0, what: "ticks of a year" };

impl About {
    /// What the schema cannot say of it.
    pub(crate) fn faults(&self) -> Vec<Fault> {
        let path = Path::root().key(PUBLISHED);
        let published = self.published.iter().enumerate().flat_map(|(i, row)| row.faults(&path.index(i)));
        let path = Path::root().key("ticks_per_year");
        let year = self.ticks_per_year.as_ref().and_then(|ticks| ticks.within(&path, YEAR).err());
        year.into_iter().chain(published).collect()
    }
}
