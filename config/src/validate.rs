//! From a name to a run that can begin: everything read, everything checked, every fault told at once.
//!
//! The order is that of the files: scenario, species with its ancestors, then what the types cannot say (ages beyond
//! the last, laws that leave their range at some age), and last the growth explosion, which needs compiled laws.
//! Absent: anything written. A scenario that fails here leaves no trace.

use std::path::Path as FilePath;
use std::sync::{Arc, OnceLock};

use phytomer_models::fault;
use phytomer_sim::clock::LAST_TICK;
use phytomer_sim::model::GrowthModel;
use serde_json::{Value as Json, json};

use crate::document::Node;
use crate::library::Kind;
use crate::load::{Loader, Mention, integer_at, path_of};
use crate::report::{Fault, Report};
use crate::scenario::Scenario;
use crate::schema;
use crate::source::{Origin, Source, Sources};
use crate::species::{Species, any_file};

/// The last age over which a species is checked that is not part of a scenario.
pub const SPECIES_ALONE_UNTIL: u32 = 100;

/// A run that can begin.
#[derive(Clone)]
pub struct Resolved {
    /// What the run grows and keeps.
    pub scenario: Scenario,
    /// The species, with its inheritance resolved.
    pub species: Species,
    /// The species' model, compiled for all ages of the run.
    pub model: Arc<dyn GrowthModel>,
    /// Every text that was read, for hashes and provenance: the scenario first, then the species and its ancestors.
    pub sources: Sources,
}

/// A species that can grow.
#[derive(Clone)]
pub struct ResolvedSpecies {
    /// The species, with its inheritance resolved.
    pub species: Species,
    /// Its model, compiled for all ages asked for.
    pub model: Arc<dyn GrowthModel>,
    /// The species' text and those of its ancestors.
    pub sources: Sources,
}

/// Reads and checks a scenario: a shipped one by its name, or a file by its path.
///
/// # Errors
/// Every fault of the scenario and of its species.
pub fn validate(scenario: &str) -> Result<Resolved, Report> {
    let mut loader = Loader::default();
    let mention = Mention { name: scenario.to_owned(), place: None };
    let found = loader.find(Kind::Scenario, &mention).and_then(|source| check_scenario(&mut loader, source));
    conclude(loader, found, |(scenario, species, model), sources| Resolved { scenario, species, model, sources })
}

/// Checks the text of a scenario that may not be a file yet. Its species is looked up as seen from `origin`.
///
/// # Errors
/// Every fault of the scenario and of its species.
pub fn validate_text(name: &str, origin: Origin, text: &str) -> Result<Resolved, Report> {
    let mut loader = Loader::default();
    let source = Source { name: name.to_owned(), origin, text: text.into() };
    let found = check_scenario(&mut loader, source);
    conclude(loader, found, |(scenario, species, model), sources| Resolved { scenario, species, model, sources })
}

/// Reads and checks a species by itself, over the ages up to `until`.
///
/// # Errors
/// Every fault of the species.
pub fn validate_species(species: &str, until: u32) -> Result<ResolvedSpecies, Report> {
    let mut loader = Loader::default();
    let mention = Mention { name: species.to_owned(), place: None };
    let found = check_species(&mut loader, &mention, Some(until.clamp(1, LAST_TICK)));
    conclude(loader, found, |(species, model), sources| ResolvedSpecies { species, model, sources })
}

/// Whether a file by its path is a species or a scenario, by the keys that it has; a bare name is a shipped scenario
/// if there is one, else a species.
pub fn kind_of(name: &str) -> Kind {
    let mut loader = Loader::default();
    let is_path = FilePath::new(name).is_file();
    let found = crate::library::find(Kind::Scenario, name, None);
    let Ok(source) = found else { return if is_path { Kind::Scenario } else { Kind::Species } };
    let (_, node) = loader.parse(source);
    let has = |key: &str| node.as_ref().is_some_and(|node| node.get(key).is_some());
    let species = ["model", "order", "every_order", "inherits", "tick"].into_iter().any(has);
    if species && !has("species") && !has("ages") { Kind::Species } else { Kind::Scenario }
}

/// The JSON Schema of a kind of file, as editors want it.
pub fn schema_of(kind: Kind) -> Json {
    match kind {
        Kind::Species => any_file(),
        Kind::Scenario => scenario_schema().clone(),
    }
}

fn scenario_schema() -> &'static Json {
    static SCHEMA: OnceLock<Json> = OnceLock::new();
    SCHEMA.get_or_init(schema::of_type::<Scenario>)
}

fn conclude<T, R>(loader: Loader, found: Option<T>, make: impl FnOnce(T, Sources) -> R) -> Result<R, Report> {
    match found {
        Some(found) if loader.faults.is_empty() => Ok(make(found, loader.sources)),
        _ => Err(Report::new(loader.sources, loader.faults)),
    }
}

type Checked = (Scenario, Species, Arc<dyn GrowthModel>);

fn check_scenario(loader: &mut Loader, source: Source) -> Option<Checked> {
    let (_, node) = loader.parse(source);
    let node = node?;
    let before = loader.faults.len();
    schema::check(scenario_schema(), &node, &mut loader.faults);
    // A fault in the scenario is no reason to keep quiet about those of its species.
    let scenario: Option<Scenario> =
        if loader.faults.len() == before { loader.read(&node, node.to_json()) } else { None };
    if let Some(scenario) = &scenario {
        tell(loader, &node, scenario.faults());
    }
    let until = integer_at(&node, &["ages", "until"]).and_then(|n| u32::try_from(n).ok());
    let mention = species_mention(&node)?;
    let (species, model) = check_species(loader, &mention, until.filter(|n| (1..=LAST_TICK).contains(n)))?;
    let scenario = scenario?;
    check_explosion(loader, &node, &scenario, &species);
    Some((scenario, species, model))
}

fn species_mention(scenario: &Node) -> Option<Mention> {
    let value = scenario.get("species")?;
    let name = value.text().filter(|name| !name.is_empty())?;
    Some(Mention { name: name.to_owned(), place: Some((value.span, path_of(&["species"]))) })
}

fn check_species(
    loader: &mut Loader,
    mention: &Mention,
    until: Option<u32>,
) -> Option<(Species, Arc<dyn GrowthModel>)> {
    let (species, node) = loader.species(mention)?;
    match species.model.compile(until?) {
        Ok(model) => Some((species, model)),
        Err(faults) => {
            tell(loader, &node, faults);
            None
        }
    }
}

/// Faults of meaning, shown where the values were typed.
fn tell(loader: &mut Loader, node: &Node, faults: Vec<fault::Fault>) {
    let place = |f: fault::Fault| Fault::new(node.locate(&f.path), &f.path, f.problem, f.expected);
    loader.faults.extend(faults.into_iter().map(place));
}

/// A plot of which more is expected than it may have would be cut off: better told before the first tick.
fn check_explosion(loader: &mut Loader, node: &Node, scenario: &Scenario, species: &Species) {
    let expected = species.model.expected_components(scenario.ages.until);
    let most = scenario.limits.max_components;
    if expected <= f64::from(most) {
        return;
    }
    let keys: &[&str] =
        if integer_at(node, &["limits", "max_components"]).is_some() { &["limits", "max_components"] } else { &["ages", "until"] };
    let path = path_of(keys);
    let problem = format!(
        "the growth explodes: by age {} a plant of `{}` is expected to have {} components",
        scenario.ages.until,
        species.about.name,
        in_words(expected)
    );
    let expected = format!("at most {} (limits.max_components): an earlier last age, or fewer branches", in_words(most.into()));
    loader.faults.push(Fault::new(node.locate(&path), &path, problem, expected));
}

/// A large number as people say it: "12 000", "3.4e12".
fn in_words(x: f64) -> String {
    match x {
        x if x.is_nan() || x.is_infinite() => "more than can be counted".to_owned(),
        x if x >= 1e9 => format!("{x:.1e}"),
        x => {
            let digits = format!("{x:.0}");
            let mut out = String::new();
            for (i, digit) in digits.chars().enumerate() {
                if i > 0 && (digits.len() - i) % 3 == 0 {
                    out.push(' ');
                }
                out.push(digit);
            }
            out
        }
    }
}

impl Resolved {
    /// The whole run as data, for `run.json`: the scenario with its defaults and the species without ancestors.
    ///
    /// # Errors
    /// A number that JSON cannot hold, which no checked run has.
    pub fn to_json(&self) -> serde_json::Result<Json> {
        Ok(json!({"scenario": serde_json::to_value(&self.scenario)?, "species": self.species.to_json()?}))
    }

    /// The scenario with its defaults, as a file that could be run again.
    ///
    /// # Errors
    /// A value that TOML cannot hold, which no checked scenario has.
    pub fn scenario_toml(&self) -> Result<String, toml::ser::Error> {
        toml::to_string(&self.scenario)
    }

    /// The species without ancestors, as a file.
    ///
    /// # Errors
    /// A value that TOML cannot hold, which no checked species has.
    pub fn species_toml(&self) -> Result<String, toml::ser::Error> {
        self.species.to_toml()
    }
}
