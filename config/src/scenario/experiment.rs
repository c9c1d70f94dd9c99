//! The experiment of a run: factors with their levels, which of their combinations are grown, and the replicates.
//!
//! A level is a table of scenario keys that are laid over the scenario, so a factor can be anything that a scenario
//! states, and a level may set several things at once (a site is a weather and a soil). A treatment is the scenario
//! with one level of each factor laid over it. Which treatments there are stands in `combine`. Absent: laying levels
//! over the scenario, which is done on the tree of the file (`expansion`), and the numbers of plots (`trial`).

mod combine;

pub(crate) use combine::{Chosen, JOINED};

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value as Json};

/// The name of the one treatment of a run that compares none.
pub const CONTROL: &str = "control";

/// The most treatments of a run: those of twelve factors of two levels.
pub const MOST_TREATMENTS: u64 = 4096;

/// The most field plots of a run, treatments × replicates.
pub const MOST_FIELD_PLOTS: u64 = 1_000_000;

/// The keys of a scenario that are those of the whole run, which no level can set.
pub const OF_THE_RUN: [&str; 10] =
    ["name", "description", "seed", "ages", "tables", "sample", "meshes", "limits", "output", "experiment"];

/// The treatments that a run compares, and how often each is repeated.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Experiment {
    /// How treatments are dealt to the places of the field (ICASA `experimental_design`): `completely_randomised`, or
    /// `randomised_blocks`, in which each replicate is a block that has each treatment once. Completely randomised if
    /// not given.
    pub experimental_design: Design,
    /// How often each treatment is repeated. Once if not given.
    #[schemars(range(min = 1, max = 100_000))]
    pub replicates: u32,
    /// The factors, as `[[experiment.factor]]`. Each combination of their levels is a treatment, unless `combination`
    /// names the treatments.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub factor: Vec<Factor>,
    /// The treatments, as `[[experiment.combination]]`. If not given, all combinations of the levels of all factors.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub combination: Vec<Combination>,
    /// Combinations of the full factorial that are not grown, each a table of factors and their levels: all treatments
    /// with these levels are left out.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(inner(length(min = 1)))]
    pub skip: Vec<BTreeMap<String, String>>,
}

/// How treatments are dealt to the places of the field.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Design {
    /// Any treatment and replicate at any place.
    #[default]
    CompletelyRandomised,
    /// Each replicate is a block: neighbouring places that hold each treatment once.
    RandomisedBlocks,
}

/// A factor: what the treatments differ in.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Factor {
    /// The name of the factor, and of its column in the table `treatments`: letters, digits and `_`.
    #[schemars(length(min = 1, max = 60))]
    pub name: String,
    /// The level of combinations that do not name the factor. The first level if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub default: Option<String>,
    /// The levels, as `[[experiment.factor.level]]` or as a list of tables.
    #[schemars(length(min = 1))]
    pub level: Vec<Level>,
}

/// A level of a factor: its name, and the keys that it lays over the scenario.
///
/// Tables are merged key by key; any other value, and a list, takes the place of the scenario's. Only `event`,
/// `fertilizer` and `pest` are joined with those of the scenario and of other factors, and a pest with the name of one
/// of these changes the keys that it states.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Level {
    /// The name of the level.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// The keys that it lays over the scenario.
    #[serde(flatten)]
    pub sets: Map<String, Json>,
}

/// A treatment by its name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Combination {
    /// The name of the treatment.
    #[schemars(length(min = 1, max = 200))]
    pub name: String,
    /// Another combination, whose levels this one has where it names none of its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub like: Option<String>,
    /// The level of each factor. A factor that neither this table nor `like` names has its default level.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub levels: BTreeMap<String, String>,
}

impl Default for Experiment {
    fn default() -> Self {
        Self {
            experimental_design: Design::default(),
            replicates: 1,
            factor: Vec::new(),
            combination: Vec::new(),
            skip: Vec::new(),
        }
    }
}

impl Experiment {
    /// Whether the run compares nothing and repeats nothing.
    pub(super) fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// Whether the run has one treatment, the scenario as it stands.
    pub fn is_control_alone(&self) -> bool {
        self.factor.is_empty() && self.combination.is_empty()
    }

    /// The names of the levels of a treatment, one for each factor, by their indices.
    pub(crate) fn level_names(&self, levels: &[usize]) -> Vec<String> {
        let levels = self.factor.iter().zip(levels).filter_map(|(factor, level)| factor.level.get(*level));
        levels.map(|level| level.name.clone()).collect()
    }

    /// The block of a replicate; `None` where the design has no blocks.
    pub fn block_of(&self, replicate: u32) -> Option<u32> {
        (self.experimental_design == Design::RandomisedBlocks).then_some(replicate)
    }
}

/// States in the JSON Schema of a scenario which keys a level may set. A table is merged with the scenario's, and a
/// pest with one of its name, so both are checked as a whole in their treatments.
pub(crate) fn state_levels(schema: &mut Json) {
    let Some(keys) = schema["properties"].as_object().cloned() else { return };
    let is_table = |property: &Json| {
        let reference = property["$ref"].as_str().or_else(|| property["allOf"][0]["$ref"].as_str());
        let target = reference.and_then(|reference| schema.pointer(reference.strip_prefix('#')?));
        target.is_some_and(|target| target["type"] == "object")
    };
    let of_level = |(key, property): (String, Json)| {
        let whole = serde_json::json!({"description": property["description"], "type": "object"});
        (key, if is_table(&property) { whole } else { property })
    };
    let settable = keys.into_iter().filter(|(key, _)| !OF_THE_RUN.contains(&key.as_str()));
    let settable: Map<String, Json> = settable.map(of_level).collect();
    let mut changed_pest = schema["definitions"]["Pest"].clone();
    changed_pest["required"] = serde_json::json!(["name"]);
    let mut genotype = settable.get("species").cloned().unwrap_or_default();
    genotype["description"] = "The species of the level, by the name that ICASA gives this key.".into();
    let Some(level) = schema.pointer_mut("/definitions/Level").and_then(Json::as_object_mut) else { return };
    level.insert("additionalProperties".to_owned(), false.into());
    if let Some(properties) = level.get_mut("properties").and_then(Json::as_object_mut) {
        properties.extend(settable);
        properties.insert("genotype_name".to_owned(), genotype);
        if let Some(pests) = properties.get_mut("pest") {
            pests["items"] = changed_pest;
        }
    }
}
