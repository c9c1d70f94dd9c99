//! Tables in memory: Arrow record batches with the rows, schemas and metadata of the Parquet files of a run.
//!
//! For programs that query a run, or pass it on, without files. A batch is one row group. The memory is that of all
//! rows, about 0.1 kB per row of `components` or `records`, until the batches are dropped. Absent: encodings and
//! compression, which only files need.

use super::buffers::{self, Values};
use super::part::words_of_run;
use super::recording::Recording;
use super::schema::Column;
use super::sink::Sink;
use super::{RunPlan, Table, TableError, arrow};
use arrow_array::{RecordBatch, StringArray};
use arrow_schema::{ArrowError, SchemaRef};
use phytomer_sim::{Ending, Plot, RecordError, Recorder, Tick};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// The record batches of each table of the plan, in the order of its rows.
pub type TableBatches = BTreeMap<Table, Vec<RecordBatch>>;

/// The memory that the tables of a run may take, shared by the threads that fill them.
#[derive(Debug)]
pub struct Room {
    most: u64,
    taken: AtomicU64,
}

impl Room {
    /// Room for so many bytes of full row groups. Row groups that are being filled come on top: at most 122,880 rows of
    /// each table and thread.
    pub fn of(most: u64) -> Self {
        Self { most, taken: AtomicU64::new(0) }
    }

    /// Takes room for a batch of a table.
    fn take(&self, table: Table, batch: &RecordBatch) -> Result<(), TableError> {
        let bytes = batch.get_array_memory_size() as u64;
        let taken = self.taken.fetch_add(bytes, Relaxed).saturating_add(bytes);
        if taken > self.most {
            return Err(TableError::NoRoom { table: table.name(), most_mb: self.most / 1_000_000 });
        }
        Ok(())
    }
}

impl Default for Room {
    /// Without a bound.
    fn default() -> Self {
        Self::of(u64::MAX)
    }
}

/// A [`Recorder`] that keeps the tables of its plots in memory.
///
/// Plots come one after another; each is ended by [`MemoryTables::end_plot`].
pub struct MemoryTables {
    recording: Recording<MemorySink>,
}

impl MemoryTables {
    /// Empty tables for a plan, which together with others take no more than this room.
    pub fn of(plan: &RunPlan, room: &Arc<Room>) -> Self {
        let open = |table| Ok::<_, std::convert::Infallible>(MemorySink::of(table, plan, Arc::clone(room)));
        let Ok(recording) = Recording::of(plan, open);
        Self { recording }
    }

    /// Adds the components, events and `plants` rows of a plot. Call it after the last tick of the plot.
    ///
    /// # Errors
    /// [`TableError::PlantTooLarge`], [`TableError::NoRoom`].
    pub fn end_plot(&mut self, plot: &Plot, ending: &Ending) -> Result<(), TableError> {
        let last = self.recording.last_tick(ending);
        self.recording.end_plot(plot, last)
    }

    /// The record batches of all tables of the plan.
    ///
    /// # Errors
    /// Where Arrow refuses a batch; batches with the declared columns are accepted.
    pub fn finish(self) -> Result<TableBatches, TableError> {
        Ok(self.recording.close()?.into_iter().collect())
    }
}

impl Recorder for MemoryTables {
    fn wants(&self, tick: Tick) -> bool {
        self.recording.wants(tick)
    }

    fn grown(&mut self, until: Tick, plot: &Plot) -> Result<(), RecordError> {
        Ok(self.recording.grown(until, plot)?)
    }

    fn record(&mut self, tick: Tick, plot: &Plot) -> Result<(), RecordError> {
        Ok(self.recording.record(tick, plot)?)
    }
}

/// A sink that keeps row groups as record batches.
struct MemorySink {
    table: Table,
    declared: &'static [Column],
    schema: SchemaRef,
    words: Vec<Arc<StringArray>>,
    precision_m: Option<f32>,
    room: Arc<Room>,
    batches: Vec<RecordBatch>,
}

impl MemorySink {
    fn of(table: Table, plan: &RunPlan, room: Arc<Room>) -> Self {
        let declared = plan.columns(table);
        let metadata = arrow::key_values(table, plan).into_iter();
        let metadata = metadata.map(|pair| (pair.key, pair.value.unwrap_or_default())).collect();
        Self {
            table,
            declared,
            schema: Arc::new(arrow::schema(declared).as_ref().clone().with_metadata(metadata)),
            words: words_of_run(declared, plan),
            precision_m: plan.precision_m.map(|precision| precision as f32),
            room,
            batches: Vec::new(),
        }
    }

    fn batch(&self, columns: Vec<Values>) -> Result<RecordBatch, ArrowError> {
        // The buffers after the columns of this run are empty, and are dropped.
        let columns = self.declared.iter().zip(columns).zip(&self.words).map(|((column, mut values), words)| {
            if let Some(precision) = self.precision_m {
                buffers::round(&mut values, column.rounding, precision);
            }
            buffers::lend(values, column, words).map(|(array, _)| array)
        });
        RecordBatch::try_new(self.schema.clone(), columns.collect::<Result<_, _>>()?)
    }
}

impl Sink for MemorySink {
    type Closed = Vec<RecordBatch>;

    fn put(&mut self, _rows: usize, columns: Vec<Values>) -> Result<Option<Vec<Values>>, TableError> {
        let batch = self.batch(columns);
        let table = self.table.name();
        let batch = batch.map_err(|source| TableError::Batch { table, source: source.into() })?;
        self.room.take(self.table, &batch)?;
        self.batches.push(batch);
        Ok(None)
    }

    /// A table without rows is one empty batch, so that its columns are known.
    fn close(self) -> Result<Vec<RecordBatch>, TableError> {
        if self.batches.is_empty() {
            return Ok(vec![RecordBatch::new_empty(self.schema)]);
        }
        Ok(self.batches)
    }
}
