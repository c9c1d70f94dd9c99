//! The output of a run: the run folder with its tables (Parquet), and reading it back.
//!
//! Meshes, lives, GLB and USD files, pictures, films and pages are crates of their own, `phytomer-meshes`,
//! `phytomer-life`, `phytomer-gltf`, `phytomer-usd`, `phytomer-pictures`, `phytomer-films` and `phytomer-pages`, which
//! need neither Arrow nor Parquet; they are re-exported here as [`meshes`], [`life`], [`gltf`], [`usd`], [`pictures`],
//! [`films`] and [`pages`]. [`colouring`] colours a picture by a column of a table, [`paging`] fills the rows of a
//! page. [`RunFolder::create`] makes a run folder, which is filled shard by shard and closed by [`RunFolder::finish`].
//! Its format is described in `docs` and in its own `datapackage.json`. [`read`] opens it again, [`check()`] tells
//! whether it is whole. Absent: growth rules.

pub mod cells;
pub mod colouring;
pub mod destination;
pub mod exchange;
mod frames;
pub mod measured;
pub mod paging;
pub mod read;
pub mod rows;
pub mod run_folder;
#[cfg(test)]
mod specimen;
#[cfg(test)]
mod specimen_plots;
mod storage;
pub mod tables;
pub mod views;
pub mod views_of_run;

pub use destination::Destination;
pub use frames::Frames;
pub use phytomer_films as films;
pub use phytomer_gltf as gltf;
pub use phytomer_life as life;
pub use phytomer_meshes as meshes;
pub use phytomer_pages as pages;
pub use phytomer_pictures as pictures;
pub use phytomer_usd as usd;
pub use run_folder::{
    Checking, Checkup, Depth, Difference, Differences, Error, FileReport, Files, Finding, Holder, MergeFault,
    MergeFaults, Merged, Mode, Opening, OvergrownPlot, RunFolder, RunReport, Shard, ShardReport, Share, State, Trouble,
    check, fingerprint, merge, merge_by,
};
pub use storage::FileError;
pub use storage::space::{Bytes, FreeSpace, Space, SystemSpace, WaitFor};
pub use tables::{Input, Provenance, RunPlan, Sample, Table};
