//! A table of a run as an Arrow stream, which pyarrow, Polars, DuckDB and pandas read without a file between.
//!
//! Each call of `__arrow_c_stream__` begins a new stream: of a run in memory over its batches, without a copy, of a run
//! folder over its part files, a batch at a time. Absent: conversions, which the libraries do.

use super::raise;
use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::{RecordBatch, RecordBatchReader};
use arrow_schema::ffi::FFI_ArrowSchema;
use arrow_schema::{ArrowError, SchemaRef};
use phytomer::outputs::Table as Name;
use phytomer::outputs::read::{Batches, Run};
use pyo3::exceptions::{PyKeyError, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::types::PyCapsule;

/// The rows of a batch that is read from a file.
const ROWS: usize = 65_536;

/// A table of a run: an Arrow stream of its rows (`__arrow_c_stream__`).
#[pyclass(frozen, module = "phytomer")]
pub struct Table {
    run: Run,
    name: Name,
    schema: SchemaRef,
    rows: u64,
}

/// The batches of a table with the schema that they share.
struct Reader {
    schema: SchemaRef,
    batches: Batches,
}

impl Iterator for Reader {
    type Item = Result<RecordBatch, ArrowError>;

    fn next(&mut self) -> Option<Self::Item> {
        let batch = self.batches.next()?;
        let failed = |error: phytomer::outputs::tables::TableError| {
            ArrowError::IoError(raise::in_words(&error), std::io::Error::other(raise::in_words(&error)))
        };
        // Parts of one table have equal columns; the metadata of a part file may differ from that of the first.
        let same = |batch: RecordBatch| batch.with_schema(self.schema.clone());
        Some(batch.map_err(failed).and_then(same))
    }
}

impl RecordBatchReader for Reader {
    fn schema(&self) -> SchemaRef {
        self.schema.clone()
    }
}

impl Table {
    /// The table of this name.
    pub fn of(run: &Run, name: &str) -> PyResult<Self> {
        let known = Name::ALL.into_iter().find(|table| table.name() == name);
        let unknown = || {
            let names: Vec<&str> = Name::ALL.iter().map(|table| table.name()).collect();
            PyKeyError::new_err(format!("`{name}` is no table; the tables are {}", names.join(", ")))
        };
        let name = known.ok_or_else(unknown)?;
        let absent = || {
            PyKeyError::new_err(format!(
                "the run has no table `{0}`: name it in the scenario, as in tables = [\"{0}\"]",
                name.name()
            ))
        };
        let (schema, rows) = described(run, name)?.ok_or_else(absent)?;
        Ok(Self { run: run.clone(), name, schema, rows })
    }
}

/// The schema of a table and the number of its rows; `None` where the run does not have it.
fn described(run: &Run, name: Name) -> PyResult<Option<(SchemaRef, u64)>> {
    let unreadable = |error: phytomer::outputs::Error| raise::unreadable(&error);
    if !run.has(name).map_err(unreadable)? {
        return Ok(None);
    }
    if let Some(schema) = run.schema(name).map_err(unreadable)? {
        let rows = run.rows().map_err(unreadable)?.get(&name).copied().unwrap_or_default();
        return Ok(Some((schema, rows)));
    }
    let (mut schema, mut rows) = (None, 0);
    for batch in run.batches(name).map_err(unreadable)? {
        let batch = batch.map_err(|error| raise::unreadable(&error))?;
        rows += batch.num_rows() as u64;
        schema.get_or_insert_with(|| batch.schema());
    }
    Ok(schema.map(|schema| (schema, rows)))
}

fn refused(error: ArrowError) -> PyErr {
    PyRuntimeError::new_err(format!("Arrow refuses the table: {error}"))
}

#[pymethods]
impl Table {
    /// The name of the table.
    #[getter]
    fn name(&self) -> &'static str {
        self.name.name()
    }

    /// The names of its columns.
    #[getter]
    fn columns(&self) -> Vec<String> {
        self.schema.fields().iter().map(|field| field.name().clone()).collect()
    }

    /// The unit of each column that has one.
    #[getter]
    fn units(&self) -> std::collections::BTreeMap<String, String> {
        let unit = |field: &std::sync::Arc<arrow_schema::Field>| {
            let unit = field.metadata().get("unit").filter(|unit| !unit.is_empty())?;
            Some((field.name().clone(), unit.clone()))
        };
        self.schema.fields().iter().filter_map(unit).collect()
    }

    fn __len__(&self) -> usize {
        self.rows as usize
    }

    fn __repr__(&self) -> String {
        format!("<phytomer.Table {}: {} rows, {} columns>", self.name.name(), self.rows, self.schema.fields().len())
    }

    /// The Arrow schema as a capsule `arrow_schema` (the PyCapsule interface of Arrow).
    fn __arrow_c_schema__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        let schema = FFI_ArrowSchema::try_from(self.schema.as_ref()).map_err(refused)?;
        PyCapsule::new_with_value(py, schema, c"arrow_schema")
    }

    /// A new stream of the rows as a capsule `arrow_array_stream` (the PyCapsule interface of Arrow).
    #[pyo3(signature = (requested_schema = None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        // The interface lets a producer ignore a schema that it cannot give.
        let _ = requested_schema;
        let batches = self.run.batches_of(self.name, ROWS).map_err(|error| raise::unreadable(&error))?;
        let stream = FFI_ArrowArrayStream::new(Box::new(Reader { schema: self.schema.clone(), batches }));
        PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
    }
}
