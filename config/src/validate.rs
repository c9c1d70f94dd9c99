//! From a name to a run that can begin: everything read, everything checked, every fault told at once.
//!
//! The order is that of the files: scenario, species with its ancestors, then what the types cannot say (ages beyond
//! the last, laws that leave their range at some age), and last the growth explosion, which needs compiled laws.
//! Absent: anything written. A scenario that fails here leaves no trace.

use std::fmt;
use std::path::Path as FilePath;
use std::sync::{Arc, OnceLock};

use phytomer_models::fault;
use phytomer_models::law::Constant;
use phytomer_sim::clock::LAST_TICK;
use phytomer_sim::expectation::Certainty;
use phytomer_sim::model::GrowthModel;
use serde_json::{Value as Json, json};

use crate::document::Node;
use crate::library::{Kind, Library};
use crate::load::{Found, Loader, Mention, integer_at, path_of};
use crate::meaning;
use crate::report::{Fault, Report};
use crate::scenario::Scenario;
use crate::schema;
use crate::source::{Source, Sources};
use crate::species::{About, Model, Species, any_file};

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
    pub(crate) tree: Node,
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
    pub(crate) tree: Node,
}

/// Reads and checks a scenario: a shipped one by its name, or a file by its path. A species in its place is one plant
/// of it ([`ResolvedSpecies::alone`]).
///
/// # Errors
/// Every fault of the scenario and of its species.
pub fn validate(scenario: &str) -> Result<Resolved, Report> {
    validate_in(Library::Disk, scenario)
}

/// The same of texts in memory: `name` is that of one of `texts`, which are pairs of a name and a TOML text, or of a
/// preset. What a text names (`species`, `inherits`) is another of the texts, else a preset. No file is read, so no
/// species among the texts can have a mesh of its own.
///
/// ```
/// let species = "inherits = \"coffee\"\nname = \"short_coffee\"";
/// let scenario = "name = \"trial\"\nspecies = \"short\"\nplants = 9\nages = { until = 12 }";
/// let resolved = phytomer_config::validate_texts("trial", &[("trial", scenario), ("short", species)]).unwrap();
/// assert_eq!(resolved.species.about.name, "short_coffee");
/// ```
///
/// # Errors
/// As [`validate`]; messages call a text by its name.
pub fn validate_texts(name: &str, texts: &[(&str, &str)]) -> Result<Resolved, Report> {
    validate_in(Library::of_texts(texts), name)
}

fn validate_in(library: Library, scenario: &str) -> Result<Resolved, Report> {
    if kind_in(&library, scenario) == Kind::Species && library.find(Kind::Species, scenario, None).is_ok() {
        return species_in(library, scenario, SPECIES_ALONE_UNTIL).map(|species| species.alone(scenario));
    }
    let mut loader = Loader { library, ..Loader::default() };
    let mention = Mention { name: scenario.to_owned(), place: None };
    let found = loader.find(Kind::Scenario, &mention).and_then(|source| check_scenario(&mut loader, source));
    conclude(loader, found, |(scenario, Compiled { species, model, tree }), sources| Resolved {
        scenario,
        species,
        model,
        sources,
        tree,
    })
}

/// Reads and checks a species by itself, over the ages up to `until` and up to that at which it says that it is shown.
///
/// # Errors
/// Every fault of the species.
pub fn validate_species(species: &str, until: u32) -> Result<ResolvedSpecies, Report> {
    species_in(Library::Disk, species, until)
}

fn species_in(library: Library, species: &str, until: u32) -> Result<ResolvedSpecies, Report> {
    let mut loader = Loader { library, ..Loader::default() };
    let mention = Mention { name: species.to_owned(), place: None };
    let until = |about: Option<&About>| {
        Some(about.and_then(|about| about.shown_at).unwrap_or(1).max(until).clamp(1, LAST_TICK))
    };
    let found = check_species(&mut loader, &mention, until);
    conclude(loader, found, |Compiled { species, model, tree }, sources| ResolvedSpecies {
        species,
        model,
        sources,
        tree,
    })
}

/// Whether a file by its path is a species or a scenario, by the keys that it has; a bare name is a shipped scenario
/// if there is one, else a species.
pub fn kind_of(name: &str) -> Kind {
    kind_in(&Library::Disk, name)
}

fn kind_in(library: &Library, name: &str) -> Kind {
    let mut loader = Loader::default();
    let is_path = matches!(library, Library::Disk) && FilePath::new(name).is_file();
    let found = library.find(Kind::Scenario, name, None);
    let Ok(source) = found else { return if is_path { Kind::Scenario } else { Kind::Species } };
    let (_, node) = loader.parse(source);
    if node.is_some_and(|node| looks_like_species(&node)) { Kind::Species } else { Kind::Scenario }
}

fn looks_like_species(node: &Node) -> bool {
    let has = |key: &&str| node.get(key).is_some();
    ["model", "order", "every_order", "inherits", "tick"].iter().any(has) && !["species", "ages"].iter().any(has)
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

/// A species that was checked, with the tree that it was read from.
struct Compiled {
    species: Species,
    model: Arc<dyn GrowthModel>,
    tree: Node,
}

type Checked = (Scenario, Compiled);

fn check_scenario(loader: &mut Loader, source: Source) -> Option<Checked> {
    let (_, node) = loader.parse(source);
    let node = node?;
    let mut refused = Vec::new();
    schema::check(scenario_schema(), &node, &mut refused);
    loader.faults.extend(refused.iter().cloned());
    let scenario: Option<Scenario> = loader.read(&node, &refused, serde_path_to_error::deserialize);
    if let Some(scenario) = &scenario {
        tell(loader, &node, scenario.faults());
    }
    let until = integer_at(&node, &["ages", "until"]).and_then(|n| u32::try_from(n).ok());
    let mention = species_mention(&node)?;
    let species = check_species(loader, &mention, |_| until.filter(|n| (1..=LAST_TICK).contains(n)))?;
    let checked = (scenario?, species);
    check_explosion(loader, &node, &checked);
    Some(checked)
}

fn species_mention(scenario: &Node) -> Option<Mention> {
    let value = scenario.get("species")?;
    let name = value.text().filter(|name| !name.is_empty())?;
    Some(Mention { name: name.to_owned(), place: Some((value.span, path_of(&["species"]))) })
}

fn check_species(
    loader: &mut Loader,
    mention: &Mention,
    until: impl Fn(Option<&About>) -> Option<u32>,
) -> Option<Compiled> {
    let Found { about, model, node } = loader.species(mention)?;
    if let Some(about) = &about {
        tell(loader, &node, about.faults());
        check_year(loader, &node, about, &model);
    }
    match model.compile(until(about.as_ref())?) {
        Ok(compiled) => Some(Compiled { species: Species { about: about?, model }, model: compiled, tree: node }),
        Err(faults) => {
            tell(loader, &node, faults);
            None
        }
    }
}

/// A species has one year: where its season states the ticks of it too, the two must agree.
fn check_year(loader: &mut Loader, node: &Node, about: &About, model: &Model) {
    let (Some(stated), Some((path, in_season))) = (about.ticks_per_year.as_ref().map(Constant::value), model.year())
    else {
        return;
    };
    if stated == f64::from(in_season) {
        return;
    }
    let other = path_of(&["ticks_per_year"]);
    let span = node.locate(&other);
    let ((line, column), file) = (loader.sources.place(span), &loader.sources.get(span.source).name);
    let problem = format!(
        "the year of the season is of {in_season} ticks, and `ticks_per_year` is {stated} ({file}:{line}:{column})"
    );
    loader.faults.push(Fault::new(node.locate(&path), &path, problem, "the same number at both places"));
}

/// Faults of meaning, shown where the values were typed.
fn tell(loader: &mut Loader, node: &Node, faults: Vec<fault::Fault>) {
    let placed = faults.into_iter().map(|fault| meaning::place(&loader.sources, node, fault));
    loader.faults.extend(placed.collect::<Vec<_>>());
}

/// A plant that is expected to have more components than it may would be cut off: better told before the first tick.
/// The figure is the expectation, or of a species without one in closed form those components of which it is known; an
/// estimate or an upper bound refuses nothing, and the limit then holds while the plant grows.
fn check_explosion(loader: &mut Loader, node: &Node, (scenario, Compiled { species, model, .. }): &Checked) {
    let until = scenario.ages.until;
    let (most, key) = (scenario.limits.components(), scenario.limits.binding());
    let Some(means) = model.expectation(until) else { return };
    let expected = means.least_components(until);
    if expected <= f64::from(most) {
        return;
    }
    let set = integer_at(node, &["limits", key]).is_some();
    let path = path_of(&if set { ["limits", key] } else { ["ages", "until"] });
    let (name, expected, most) = (&species.about.name, in_words(expected), in_words(most.into()));
    let least = if means.certainty() == Certainty::Exact { "" } else { "at least " };
    let problem = format!(
        "the growth explodes: by age {until} a plant of `{name}` is expected to have {least}{expected} components"
    );
    let expected = format!("at most {most} (limits.{key}): an earlier last age, or fewer branches");
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

impl fmt::Debug for Resolved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Resolved").field("scenario", &self.scenario).field("species", &self.species).finish()
    }
}

impl fmt::Debug for ResolvedSpecies {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ResolvedSpecies").field("species", &self.species).finish()
    }
}

impl ResolvedSpecies {
    /// A report of what was found wrong with the species after it was read, such as by growing it: each fault at its
    /// path from the top of the species file.
    pub fn report(&self, faults: Vec<fault::Fault>) -> Report {
        placed(&self.sources, &self.tree, faults)
    }
}

fn placed(sources: &Sources, tree: &Node, faults: Vec<fault::Fault>) -> Report {
    let placed = faults.into_iter().map(|fault| meaning::place(sources, tree, fault)).collect();
    Report::new(sources.clone(), placed)
}

impl Resolved {
    /// A report of what was found wrong with the species after it was read, as [`ResolvedSpecies::report`].
    pub fn report(&self, faults: Vec<fault::Fault>) -> Report {
        placed(&self.sources, &self.tree, faults)
    }

    /// The components that a plant is expected to have made by `age`: the mean, a bound from above or an estimate;
    /// `None` where the sum would take too long.
    pub fn expected_components(&self, age: u32) -> Option<f64> {
        self.model.expectation(age).map(|means| means.components(age))
    }

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document;
    use crate::library::find;

    /// Editors have one schema for species of all models; it must pass what the program passes.
    #[test]
    fn the_schema_for_editors_passes_good_files() {
        for name in [
            "child",
            "coffee_like",
            "states",
            "binary",
            "gmt1_drawn",
            "sourced",
            "minimal_species",
            "wood_laws",
            "wood_vinci",
            "published",
        ] {
            let mut sources = Sources::default();
            let source = find(Kind::Species, &format!("tests/good/{name}.toml"), None).expect("a good file");
            let id = sources.add(source);
            let mut faults = Vec::new();
            let node = document::parse(&sources, id, &mut faults).expect("a tree");
            schema::check(&schema_of(Kind::Species), &node, &mut faults);
            assert_eq!(faults, []);
        }
    }

    #[test]
    fn large_numbers_are_readable() {
        assert_eq!(in_words(12_345_678.4), "12 345 678");
        assert_eq!(in_words(100.0), "100");
        assert_eq!(in_words(2.96e12), "3.0e12");
        assert_eq!(in_words(f64::INFINITY), "more than can be counted");
    }
}
