//! Summaries of a recorded run, by the names that simulations have: what was observed, where the plants are those of a
//! run folder.
//!
//! Sizes are read from `summary` at any recorded age; measures of other tables tell of the end of a run, so their age
//! must be its last. Absent: simulations.

use super::measured::value;
use super::summaries::{Summary, What, summarised};
use phytomer_outputs::read::Run;
use phytomer_outputs::{Table, cells};
use std::path::Path;

/// A run that is observed.
pub struct Observed {
    run: Run,
}

impl Observed {
    /// Opens a run folder.
    ///
    /// # Errors
    /// In words: no run, or one that is not finished.
    pub fn open(folder: &Path) -> Result<Self, String> {
        let run = Run::open(folder).map_err(|error| error.to_string())?;
        match run.is_complete() {
            true => Ok(Self { run }),
            false => Err(format!("{}: the run is not finished; `phytomer grow --resume` ends it", folder.display())),
        }
    }

    /// The number of its plants.
    ///
    /// # Errors
    /// In words: a table that cannot be read.
    pub fn plants(&self) -> Result<usize, String> {
        Ok(cells::of_run(&self.run, Table::Plants, &["plant_id"])?.1.len())
    }

    /// The value of a summary.
    ///
    /// # Errors
    /// In words: an age that was not recorded, a table that the run has not, no plant with a value.
    pub fn of(&self, summary: &Summary) -> Result<f64, String> {
        let found = match &summary.what {
            What::Size { column, spread, .. } => self.size(summary, column, *spread)?,
            What::Living => self.living(summary)?,
            what => {
                self.check_last(summary)?;
                value(what, &self.run)?
            }
        };
        let path = self.run.path().display();
        found.ok_or_else(|| format!("{path}: no plant has a value of {}", summary.name))
    }

    fn check_last(&self, summary: &Summary) -> Result<(), String> {
        let until = self.run.json()["until"].as_u64().unwrap_or_default();
        if until == u64::from(summary.age) {
            return Ok(());
        }
        let path = self.run.path().display();
        Err(format!(
            "{path}: {} tells of the end of a run, and this one ends at {until}: ask for @{until}",
            summary.name
        ))
    }

    fn size(&self, summary: &Summary, column: &str, spread: bool) -> Result<Option<f64>, String> {
        let (names, rows) = self.summary(&["age", "alive", column])?;
        let place = |name: &str| names.iter().position(|own| own == name);
        let (Some(age), Some(alive), Some(column)) = (place("age"), place("alive"), place(column)) else {
            return Err(format!("{}: summary has no column {column}", self.run.path().display()));
        };
        let at_age = self.at_age(summary, &rows, age)?;
        let values: Vec<f64> =
            at_age.filter(|row| row[alive] == "1").filter_map(|row| row[column].parse().ok()).collect();
        Ok(summarised(&values, spread))
    }

    fn living(&self, summary: &Summary) -> Result<Option<f64>, String> {
        let (names, rows) = self.summary(&["age", "alive"])?;
        let place = |name: &str| names.iter().position(|own| own == name);
        let (Some(age), Some(alive)) = (place("age"), place("alive")) else { return Ok(None) };
        let all: Vec<f64> =
            self.at_age(summary, &rows, age)?.map(|row| f64::from(u8::from(row[alive] == "1"))).collect();
        Ok(summarised(&all, false))
    }

    fn summary(&self, columns: &[&str]) -> Result<cells::Cells, String> {
        let found = cells::of_run(&self.run, Table::Summary, columns)?;
        match found.1.is_empty() {
            true => Err(format!("{}: the run has no rows of summary", self.run.path().display())),
            false => Ok(found),
        }
    }

    fn at_age<'a>(
        &self,
        summary: &Summary,
        rows: &'a [Vec<String>],
        age: usize,
    ) -> Result<impl Iterator<Item = &'a Vec<String>> + use<'a>, String> {
        let wanted = summary.age.to_string();
        if !rows.iter().any(|row| row[age] == wanted) {
            let mut ages: Vec<u32> = rows.iter().filter_map(|row| row[age].parse().ok()).collect();
            ages.sort_unstable();
            ages.dedup();
            let ages: Vec<String> = ages.iter().map(u32::to_string).collect();
            let path = self.run.path().display();
            return Err(format!("{path}: no plant was recorded at age {wanted}; recorded: {}", ages.join(", ")));
        }
        Ok(rows.iter().filter(move |row| row[age] == wanted))
    }
}
