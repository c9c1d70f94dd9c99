//! A species: who it is, and its growth model with the model's parameters.
//!
//! [`Model`] is the one enum that names every model; a new model is one variant here. In a file the model's keys stand
//! at the top level beside `name` (`[[order]]`, not `[[buds.order]]`): the key `model` is read first and chooses the
//! schema, so that unknown keys are found as exactly as in a nested table.
//! Absent: the parameters, which each model documents beside its formulas, and reading files (`load`).

use std::sync::{Arc, OnceLock};

use phytomer_models::buds::Buds;
use phytomer_models::fault::{Fault, Path};
use phytomer_models::geometric::Gmt1;
use phytomer_models::law::{Constant, ValueRange};
use phytomer_sim::model::GrowthModel;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value as Json, json};

use crate::architectural_model::ArchitecturalModel;
use crate::inherit::{EVERY_ORDER, ORDER};
use crate::published::{PUBLISHED, Published};
use crate::schema::{join, of_type, partial, resolve};

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

/// Every growth model, with its parameters.
#[derive(Debug, Clone, PartialEq)]
pub enum Model {
    /// The bud model of de Reffye et al. 1988.
    Buds(Buds),
    /// The geometric model GMT1 of Aono & Kunii 1984.
    Gmt1(Gmt1),
}

/// The names of the models, as the key `model` takes them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModelName {
    /// `buds`
    Buds,
    /// `gmt1`
    Gmt1,
}

/// Every model, in the order of the lists that people see.
pub const MODELS: [ModelName; 2] = [ModelName::Buds, ModelName::Gmt1];

impl ModelName {
    /// The word of the key `model`.
    pub fn word(self) -> &'static str {
        match self {
            ModelName::Buds => "buds",
            ModelName::Gmt1 => "gmt1",
        }
    }

    /// The model of that word.
    pub fn from_word(word: &str) -> Option<Self> {
        MODELS.into_iter().find(|model| model.word() == word)
    }

    fn parameters(self) -> Json {
        match self {
            ModelName::Buds => of_type::<Buds>(),
            ModelName::Gmt1 => of_type::<Gmt1>(),
        }
    }

    /// The parameters from their keys.
    ///
    /// # Errors
    /// What serde says of keys that the schema would have refused.
    pub fn read(self, keys: Json) -> Result<Model, serde_path_to_error::Error<serde_json::Error>> {
        match self {
            ModelName::Buds => serde_path_to_error::deserialize(keys).map(Model::Buds),
            ModelName::Gmt1 => serde_path_to_error::deserialize(keys).map(Model::Gmt1),
        }
    }

    /// The schema of a complete species of this model.
    pub fn schema(self) -> &'static Json {
        static SCHEMAS: [OnceLock<Json>; MODELS.len()] = [const { OnceLock::new() }; MODELS.len()];
        SCHEMAS[self as usize].get_or_init(|| complete(self))
    }

    /// The schema of one file of this model, which may leave keys to its ancestors and share them between orders.
    pub fn file_schema(self) -> &'static Json {
        static SCHEMAS: [OnceLock<Json>; MODELS.len()] = [const { OnceLock::new() }; MODELS.len()];
        SCHEMAS[self as usize].get_or_init(|| one_file(self))
    }
}

impl Model {
    /// The model's name.
    pub fn name(&self) -> ModelName {
        match self {
            Model::Buds(_) => ModelName::Buds,
            Model::Gmt1(_) => ModelName::Gmt1,
        }
    }

    /// The model compiled for all ages up to `until`, every law checked over its whole range.
    ///
    /// # Errors
    /// Every fault that there is, each with its path from the top of the species file.
    pub fn compile(&self, until: u32) -> Result<Arc<dyn GrowthModel>, Vec<Fault>> {
        let top = Path::root();
        match self {
            Model::Buds(buds) => Ok(Arc::new(buds.compile(until, &top)?)),
            Model::Gmt1(gmt1) => Ok(Arc::new(gmt1.compile(until, &top)?)),
        }
    }

    /// The files of the meshes that it names as forms, each once, in the order of their numbers, with the place of the
    /// first mention.
    pub fn own_forms(&self) -> Vec<(Path, &str)> {
        match self {
            Model::Buds(buds) => buds.own_forms(),
            Model::Gmt1(_) => Vec::new(),
        }
    }

    /// The ticks of a year that its own parameters state, with the place.
    pub(crate) fn year(&self) -> Option<(Path, u32)> {
        match self {
            Model::Buds(buds) => buds
                .season
                .as_ref()
                .map(|season| (Path::root().key("season").key("ticks_per_year"), season.ticks_per_year.value())),
            Model::Gmt1(_) => None,
        }
    }

    /// States the area share of leaves that are drawn with a mesh of the user's and state none, as `share` tells it by
    /// the mesh's number. Whether there is any such leaf; the model is then to be compiled again.
    pub fn state_area_shares(&mut self, share: impl Fn(usize) -> Option<f64>) -> bool {
        match self {
            Model::Buds(buds) => buds.state_area_shares(share),
            Model::Gmt1(_) => false,
        }
    }

    fn to_json(&self) -> serde_json::Result<Json> {
        match self {
            Model::Buds(buds) => serde_json::to_value(buds),
            Model::Gmt1(gmt1) => serde_json::to_value(gmt1),
        }
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

fn complete(model: ModelName) -> Json {
    let mut schema = of_type::<About>();
    join(&mut schema, &model.parameters());
    let says = "The growth model, which decides the other keys.";
    schema["properties"]["model"] = json!({"type": "string", "const": model.word(), "description": says});
    schema["title"] = format!("A phytomer species of the model {}", model.word()).into();
    for key in ["model", ORDER] {
        let known = schema["properties"].get(key).is_some();
        let required = schema["required"].as_array_mut().filter(|r| known && !r.contains(&key.into()));
        required.into_iter().for_each(|r| r.push(key.into()));
    }
    schema["additionalProperties"] = false.into();
    schema
}

fn one_file(model: ModelName) -> Json {
    let mut schema = partial(model.schema(), ORDER);
    let order = schema["properties"][ORDER].get("items").and_then(|items| resolve(&schema, items)).cloned();
    if let Some(mut order) = order {
        order["description"] = "What holds for each [[order]] that does not say otherwise.".into();
        schema["properties"][EVERY_ORDER] = order;
    }
    schema
}

/// The schema of a species file of any model, for editors.
pub(crate) fn any_file() -> Json {
    let mut any = json!({
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "A phytomer species",
        "type": "object",
        "definitions": {},
        "anyOf": [],
    });
    for model in MODELS {
        let mut schema = model.file_schema().clone();
        join(&mut any, &json!({"definitions": schema["definitions"]}));
        if let (Some(keys), Some(forms)) = (schema.as_object_mut(), any["anyOf"].as_array_mut()) {
            keys.retain(|key, _| key != "definitions" && key != "$schema");
            forms.push(schema);
        }
    }
    any
}
