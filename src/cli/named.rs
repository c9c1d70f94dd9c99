//! What a name on the command line stands for: a run folder, a scenario or a species.
//!
//! A folder with a `run.json` or a journal is a run, and so is one of that name under `runs/`, unless a scenario or a
//! species of the name ships; `runs/coffee` always means the run. Absent: what is told of them.

use anyhow::{Context, Result};
use phytomer::run::forms;
use phytomer_config::{
    Kind, Reads, Report, Resolved, ResolvedSpecies, SPECIES_ALONE_UNTIL, Scenario, Species, Treatment, Trial,
    calendars_of_run, compiled, kind_of, presets, validate, validate_species_with,
};
use phytomer_models::parameters::Surroundings;
use phytomer_outputs::read::Run;
use phytomer_sim::GrowthModel;
use phytomer_sim::site::calendars::Calendars;
use serde::Deserialize;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The folder that runs are written to.
pub const RUNS: &str = "runs";

/// What was named.
pub enum Named {
    /// A run folder.
    Run(PathBuf),
    /// A scenario, checked.
    Scenario(Box<Resolved>),
    /// A species, checked.
    Species(Box<ResolvedSpecies>),
}

/// The run folder of a name, where there is one.
pub fn run_folder(name: &str) -> Option<PathBuf> {
    let ships =
        [Kind::Scenario, Kind::Species].iter().any(|kind| presets(*kind).iter().any(|(preset, _)| *preset == name));
    let below = Path::new(RUNS).join(name);
    let candidates = [Some(PathBuf::from(name)), (!ships).then_some(below)];
    // Of a damaged run one of them is left.
    let is_run = |folder: &PathBuf| ["run.json", "journal.jsonl"].iter().any(|name| folder.join(name).is_file());
    candidates.into_iter().flatten().find(is_run)
}

/// The run folder of a name, where its plants were measured and not grown.
pub fn measured_run(name: &str) -> Option<PathBuf> {
    let folder = run_folder(name)?;
    let run = Run::open(&folder).ok()?;
    run.json()["resolved_scenario"].get("measured").is_some().then_some(folder)
}

/// Finds and checks what a name stands for.
///
/// # Errors
/// Every fault of it; for a name that nothing has, the nearest spelling.
pub fn find(name: &str) -> std::result::Result<Named, Report> {
    find_with(name, &Surroundings::default())
}

/// As [`find`], where a species is one in such surroundings.
///
/// # Errors
/// Every fault of it; for a name that nothing has, the nearest spelling.
pub fn find_with(name: &str, surroundings: &Surroundings) -> std::result::Result<Named, Report> {
    if let Some(folder) = run_folder(name) {
        return Ok(Named::Run(folder));
    }
    if kind_of(name) == Kind::Scenario {
        let mut scenario = validate(name)?;
        forms::settle(&mut scenario)?;
        return Ok(Named::Scenario(Box::new(scenario)));
    }
    let species = validate_species_with(name, SPECIES_ALONE_UNTIL, surroundings);
    let mut species = species.map_err(|report| if is_unknown(&report) { unknown(name, report) } else { report })?;
    match forms::read(&species.species) {
        Ok(forms) => {
            forms::state_shares(&mut species.species, &forms);
            Ok(Named::Species(Box::new(species)))
        }
        Err(faults) => Err(species.report(faults)),
    }
}

/// Whether the fault is that nothing has this name.
fn is_unknown(report: &Report) -> bool {
    report.sources.iter().next().is_none()
}

/// The report of an unknown name, with the nearer of the spellings that a species and a scenario would have.
fn unknown(name: &str, mut report: Report) -> Report {
    let as_scenario = validate(name).err().and_then(|report| report.faults.into_iter().next()?.suggestion);
    if let Some(fault) = report.faults.first_mut() {
        let alike = |word: &String| name.chars().zip(word.chars()).take_while(|(a, b)| a == b).count();
        let spellings = [as_scenario, fault.suggestion.take()].into_iter().flatten();
        fault.suggestion = spellings.max_by_key(alike);
        fault.problem = format!("there is no run, scenario or species `{name}`");
        fault.expected = "what ships (`phytomer list` has it), a run below runs/, or the path of a file".to_owned();
    }
    report
}

/// The scenario and the species as a run folder keeps them.
pub struct Recorded {
    /// The scenario, with what the command line changed.
    pub scenario: Scenario,
    /// Its treatments.
    pub trial: Trial,
    /// The first species, without ancestors.
    pub species: Species,
    /// The species that members and levels name beside it, in the order of the run.
    pub others: Vec<Species>,
    /// The run folder.
    pub run: Run,
}

impl Recorded {
    /// Reads them from `run.json`.
    ///
    /// # Errors
    /// Where it cannot be read, or was written by a program whose files this one does not know.
    pub fn of(folder: &Path) -> Result<Self> {
        let run = Run::open(folder)?;
        let doing = || format!("cannot understand {}", folder.join("run.json").display());
        let resolved = &run.json()["resolved_scenario"];
        if let Some(measured) = resolved.get("measured") {
            let (shown, file) = (folder.display(), measured["file"].as_str().unwrap_or("a file"));
            let told = format!(
                "{shown}: its plants were measured ({file}) and none is grown: `describe`, `picture`, `mesh`, `view`, \
                 `report`, `measure`, `query` and `fit` work on its tables, and `convert {file}` writes them in other formats"
            );
            return Err(super::Misuse(told).into());
        }
        let scenario = Scenario::deserialize(&resolved["scenario"]).with_context(doing)?;
        let species = Species::from_json(&resolved["species"]).with_context(doing)?;
        let others = resolved["other_species"].as_array().map(Vec::as_slice).unwrap_or_default();
        let others = others.iter().map(Species::from_json);
        let others = others.collect::<serde_json::Result<Vec<Species>>>().with_context(doing)?;
        let treatments = match &resolved["treatments"] {
            serde_json::Value::Null => Vec::new(),
            treatments => Vec::<Treatment>::deserialize(treatments).with_context(doing)?,
        };
        let calendars = calendars(resolved).with_context(doing)?;
        let reads: Vec<Reads> = [&species].into_iter().chain(&others).map(Species::reads).collect();
        let trial = Trial::of(&scenario, &treatments).dated(&calendars, &reads, scenario.seed);
        Ok(Self { trial, scenario, species, others, run })
    }

    /// All species, in the order of the run.
    pub fn all_species(&self) -> impl Iterator<Item = &Species> {
        [&self.species].into_iter().chain(&self.others)
    }

    /// The names of all species: "a, b".
    pub fn species_in_words(&self) -> String {
        let mut names: Vec<&str> = Vec::new();
        for species in self.all_species() {
            let name = species.about.name.as_str();
            names.extend(Some(name).filter(|name| !names.contains(name)));
        }
        names.join(", ")
    }

    /// The models of all cohorts, for the ages that their plants reach in the run.
    ///
    /// # Errors
    /// Where their laws do not hold, which those of a run that began do.
    pub fn compile(&self) -> Result<Vec<Arc<dyn GrowthModel>>> {
        let species: Vec<&Species> = self.all_species().collect();
        compiled(&self.trial, &species).map_err(|(_, faults)| match faults.into_iter().next() {
            Some(fault) => anyhow::Error::new(fault),
            None => anyhow::anyhow!("the species of the run cannot be compiled"),
        })
    }
}

/// The calendars of each treatment, as `run.json` keeps them.
fn calendars(resolved: &serde_json::Value) -> serde_json::Result<Vec<Calendars>> {
    match resolved["treatments"].as_array() {
        None => Ok(vec![calendars_of_run(resolved)?]),
        Some(treatments) => treatments.iter().map(calendars_of_run).collect(),
    }
}
