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

/// The record batches of each table of the plan, in the order of its rows.
pub type TableBatches = BTreeMap<Table, Vec<RecordBatch>>;

/// A [`Recorder`] that keeps the tables of its plots in memory.
///
/// Plots come one after another; each is ended by [`MemoryTables::end_plot`].
pub struct MemoryTables {
    recording: Recording<MemorySink>,
}

impl MemoryTables {
    /// Empty tables for a plan.
    pub fn of(plan: &RunPlan) -> Self {
        let Ok(recording) = Recording::of(plan, |table| Ok::<_, std::convert::Infallible>(MemorySink::of(table, plan)));
        Self { recording }
    }

    /// Adds the components, events and `plants` rows of a plot. Call it after the last tick of the plot.
    ///
    /// # Errors
    /// [`TableError::PlantTooLarge`].
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
    batches: Vec<RecordBatch>,
}

impl MemorySink {
    fn of(table: Table, plan: &RunPlan) -> Self {
        let declared = plan.columns(table);
        let metadata = arrow::key_values(table, plan).into_iter();
        let metadata = metadata.map(|pair| (pair.key, pair.value.unwrap_or_default())).collect();
        Self {
            table,
            declared,
            schema: Arc::new(arrow::schema(declared).as_ref().clone().with_metadata(metadata)),
            words: words_of_run(declared, plan),
            precision_m: plan.precision_m.map(|precision| precision as f32),
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
        self.batches.push(batch.map_err(|source| TableError::Batch { table, source: source.into() })?);
        Ok(None)
    }

    fn close(self) -> Result<Vec<RecordBatch>, TableError> {
        Ok(self.batches)
    }
}
