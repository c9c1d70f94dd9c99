//! A species: who it is, and its growth model with the model's parameters.
//!
//! In a file the model's keys stand at the top level beside `name` (`[[order]]`, not `[[buds.order]]`): the key `model`
//! is read first and chooses the schema, so that unknown keys are found as exactly as in a nested table.
//! Absent: the list of models (`models`), their parameters, which each model documents beside its formulas, and reading
//! files (`load`).

use std::sync::OnceLock;

use phytomer_models::fault::{Fault, Path};
use phytomer_models::law::{Constant, ValueRange};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value as Json};

use crate::architectural_model::ArchitecturalModel;
use crate::models::{Model, ModelName};
use crate::published::{PUBLISHED, Published};
use crate::schema::of_type;

/// A species, complete: inheritance is resolved.
#[derive(Debug, Clone, PartialEq)]
pub struct Species {
    /// Who it is.
    pub about: About,
    /// How it grows.
    pub model: Model,
}

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

impl Species {
    /// How many ticks make a year: as the species states, else as its season does, which a checked species states
    /// alike.
    pub fn ticks_per_year(&self) -> Option<f64> {
        let stated = self.about.ticks_per_year.as_ref().map(Constant::value);
        stated.or_else(|| self.model.year().map(|(_, ticks)| ticks.into()))
    }

    /// The species as one file without ancestors would state it.
    ///
    /// # Errors
    /// A number that JSON cannot hold, which no checked species has.
    pub fn to_json(&self) -> serde_json::Result<Json> {
        let mut json = serde_json::to_value(&self.about)?;
        json["model"] = self.model.name().word().into();
        if let (Some(keys), Json::Object(parameters)) = (json.as_object_mut(), self.model.to_json()?) {
            keys.extend(parameters);
        }
        Ok(json)
    }

    /// The species that [`Species::to_json`] has written, as `run.json` keeps it.
    ///
    /// # Errors
    /// Where it is no such species; that its laws make sense is told by [`Model::compile`].
    pub fn from_json(json: &Json) -> serde_json::Result<Self> {
        let word = json["model"].as_str().and_then(ModelName::from_word);
        let unknown = || <serde_json::Error as serde::de::Error>::custom("a species of an unknown model");
        let (about, parameters) = split(json.clone());
        let model = word.ok_or_else(unknown)?.read(parameters).map_err(serde_path_to_error::Error::into_inner)?;
        Ok(Self { about: serde_json::from_value(about)?, model })
    }

    /// The same as TOML.
    ///
    /// # Errors
    /// A value that TOML cannot hold, which no checked species has.
    pub fn to_toml(&self) -> Result<String, toml::ser::Error> {
        let json = self.to_json().map_err(<toml::ser::Error as serde::ser::Error>::custom)?;
        toml::to_string(&json)
    }
}

/// The keys of [`About`] in a species' table, apart from the model's.
pub(crate) fn split(species: Json) -> (Json, Json) {
    static ABOUT: OnceLock<Json> = OnceLock::new();
    let schema = ABOUT.get_or_init(of_type::<About>);
    let Json::Object(mut keys) = species else { return (Json::Null, Json::Null) };
    keys.remove("model");
    let (about, model): (Map<_, _>, Map<_, _>) =
        keys.into_iter().partition(|(key, _)| schema["properties"].get(key).is_some());
    (about.into(), model.into())
}
