//! What leaves a run: the run folder with its tables (Parquet), and the reading back of what was written.
//!
//! Meshes and pictures are crates of their own, `phytomer-meshes` and `phytomer-pictures`, which need neither Arrow nor
//! Parquet; they stand here under [`meshes`] and [`pictures`]. [`colouring`] paints a picture by a column of a table.
//! A run folder is made by [`RunFolder::create`], filled shard by shard and closed by [`RunFolder::finish`]; what it
//! holds is in `docs` and in its own `datapackage.json`. [`read`] opens it again, [`check()`] tells whether it is
//! whole. Absent on purpose: growth rules.

pub mod colouring;
pub mod destination;
pub mod read;
pub mod rows;
pub mod run_folder;
#[cfg(test)]
mod specimen;
#[cfg(test)]
mod specimen_plots;
mod storage;
pub mod tables;

pub use destination::Destination;
pub use phytomer_meshes as meshes;
pub use phytomer_pictures as pictures;
pub use run_folder::{
    Checking, Checkup, Depth, Difference, Differences, Error, FileReport, Finding, Holder, Mode, Opening,
    OvergrownPlot, RunFolder, RunReport, Shard, ShardReport, State, Trouble, check,
};
pub use storage::FileError;
pub use storage::space::{Bytes, FreeSpace, Space, SystemSpace};
pub use tables::{Input, Provenance, RunPlan, Table};
