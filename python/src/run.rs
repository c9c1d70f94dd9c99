//! A run: its tables, and its plants grown again.
//!
//! Absent: growth (`growing`), and pictures and meshes, which are those of its plants (`plants`).

use super::plants::{Again, Plants};
use super::raise;
use super::table::Table;
use phytomer::outputs::Table as Name;
use phytomer::outputs::read;
use pyo3::prelude::*;
use std::path::PathBuf;

/// A run in memory or in a folder.
#[pyclass(frozen, module = "phytomer")]
pub struct Run {
    tables: read::Run,
    plants: Py<Plants>,
}

impl Run {
    /// A run with these tables, and the plants that made them.
    pub fn of(py: Python<'_>, tables: read::Run, again: Again) -> PyResult<Self> {
        Ok(Self { tables, plants: Py::new(py, Plants::new(again))? })
    }
}

#[pymethods]
impl Run {
    /// Opens the run folder at `path`.
    #[staticmethod]
    pub fn open(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let tables = py.detach(|| read::Run::open(&path)).map_err(|error| raise::unreadable(&error))?;
        let again = py.detach(|| Again::of_folder(&path)).map_err(|error| raise::unreadable(error.as_ref()))?;
        Self::of(py, tables, again)
    }

    /// The name of the run, or its folder.
    #[getter]
    fn name(&self) -> String {
        self.tables.path().display().to_string()
    }

    /// The names of its tables.
    #[getter]
    fn tables(&self) -> PyResult<Vec<&'static str>> {
        let mut names = Vec::new();
        for table in Name::ALL {
            if self.tables.has(table).map_err(|error| raise::unreadable(&error))? {
                names.push(table.name());
            }
        }
        Ok(names)
    }

    /// One of its tables by its name.
    fn table(&self, name: &str) -> PyResult<Table> {
        Table::of(&self.tables, name)
    }

    /// Its plants, which grow again when they are drawn.
    #[getter]
    fn plants(&self, py: Python<'_>) -> Py<Plants> {
        self.plants.clone_ref(py)
    }

    /// What `run.json` holds, as JSON.
    fn json(&self) -> String {
        self.tables.json().to_string()
    }
}
