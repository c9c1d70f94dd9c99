//! Encodes columns on as many threads as there are, while the thread that grows the plants goes on.
//!
//! A full row group puts one job per column into a queue. The threads of the rayon pool take jobs from it. A thread
//! that needs a finished row group also takes jobs, and then waits only for jobs that other threads have begun. So
//! encoding needs no free thread in the pool, and a waiting shard never grows plants of another shard.

use super::buffers::{self, Values};
use super::pages::{self, Chunk, Described};
use super::schema::Column;
use crate::storage::space::{WaitFor, Watch};
use arrow_array::StringArray;
use arrow_schema::Field;
use parquet::arrow::arrow_writer::{ArrowColumnChunk, ArrowRowGroupWriterFactory, compute_leaves};
use parquet::errors::ParquetError;
use parquet::file::writer::SerializedRowGroupWriter;
use std::collections::VecDeque;
use std::io::Write;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

/// A job: one column of one row group.
pub struct Job {
    /// The row group that gets the result.
    pub group: Arc<RowGroup>,
    /// The index of the column.
    pub place: usize,
    /// The declared column.
    pub column: &'static Column,
    /// The column as its pages need it.
    pub described: Arc<Described>,
    /// The column as an Arrow field.
    pub field: Arc<Field>,
    /// The words of the column; empty for a column of numbers.
    pub words: Arc<StringArray>,
    /// The precision of positions, metres; `None` without rounding.
    pub precision_m: Option<f32>,
    /// The values of the column.
    pub values: Values,
    /// What makes the crate's writer of the column, where it is left to that, and the number of the row group.
    pub factory: Arc<ArrowRowGroupWriterFactory>,
    pub number: usize,
}

/// An encoded column: by this program, or by the crate `parquet`.
pub enum EncodedColumn {
    Own(Chunk),
    OfTheCrate(ArrowColumnChunk),
}

impl EncodedColumn {
    /// Writes it as the next column of a row group.
    pub fn append<W: Write + Send>(self, group: &mut SerializedRowGroupWriter<'_, W>) -> Result<(), ParquetError> {
        match self {
            Self::Own(chunk) => chunk.append(group),
            Self::OfTheCrate(chunk) => chunk.append_to_row_group(group),
        }
    }
}

type Encoded = Result<(EncodedColumn, Values), ParquetError>;

/// A row group whose columns are being encoded.
pub struct RowGroup {
    columns: Mutex<Encoding>,
    finished: Condvar,
}

struct Encoding {
    done: Vec<Option<Encoded>>,
    left: usize,
}

impl RowGroup {
    /// A row group of `columns` columns, of which none is encoded.
    pub fn of(columns: usize) -> Arc<Self> {
        let done = std::iter::repeat_with(|| None).take(columns).collect();
        Arc::new(Self { columns: Mutex::new(Encoding { done, left: columns }), finished: Condvar::new() })
    }

    fn put(&self, place: usize, encoded: Encoded) {
        let mut columns = lock(&self.columns);
        columns.done[place] = Some(encoded);
        columns.left -= 1;
        if columns.left == 0 {
            self.finished.notify_all();
        }
    }

    fn is_finished(&self) -> bool {
        lock(&self.columns).left == 0
    }

    fn wait(&self) -> Vec<Encoded> {
        let mut columns = lock(&self.columns);
        while columns.left > 0 {
            columns = self.finished.wait(columns).unwrap_or_else(PoisonError::into_inner);
        }
        columns.done.drain(..).flatten().collect()
    }
}

/// The jobs of one shard.
#[derive(Default)]
pub struct Queue {
    waiting: Mutex<Waiting>,
}

#[derive(Default)]
struct Waiting {
    jobs: VecDeque<Job>,
    hands: usize,
}

impl Queue {
    /// Adds jobs, and starts workers in the pool until there is one for each thread but this one.
    pub fn submit(self: &Arc<Self>, jobs: Vec<Job>) {
        let spare = rayon::current_num_threads() - 1;
        let mut waiting = lock(&self.waiting);
        waiting.jobs.extend(jobs);
        while waiting.hands < spare {
            waiting.hands += 1;
            let queue = self.clone();
            rayon::spawn(move || queue.work());
        }
    }

    /// Waits for the encoded columns of `group` and returns them in their order. Until then this thread runs jobs from
    /// the queue; the watch counts the time in which there is none.
    pub fn finish(&self, group: &RowGroup, watch: &Watch) -> Vec<Encoded> {
        while !group.is_finished() {
            let Some(job) = lock(&self.waiting).jobs.pop_front() else { break };
            job.run();
        }
        watch.wait(WaitFor::Columns, || group.wait())
    }

    fn work(&self) {
        while let Some(job) = self.next_or_leave() {
            job.run();
        }
    }

    fn next_or_leave(&self) -> Option<Job> {
        let mut waiting = lock(&self.waiting);
        let job = waiting.jobs.pop_front();
        if job.is_none() {
            waiting.hands -= 1;
        }
        job
    }
}

impl Job {
    fn run(self) {
        let (group, place) = (self.group.clone(), self.place);
        group.put(place, self.encode());
    }

    fn encode(self) -> Encoded {
        let Self { place, column, described, field, words, precision_m, mut values, factory, number, .. } = self;
        if let Some(precision) = precision_m {
            buffers::round(&mut values, column.rounding, precision);
        }
        if let Some(chunk) = pages::encode(&values, &described)? {
            values.clear();
            return Ok((EncodedColumn::Own(chunk), values));
        }
        let writer = factory.create_column_writers(number)?.into_iter().nth(place);
        let Some(mut writer) = writer else {
            return Err(ParquetError::General(format!("no writer of column {place}")));
        };
        let (array, lent) = buffers::lend(values, column, &words)?;
        for leaf in compute_leaves(&field, &array)? {
            writer.write(&leaf)?;
        }
        drop(array);
        Ok((EncodedColumn::OfTheCrate(writer.close()?), lent.take_back()))
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
