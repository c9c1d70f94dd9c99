//! Errors of tables: while a table is written, kept in memory or read back.
//!
//! A failed write ends the run; no error is only logged. A message does not repeat its cause, since people are shown
//! the whole chain of causes (`source`).

use crate::storage::FileError;
use parquet::errors::ParquetError;
use std::path::{Path, PathBuf};

/// A failure of a table.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    /// The file system returned an error.
    #[error(transparent)]
    File(#[from] FileError),
    /// A table could not be written.
    #[error("cannot write the table {}", path.display())]
    Write {
        /// The part file.
        path: PathBuf,
        /// The writer's error.
        source: Cause,
    },
    /// A table could not be read.
    #[error("cannot read the table {}", path.display())]
    Read {
        /// The part file.
        path: PathBuf,
        /// The reader's error.
        source: Cause,
    },
    /// A table could not be kept in memory.
    #[error("cannot keep the table {table} in memory")]
    Batch {
        /// The table.
        table: &'static str,
        /// Arrow's error.
        source: Cause,
    },
    /// The tables outgrow the memory that they may take.
    #[error("the tables outgrow the {most_mb} MB of memory that they may take, while `{table}` is filled")]
    NoRoom {
        /// The table that was being filled.
        table: &'static str,
        /// What all tables of the run may take, megabytes.
        most_mb: u64,
    },
    /// A column of a table is not of the type that its schema states.
    #[error("the table {} has no column `{column}` of the stated type", path.display())]
    Column {
        /// The part file.
        path: PathBuf,
        /// The column.
        column: &'static str,
    },
    /// A plant has more components than the tables can hold.
    #[error("plant {plant} has {components} components; tables hold at most {most} a plant: lower max_components")]
    PlantTooLarge {
        /// The plant's number.
        plant: u32,
        /// The number of its components.
        components: u32,
        /// The largest number of components that a table holds.
        most: u32,
    },
}

/// The cause of an error, as another crate reports it.
pub type Cause = Box<dyn std::error::Error + Send + Sync>;

/// The cause of an error of the Parquet crate, which repeats an outer cause in its own message.
fn cause(error: ParquetError) -> Cause {
    match error {
        ParquetError::External(cause) => cause,
        error => error.into(),
    }
}

impl TableError {
    pub(crate) fn write(path: &Path) -> impl FnOnce(ParquetError) -> Self {
        let path = path.to_path_buf();
        move |error| Self::Write { path, source: cause(error) }
    }

    pub(crate) fn read(path: &Path) -> impl FnOnce(ParquetError) -> Self {
        let path = path.to_path_buf();
        move |error| Self::Read { path, source: cause(error) }
    }
}
