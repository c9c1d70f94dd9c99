//! The destination of full row groups of a table: a Parquet file (`part`) or memory (`memory`).
//!
//! [`Rows`] is a table that is being filled: rows go into its column buffers, and a full row group goes to the sink.
//! The memory is that of one row group and of what the sink keeps.

use super::buffers::{Columns, Values};
use super::{ROW_GROUP, TableError};

/// A destination of the row groups of one table, which come in their order.
pub trait Sink {
    /// The result of the completed table.
    type Closed;

    /// Takes a row group of `rows` rows: one buffer per column of the table, empty for columns that the run does not
    /// have. Returned buffers are empty, and a later row group uses their memory.
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

/// A table that is being filled.
pub struct Rows<C, S> {
    /// The rows of the present row group. Call [`Rows::flush_if_full`] after adding rows.
    pub columns: C,
    sink: S,
}

impl<C: Columns, S: Sink> Rows<C, S> {
    /// An empty table with its sink.
    pub fn to(sink: S) -> Self {
        Self { columns: C::default(), sink }
    }

    /// The number of rows that still fit into the row group.
    pub fn room(&self) -> usize {
        ROW_GROUP - self.columns.rows()
    }

    /// Passes a full row group to the sink; does nothing before it is full.
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

    /// Passes the last row group to the sink and completes the table.
    pub fn close(mut self) -> Result<S::Closed, TableError> {
        if self.columns.rows() > 0 {
            self.flush()?;
        }
        self.sink.close()
    }
}
