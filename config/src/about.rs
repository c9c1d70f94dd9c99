//! General statements of a species file beside the parameters of its growth model: names, sources, the length of its
//! tick and its year, published sizes.
//!
//! Absent: the parameters (`models`), and a species as a whole (`species`).

use phytomer_law::fault::{Fault, Path};
use phytomer_law::{Constant, ValueRange};
use phytomer_looks::Flare;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::architectural_model::ArchitecturalModel;
use crate::material::{self, Material};
use crate::published::{PUBLISHED, Published};

/// The keys of a species file that do not belong to its growth model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct About {
    /// The name of the species in this program, such as `coffee`.
    #[schemars(length(min = 1, max = 200))]
    pub name: String,
    /// The botanical name, such as *Coffea canephora* Pierre ex A.Froehner.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scientific_name: Option<String>,
    /// The common name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub common_name: Option<String>,
    /// The architectural model of the species (Hallé & Oldeman 1970).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub architectural_model: Option<ArchitecturalModel>,
    /// What the file describes, and how reliable its parameters are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub description: Option<String>,
    /// Where the parameters come from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<String>,
    /// Another species, whose keys hold wherever this file has none: a name, or a path from the folder of this file.
    #[serde(default, skip_serializing)]
    #[schemars(length(min = 1))]
    pub inherits: Option<String>,
    /// The length of one tick in words, such as "one month" or "one growth season".
    #[schemars(length(min = 1))]
    pub tick: String,
    /// The number of ticks in a year, where a year is a number of ticks. A constant, not a distribution.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Constant", extend("exclusiveMinimum" = 0, "maximum" = 100_000))]
    pub ticks_per_year: Option<Constant>,
    /// The names of the ticks of a year, as many as `ticks_per_year` has, such as `["May", "summer", "autumn",
    /// "winter"]`; the first is that of the ages that are whole years. Films write them below the plant.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(inner(length(min = 1, max = 40)))]
    pub seasons: Vec<String>,
    /// Published sizes and survival of plants of this species. `validate` grows a sample and compares it with these
    /// ranges. A species that inherits and states its own ranges takes none from its ancestors.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub published: Vec<Published>,
    /// The age, in ticks, at which a plant shows its architecture. A species that is named without a scenario is grown
    /// to this age, and `validate` grows its sample to this age. If not given, 100 ticks, or fewer for a species that
    /// would grow large.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 65_535))]
    pub shown_at: Option<u32>,
    /// How the foot of the trunk widens into its roots, in meshes and pictures; tables have the wood without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub flare: Option<Flare>,
    /// The pictures that cover bark, leaves, flowers and fruits in meshes that hold textures.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 64))]
    pub material: Vec<Material>,
}

/// The allowed numbers of ticks in a year.
const YEAR: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: 100_000.0, what: "ticks of a year" };

impl About {
    /// The faults that the schema cannot state, each with its path in the species file.
    pub(crate) fn faults(&self) -> Vec<Fault> {
        let path = Path::root().key(PUBLISHED);
        let published = self.published.iter().enumerate().flat_map(|(i, row)| row.faults(&path.index(i)));
        let path = Path::root().key("ticks_per_year");
        let year = self.ticks_per_year.as_ref().and_then(|ticks| ticks.within(&path, YEAR).err());
        let materials = material::faults(&self.material);
        year.into_iter().chain(self.fault_of_seasons()).chain(published).chain(materials).collect()
    }

    fn fault_of_seasons(&self) -> Option<Fault> {
        let (path, count) = (Path::root().key("seasons"), self.seasons.len());
        let stated = self.ticks_per_year.as_ref().map(Constant::value);
        if count == 0 || stated == Some(count as f64) {
            return None;
        }
        let expected = match stated {
            Some(ticks) => format!("a name for each of the {ticks} ticks of `ticks_per_year`"),
            None => "`ticks_per_year` beside it, and a name for each of those ticks".to_owned(),
        };
        Some(Fault::new(&path, format!("there are {count} names"), expected))
    }

    /// The name of the tick of the year at an age, where the species names them.
    pub fn season(&self, age: u32) -> Option<&str> {
        let place = (age as usize).checked_rem(self.seasons.len())?;
        self.seasons.get(place).map(String::as_str)
    }
}
