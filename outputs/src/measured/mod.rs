//! Measured plants as a run folder: the tables of a run, of plants that no species grows.
//!
//! `parts` numbers the components of a description and finds their axes, `rows` are the values of the tables. What the
//! file does not say is null, also in columns that a grown run never has null. Dates of observation are ticks: days
//! since the first of the file. A plant that tells its age stands at that tick; where neither is told there is the tick
//! 0. What is not said to be dead counts as living. `resolved_scenario` of `run.json` holds `measured` instead of a
//! scenario. [`MeasuredPlants`] reads such a run, and has its plants as they can be drawn. Absent: plants that grow.

mod drawn;
mod parts;
mod recorded;
mod rows;

use crate::exchange::{Date, Description, Observation};
use crate::run_folder::{Error, Mode, RunFolder, RunReport};
use crate::tables::{Input, Part, Provenance, Queue, RunPlan, Sink, Table};
use parts::{Measured, measured};
pub use recorded::{MeasuredPlants, Row};
use serde_json::json;
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;

/// The tables that measured plants have.
const TABLES: [Table; 4] = [Table::Components, Table::Records, Table::Summary, Table::Plants];

/// Where measured plants come from.
#[derive(Debug, Clone)]
pub struct Source {
    /// The name of the run.
    pub name: String,
    /// The file, as it was named, with its hash.
    pub file: Input,
    /// The word of its format.
    pub format: String,
    /// The version of the program.
    pub version: String,
    /// The commit that the program was built from.
    pub git_hash: String,
}

/// What a run folder of measured plants holds.
#[derive(Debug)]
pub struct Taken {
    /// Its files.
    pub report: RunReport,
    /// How many plants have no place of any component: they cannot be drawn.
    pub without_places: u64,
}

/// Writes a run folder. In memory of about 200 bytes a component beside the description.
///
/// # Errors
/// A folder that is taken, or a failed write.
pub fn write(path: &Path, description: &Description, source: Source, mode: Mode) -> Result<Taken, Error> {
    let ticks = Ticks::of(description);
    let plants: Vec<Measured<'_>> = description.individuals.iter().map(|one| measured(description, one)).collect();
    let without_places = plants.iter().filter(|plant| !plant.has_places()).count() as u64;
    let folder = RunFolder::create(path, plan(description, source, &ticks, without_places), mode)?;
    let mut shard = folder.shard(0)?;
    for table in TABLES {
        shard.put(table, |staged, plan, watch| {
            let queue = Arc::new(Queue::default());
            let mut part = Part::create(table, staged, plan, (&queue, watch))?;
            rows::fill(table, (description, &plants), &ticks, plan.columns(table), &mut part)?;
            part.close()
        })?;
    }
    let components = plants.iter().map(|plant| plant.parts.len() as u64).sum();
    shard.end_measured(plants.len() as u64, components);
    shard.commit()?;
    Ok(Taken { report: folder.finish(&[])?, without_places })
}

fn plan(description: &Description, source: Source, ticks: &Ticks, without_places: u64) -> RunPlan {
    let individuals = &description.individuals;
    let mut species: Vec<String> = individuals.iter().filter_map(|one| one.species.clone()).collect();
    species.sort_unstable();
    species.dedup();
    let told = json!({"measured": {"file": source.file.path, "sha256": source.file.sha256, "format": source.format,
        "plants": individuals.len(), "entities": description.entities(), "plants_without_places": without_places,
        "dates": ticks.dates.iter().map(ToString::to_string).collect::<Vec<_>>()}});
    RunPlan {
        tables: TABLES.to_vec(),
        sample: None,
        recorded: ticks.recorded.clone(),
        until: ticks.recorded.last().copied().unwrap_or(0),
        plots: 1,
        plots_per_part: 1,
        compression_level: 1,
        precision_m: None,
        mechanics: false,
        light: false,
        measured: true,
        calendars: Vec::new(),
        species_of_models: Vec::new(),
        members: Vec::new(),
        provenance: Provenance {
            scenario: source.name,
            treatments: vec!["measured".to_owned()],
            factors: Vec::new(),
            ticks_per_year: vec![description.ticks_per_year; species.len()],
            species,
            states: Vec::new(),
            seed: 0,
            version: source.version,
            git_hash: source.git_hash,
            resolved: told,
            inputs: vec![source.file],
        },
    }
}

/// The ticks at which measured plants are recorded.
#[derive(Debug)]
pub(crate) struct Ticks {
    /// The dates of observation, each once, in order; empty where the file has none.
    dates: Vec<Date>,
    /// The ticks, ascending.
    recorded: Vec<u32>,
}

impl Ticks {
    fn of(description: &Description) -> Self {
        let individuals = &description.individuals;
        let seen = individuals.iter().flat_map(|one| &one.entities).flat_map(|entity| &entity.observations);
        let mut dates: Vec<Date> = seen.filter_map(|seen| seen.date).collect();
        dates.sort_unstable();
        dates.dedup();
        let mut recorded: BTreeSet<u32> = match dates.first() {
            Some(first) => dates.iter().map(|date| days(*date).saturating_sub(days(*first)).max(0) as u32).collect(),
            None => individuals.iter().filter_map(|one| one.age).collect(),
        };
        if recorded.is_empty() {
            recorded.insert(0);
        }
        Self { dates, recorded: recorded.into_iter().collect() }
    }

    /// The tick of an observation; what has no date is seen at the first tick.
    fn tick_of(&self, seen: &Observation) -> u32 {
        match (seen.date, self.dates.first()) {
            (Some(date), Some(first)) => days(date).saturating_sub(days(*first)).max(0) as u32,
            _ => self.recorded.first().copied().unwrap_or(0),
        }
    }
}

/// The number of a day of the Gregorian calendar (Hinnant, "chrono-compatible low-level date algorithms": days from
/// civil).
fn days(date: Date) -> i64 {
    let year = i64::from(date.year) - i64::from(date.month <= 2);
    let era = year.div_euclid(400);
    let month = (i64::from(date.month) + 9) % 12;
    let day_of_year = (153 * month + 2) / 5 + i64::from(date.day) - 1;
    let of_era = year.rem_euclid(400);
    era * 146_097 + of_era * 365 + of_era / 4 - of_era / 100 + day_of_year
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_those_of_the_calendar() {
        let day = |year, month, day| days(Date { year, month, day, minute: None });
        assert_eq!(day(2000, 3, 1) - day(2000, 2, 28), 2);
        assert_eq!(day(1900, 3, 1) - day(1900, 2, 28), 1);
        assert_eq!(day(2007, 12, 31) - day(2007, 7, 16), 168);
    }
}
