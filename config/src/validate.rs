//! From a name to a run that is ready to start: every file is read and checked, and all faults are reported at once.
//!
//! The order of checks is: the scenario, its species with their ancestors, conditions that the types cannot state (ages
//! after the last, laws that leave their range at some age), and last the growth explosion, which needs compiled laws.
//! Absent: writing; nothing is written before the whole scenario has passed.

use std::fmt;
use std::path::Path as FilePath;
use std::sync::{Arc, OnceLock};

use phytomer_law::fault::{self, Segment};
use phytomer_models::parameters::{Keys, Surroundings};
use phytomer_sim::clock::LAST_TICK;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::site::calendar::Calendar;
use serde_json::Value as Json;

use crate::about::About;
use crate::checked::{
    Checked, Compiled, Stated, check_cells, check_constants, check_cuttable, check_explosions, check_successors,
};
use crate::dates::{self, Dated};
use crate::document::Node;
use crate::expansion::{self, Expanded};
use crate::library::{Kind, Library, is_lsystem};
use crate::load::{Loader, Mention, integer_at};
use crate::models::{MODELS, any_file};
use crate::report::{Fault, Report};
use crate::resolved::{OtherSpecies, Resolved, placed};
use crate::scenario::experiment::{CONTROL, Chosen, Experiment, state_levels};
use crate::scenario::{Scenario, icasa};
use crate::schema;
use crate::source::{Source, Sources};
use crate::species::Species;
use crate::species_of_run::{Run, SpeciesOfRun, check_species};
use crate::treatments::{self, Read};

/// The last age, in ticks, up to which a species without a scenario is checked.
pub const SPECIES_ALONE_UNTIL: u32 = 100;

/// A species that is ready to grow.
#[derive(Clone)]
pub struct ResolvedSpecies {
    /// The species, with its inheritance resolved.
    pub species: Species,
    /// The growth model, compiled for the ages up to a last age.
    pub model: Arc<dyn GrowthModel>,
    /// The texts of the species and of its ancestors.
    pub sources: Sources,
    pub(crate) tree: Node,
}

/// Reads and checks a scenario: a shipped scenario by its name, or a file by its path. Where `scenario` names a
/// species, the run is one plant of the species ([`ResolvedSpecies::alone`]). Every law is checked over all its ages.
///
/// # Errors
/// A [`Report`] with every fault of the scenario and of its species.
pub fn validate(scenario: &str) -> Result<Resolved, Report> {
    validate_in(Library::Disk, scenario, &Surroundings::default())
}

/// As [`validate`], where a species that is named stands in surroundings that are stated elsewhere. A scenario states
/// its own, and is not changed by these.
///
/// # Errors
/// A [`Report`] with every fault of the scenario and of its species.
pub fn validate_with(scenario: &str, around: &Surroundings) -> Result<Resolved, Report> {
    validate_in(Library::Disk, scenario, around)
}

/// Checks a scenario or species from texts in memory. `texts` are pairs of a name and a TOML text, and `name` is the
/// name of one of them or of a preset. The names in a text (`species`, `inherits`) lead to other texts, else to
/// presets. No file is read, so a species in memory cannot have mesh files of its own.
///
/// ```
/// let species = "inherits = \"coffee\"\nname = \"short_coffee\"";
/// let scenario = "name = \"trial\"\nspecies = \"short\"\nplants = 9\nages = { until = 12 }";
/// let resolved = phytomer_config::validate_texts("trial", &[("trial", scenario), ("short", species)]).unwrap();
/// assert_eq!(resolved.species.about.name, "short_coffee");
/// ```
///
/// # Errors
/// A [`Report`], as from [`validate`], in which a text is called by its name.
pub fn validate_texts(name: &str, texts: &[(&str, &str)]) -> Result<Resolved, Report> {
    validate_in(Library::of_texts(texts), name, &Surroundings::default())
}

fn validate_in(library: Library, scenario: &str, around: &Surroundings) -> Result<Resolved, Report> {
    if kind_in(&library, scenario) == Kind::Species && library.find(Kind::Species, scenario, None).is_ok() {
        return species_in(library, scenario, SPECIES_ALONE_UNTIL, around).map(|species| species.alone(scenario));
    }
    let mut loader = Loader { library, ..Loader::default() };
    let mention = Mention { name: scenario.to_owned(), place: None };
    let found = loader.find(Kind::Scenario, &mention).and_then(|source| check_scenario(&mut loader, source));
    conclude(loader, found.and_then(resolved), |resolved, sources| Resolved { sources, ..resolved })
}

/// The run of a checked scenario, without its texts.
fn resolved(checked: Checked) -> Option<Resolved> {
    let Checked { scenario, treatments, species, models, calendars, .. } = checked;
    let (mut species, mut models) = (species.into_iter(), models.into_iter());
    let (Stated { species: first, tree }, model) = (species.next()?, models.next()?);
    Some(Resolved {
        site_seed: scenario.seed,
        shifted: OnceLock::new(),
        scenario,
        treatments,
        species: first,
        model,
        others: species.map(|Stated { species, tree }| OtherSpecies { species, tree }).collect(),
        other_models: models.collect(),
        calendars,
        sources: Sources::default(),
        tree,
    })
}

/// Reads and checks a species by itself, for the ages up to `until` (ticks) and up to its `shown_at`.
///
/// # Errors
/// A [`Report`] with every fault of the species.
pub fn validate_species(species: &str, until: u32) -> Result<ResolvedSpecies, Report> {
    species_in(Library::Disk, species, until, &Surroundings::default())
}

/// As [`validate_species`], in surroundings that are stated elsewhere: constants of an L-system, and shapes.
///
/// # Errors
/// A [`Report`] with every fault of the species in these surroundings.
pub fn validate_species_with(species: &str, until: u32, around: &Surroundings) -> Result<ResolvedSpecies, Report> {
    species_in(Library::Disk, species, until, around)
}

fn species_in(library: Library, species: &str, until: u32, around: &Surroundings) -> Result<ResolvedSpecies, Report> {
    let mut loader = Loader { library, ..Loader::default() };
    let mention = Mention { name: species.to_owned(), place: None };
    let until =
        |about: Option<&About>| about.and_then(|about| about.shown_at).unwrap_or(1).max(until).clamp(1, LAST_TICK);
    let found = check_species(&mut loader, &mention, until, around);
    conclude(loader, found, |found, sources| ResolvedSpecies::of(found, &sources))
}

/// Whether a name is that of a species or of a scenario. A file is recognised by its keys. A bare name is a shipped
/// scenario if there is one, else a species.
pub fn kind_of(name: &str) -> Kind {
    kind_in(&Library::Disk, name)
}

fn kind_in(library: &Library, name: &str) -> Kind {
    let mut loader = Loader::default();
    let is_path = matches!(library, Library::Disk) && FilePath::new(name).is_file();
    if is_path && is_lsystem(name) {
        return Kind::Species;
    }
    let found = library.find(Kind::Scenario, name, None);
    let Ok(source) = found else { return if is_path { Kind::Scenario } else { Kind::Species } };
    let (_, node) = loader.parse(source);
    if node.is_some_and(|node| looks_like_species(&node)) { Kind::Species } else { Kind::Scenario }
}

fn looks_like_species(node: &Node) -> bool {
    let has = |key: &str| node.get(key).is_some();
    let by_place = MODELS.into_iter().filter_map(|model| model.card().keys.by_place.as_ref());
    let of_models = by_place.flat_map(|tables| [tables.list, tables.every]);
    ["model", "inherits", "tick"].into_iter().chain(of_models).any(has) && !["species", "ages"].into_iter().any(has)
}

/// The JSON Schema of a kind of file, for editors. A species file may name any model.
pub fn schema_of(kind: Kind) -> Json {
    match kind {
        Kind::Species => any_file(),
        Kind::Scenario => with_plants_or_stand(scenario_schema().clone()),
    }
}

/// A schema of scenarios in which a stand may take the place of the number of plants, as it does in files.
fn with_plants_or_stand(mut schema: Json) -> Json {
    if let Some(required) = schema["required"].as_array_mut() {
        required.retain(|key| key != "plants");
    }
    schema["anyOf"] = serde_json::json!([{ "required": ["plants"] }, { "required": ["stand"] }]);
    schema
}

fn scenario_schema() -> &'static Json {
    static SCHEMA: OnceLock<Json> = OnceLock::new();
    SCHEMA.get_or_init(|| {
        let mut schema = schema::of_type::<Scenario>();
        state_levels(&mut schema);
        schema
    })
}

fn conclude<T, R>(loader: Loader, found: Option<T>, make: impl FnOnce(T, Sources) -> R) -> Result<R, Report> {
    match found {
        Some(found) if loader.faults.is_empty() => Ok(make(found, loader.sources)),
        _ => Err(Report::new(loader.sources, loader.faults)),
    }
}

fn check_scenario(loader: &mut Loader, source: Source) -> Option<Checked> {
    let (_, node) = loader.parse(source);
    let bare = node?;
    let mut node = bare.clone();
    loader.fill_solids(&mut node);
    loader.fill_stand(&mut node);
    let mut refused = Vec::new();
    schema::check(scenario_schema(), &node, &mut refused);
    icasa::name_keys(&mut refused);
    let scenario: Option<Scenario> = loader.read(&node, &Keys::PLAIN, &refused, serde_path_to_error::deserialize);
    // A level may change the file of a mesh.
    let mut expanded = expanded(loader, &bare, &refused);
    for Expanded { node, .. } in &mut expanded {
        loader.fill_solids(node);
        loader.fill_stand(node);
    }
    loader.faults.extend(refused.iter().cloned());
    let read = treatments::check(loader, scenario_schema(), (&node, scenario.as_ref()), expanded);
    let replicates = scenario.as_ref().map_or(1, |scenario| scenario.experiment.replicates);
    let calendars = calendars(loader, (&read, replicates), &refused);
    let until = integer_at(&node, &["ages", "until"]).and_then(|n| u32::try_from(n).ok());
    let until = until.filter(|n| (1..=LAST_TICK).contains(n));
    let run = Run { node: &node, scenario: scenario.as_ref(), until, calendars: calendars.as_deref(), read: &read };
    let SpeciesOfRun { treatments, species, trial, models } = run.check(loader)?;
    let calendars = calendars.ok()?;
    treatments::tell_each(loader, &read, |place, scenario| {
        let dated = calendars.get(place).and_then(Option::as_ref);
        let of = |calendar: &Arc<Calendar>| scenario.faults_of_days(calendar);
        let all = dated.map(|dated| dated.calendars.all()).unwrap_or_default();
        all.iter().map(of).find(|faults| !faults.is_empty()).unwrap_or_default()
    });
    let checked = Checked { scenario: scenario?, treatments, species, trial, models, calendars };
    check_constants(loader, &read, &checked);
    check_successors(loader, &node, &checked);
    check_cells(loader, &node, &checked);
    check_explosions(loader, &node, &checked);
    check_cuttable(loader, &node, &checked);
    Some(checked)
}

/// The trees of all treatments; that of the scenario alone where its experiment cannot be understood.
fn expanded(loader: &mut Loader, node: &Node, refused: &[Fault]) -> Vec<Expanded> {
    let chosen = experiment_of(node, refused).unwrap_or_default().chosen().unwrap_or_else(|faults| {
        loader.tell(node, faults);
        Vec::new()
    });
    let control = || vec![Chosen { name: CONTROL.to_owned(), levels: Vec::new() }];
    expansion::expand(scenario_schema(), node, if chosen.is_empty() { control() } else { chosen })
}

/// The calendar of each treatment; none where its scenario could not be read for other reasons. Where the schema has
/// refused a key of the dates, that key is missing in what was read, and no more is told of the dates.
fn calendars(
    loader: &mut Loader,
    (read, replicates): (&[Read], u32),
    refused: &[Fault],
) -> Result<Vec<Option<Dated>>, dates::Refused> {
    let is_refused = refused.iter().any(|fault| dates::is_of_dates(&fault.path));
    let told = |fault: &Fault| refused.iter().any(|other| (other.span, &other.problem) == (fault.span, &fault.problem));
    loader.faults.retain(|fault| !is_refused || !dates::is_of_dates(&fault.path) || told(fault));
    if loader.faults.iter().any(|fault| dates::is_of_dates(&fault.path)) {
        return Err(dates::Refused);
    }
    dates::of_treatments(loader, read, replicates)
}

/// The experiment of a scenario. A key that it does not know is left out, as is told of it; what is refused in a level
/// is left to the check of its treatments; `None` where anything else is refused.
fn experiment_of(node: &Node, refused: &[Fault]) -> Option<Experiment> {
    let mut experiment = node.get("experiment")?.clone();
    for fault in refused {
        match fault.path.0.as_slice() {
            [Segment::Key(table), Segment::Key(key)] if table == "experiment" => _ = experiment.remove(key),
            [Segment::Key(table), _, _, Segment::Key(level), _, Segment::Key(key), ..]
                if table == "experiment" && level == "level" && key != "name" => {}
            [Segment::Key(table), ..] if table == "experiment" => return None,
            _ => {}
        }
    }
    serde_json::from_value(experiment.to_json()).ok()
}

impl fmt::Debug for ResolvedSpecies {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ResolvedSpecies").field("species", &self.species).finish()
    }
}

impl ResolvedSpecies {
    /// A checked species with the texts that it was read from.
    pub(crate) fn of(found: Compiled, sources: &Sources) -> Self {
        let Compiled { species, model, tree } = found;
        Self { species, model, sources: sources.clone(), tree }
    }

    /// A report of faults that were found in the species after reading, such as by growing it. The path of each fault
    /// starts at the top of the species file.
    pub fn report(&self, faults: Vec<fault::Fault>) -> Report {
        placed(&self.sources, &self.tree, faults)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document;
    use crate::library::find;

    /// Editors have one schema for species of all models: it must accept every file that the program accepts.
    #[test]
    fn the_schema_for_editors_passes_good_files() {
        for name in [
            "child",
            "coffee_like",
            "states",
            "binary",
            "gmt1_drawn",
            "gmt_composed",
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
}
