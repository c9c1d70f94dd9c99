//! Where full row groups of a table go: to a Parquet file (`part`) or into memory (`memory`).
//!
//! A [`Rows`] is a table being filled: rows go into its column buffers, and a full row group goes to the sink. Memory
//! is bounded by one row group and by what the sink keeps.

use super::buffers::{Columns, Values};
use super::{ROW_GROUP, TableError};

/// What takes the row groups of one table, in their order.
pub trait Sink {
    /// What is left of it at the end.
    type Closed;

    /// Takes a row group of so many rows: one buffer a column of the table, those that the run does not ask for empty.
    /// Emptied buffers that come back lend their memory to a later row group.
    ///
    /// # Errors
    /// Where the row group cannot be kept.
    fn put(&mut self, rows: usize, columns: Vec<Values>) -> Result<Option<Vec<Values>>, TableError>;

    /// Completes the table.
    ///
    /// # Errors
    /// Where a row group cannot be kept.
    fn close(self) -> Result<Self::Closed, TableError>;
}

/// A table being filled.
pub struct Rows<C, S> {
    /// The rows of the row group that is being filled; [`Rows::flush_if_full`] goes after each row.
    pub columns: C,
    sink: S,
}

impl<C: Columns, S: Sink> Rows<C, S> {
    /// No rows yet, on their way to a sink.
    pub fn to(sink: S) -> Self {
        Self { columns: C::default(), sink }
    }

    /// The rows that still fit into the row group.
    pub fn room(&self) -> usize {
        ROW_GROUP - self.columns.rows()
    }

    /// Sends a full row group on its way.
    #[inline]
    pub fn flush_if_full(&mut self) -> Result<(), TableError> {
        if self.columns.rows() < ROW_GROUP { Ok(()) } else { self.flush() }
    }

    #[cold]
    fn flush(&mut self) -> Result<(), TableError> {
        let rows = self.columns.rows();
        if let Some(buffers) = self.sink.put(rows, self.columns.take())? {
            self.columns.give_back(buffers);
        }
        Ok(())
    }

    /// Sends what is left on its way and completes the table.
    pub fn close(mut self) -> Result<S::Closed, TableError> {
        if self.columns.rows() > 0 {
            self.flush()?;
        }
        self.sink.close()
    }
}
