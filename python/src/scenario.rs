//! Scenarios as Python states them: a name, a path, or texts in memory.
//!
//! The package makes texts of dictionaries. Absent: the checks, which are those of `phytomer validate`.

use super::raise;
use phytomer::config::{self, Kind, Report, Resolved, kind_of};
use pyo3::prelude::*;
use pyo3::types::PyList;

/// What is grown: the name of a shipped scenario or species or of a file; or the name of one of some texts.
pub struct Stated {
    /// The name.
    pub name: String,
    /// Names and TOML texts; empty where files are meant.
    pub texts: Vec<(String, String)>,
}

impl Stated {
    /// Reads and checks it.
    pub fn resolved(&self) -> Result<Resolved, Report> {
        if self.texts.is_empty() {
            return config::validate(&self.name);
        }
        let texts: Vec<(&str, &str)> = self.texts.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
        config::validate_texts(&self.name, &texts)
    }

    /// As [`Stated::resolved`], where a species by itself lives until this age at least.
    pub fn resolved_until(&self, until: Option<u32>) -> Result<Resolved, Report> {
        let (true, Kind::Species) = (self.texts.is_empty(), kind_of(&self.name)) else { return self.resolved() };
        let found = config::validate_species(&self.name, until.unwrap_or(1))?;
        let until = until.unwrap_or(0).max(found.shown_at()).max(1);
        let mut resolved = found.alone(&self.name);
        resolved.scenario.ages.until = until;
        resolved.treatments.iter_mut().for_each(|treatment| treatment.scenario.ages.until = until);
        match resolved.compile() {
            Ok(()) => Ok(resolved),
            Err((species, faults)) => Err(resolved.report_of(species, faults)),
        }
    }
}

/// Every fault of a scenario or a species, each as a dictionary; none where it can be grown.
#[pyfunction]
pub fn validate(py: Python<'_>, name: String, texts: Vec<(String, String)>) -> PyResult<Bound<'_, PyList>> {
    let stated = Stated { name, texts };
    match py.detach(|| stated.resolved()) {
        Ok(_) => Ok(PyList::empty(py)),
        Err(report) => raise::faults(py, &report),
    }
}
