//! A species: what it is called and where it is known from, and its growth model with the model's parameters.
//!
//! In a file the model's keys stand at the top level beside `name` (`[[order]]`, not `[[buds.order]]`): the key `model`
//! is read first and chooses the schema, so that unknown keys are found as exactly as in a nested table.
//! Absent: the list of models (`models`), their parameters, which each model documents beside its formulas, and reading
//! files (`load`).

use std::sync::OnceLock;

use phytomer_law::Constant;
use serde_json::{Map, Value as Json};

use crate::about::About;
use crate::models::{Model, ModelName};
use crate::schema::of_type;

/// A species, complete: inheritance is resolved.
#[derive(Debug, Clone, PartialEq)]
pub struct Species {
    /// What it is called, and where it is known from.
    pub about: About,
    /// How it grows.
    pub model: Model,
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
