//! SQL over recorded runs, by DataFusion on the workspace's Arrow: the tables and views of run folders as relations,
//! macros such as `at_age(a)` as table functions, and the rows of a query as a table, CSV, JSON or Parquet.
//!
//! Nothing can be written through a query, and no file can be read but the part files of the runs. The bodies of the
//! views are those that DuckDB reads from `views.sql` (`phytomer_outputs::views`). A crate of its own, which only the
//! feature `sql` of `phytomer` asks for: DataFusion compiles for many minutes. Absent: measures, which need no SQL.

#![cfg(feature = "engine")]

mod aligned;
mod codes;
mod engine;
mod error;
mod functions;
mod order;
mod output;
mod step;
mod stop;

pub use arrow_schema::SchemaRef;
pub use engine::{Engine, Settings};
pub use error::Error;
pub use output::{First, Format, Rows, Table, TableText, open};
pub use stop::Stop;
