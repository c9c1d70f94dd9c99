//! The module of Python, `phytomer._phytomer`: what the package `phytomer` is made of.
//!
//! A file each: scenarios as Python states them (`scenario`), growth beside a waiting interpreter (`growing`), a
//! run and its plants (`run`), tables as Arrow streams (`table`), meshes as arrays (`mesh`), and exceptions
//! (`raise`). Nothing here is unsafe: Arrow's own stream goes into a capsule, and arrays are told by the address of
//! their numbers (`__array_interface__`). Absent: what is written in Python (`phytomer/`), such as the verbs that are
//! called as programs.

mod growing;
mod mesh;
mod plants;
mod raise;
mod run;
mod scenario;
mod table;

use phytomer::config::Kind;
use phytomer::config::schema_of;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// The whole command line: `words[0]` is the name of the program. Returns the exit code.
#[pyfunction]
fn main(py: Python<'_>, words: Vec<String>) -> i32 {
    py.detach(|| phytomer::cli::main(words) as i32)
}

/// The JSON Schema of a `species` or a `scenario` file, as JSON.
#[pyfunction]
fn schema(kind: &str) -> PyResult<String> {
    let kind = match kind {
        "species" => Kind::Species,
        "scenario" => Kind::Scenario,
        _ => return Err(PyValueError::new_err(format!("`{kind}`: `species` or `scenario` is expected"))),
    };
    Ok(schema_of(kind).to_string())
}

/// JSON as TOML.
#[pyfunction]
fn toml_of_json(json: &str) -> PyResult<String> {
    let wrong = |error: &dyn std::fmt::Display| PyValueError::new_err(format!("cannot be written as TOML: {error}"));
    let value: serde_json::Value = serde_json::from_str(json).map_err(|error| wrong(&error))?;
    toml::to_string(&value).map_err(|error| wrong(&error))
}

/// What the package `phytomer` is made of.
#[pymodule]
mod _phytomer {
    #[pymodule_export]
    use super::growing::grow;
    #[pymodule_export]
    use super::main;
    #[pymodule_export]
    use super::mesh::{Column, Mesh};
    #[pymodule_export]
    use super::plants::Plants;
    #[pymodule_export]
    use super::run::Run;
    #[pymodule_export]
    use super::scenario::validate;
    #[pymodule_export]
    use super::schema;
    #[pymodule_export]
    use super::table::Table;
    #[pymodule_export]
    use super::toml_of_json;
    use pyo3::prelude::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
