//! Reads a run folder back: `run.json`, and the schemas, metadata and rows of its tables.
//!
//! For `describe`, analysis and tests. A run that is not finished can be read as far as it is written: a part is read
//! where `run.json` or the journal names it. A `run.json` whose check does not hold is refused, since plants are grown
//! again from it.

use crate::run_folder::{Error, Papers, RunJson};
use crate::storage::FileError;
use crate::storage::durable::files_in;
use crate::tables::{Table, TableBatches, TableError};
use arrow_array::types::{Float64Type, Int32Type};
use arrow_array::{Array, BooleanArray, PrimitiveArray, RecordBatch};
use arrow_schema::SchemaRef;
use parquet::arrow::ProjectionMask;
use parquet::arrow::arrow_reader::{ParquetRecordBatchReader, ParquetRecordBatchReaderBuilder};
use parquet::errors::ParquetError;
use parquet::file::metadata::ParquetMetaData;
use phytomer_sim::Tick;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A run folder, opened for reading.
#[derive(Debug, Clone)]
pub struct Run {
    path: PathBuf,
    json: Value,
    /// The files that belong to the run; `None` for a run of an older program.
    named: Option<BTreeSet<PathBuf>>,
    /// The rows, of a run whose tables are in memory.
    rows: Option<Arc<TableBatches>>,
}

/// One row of `summary`, in the units of its columns.
#[derive(Debug, Clone, PartialEq)]
#[expect(missing_docs, reason = "the columns are described in tables::columns::SUMMARY")]
pub struct SummaryRow {
    pub plot_id: u32,
    pub plant_id: u32,
    pub tick: Tick,
    pub age: Tick,
    pub internodes: u32,
    pub leaves: u32,
    pub flowers: u32,
    pub fruits: u32,
    pub buds: u32,
    pub dead_internodes: u32,
    pub axes: u32,
    pub max_order: u32,
    pub height_m: Option<f64>,
    pub crown_width_m: Option<f64>,
    pub leaf_area_m2: f64,
    pub wood_volume_m3: f64,
    pub alive: bool,
    pub death_age: Option<Tick>,
    pub harvested_fruits: u32,
    pub harvested_fresh_mass_kg: Option<f64>,
}

impl Run {
    /// Opens a run folder. Reads `run.json` and the journal, but no table.
    ///
    /// # Errors
    /// [`Error::NotARun`], [`Error::Damaged`], or a failed read.
    pub fn open(path: &Path) -> Result<Self, Error> {
        let papers = Papers::read(path)?;
        let named = papers.names().map(|names| names.into_iter().map(|name| path.join(name)).collect());
        let path = path.to_path_buf();
        match papers.run {
            RunJson::Missing => Err(Error::NotARun { path }),
            RunJson::Damaged { .. } => Err(Error::Damaged { path: path.join("run.json") }),
            RunJson::Older(json) => Ok(Self { path, json, named: None, rows: None }),
            RunJson::Whole(json) => Ok(Self { path, json, named, rows: None }),
        }
    }

    /// A run whose tables are in memory, with what `run.json` would hold; `name` stands for its folder.
    pub fn in_memory(name: &str, json: Value, rows: TableBatches) -> Self {
        Self { path: PathBuf::from(name), json, named: None, rows: Some(Arc::new(rows)) }
    }

    /// Whether the run has rows of a table.
    ///
    /// # Errors
    /// Where the folder cannot be read.
    pub fn has(&self, table: Table) -> Result<bool, Error> {
        match &self.rows {
            Some(rows) => Ok(rows.contains_key(&table)),
            None => Ok(!self.parts(table)?.is_empty()),
        }
    }

    /// The path of the run folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The content of `run.json`.
    pub fn json(&self) -> &Value {
        &self.json
    }

    /// Whether the run was finished.
    pub fn is_complete(&self) -> bool {
        self.json["status"] == "complete"
    }

    /// The part files of a table that exist, sorted by name; empty where the run has no such table.
    ///
    /// # Errors
    /// Where the folder cannot be read.
    pub fn parts(&self, table: Table) -> Result<Vec<PathBuf>, Error> {
        let mut files = files_in(&self.path.join(table.name()))?;
        files.retain(|file| {
            let name = file.file_name().unwrap_or_default().to_string_lossy();
            let is_part = name.starts_with("part-") && name.ends_with(".parquet");
            is_part && self.named.as_ref().is_none_or(|named| named.contains(file))
        });
        Ok(files)
    }

    /// The tables of the run, each with its number of rows. Reads the footers of all parts, no rows.
    ///
    /// # Errors
    /// Where a part cannot be read.
    pub fn rows(&self) -> Result<BTreeMap<Table, u64>, Error> {
        let mut rows = BTreeMap::new();
        for table in Table::ALL {
            for part in self.parts(table)? {
                *rows.entry(table).or_default() += open(&part)?.metadata().file_metadata().num_rows() as u64;
            }
        }
        Ok(rows)
    }

    /// The Arrow schema of a table, from its first part; `None` where the table has no part.
    ///
    /// # Errors
    /// Where the part cannot be read.
    pub fn schema(&self, table: Table) -> Result<Option<SchemaRef>, Error> {
        let parts = self.parts(table)?;
        parts.first().map(|part| Ok(open(part)?.schema().clone())).transpose()
    }

    /// The Parquet metadata of each part of a table: row groups, encodings, statistics.
    ///
    /// # Errors
    /// Where a part cannot be read.
    pub fn parquet(&self, table: Table) -> Result<Vec<Arc<ParquetMetaData>>, Error> {
        self.parts(table)?.iter().map(|part| Ok(open(part)?.metadata().clone())).collect()
    }

    /// The key-value metadata of a table's first part; empty where the table has no part.
    ///
    /// # Errors
    /// Where the part cannot be read.
    pub fn metadata(&self, table: Table) -> Result<BTreeMap<String, String>, Error> {
        let parts = self.parquet(table)?;
        let pairs = parts.first().and_then(|part| part.file_metadata().key_value_metadata().cloned());
        Ok(pairs.into_iter().flatten().map(|pair| (pair.key, pair.value.unwrap_or_default())).collect())
    }

    /// An iterator over the rows of a table in record batches, part after part. One batch is in memory at a time.
    ///
    /// # Errors
    /// Where the folder cannot be read. Where a part cannot be read, the iterator returns the error and ends.
    pub fn batches(&self, table: Table) -> Result<Batches, Error> {
        self.batches_of(table, 8192)
    }

    /// As [`Run::batches`], with at most `rows` rows in a batch.
    ///
    /// # Errors
    /// As [`Run::batches`].
    pub fn batches_of(&self, table: Table, rows: usize) -> Result<Batches, Error> {
        let of_table = self.rows.as_ref().map(|rows| rows.get(&table).cloned().unwrap_or_default());
        let parts = if of_table.is_some() { Vec::new() } else { self.parts(table)? };
        let in_memory = of_table.unwrap_or_default().into_iter();
        Ok(Batches { parts: parts.into_iter(), rows, columns: None, now: None, in_memory })
    }

    /// As [`Run::batches`], with only those of the named columns that the table has, in the order of the table. No
    /// other column is read from the disk.
    ///
    /// # Errors
    /// As [`Run::batches`].
    pub fn batches_with(&self, table: Table, columns: &[&str]) -> Result<Batches, Error> {
        let columns = Some(columns.iter().map(|name| (*name).to_owned()).collect());
        Ok(Batches { columns, ..self.batches(table)? })
    }

    /// All rows of `summary`, in the order of the table: one per plant and recorded tick.
    ///
    /// # Errors
    /// Where a part cannot be read.
    pub fn summary(&self) -> Result<Vec<SummaryRow>, Error> {
        let mut rows = Vec::new();
        for batch in self.batches(Table::Summary)? {
            let batch = batch?;
            let columns = SummaryBatch { batch: &batch, path: &self.path };
            for row in 0..batch.num_rows() {
                rows.push(columns.row(row)?);
            }
        }
        Ok(rows)
    }
}

fn open(part: &Path) -> Result<ParquetRecordBatchReaderBuilder<File>, TableError> {
    let file = File::open(part).map_err(FileError::io("open", part))?;
    caught(|| ParquetRecordBatchReaderBuilder::try_new(file)).map_err(TableError::read(part))
}

/// Calls a reader of Parquet and turns a panic into an error. The crates that read Parquet panic on some damaged files,
/// such as on an integer of 33,554,464 bits in a schema. A reader that has panicked must not be used again.
fn caught<T>(work: impl FnOnce() -> Result<T, ParquetError>) -> Result<T, ParquetError> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|cause| {
        let text = cause.downcast_ref::<String>().cloned();
        let text = text.or_else(|| cause.downcast_ref::<&str>().map(|text| (*text).to_owned()));
        Err(ParquetError::General(text.unwrap_or_else(|| "a damaged file".to_owned())))
    })
}

/// An iterator over the record batches of a table.
pub struct Batches {
    parts: std::vec::IntoIter<PathBuf>,
    rows: usize,
    /// The columns that are read; `None` for all.
    columns: Option<Vec<String>>,
    now: Option<(PathBuf, ParquetRecordBatchReader)>,
    /// The batches of a run in memory.
    in_memory: std::vec::IntoIter<RecordBatch>,
}

impl Batches {
    fn open_next(&mut self) -> Option<Result<(), TableError>> {
        let part = self.parts.next()?;
        let build = |file: ParquetRecordBatchReaderBuilder<File>| {
            let mask = self
                .columns
                .as_ref()
                .map(|names| ProjectionMask::columns(file.parquet_schema(), names.iter().map(String::as_str)));
            let file = file.with_batch_size(self.rows);
            let file = match mask {
                Some(mask) => file.with_projection(mask),
                None => file,
            };
            caught(|| file.build())
        };
        let reader = open(&part).and_then(|file| build(file).map_err(TableError::read(&part)));
        Some(reader.map(|reader| self.now = Some((part, reader))))
    }

    /// A batch in memory with the columns that are read.
    fn chosen(&self, batch: RecordBatch) -> Result<RecordBatch, TableError> {
        let Some(names) = &self.columns else { return Ok(batch) };
        let schema = batch.schema();
        let is_read = |place: &usize| names.iter().any(|name| name == schema.field(*place).name());
        let places: Vec<usize> = (0..batch.num_columns()).filter(is_read).collect();
        batch.project(&places).map_err(|source| TableError::Batch { table: "in memory", source: source.into() })
    }

    /// Ends the iterator: no batch comes after an error.
    fn ended_by(&mut self, error: TableError) -> TableError {
        (self.parts, self.now) = (Vec::new().into_iter(), None);
        error
    }
}

impl Iterator for Batches {
    type Item = Result<RecordBatch, TableError>;

    fn next(&mut self) -> Option<Self::Item> {
        if let Some(batch) = self.in_memory.next() {
            return Some(self.chosen(batch));
        }
        loop {
            if let Some((part, reader)) = &mut self.now {
                match caught(|| Ok(reader.next().transpose()?)).map_err(TableError::read(part)) {
                    Ok(None) => {}
                    Ok(Some(batch)) => return Some(Ok(batch)),
                    Err(error) => return Some(Err(self.ended_by(error))),
                }
            }
            if let Err(error) = self.open_next()? {
                return Some(Err(self.ended_by(error)));
            }
        }
    }
}

struct SummaryBatch<'a> {
    batch: &'a RecordBatch,
    path: &'a Path,
}

impl SummaryBatch<'_> {
    fn row(&self, row: usize) -> Result<SummaryRow, TableError> {
        Ok(SummaryRow {
            plot_id: self.count("plot_id", row)?,
            plant_id: self.count("plant_id", row)?,
            // Runs of older programs have no column `tick`; their plants were all sown at tick 0.
            tick: self.count(if self.has("tick") { "tick" } else { "age" }, row)?,
            age: self.count("age", row)?,
            internodes: self.count("internodes", row)?,
            leaves: self.count("leaves", row)?,
            flowers: self.count("flowers", row)?,
            fruits: self.count("fruits", row)?,
            buds: self.count("buds", row)?,
            dead_internodes: self.count("dead_internodes", row)?,
            axes: self.count("axes", row)?,
            max_order: self.count("max_order", row)?,
            height_m: self.real("height_m", row)?,
            crown_width_m: self.real("crown_width_m", row)?,
            leaf_area_m2: self.real("leaf_area_m2", row)?.unwrap_or_default(),
            wood_volume_m3: self.real("wood_volume_m3", row)?.unwrap_or_default(),
            alive: self.column::<BooleanArray>("alive")?.value(row),
            death_age: self.number("death_age", row)?,
            // Runs of older programs harvest nothing.
            harvested_fruits: match self.has("harvested_fruits") {
                true => self.count("harvested_fruits", row)?,
                false => 0,
            },
            harvested_fresh_mass_kg: match self.has("harvested_fresh_mass_kg") {
                true => self.real("harvested_fresh_mass_kg", row)?,
                false => None,
            },
        })
    }

    fn has(&self, column: &str) -> bool {
        self.batch.column_by_name(column).is_some()
    }

    fn column<A: 'static>(&self, column: &'static str) -> Result<&A, TableError> {
        let array = self.batch.column_by_name(column).and_then(|array| array.as_any().downcast_ref());
        array.ok_or(TableError::Column { path: self.path.join(Table::Summary.name()), column })
    }

    fn number(&self, column: &'static str, row: usize) -> Result<Option<u32>, TableError> {
        let array = self.column::<PrimitiveArray<Int32Type>>(column)?;
        Ok(array.is_valid(row).then(|| array.value(row).unsigned_abs()))
    }

    fn count(&self, column: &'static str, row: usize) -> Result<u32, TableError> {
        Ok(self.number(column, row)?.unwrap_or_default())
    }

    fn real(&self, column: &'static str, row: usize) -> Result<Option<f64>, TableError> {
        let array = self.column::<PrimitiveArray<Float64Type>>(column)?;
        Ok(array.is_valid(row).then(|| array.value(row)))
    }
}
