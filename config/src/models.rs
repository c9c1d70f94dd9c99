//! Every growth model that a species file can name, and the schema of its keys.
//!
//! A new model is one line in [`registry!`]; its keys, schema and compiled form come from its type of parameters
//! ([`phytomer_models::parameters`]). Absent: anything that depends on the keys of a single model.

use std::sync::{Arc, OnceLock};

use phytomer_law::Variable;
use phytomer_law::fault::{Fault, Path};
use phytomer_models::parameters::{Card, Levelled, Parameters, Surroundings};
use phytomer_sim::model::GrowthModel;
use phytomer_sim::site::calendar::Dates;
use serde_json::{Value as Json, json};

use crate::about::About;
use crate::schema::{join, of_type, partial, resolve};

/// Makes the enums of the models from one line per model: the name of its variant, and the type of its parameters.
macro_rules! registry {
    ($($name:ident: $parameters:ty,)+) => {
        /// Every growth model, with its parameters.
        #[derive(Debug, Clone, PartialEq)]
        pub enum Model {
            $(#[doc = concat!("[`", stringify!($parameters), "`]")] $name($parameters),)+
        }

        /// The names of the models, as the key `model` takes them.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum ModelName {
            $(#[doc = concat!("That of [`", stringify!($parameters), "`].")] $name,)+
        }

        /// Every model, in the order of the lists that people see.
        pub const MODELS: [ModelName; [$(ModelName::$name),+].len()] = [$(ModelName::$name),+];

        impl ModelName {
            /// The model's card: the word that names it, and the roles of its keys.
            pub fn card(self) -> &'static Card {
                match self {
                    $(ModelName::$name => &<$parameters>::CARD,)+
                }
            }

            fn parameters(self) -> Json {
                match self {
                    $(ModelName::$name => of_type::<$parameters>(),)+
                }
            }

            /// Reads the parameters from the model's keys of a species.
            ///
            /// # Errors
            /// Where serde refuses the keys; keys that the schema has passed are read.
            pub fn read(self, keys: Json) -> Result<Model, serde_path_to_error::Error<serde_json::Error>> {
                match self {
                    $(ModelName::$name => serde_path_to_error::deserialize(keys).map(Model::$name),)+
                }
            }
        }

        impl Model {
            /// The model's name.
            pub fn name(&self) -> ModelName {
                match self {
                    $(Model::$name(_) => ModelName::$name,)+
                }
            }

            fn parameters(&self) -> &dyn Parameters {
                match self {
                    $(Model::$name(parameters) => parameters,)+
                }
            }

            fn parameters_mut(&mut self) -> &mut dyn Parameters {
                match self {
                    $(Model::$name(parameters) => parameters,)+
                }
            }

            pub(crate) fn to_json(&self) -> serde_json::Result<Json> {
                match self {
                    $(Model::$name(parameters) => serde_json::to_value(parameters),)+
                }
            }
        }
    };
}

registry! {
    Buds: phytomer_models::buds::Buds,
    Cohen: phytomer_models::cellular::Cohen,
    Gmt1: phytomer_models::geometric::Gmt1,
    Gmt2: phytomer_models::geometric::Gmt2,
    Gmt3: phytomer_models::geometric::Gmt3,
    Gmt4: phytomer_models::geometric::Gmt4,
    Greene: phytomer_models::cellular::Greene,
    Lsystem: phytomer_models::lsystem::Lsystem,
    Parametric: phytomer_models::parametric::Tree,
    Ulam: phytomer_models::cellular::Ulam,
}

/// What the models of a species depend on beside its own parameters.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Reads {
    /// Whether its laws may depend on the date.
    pub dates: bool,
    /// Whether it reads what the scenario states for its species.
    pub surroundings: bool,
}

impl ModelName {
    /// The model as the key `model` takes it.
    pub fn word(self) -> &'static str {
        self.card().word
    }

    /// The model with the word `word`; `None` where there is none.
    pub fn from_word(word: &str) -> Option<Self> {
        MODELS.into_iter().find(|model| model.word() == word)
    }

    /// The defaults of a table that merges by place, such as `[[order]]`: its values where a file leaves out every
    /// optional key. `None` for a model without such tables.
    pub fn default_table(self) -> Option<Json> {
        let list = self.card().keys.by_place.as_ref()?.list;
        let model = self.read(json!({list: [{}]})).ok()?;
        model.to_json().ok()?.get_mut(list)?.get_mut(0).map(Json::take)
    }

    /// The JSON Schema of a complete species of this model. Made at the first call and kept.
    pub fn schema(self) -> &'static Json {
        static SCHEMAS: [OnceLock<Json>; MODELS.len()] = [const { OnceLock::new() }; MODELS.len()];
        SCHEMAS[self as usize].get_or_init(|| complete(self))
    }

    /// The JSON Schema of one file of a species of this model: no key is required, since ancestors may state it, and
    /// keys may stand in the table for all tables that merge by place. Made at the first call and kept.
    pub fn file_schema(self) -> &'static Json {
        static SCHEMAS: [OnceLock<Json>; MODELS.len()] = [const { OnceLock::new() }; MODELS.len()];
        SCHEMAS[self as usize].get_or_init(|| one_file(self))
    }
}

impl Model {
    /// Compiles the model for all ages up to `until`, in ticks, and checks every law over its whole range. A law that
    /// names the date is a fault: see [`Model::compile_dated`].
    ///
    /// # Errors
    /// Every fault, each with its path from the top of the species file.
    pub fn compile(&self, until: u32) -> Result<Arc<dyn GrowthModel>, Vec<Fault>> {
        self.compile_dated(until, None)
    }

    /// As [`Model::compile`], for a plant whose ages have these dates.
    ///
    /// # Errors
    /// Every fault, each with its path from the top of the species file.
    pub fn compile_dated(&self, until: u32, dates: Option<&Dates>) -> Result<Arc<dyn GrowthModel>, Vec<Fault>> {
        self.parameters().model(until, dates, &Path::root())
    }

    /// Whether a law may depend on the date: a parameter has the name of a variable of the date, in `over` or in an
    /// expression. A word of the parameters' texts is enough. Where the word has another meaning there, the model is
    /// compiled for each calendar without need, and the species cannot be that of a successor in a run with a calendar.
    pub(crate) fn may_know_the_date(&self) -> bool {
        let names = Variable::ALL.into_iter().filter(|variable| variable.is_of_the_date()).map(Variable::name);
        let names: Vec<&str> = names.collect();
        self.to_json().map_or(true, |parameters| has_word(&parameters, &names))
    }

    /// As [`Parameters::reads_surroundings`].
    pub(crate) fn reads_surroundings(&self) -> bool {
        self.parameters().reads_surroundings()
    }

    /// What the models of a species with these parameters depend on beside them.
    pub(crate) fn reads(&self) -> Reads {
        Reads { dates: self.may_know_the_date(), surroundings: self.reads_surroundings() }
    }

    /// The model in these surroundings: what a scenario states stands in place of what the species states under the
    /// same names.
    pub fn surrounded(&self, surroundings: &Surroundings) -> Self {
        let mut model = self.clone();
        model.parameters_mut().surround(surroundings);
        model
    }

    /// As [`Parameters::own_forms`].
    pub fn own_forms(&self) -> Vec<(Path, &str)> {
        self.parameters().own_forms()
    }

    /// As [`Parameters::state_area_shares`].
    pub fn state_area_shares(&mut self, share: impl Fn(usize) -> Option<f64>) -> bool {
        self.parameters_mut().state_area_shares(&share)
    }

    /// As [`Parameters::levelled`].
    pub fn levelled(&self, age: u32) -> Option<Levelled> {
        self.parameters().levelled(age)
    }

    /// As [`Parameters::set_quality`].
    pub fn set_quality(&mut self, quality: f64) -> bool {
        self.parameters_mut().set_quality(quality)
    }

    /// As [`Parameters::full_grown_at`].
    pub fn full_grown_at(&self) -> Option<u32> {
        self.parameters().full_grown_at()
    }

    /// As [`Parameters::states`].
    pub fn states(&self) -> &[String] {
        self.parameters().states()
    }

    /// As [`Parameters::year`].
    pub(crate) fn year(&self) -> Option<(Path, u32)> {
        self.parameters().year()
    }
}

/// Whether any text in a value has one of the words.
fn has_word(value: &Json, words: &[&str]) -> bool {
    let is_in_name = |character: char| character.is_alphanumeric() || character == '_';
    match value {
        Json::String(text) => text.split(|character| !is_in_name(character)).any(|word| words.contains(&word)),
        Json::Array(items) => items.iter().any(|item| has_word(item, words)),
        // Neither a citation nor the text of an L-system is a law.
        Json::Object(keys) => {
            let says = |(key, value): (&String, &Json)| key != "source" && key != "texts" && has_word(value, words);
            keys.iter().any(says)
        }
        _ => false,
    }
}

fn complete(model: ModelName) -> Json {
    let mut schema = of_type::<About>();
    join(&mut schema, &model.parameters());
    let says = "The growth model, which decides the other keys.";
    schema["properties"]["model"] = json!({"type": "string", "const": model.word(), "description": says});
    schema["title"] = format!("A phytomer species of the model {}", model.word()).into();
    let listed = model.card().keys.by_place.as_ref().map(|tables| tables.list);
    for key in ["model"].into_iter().chain(listed) {
        let known = schema["properties"].get(key).is_some();
        let required = schema["required"].as_array_mut().filter(|r| known && !r.contains(&key.into()));
        required.into_iter().for_each(|r| r.push(key.into()));
    }
    schema["additionalProperties"] = false.into();
    schema
}

fn one_file(model: ModelName) -> Json {
    let Some(tables) = &model.card().keys.by_place else { return partial(model.schema(), None) };
    let mut schema = partial(model.schema(), Some(tables.list));
    let item = schema["properties"][tables.list].get("items").and_then(|items| resolve(&schema, items)).cloned();
    if let Some(mut every) = item {
        every["description"] = format!("What holds for each [[{}]] that does not say otherwise.", tables.list).into();
        schema["properties"][tables.every] = every;
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
