//! One part file of one table: full row groups are encoded column by column and written in their order.
//!
//! The memory is that of [`IN_FLIGHT`] row groups and the row group that is being filled, whatever the number of
//! plants. The file is hashed while it is written.

use super::buffers::Values;
use super::encode::{Job, Queue, RowGroup};
use super::pages::Described;
use super::schema::{Column, Named, Type};
use super::sink::Sink;
use super::{Provenance, RunPlan, Table, TableError, arrow};
use crate::storage::durable::HashingFile;
use crate::storage::space::Watch;
use arrow_array::StringArray;
use arrow_schema::SchemaRef;
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_writer::ArrowRowGroupWriterFactory;
use parquet::errors::ParquetError;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::ColumnDescPtr;
use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The number of row groups that may be in encoding while the next one is filled.
const IN_FLIGHT: usize = 3;

/// A part file being written.
pub struct Part {
    declared: &'static [Column],
    path: PathBuf,
    schema: SchemaRef,
    words: Vec<Arc<StringArray>>,
    precision_m: Option<f32>,
    queue: Arc<Queue>,
    watch: Arc<Watch>,
    file: SerializedFileWriter<HashingFile>,
    factory: Arc<ArrowRowGroupWriterFactory>,
    described: Vec<Arc<Described>>,
    in_flight: VecDeque<Arc<RowGroup>>,
    spare: Vec<Vec<Values>>,
    groups: usize,
    rows: u64,
}

/// A part file that was written.
#[derive(Debug, Clone)]
pub struct PartReport {
    /// The number of its rows.
    pub rows: u64,
    /// Its size in bytes.
    pub bytes: u64,
    /// Its SHA-256, in hexadecimal.
    pub sha256: String,
}

impl Part {
    /// Creates the file at `path`, replacing an existing file.
    pub fn create(
        table: Table,
        path: &Path,
        plan: &RunPlan,
        (queue, watch): (&Arc<Queue>, &Arc<Watch>),
    ) -> Result<Self, TableError> {
        let declared = plan.columns(table);
        let schema = arrow::schema(declared);
        let properties = arrow::properties(table, plan).map_err(TableError::write(path))?;
        let writer = ArrowWriter::try_new(HashingFile::create(path, watch)?, schema.clone(), Some(properties));
        let (file, factory) = writer.and_then(ArrowWriter::into_serialized_writer).map_err(TableError::write(path))?;
        let words = words_of_run(declared, plan);
        let columns = file.schema_descr().columns().iter().zip(declared).zip(&words);
        let described = |((column, declared), words): ((&ColumnDescPtr, &Column), &Arc<StringArray>)| {
            Arc::new(Described::of(declared, column.clone(), file.properties().clone(), words))
        };
        let described = columns.map(described).collect();
        Ok(Self {
            declared,
            path: path.to_path_buf(),
            schema,
            words,
            precision_m: plan.precision_m.map(|precision| precision as f32),
            queue: queue.clone(),
            watch: watch.clone(),
            file,
            factory: Arc::new(factory),
            described,
            in_flight: VecDeque::new(),
            spare: Vec::new(),
            groups: 0,
            rows: 0,
        })
    }

    fn submit(&mut self, rows: usize, columns: Vec<Values>) {
        let number = self.groups;
        self.groups += 1;
        self.rows += rows as u64;
        let group = RowGroup::of(self.declared.len());
        // The buffers after the columns of this run are empty, and are dropped.
        let columns = self.declared.iter().zip(columns);
        let job = |(place, (column, values))| Job {
            group: group.clone(),
            place,
            column,
            described: self.described[place].clone(),
            field: self.schema.fields()[place].clone(),
            words: self.words[place].clone(),
            precision_m: self.precision_m,
            values,
            factory: self.factory.clone(),
            number,
        };
        self.queue.submit(columns.enumerate().map(job).collect());
        self.in_flight.push_back(group);
    }

    fn write_first(&mut self) -> Result<(), ParquetError> {
        let Some(group) = self.in_flight.pop_front() else { return Ok(()) };
        let columns = self.queue.finish(&group, &self.watch);
        let mut row_group = self.file.next_row_group()?;
        let mut buffers = Vec::with_capacity(columns.len());
        for column in columns {
            let (chunk, values) = column?;
            chunk.append(&mut row_group)?;
            buffers.push(values);
        }
        row_group.close()?;
        self.spare.push(buffers);
        Ok(())
    }
}

impl Sink for Part {
    type Closed = PartReport;

    fn put(&mut self, rows: usize, columns: Vec<Values>) -> Result<Option<Vec<Values>>, TableError> {
        self.submit(rows, columns);
        while self.in_flight.len() > IN_FLIGHT {
            self.write_first().map_err(TableError::write(&self.path))?;
        }
        Ok(self.spare.pop())
    }

    /// Writes the remaining rows, closes the file and syncs it.
    fn close(mut self) -> Result<PartReport, TableError> {
        while !self.in_flight.is_empty() {
            self.write_first().map_err(TableError::write(&self.path))?;
        }
        let file = self.file.into_inner().map_err(TableError::write(&self.path))?;
        let (bytes, sha256) = file.finish()?;
        Ok(PartReport { rows: self.rows, bytes, sha256 })
    }
}

/// The words of each column of a run; empty for a column of numbers.
pub fn words_of_run(declared: &[Column], plan: &RunPlan) -> Vec<Arc<StringArray>> {
    declared.iter().map(|column| words_of(column, &plan.provenance)).collect()
}

fn words_of(column: &Column, provenance: &Provenance) -> Arc<StringArray> {
    Arc::new(match column.holds {
        Type::Word(words) => StringArray::from_iter_values(words),
        Type::Name(Named::Treatment) => StringArray::from_iter_values(&provenance.treatments),
        Type::Name(Named::State) => StringArray::from_iter_values(provenance.state_names()),
        Type::Name(Named::Species) => StringArray::from_iter_values(&provenance.species),
        _ => StringArray::from_iter_values([""; 0]),
    })
}
