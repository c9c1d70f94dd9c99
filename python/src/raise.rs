//! Failures as Python's exceptions: those of the package (`phytomer._errors`), `OSError` and `RuntimeError`.
//!
//! The text is the whole chain of causes. Absent: `KeyboardInterrupt`, which the interpreter raises itself.

use phytomer::config::Report;
use phytomer::outputs::tables::TableError;
use phytomer::run::RunError;
use pyo3::exceptions::{PyOSError, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::error::Error;
use std::io;

/// The exceptions of the package.
const OWN: &str = "phytomer._errors";

/// An exception of the package by its name.
pub fn own<'py>(py: Python<'py>, name: &str, arguments: impl pyo3::call::PyCallArgs<'py>) -> PyErr {
    let made = py.import(OWN).and_then(|errors| errors.getattr(name)?.call1(arguments));
    made.map_or_else(|error| error, PyErr::from_value)
}

/// A scenario or a species that is wrong, with each of its faults.
pub fn faulty(py: Python<'_>, report: &Report) -> PyErr {
    match faults(py, report) {
        Ok(faults) => own(py, "ScenarioError", (report.render(false), faults)),
        Err(error) => error,
    }
}

/// The faults of a report, each as a dictionary.
pub fn faults<'py>(py: Python<'py>, report: &Report) -> PyResult<Bound<'py, PyList>> {
    let list = PyList::empty(py);
    for record in report.records() {
        let fault = PyDict::new(py);
        fault.set_item("file", record.file)?;
        fault.set_item("line", record.line)?;
        fault.set_item("column", record.column)?;
        fault.set_item("path", record.path)?;
        fault.set_item("text", record.problem)?;
        fault.set_item("expected", record.expected)?;
        fault.set_item("help", record.suggestion.map(|word| format!("did you mean `{word}`?")))?;
        list.append(fault)?;
    }
    Ok(list)
}

/// A run that failed.
pub fn failed(py: Python<'_>, error: &RunError) -> PyErr {
    let text = in_words(error);
    if let RunError::Outputs(phytomer::outputs::Error::Table(TableError::NoRoom { .. })) = error {
        let way = "name a folder by out=, where tables are files, or give them more by max_memory_mb=";
        return own(py, "LimitReached", (format!("{text}: {way}"),));
    }
    match error {
        RunError::Overgrown { .. } | RunError::OvergrownAtOnce { .. } => own(py, "LimitReached", (text,)),
        _ if is_of_the_system(error) => PyOSError::new_err(text),
        _ => PyRuntimeError::new_err(text),
    }
}

/// A file or a folder that cannot be read or written.
pub fn unreadable(error: &(dyn Error + 'static)) -> PyErr {
    PyOSError::new_err(in_words(error))
}

/// An error and its causes, each once.
pub fn in_words(error: &(dyn Error + 'static)) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        let next = error.to_string();
        if !text.ends_with(&next) {
            text = format!("{text}: {next}");
        }
        cause = error.source();
    }
    text
}

fn is_of_the_system(error: &(dyn Error + 'static)) -> bool {
    let mut cause = Some(error);
    while let Some(error) = cause {
        if error.is::<io::Error>() {
            return true;
        }
        cause = error.source();
    }
    matches!(error.downcast_ref(), Some(RunError::Outputs(_) | RunError::TooSmall(_)))
}
