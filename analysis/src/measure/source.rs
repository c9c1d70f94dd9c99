//! The runs that a measure reads, and what is known of their plants before any of their rows is read.
//!
//! Runs are measured together where their tables have one schema and all are finished. Absent: the measures.

use super::columns::Columns;
use super::fault::Fault;
use phytomer_outputs::Table;
use phytomer_outputs::read::Run;
use std::collections::BTreeMap;
use std::path::Path;

/// A run and its plants.
pub(super) struct Source {
    pub run: Run,
    /// The run in the column of groups.
    pub label: String,
    /// The number of the first plant among the plants of all runs.
    pub first: u32,
    /// The plants, by their numbers.
    pub plants: Vec<Plant>,
    /// The level of each factor, by treatment.
    pub levels: BTreeMap<String, BTreeMap<String, String>>,
    /// The words of treatments and species, by the numbers that [`Plant`] has.
    pub treatments: Vec<String>,
    pub species: Vec<String>,
}

/// A row of the table `plants`.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Plant {
    pub treatment: u32,
    /// No species where a measured plant's file tells none.
    pub species: u32,
    pub replicate: i32,
    pub block: i32,
    pub plot: i32,
    /// The tick of its sowing; `None` of a seed that did not germinate.
    pub sown: Option<u32>,
    /// The last recorded age; `None` of a seed that did not germinate.
    pub last: Option<u32>,
    /// Its number within treatment and replicate: plants of one number, replicate and seed share their draws.
    pub number: u32,
    pub ground_area_m2: Option<f64>,
    /// Whether it is a guard of its stand, of which no measure tells.
    pub guard: bool,
}

impl Source {
    /// Opens the runs.
    ///
    /// # Errors
    /// A run that cannot be read or is not finished, or runs of several schemas.
    pub fn open(folders: &[&Path]) -> Result<Vec<Self>, Fault> {
        let runs: Result<Vec<Run>, _> = folders.iter().map(|folder| Run::open(folder)).collect();
        Self::of_runs(runs?)
    }

    /// The same of runs that are open, such as one in memory.
    pub fn of_runs(runs: Vec<Run>) -> Result<Vec<Self>, Fault> {
        let (mut sources, mut first): (Vec<Self>, u32) = (Vec::new(), 0);
        for run in runs {
            if !run.is_complete() {
                return Err(Fault::Unfinished { path: run.path().to_path_buf() });
            }
            if let Some(before) = sources.first() {
                same_schema(&before.run, &run)?;
            }
            let source = Self::of(run, first)?;
            first = first.saturating_add(source.plants.len() as u32);
            sources.push(source);
        }
        Ok(sources)
    }

    fn of(run: Run, first: u32) -> Result<Self, Fault> {
        let label = run.path().file_name().map_or_else(|| "run".into(), |name| name.to_string_lossy().into_owned());
        let (levels, treatments, species) = (BTreeMap::new(), Vec::new(), Vec::new());
        let mut source = Self { run, label, first, plants: Vec::new(), levels, treatments, species };
        source.read_levels()?;
        source.read_plants()?;
        Ok(source)
    }

    /// The recorded ticks of plots.
    pub fn recorded(&self) -> Vec<u32> {
        let ticks = self.run.json()["recorded_ages"].as_array().map(Vec::as_slice).unwrap_or_default();
        ticks.iter().filter_map(|tick| tick.as_u64().and_then(|tick| u32::try_from(tick).ok())).collect()
    }

    /// The seed of the run's draws.
    pub fn seed(&self) -> u64 {
        self.run.json()["seed"].as_u64().unwrap_or_default()
    }

    fn read_levels(&mut self) -> Result<(), Fault> {
        let run = self.run.path().to_path_buf();
        for batch in self.run.batches(Table::Treatments)? {
            let batch = batch?;
            let columns = Columns { batch: &batch, run: &run, table: Table::Treatments.name() };
            let names: Vec<String> = batch.schema().fields().iter().map(|field| field.name().clone()).collect();
            let treatment = columns.words("treatment").or_else(|_| columns.words("name"))?;
            for name in names.iter().filter(|name| *name != "treatment") {
                let Ok(words) = columns.words(name) else { continue };
                for row in 0..columns.rows() {
                    if let (Some(treatment_at), Some(level)) = (treatment.at(row), words.at(row)) {
                        let of = self.levels.entry(name.clone()).or_default();
                        of.insert(treatment.words[treatment_at].clone(), words.words[level].clone());
                    }
                }
            }
        }
        Ok(())
    }

    fn read_plants(&mut self) -> Result<(), Fault> {
        let until = self.run.json()["until"].as_u64().unwrap_or_default() as u32;
        let ends = overgrown(&self.run);
        let path = self.run.path().to_path_buf();
        let mut numbers: BTreeMap<(u32, i32), u32> = BTreeMap::new();
        for batch in self.run.batches(Table::Plants)? {
            let batch = batch?;
            let columns = Columns { batch: &batch, run: &path, table: Table::Plants.name() };
            let int = |name: &str| columns.ints(name);
            let (id, plot, replicate, block) = (int("plant_id")?, int("plot_id")?, int("replicate")?, int("block")?);
            let (sown, treatment, species) =
                (int("sown_tick")?, columns.words("treatment")?, columns.words("species")?);
            let treatment_of = interned(&treatment.words, &mut self.treatments);
            let species_of = interned(&species.words, &mut self.species);
            let ground = columns.has("ground_area_m2").then(|| columns.numbers("ground_area_m2")).transpose()?;
            let guard = columns.has("guard").then(|| columns.ints("guard")).transpose()?;
            for row in 0..columns.rows() {
                let end = ends.get(&plot[row]).copied().unwrap_or(until);
                let plant = Plant {
                    treatment: treatment.at(row).map_or(0, |at| treatment_of[at]),
                    species: species.at(row).map_or(u32::MAX, |at| species_of[at]),
                    replicate: replicate[row],
                    block: block[row],
                    plot: plot[row],
                    sown: u32::try_from(sown[row]).ok(),
                    last: u32::try_from(sown[row]).ok().and_then(|sown| end.checked_sub(sown)),
                    number: 0,
                    ground_area_m2: ground.as_ref().and_then(|ground| ground[row]),
                    guard: guard.as_ref().is_some_and(|guard| guard[row] == 1),
                };
                let at = usize::try_from(id[row]).unwrap_or_default();
                if self.plants.len() <= at {
                    self.plants.resize(at + 1, Plant::default());
                }
                self.plants[at] = plant;
            }
        }
        for plant in &mut self.plants {
            let next = numbers.entry((plant.treatment, plant.replicate)).or_default();
            plant.number = *next;
            *next += 1;
        }
        Ok(())
    }
}

/// The last recorded tick of each plot that ended at a limit.
fn overgrown(run: &Run) -> BTreeMap<i32, u32> {
    let plots = run.json()["overgrown"].as_array().map(Vec::as_slice).unwrap_or_default();
    let of = |plot: &serde_json::Value| {
        let tick = plot["tick"].as_u64()? as u32;
        Some((i32::try_from(plot["plot"].as_u64()?).ok()?, tick.saturating_sub(1)))
    };
    plots.iter().filter_map(of).collect()
}

/// The numbers of words in a list that grows.
fn interned(words: &[String], list: &mut Vec<String>) -> Vec<u32> {
    let number = |word: &String| match list.iter().position(|known| known == word) {
        Some(at) => at as u32,
        None => {
            list.push(word.clone());
            (list.len() - 1) as u32
        }
    };
    words.iter().map(number).collect()
}

fn same_schema(first: &Run, second: &Run) -> Result<(), Fault> {
    let schema = |run: &Run| run.json()["schema_version"].as_str().unwrap_or("unknown").to_owned();
    let (first_schema, second_schema) = (schema(first), schema(second));
    if first_schema == second_schema {
        return Ok(());
    }
    let (first, second) = (first.path().to_path_buf(), second.path().to_path_buf());
    Err(Fault::Schemas { first, first_schema, second, second_schema })
}
