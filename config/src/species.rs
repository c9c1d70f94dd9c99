//! A species: its names and sources, and its growth model with the model's parameters.
//!
//! In a file the model's keys stand at the top level beside `name` (`[[order]]`, not `[[buds.order]]`). The key `model`
//! is read first and chooses the schema, so that unknown keys are found as exactly as in a nested table. Absent: the
//! list of models (`models`), their parameters, which each model documents beside its formulas, and reading files
//! (`load`).

use std::sync::OnceLock;

use phytomer_law::Constant;
use serde_json::{Map, Value as Json};

use crate::about::About;
use crate::models::{Model, ModelName, Reads};
use crate::schema::of_type;

/// A complete species, with its inheritance resolved.
#[derive(Debug, Clone, PartialEq)]
pub struct Species {
    /// Names, sources, tick and published sizes.
    pub about: About,
    /// The growth model with its parameters.
    pub model: Model,
}

impl Species {
    /// The number of ticks in a year: the stated `ticks_per_year`, else the year of the season; a checked species has
    /// no differing values. `None` where the species states neither.
    pub fn ticks_per_year(&self) -> Option<f64> {
        let stated = self.about.ticks_per_year.as_ref().map(Constant::value);
        stated.or_else(|| self.model.year().map(|(_, ticks)| ticks.into()))
    }

    /// Whether a law of the species may depend on the date.
    pub fn may_know_the_date(&self) -> bool {
        self.model.may_know_the_date()
    }

    /// What its models depend on beside its own parameters.
    pub fn reads(&self) -> Reads {
        self.model.reads()
    }

    /// Whether it is an L-system of a file, which has constants and calls shapes.
    pub fn reads_surroundings(&self) -> bool {
        self.model.reads_surroundings()
    }

    /// The species as JSON, with the keys of a species file without ancestors.
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

    /// Reads the species from the JSON of [`Species::to_json`], as `run.json` holds it.
    ///
    /// # Errors
    /// Where the JSON is not that of a species. The laws of the species are not checked; [`Model::compile`] does.
    pub fn from_json(json: &Json) -> serde_json::Result<Self> {
        let word = json["model"].as_str().and_then(ModelName::from_word);
        let unknown = || <serde_json::Error as serde::de::Error>::custom("a species of an unknown model");
        let (about, parameters) = split(json.clone());
        let model = word.ok_or_else(unknown)?.read(parameters).map_err(serde_path_to_error::Error::into_inner)?;
        Ok(Self { about: serde_json::from_value(about)?, model })
    }

    /// The species as the TOML text of a species file without ancestors.
    ///
    /// # Errors
    /// A value that TOML cannot hold, which no checked species has.
    pub fn to_toml(&self) -> Result<String, toml::ser::Error> {
        let json = self.to_json().map_err(<toml::ser::Error as serde::ser::Error>::custom)?;
        toml::to_string(&json)
    }
}

/// The keys of [`About`] in a species' table, and the keys of the model.
pub(crate) fn split(species: Json) -> (Json, Json) {
    static ABOUT: OnceLock<Json> = OnceLock::new();
    let schema = ABOUT.get_or_init(of_type::<About>);
    let Json::Object(mut keys) = species else { return (Json::Null, Json::Null) };
    keys.remove("model");
    let (about, model): (Map<_, _>, Map<_, _>) =
        keys.into_iter().partition(|(key, _)| schema["properties"].get(key).is_some());
    (about.into(), model.into())
}
