//! The rows of a query as text or as a file: a table for people, CSV, JSON, Parquet.
//!
//! A file is written row after row, whatever their number; a table is held in memory, up to the number of rows that is
//! asked for. A file gets its name when it is whole. Absent: the terminal.

use super::error::Error;
use arrow_array::RecordBatch;
use arrow_array::cast::AsArray;
use arrow_array::types::Float64Type;
use arrow_schema::{ArrowError, DataType, SchemaRef};
use datafusion::arrow::compute::cast;
use datafusion::arrow::csv::{self, WriterBuilder};
use datafusion::arrow::json::ArrayWriter;
use datafusion::arrow::util::display::FormatOptions;
use datafusion::arrow::util::pretty::pretty_format_batches_with_options;
use parquet::arrow::ArrowWriter;
use parquet::basic::{Compression, ZstdLevel};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use phytomer_outputs::Destination;
use std::path::Path;

/// Takes the rows of a query.
pub trait Rows: Send {
    /// Takes the columns, before the first row.
    ///
    /// # Errors
    /// Where the format cannot hold them.
    fn begin(&mut self, schema: &SchemaRef) -> Result<(), Error>;

    /// Takes more rows.
    ///
    /// # Errors
    /// A failed write.
    fn add(&mut self, batch: &RecordBatch) -> Result<(), Error>;

    /// Takes the end of the rows.
    ///
    /// # Errors
    /// A failed write.
    fn finish(self: Box<Self>) -> Result<(), Error>;
}

/// Keeps the first number of the first row, of whatever type, and nothing else.
#[derive(Debug, Default)]
pub struct First(pub Option<f64>);

impl Rows for First {
    fn begin(&mut self, _: &SchemaRef) -> Result<(), Error> {
        Ok(())
    }

    fn add(&mut self, batch: &RecordBatch) -> Result<(), Error> {
        let first = batch.columns().first().filter(|column| self.0.is_none() && !column.is_empty());
        // What is no number is null after the cast.
        let number = first.and_then(|column| cast(column, &DataType::Float64).ok());
        let number = number.and_then(|column| column.as_primitive_opt::<Float64Type>()?.iter().next()?);
        self.0 = self.0.or(number.filter(|number| number.is_finite()));
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<(), Error> {
        Ok(())
    }
}

/// A format of files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Comma-separated values with a header (RFC 4180); null is empty.
    Csv,
    /// An array with an object a row; null is left out.
    Json,
    /// Parquet, zstd.
    Parquet,
}

/// Begins a file of rows.
///
/// # Errors
/// Where the file cannot be created.
pub fn open(path: &Path, format: Format) -> Result<Box<dyn Rows>, Error> {
    let file = Destination::create(path)?;
    Ok(match format {
        Format::Csv => Box::new(Csv(WriterBuilder::new().with_header(true).build(file))),
        Format::Json => Box::new(Json(ArrayWriter::new(file))),
        Format::Parquet => Box::new(Parquet(State::File(file))),
    })
}

fn failed(error: ArrowError) -> Error {
    match error {
        ArrowError::IoError(_, source) => Error::Write(source.to_string()),
        other => Error::Write(other.to_string()),
    }
}

struct Csv(csv::Writer<Destination>);

impl Rows for Csv {
    fn begin(&mut self, schema: &SchemaRef) -> Result<(), Error> {
        self.0.write(&RecordBatch::new_empty(schema.clone())).map_err(failed)
    }

    fn add(&mut self, batch: &RecordBatch) -> Result<(), Error> {
        self.0.write(batch).map_err(failed)
    }

    fn finish(self: Box<Self>) -> Result<(), Error> {
        self.0.into_inner().finish().map(drop).map_err(Error::from)
    }
}

struct Json(ArrayWriter<Destination>);

impl Rows for Json {
    fn begin(&mut self, _schema: &SchemaRef) -> Result<(), Error> {
        Ok(())
    }

    fn add(&mut self, batch: &RecordBatch) -> Result<(), Error> {
        self.0.write(batch).map_err(failed)
    }

    fn finish(mut self: Box<Self>) -> Result<(), Error> {
        self.0.finish().map_err(failed)?;
        self.0.into_inner().finish().map(drop).map_err(Error::from)
    }
}

struct Parquet(State);

/// The file before and after its columns are known.
enum State {
    File(Destination),
    Writer(Box<ArrowWriter<Destination>>),
    Failed,
}

impl Rows for Parquet {
    fn begin(&mut self, schema: &SchemaRef) -> Result<(), Error> {
        let State::File(file) = std::mem::replace(&mut self.0, State::Failed) else { return Ok(()) };
        let written = |error: ParquetError| Error::Write(error.to_string());
        let level = ZstdLevel::try_new(1).map_err(written)?;
        let properties = WriterProperties::builder().set_compression(Compression::ZSTD(level)).build();
        let writer = ArrowWriter::try_new(file, schema.clone(), Some(properties)).map_err(written)?;
        self.0 = State::Writer(Box::new(writer));
        Ok(())
    }

    fn add(&mut self, batch: &RecordBatch) -> Result<(), Error> {
        let State::Writer(writer) = &mut self.0 else { return Ok(()) };
        writer.write(batch).map_err(|error| Error::Write(error.to_string()))
    }

    fn finish(self: Box<Self>) -> Result<(), Error> {
        let State::Writer(writer) = self.0 else { return Ok(()) };
        let file = writer.into_inner().map_err(|error| Error::Write(error.to_string()))?;
        file.finish().map(drop).map_err(Error::from)
    }
}

/// Rows as a table of text, up to a number of rows.
#[derive(Debug)]
pub struct Table {
    most: usize,
    rows: usize,
    batches: Vec<RecordBatch>,
}

/// A table as text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TableText {
    /// The text.
    pub text: String,
    /// The rows that it does not show.
    pub left_out: usize,
}

impl Table {
    /// A table that shows at most `most` rows.
    pub fn of(most: usize) -> Self {
        Self { most, rows: 0, batches: Vec::new() }
    }

    /// Its text.
    ///
    /// # Errors
    /// Where a value cannot be written as text.
    pub fn text(&self) -> Result<TableText, Error> {
        let options = FormatOptions::default().with_null("");
        let text = pretty_format_batches_with_options(&self.batches, &options).map_err(failed)?.to_string();
        Ok(TableText { text, left_out: self.rows.saturating_sub(self.most) })
    }
}

impl Rows for Table {
    fn begin(&mut self, schema: &SchemaRef) -> Result<(), Error> {
        self.batches.push(RecordBatch::new_empty(schema.clone()));
        Ok(())
    }

    fn add(&mut self, batch: &RecordBatch) -> Result<(), Error> {
        let room = self.most.saturating_sub(self.rows);
        if room > 0 {
            self.batches.push(batch.slice(0, room.min(batch.num_rows())));
        }
        self.rows += batch.num_rows();
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<(), Error> {
        Ok(())
    }
}
