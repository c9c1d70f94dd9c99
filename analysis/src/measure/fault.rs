//! Faults of measures: what cannot be asked of these runs, with the file and what to do.
//!
//! What a run has but is too little for an estimate is no fault: the result says so. Absent: faults of the command
//! line.

use phytomer_outputs::Error;
use phytomer_outputs::tables::TableError;
use std::path::PathBuf;

/// Why a measure cannot be taken.
#[derive(Debug, thiserror::Error)]
pub enum Fault {
    /// A file of a run cannot be read.
    #[error(transparent)]
    Run(#[from] Error),
    /// A table cannot be read.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A run is not finished.
    #[error("{}: the run is not finished, and a measure of it would leave out plants; `phytomer grow --resume` goes on", path.display())]
    Unfinished {
        /// The run folder.
        path: PathBuf,
    },
    /// Two runs have tables of other columns.
    #[error(
        "{} has tables of schema {second_schema}, {} of schema {first_schema}; only runs of one schema are measured \
         together: grow one of them again", second.display(), first.display()
    )]
    Schemas {
        /// The first run.
        first: PathBuf,
        /// Its schema.
        first_schema: String,
        /// The run that differs.
        second: PathBuf,
        /// Its schema.
        second_schema: String,
    },
    /// A run has no such table.
    #[error("{}: the run has no table `{table}`, which this measure reads; name it among the `tables` of the scenario and grow again", path.display())]
    NoTable {
        /// The run folder.
        path: PathBuf,
        /// The table.
        table: &'static str,
    },
    /// A table has no such column.
    #[error("{}: the table `{table}` has no column `{column}`; {hint}", path.display())]
    NoColumn {
        /// The run folder.
        path: PathBuf,
        /// The table.
        table: &'static str,
        /// The column.
        column: String,
        /// What to do.
        hint: String,
    },
    /// Rows cannot be grouped so.
    #[error("--by {by}: `{measure}` has no such groups; it has: {allowed}")]
    Grouping {
        /// The grouping.
        by: String,
        /// The measure.
        measure: &'static str,
        /// The groupings that there are.
        allowed: String,
    },
    /// An age was not recorded.
    #[error("--age {age}: {} has no rows of that age; recorded are {recorded}", path.display())]
    Age {
        /// The run folder.
        path: PathBuf,
        /// The age.
        age: u32,
        /// The recorded ages.
        recorded: String,
    },
    /// A word or a number that a measure needs.
    #[error("{0}")]
    Asked(String),
}
