//! What a run folder holds: tables with rows, parts and sizes, ages, plants, seed, version, limits that were met, the
//! architectural models of its first plants, and the population at each recorded age.
//!
//! Rows are counted in the Parquet files themselves, so that an unfinished run is told as far as it has come. Of a
//! damaged run only the damage is told: what its tables say cannot be relied on.

use super::super::named::Recorded;
use super::super::{amounts, findings};
use anyhow::Result;
use phytomer_analysis::architecture::{Qualified, qualified};
use phytomer_analysis::measure::effective_leaf_areas;
use phytomer_analysis::{AgeOfPopulation, Moments, population};
use phytomer_outputs::{Checkup, Depth, State, Table};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

/// A run folder and what was found in it.
pub struct Held {
    recorded: Recorded,
    folder: PathBuf,
    /// What a check of its files found; `None` of a run that keeps no checks.
    found: Option<Checkup>,
    tables: BTreeMap<Table, Size>,
    meshes: Size,
    population: BTreeMap<u32, AgeOfPopulation>,
    /// The sums of the effective leaf areas of plants by age, m²; `None` where the rows were not read.
    effective: Option<BTreeMap<u32, f64>>,
    architecture: Option<Qualified>,
}

/// A run folder in which something is missing or damaged.
pub struct Damaged {
    /// What `run.json` says, where it can be relied on.
    pub recorded: Option<Recorded>,
    pub folder: PathBuf,
    pub found: Checkup,
}

impl Damaged {
    pub fn as_json(&self) -> Value {
        let mut json = findings::as_json(&self.found);
        let run = self.recorded.as_ref().map(|recorded| recorded.run.json());
        json["kind"] = "run".into();
        json["run"] = self.folder.display().to_string().into();
        for key in ["scenario", "seed", "version", "git_hash", "schema_version"] {
            json[key] = run.map(|run| run[key].clone()).unwrap_or_default();
        }
        json
    }

    pub fn as_text(&self) -> String {
        const SHOWN: usize = 12;
        let of = self.recorded.as_ref().map(|recorded| {
            format!(" of the scenario `{}`, species `{}`", recorded.scenario.name, recorded.species_in_words())
        });
        let mut text = format!("{}: a damaged run{}", self.folder.display(), of.unwrap_or_default());
        text += &findings::lines(&self.found, SHOWN);
        findings::advice(&self.found).map(|advice| format!("{text}\n{advice}")).unwrap_or(text)
    }
}

/// Rows, files and bytes.
#[derive(Debug, Clone, Copy, Default)]
struct Size {
    rows: u64,
    files: u64,
    bytes: u64,
}

impl Size {
    fn add(&mut self, file: &Path) {
        self.files += 1;
        self.bytes += fs::metadata(file).map(|metadata| metadata.len()).unwrap_or_default();
    }

    fn as_json(self) -> Value {
        json!({"rows": self.rows, "files": self.files, "bytes": self.bytes})
    }
}

impl Held {
    /// Looks into the folder. At the depth of bytes the leaves in `records` are read too.
    ///
    /// # Errors
    /// Where a file of it cannot be read.
    pub fn of(recorded: Recorded, folder: PathBuf, found: Option<Checkup>, depth: Depth) -> Result<Self> {
        let mut tables = BTreeMap::new();
        for (table, rows) in recorded.run.rows()? {
            let mut size = Size { rows, ..Size::default() };
            recorded.run.parts(table)?.iter().for_each(|part| size.add(part));
            tables.insert(table, size);
        }
        let mut meshes = Size::default();
        if let Ok(files) = fs::read_dir(folder.join("meshes")) {
            let files = files.flatten().map(|file| file.path());
            files.filter(|file| file.extension().is_some_and(|end| end == "ply")).for_each(|file| meshes.add(&file));
        }
        let population = population(&recorded.run)?;
        let architecture = qualified(&recorded.run, recorded.trial.plants())?;
        let effective = match depth {
            Depth::Bytes if tables.contains_key(&Table::Records) => Some(effective_leaf_areas(&recorded.run)?),
            _ => None,
        };
        Ok(Self { recorded, folder, found, tables, meshes, population, effective, architecture })
    }

    fn words(&self, key: &str) -> &str {
        self.recorded.run.json()[key].as_str().unwrap_or("unknown")
    }

    fn number(&self, key: &str) -> Option<u64> {
        self.recorded.run.json()[key].as_u64()
    }

    fn state(&self) -> State {
        match &self.found {
            Some(found) => found.state,
            None if self.recorded.run.is_complete() => State::Complete,
            None => State::Unfinished,
        }
    }

    /// How far the files can be relied on, and which lie beside them.
    fn files_in_words(&self) -> String {
        const SHOWN: usize = 5;
        let Some(found) = &self.found else {
            return "not checked: the run was written by an older phytomer, which kept no checks".to_owned();
        };
        let (files, bytes) = (amounts::of(found.files as u64, "file"), amounts::bytes(found.bytes as f64));
        let mut text = match found.depth {
            Depth::Bytes => format!("{files}, {bytes}, as they were written"),
            Depth::Lengths => format!("{files}, {bytes}, there; `phytomer verify` compares their bytes"),
        };
        text += &findings::lines(found, SHOWN).replace("\n", "\n             ");
        findings::advice(found).map(|advice| format!("{text}\n               {advice}")).unwrap_or(text)
    }

    fn overgrown(&self) -> usize {
        self.recorded.run.json()["overgrown"].as_array().map_or(0, Vec::len)
    }

    pub fn as_json(&self) -> Value {
        let tables: serde_json::Map<_, _> =
            self.tables.iter().map(|(table, size)| (table.name().to_owned(), size.as_json())).collect();
        let run = self.recorded.run.json();
        json!({
            "kind": "run",
            "run": self.folder.display().to_string(),
            "status": findings::word(self.state()),
            "check": self.found.as_ref().map(findings::as_json),
            "scenario": run["scenario"],
            "species": self.recorded.species_in_words(),
            "seed": run["seed"],
            "version": run["version"],
            "git_hash": run["git_hash"],
            "schema_version": run["schema_version"],
            "plants": self.recorded.trial.plants(),
            "living": run["living"],
            "dead": run["dead"],
            "components": run["components"],
            "until": self.recorded.scenario.ages.until,
            "recorded_ages": run["recorded_ages"],
            "tables": tables,
            "meshes": self.meshes.as_json(),
            "population": self.population_as_json(),
            "overgrown": run["overgrown"],
            "architecture": self.architecture.as_ref().map(|of| json!({"plants": of.plants, "models": of.models})),
        })
    }

    pub fn as_text(&self) -> String {
        let scenario = &self.recorded.scenario;
        let share = self.found.as_ref().and_then(|found| found.share);
        let status = findings::kind_of(self.state(), share);
        let (name, species) = (self.words("scenario"), self.recorded.species_in_words());
        let mut text = format!("{}: {status} of the scenario `{name}`, species `{species}`\n", self.folder.display());
        let mut line = |name: &str, value: String| {
            let _ = writeln!(text, "  {name:<12} {value}");
        };
        line("plants", self.plants_in_words());
        line("ages", ages_in_words(&scenario.ages.recorded(), scenario.ages.until));
        if let Some(components) = self.number("components") {
            line("components", amounts::count(components));
        }
        if let Some(architecture) = &self.architecture {
            line("architecture", architecture_in_words(architecture));
        }
        line("seed", scenario.seed.to_string());
        line("made by", format!("phytomer {} ({})", self.words("version"), self.words("git_hash")));
        line("files", self.files_in_words());
        if self.overgrown() > 0 {
            line(
                "limits",
                format!("{} came to the limit: `overgrown` in run.json", amounts::of(self.overgrown() as u64, "plant")),
            );
        }
        text + &self.tables_in_words() + &self.population_in_words()
    }

    /// The living at each recorded age, as means with their standard deviations.
    fn population_in_words(&self) -> String {
        if self.population.is_empty() {
            return String::new();
        }
        let mut text = format!(
            "\n  {:>5} {:>9} {:>9} {:>16} {:>20} {:>16} {:>13}\n",
            "age", "living", "dead", "height, m", "internodes", "leaf area, m2", "effective, m2"
        );
        for (age, of) in &self.population {
            let _ = writeln!(
                text,
                "  {age:>5} {:>9} {:>9} {:>16} {:>20} {:>16} {:>13}",
                amounts::count(of.living),
                amounts::count(of.dead),
                spread(&of.height_m, 2),
                spread(&of.internodes, 1),
                spread(&of.leaf_area_m2, 2),
                self.effective_of(*age, of).map_or_else(|| "-".to_owned(), |area| format!("{area:.2}"))
            );
        }
        text
    }

    /// The mean of living plants: what the leaves of each cover together, seen from above.
    fn effective_of(&self, age: u32, of: &AgeOfPopulation) -> Option<f64> {
        let sum = self.effective.as_ref()?.get(&age).copied().unwrap_or_default();
        (of.living > 0).then(|| sum / of.living as f64)
    }

    fn population_as_json(&self) -> Vec<Value> {
        let moments = |of: &Moments| json!({"n": of.n, "mean": of.mean, "sd": of.standard_deviation()});
        let row = |(age, of): (&u32, &AgeOfPopulation)| {
            json!({
                "age": age,
                "living": of.living,
                "dead": of.dead,
                "height_m": moments(&of.height_m),
                "internodes": moments(&of.internodes),
                "leaf_area_m2": moments(&of.leaf_area_m2),
                "effective_leaf_area_m2": self.effective_of(*age, of),
            })
        };
        self.population.iter().map(row).collect()
    }

    fn plants_in_words(&self) -> String {
        let plants = amounts::count(self.recorded.trial.plants().into());
        match (self.number("living"), self.number("dead")) {
            (Some(living), Some(dead)) => {
                let own = match self.found.as_ref().and_then(|found| found.share) {
                    Some(_) => format!("{} of the {plants} of the run", amounts::count(living + dead)),
                    None => plants,
                };
                format!("{own}: {} living, {} dead", amounts::count(living), amounts::count(dead))
            }
            _ => format!("{plants}, not all of them grown yet; --resume goes on"),
        }
    }

    fn tables_in_words(&self) -> String {
        let mut text = format!("\n  {:<11} {:>15} {:>7} {:>9}\n", "table", "rows", "files", "size");
        for (table, size) in &self.tables {
            let (rows, bytes) = (amounts::count(size.rows), amounts::bytes(size.bytes as f64));
            let _ = writeln!(text, "  {:<11} {rows:>15} {:>7} {bytes:>9}", table.name(), size.files);
        }
        if self.meshes.files > 0 {
            let bytes = amounts::bytes(self.meshes.bytes as f64);
            let _ = writeln!(text, "  {:<11} {:>15} {:>7} {bytes:>9}", "meshes", "", self.meshes.files);
        }
        text
    }
}

/// "massart (8), of 8 plants looked at".
fn architecture_in_words(of: &Qualified) -> String {
    let words: Vec<String> = of.models.iter().map(|(model, plants)| format!("{model} ({plants})")).collect();
    let looked = amounts::of(of.plants.into(), "plant");
    match words.len() {
        0 => format!("none of the 23 models, of {looked} looked at"),
        _ => format!("{}, of {looked} looked at", words.join(", ")),
    }
}

/// "3.02 ± 0.41"; a dash where nothing was measured.
fn spread(moments: &Moments, digits: usize) -> String {
    match (moments.n, moments.standard_deviation()) {
        (0, _) => "-".to_owned(),
        (_, None) => format!("{:.digits$}", moments.mean),
        (_, Some(deviation)) => format!("{:.digits$} ± {deviation:.digits$}", moments.mean),
    }
}

/// "12 recorded of 60: 5, 10, 15, … 60".
pub fn ages_in_words(recorded: &[u32], until: u32) -> String {
    const SHOWN: usize = 12;
    let words: Vec<String> = recorded.iter().map(u32::to_string).collect();
    match words.len() {
        0 => format!("to {until}, none recorded"),
        n if n as u32 == until => format!("1 to {until}, all recorded"),
        n if n <= SHOWN => format!("to {until}, recorded at {}", words.join(", ")),
        n => format!("to {until}, {n} recorded: {}, … {}", words[..4].join(", "), words[n - 1]),
    }
}
