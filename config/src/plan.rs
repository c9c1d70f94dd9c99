//! A plan of a piece of ground: zones, buildings and trees under the sun of a place, and what may be planted (the
//! space planning of Aono & Kunii 1984).
//!
//! [`plan`] reads and checks the file with all its species. Absent: hours of shade (`phytomer_shade`), and growing the
//! trees. What contradicts itself in a plan is found by `faults`, and what a polygon must be by `polygon`.

mod faults;
mod polygon;

use std::sync::OnceLock;

use phytomer_law::fault::{self, Path};
use phytomer_models::parameters::{Keys, Surroundings};
use phytomer_sim::clock::LAST_TICK;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value as Json;

use crate::about::About;
use crate::document::Node;
use crate::library::Kind;
use crate::load::{Loader, Mention};
use crate::report::Report;
use crate::resolved::placed;
use crate::schema;
use crate::source::Sources;
use crate::species_of_run::check_species;
use crate::validate::{ResolvedSpecies, SPECIES_ALONE_UNTIL};

/// A plan as its file states it. x is east and y north, metres; the ground is level at the height 0.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The name of the plan.
    #[schemars(length(min = 1, max = 200))]
    pub name: String,
    /// What it is.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub description: String,
    /// Degrees from the equator, north positive.
    #[schemars(range(min = -90, max = 90))]
    pub latitude_deg: f64,
    /// Degrees from Greenwich, east positive. Hours are those of the sun, so it matters next to nothing.
    #[serde(default)]
    #[schemars(range(min = -180, max = 180))]
    pub longitude_deg: f64,
    /// How the year is followed.
    #[serde(default)]
    pub sun: Sun,
    /// How far apart the points of a zone are at most, metres.
    #[serde(default = "half")]
    #[schemars(range(min = 0.01, max = 1000))]
    pub grid_m: f64,
    /// How near the wood of trees is drawn to its internodes, metres.
    #[serde(default = "a_centimetre")]
    #[schemars(range(min = 0.0001, max = 1))]
    pub tolerance_m: f64,
    /// The zones whose shade is asked for.
    #[schemars(length(min = 1, max = 1000))]
    pub zone: Vec<Zone>,
    /// The buildings.
    #[serde(default)]
    #[schemars(length(max = 1000))]
    pub building: Vec<Building>,
    /// The trees that stand.
    #[serde(default)]
    #[schemars(length(max = 1000))]
    pub tree: Vec<Tree>,
    /// What may be planted besides.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Arrange")]
    pub arrange: Option<Arrange>,
}

/// How the year is followed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Sun {
    /// The year.
    #[schemars(range(min = 1900, max = 2100))]
    pub year: i32,
    /// How many days of each month are followed, each for an equal part of it.
    #[schemars(range(min = 1, max = 31))]
    pub days_a_month: u32,
    /// The longest step from moment to moment, minutes.
    #[schemars(range(min = 0.1, max = 240))]
    pub step_min: f64,
    /// The lowest altitude of the sun that counts, degrees.
    #[schemars(range(min = 0, max = 80))]
    pub lowest_deg: f64,
}

impl Default for Sun {
    fn default() -> Self {
        Self { year: 2025, days_a_month: 3, step_min: 15.0, lowest_deg: 0.0 }
    }
}

/// A part of the ground.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Zone {
    /// Its name.
    #[schemars(length(min = 1, max = 200))]
    pub name: String,
    /// The corners of its outline in their order, which must not cross itself; the last is joined to the first.
    #[schemars(length(min = 3, max = 1000), inner(inner(range(min = -1e5, max = 1e5))))]
    pub corners_m: Vec<[f64; 2]>,
    /// What an hour of its shade is worth beside one of the other zones; where shade is unwanted, less than 0.
    #[serde(default = "one")]
    #[schemars(range(min = -1e6, max = 1e6))]
    pub weight: f64,
    /// The hours of shade that it must have.
    #[serde(default)]
    #[schemars(length(max = 100))]
    pub allow: Vec<Allowed>,
}

/// Hours of shade that are allowed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Allowed {
    /// The months, from 1, in each of which it holds; the mean of the year if not given.
    #[serde(default)]
    #[schemars(length(max = 12), inner(range(min = 1, max = 12)))]
    pub months: Vec<u32>,
    /// The fewest hours a day.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = 0, max = 24))]
    pub least_h: Option<f64>,
    /// The most hours a day.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = 0, max = 24))]
    pub most_h: Option<f64>,
}

/// A building: a box.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Building {
    /// Its name.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    #[schemars(length(max = 200))]
    pub name: String,
    /// Where its middle stands.
    #[schemars(inner(range(min = -1e5, max = 1e5)))]
    pub place_m: [f64; 2],
    /// Its width, its depth and the height of its top above the ground, a millimetre or more each.
    #[schemars(inner(range(min = 0.001, max = 1e5)))]
    pub size_m: [f64; 3],
    /// The height of its underside, as of a roof on posts; 0 if not given.
    #[serde(default)]
    #[schemars(range(min = 0, max = 1e5))]
    pub from_m: f64,
    /// The azimuth of its depth: degrees from the north to the east.
    #[serde(default)]
    #[schemars(range(min = -360, max = 360))]
    pub turn_deg: f64,
}

/// A tree that stands.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Tree {
    /// Its name.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    #[schemars(length(max = 200))]
    pub name: String,
    /// Where it stands.
    #[schemars(inner(range(min = -1e5, max = 1e5)))]
    pub place_m: [f64; 2],
    /// By how much it is turned: degrees from the north to the east.
    #[serde(default)]
    #[schemars(range(min = -360, max = 360))]
    pub turn_deg: f64,
    /// The species: a shipped one by its name, or a file by its path from this file.
    #[schemars(length(min = 1))]
    pub species: String,
    /// Its age, ticks; that at which its species is shown if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "u32", range(min = 1, max = 65_535))]
    pub age: Option<u32>,
    /// The seed of its draws.
    #[serde(default)]
    #[schemars(range(min = 0, max = 9_223_372_036_854_775_807_u64))]
    pub seed: u64,
    /// The months, from 1, in which its wood alone casts a shadow.
    #[serde(default)]
    #[schemars(length(max = 12), inner(range(min = 1, max = 12)))]
    pub leafless_months: Vec<u32>,
}

/// What may be planted, and what for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Arrange {
    /// What is sought.
    #[serde(default)]
    pub aim: Aim,
    /// The most that all candidates may cost.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = 0, max = 1e12))]
    pub budget: Option<f64>,
    /// Whether every spot must be planted.
    #[serde(default)]
    pub every_spot: bool,
    /// Where something may be planted.
    #[schemars(length(min = 1, max = 200))]
    pub spot: Vec<Spot>,
    /// What may be planted there.
    #[schemars(length(min = 1, max = 100))]
    pub candidate: Vec<Candidate>,
}

/// What is sought.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Aim {
    /// As many hours of shade on the zones as can be, each by its weight.
    #[default]
    MostShade,
    /// As few as can be.
    LeastShade,
    /// The least cost.
    Cheapest,
}

/// A place where a candidate may be planted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Spot {
    /// Its name.
    #[schemars(length(min = 1, max = 200))]
    pub name: String,
    /// Where it is.
    #[schemars(inner(range(min = -1e5, max = 1e5)))]
    pub place_m: [f64; 2],
    /// Its row from the front, from 1: no tree is higher than one of a row behind it. A spot without a row may have any
    /// of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "u32", range(min = 1, max = 1000))]
    pub row: Option<u32>,
}

/// A tree that may be planted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Candidate {
    /// Its name.
    #[schemars(length(min = 1, max = 200))]
    pub name: String,
    /// The species, as that of a tree.
    #[schemars(length(min = 1))]
    pub species: String,
    /// Its age, ticks; that at which its species is shown if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "u32", range(min = 1, max = 65_535))]
    pub age: Option<u32>,
    /// The seed of its draws.
    #[serde(default)]
    #[schemars(range(min = 0, max = 9_223_372_036_854_775_807_u64))]
    pub seed: u64,
    /// What one of them costs, in any currency.
    #[schemars(range(min = 0, max = 1e12))]
    pub cost: f64,
    /// How many there are at most.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "u32", range(min = 0, max = 1000))]
    pub at_most: Option<u32>,
    /// The months, from 1, in which its wood alone casts a shadow.
    #[serde(default)]
    #[schemars(length(max = 12), inner(range(min = 1, max = 12)))]
    pub leafless_months: Vec<u32>,
}

fn half() -> f64 {
    0.5
}

fn a_centimetre() -> f64 {
    0.01
}

fn one() -> f64 {
    1.0
}

impl Plan {
    /// The species and the ages of trees and then of candidates, with their places in the file.
    fn mentions(&self) -> Vec<(&str, Option<u32>, Path)> {
        let root = Path::root();
        let trees = self.tree.iter().enumerate();
        let trees = trees.map(|(k, tree)| (tree.species.as_str(), tree.age, root.key("tree").index(k)));
        let candidates = self.arrange.iter().flat_map(|arrange| arrange.candidate.iter().enumerate());
        let of = |k: usize| root.key("arrange").key("candidate").index(k);
        trees.chain(candidates.map(|(k, tree)| (tree.species.as_str(), tree.age, of(k)))).collect()
    }
}

/// A plan whose species are ready to grow.
#[derive(Debug, Clone)]
pub struct ResolvedPlan {
    /// The plan.
    pub plan: Plan,
    /// The species of its trees and then of its candidates.
    pub species: Vec<ResolvedSpecies>,
    sources: Sources,
    tree: Node,
}

impl ResolvedPlan {
    /// A report of faults that were found later, as by growing its trees; their paths start at the top of the file.
    pub fn report(&self, faults: Vec<fault::Fault>) -> Report {
        placed(&self.sources, &self.tree, faults)
    }
}

/// Reads and checks the file of a plan and its species.
///
/// # Errors
/// A [`Report`] with every fault of the file and of its species.
pub fn plan(path: &str) -> Result<ResolvedPlan, Report> {
    let mut loader = Loader::default();
    let found = check(&mut loader, path);
    match found {
        Some(found) if loader.faults.is_empty() => Ok(ResolvedPlan { sources: loader.sources, ..found }),
        _ => Err(Report::new(loader.sources, loader.faults)),
    }
}

/// The JSON Schema of the file of a plan.
pub fn plan_schema() -> &'static Json {
    static SCHEMA: OnceLock<Json> = OnceLock::new();
    SCHEMA.get_or_init(schema::of_type::<Plan>)
}

fn check(loader: &mut Loader, path: &str) -> Option<ResolvedPlan> {
    let source = loader.find(Kind::Scenario, &Mention { name: path.to_owned(), place: None })?;
    let (_, node) = loader.parse(source);
    let node = node?;
    let mut refused = Vec::new();
    schema::check(plan_schema(), &node, &mut refused);
    let plan: Option<Plan> = loader.read(&node, &Keys::PLAIN, &refused, serde_path_to_error::deserialize);
    let is_whole = refused.is_empty();
    loader.faults.extend(refused);
    let plan = plan?;
    if is_whole {
        loader.tell(&node, plan.faults());
    }
    let mut species: Vec<(String, Option<u32>, ResolvedSpecies)> = Vec::new();
    for (name, age, path) in plan.mentions() {
        // A species is read once, however many trees are of it.
        let known = species.iter().find(|(known, of_age, _)| known == name && *of_age == age);
        if let Some(found) = known.map(|(_, _, found)| found.clone()) {
            species.push((name.to_owned(), age, found));
            continue;
        }
        let path = path.key("species");
        let mention = Mention { name: name.to_owned(), place: Some((node.locate(&path), path)) };
        let until = |about: Option<&About>| {
            let shown = about.and_then(|about| about.shown_at).unwrap_or(1).max(SPECIES_ALONE_UNTIL);
            age.unwrap_or(shown).clamp(1, LAST_TICK)
        };
        let found = check_species(loader, &mention, until, &Surroundings::default());
        let found = found.map(|found| ResolvedSpecies::of(found, &loader.sources));
        species.extend(found.map(|found| (name.to_owned(), age, found)));
    }
    let species = species.into_iter().map(|(_, _, found)| found).collect();
    Some(ResolvedPlan { plan, species, sources: Sources::default(), tree: node })
}
