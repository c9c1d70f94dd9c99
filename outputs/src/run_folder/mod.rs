//! The run folder: made, filled shard by shard, closed; after a crash, gone on with.
//!
//! `run.json` is written first, with what identifies the run, and again at the end, with what came of it. Between the
//! two the journal holds the shards that are whole. A resumed run redoes only what is missing and ends with the same
//! bytes as one that was never interrupted, but for the timings in `run.json`.

mod documents;
mod durable;
mod journal;
mod plan;
mod shard;
#[cfg(test)]
mod tests;

pub use documents::RunReport;
pub(crate) use durable::{HashingFile, files_in};
pub use journal::{FileReport, OvergrownPlot, ShardReport};
pub use plan::{Input, Provenance, RunPlan};
pub use shard::Shard;

use crate::Error;
use crate::tables::Table;
use journal::Journal;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Component, Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// What to do where the folder holds files already.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// Refuse.
    New,
    /// Go on with the run that is there, if it is this one; begin it where there is none.
    Resume,
    /// Replace the run that is there.
    Overwrite,
}

/// A run folder that is being filled; shards of several threads may be open at once.
#[derive(Debug)]
pub struct RunFolder {
    path: PathBuf,
    plan: RunPlan,
    journal: Mutex<Journal>,
}

impl RunFolder {
    /// Makes the folder, or opens that of an earlier start.
    ///
    /// # Errors
    /// [`Error::Occupied`], [`Error::NotARun`], [`Error::Foreign`], [`Error::Journal`], or a failed write.
    pub fn create(path: &Path, plan: RunPlan, mode: Mode) -> Result<Self, Error> {
        let occupied = durable::files_in(path)?.iter().any(|file| !durable::is_beside(file));
        let is_run = path.join("run.json").exists();
        match mode {
            Mode::New if occupied => return Err(Error::Occupied { path: path.to_path_buf() }),
            _ if occupied && !is_run => return Err(Error::NotARun { path: path.to_path_buf() }),
            Mode::Resume if is_run => return Self::go_on(path, plan),
            Mode::Overwrite if is_run => clear(path)?,
            _ => {}
        }
        Self::begin(path, plan)
    }

    fn begin(path: &Path, plan: RunPlan) -> Result<Self, Error> {
        fs::create_dir_all(path).map_err(Error::io("create", path))?;
        documents::write_start(path, &plan)?;
        make_tables(path, &plan)?;
        let journal = Journal::begin(&path.join("journal.jsonl"))?;
        Ok(Self { path: path.to_path_buf(), plan, journal: Mutex::new(journal) })
    }

    fn go_on(path: &Path, plan: RunPlan) -> Result<Self, Error> {
        check_identity(path, &plan)?;
        documents::write_views(path, &plan)?;
        make_tables(path, &plan)?;
        let mut journal = Journal::go_on(&path.join("journal.jsonl"))?;
        let lost: Vec<u32> =
            journal.done().values().filter(|report| !is_whole(path, report)).map(|report| report.shard).collect();
        lost.into_iter().for_each(|shard| journal.forget(shard));
        let folder = Self { path: path.to_path_buf(), plan, journal: Mutex::new(journal) };
        folder.sweep()?;
        Ok(folder)
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What the run writes.
    pub fn plan(&self) -> &RunPlan {
        &self.plan
    }

    /// The shards that are still to be grown, ascending.
    pub fn missing_shards(&self) -> Vec<u32> {
        let journal = self.journal();
        (0..self.plan.shards()).filter(|shard| !journal.done().contains_key(shard)).collect()
    }

    /// Opens a shard.
    ///
    /// # Errors
    /// [`Error::NoSuchShard`], or a failed write.
    pub fn shard(&self, shard: u32) -> Result<Shard<'_>, Error> {
        let shards = self.plan.shards();
        if shard >= shards {
            return Err(Error::NoSuchShard { shard, shards });
        }
        Shard::create(self, shard)
    }

    /// Closes the run: the journal in order, `datapackage.json`, `run.json` with the `timings` in seconds.
    ///
    /// # Errors
    /// [`Error::MissingShards`], or a failed write.
    pub fn finish(&self, timings: &[(&str, f64)]) -> Result<RunReport, Error> {
        let missing = self.missing_shards().len();
        if missing > 0 {
            return Err(Error::MissingShards { path: self.path.clone(), missing });
        }
        let mut journal = self.journal();
        journal.put_in_order()?;
        documents::write_end(&self.path, &self.plan, journal.done(), timings)
    }

    fn journal(&self) -> MutexGuard<'_, Journal> {
        self.journal.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Removes what an interrupted shard left: files beside their names, and parts and meshes that are not in the
    /// journal.
    fn sweep(&self) -> Result<(), Error> {
        let journal = self.journal();
        let files = journal.done().values().flat_map(|report| &report.files);
        let known: BTreeSet<PathBuf> = files.map(|file| self.path.join(&file.path)).collect();
        for name in filled() {
            let files = durable::files_in(&self.path.join(name))?;
            files
                .iter()
                .filter(|file| is_own(file) && !known.contains(*file))
                .try_for_each(|file| durable::remove(file))?;
        }
        for folder in durable::files_in(&self.path)?.iter().filter(|path| path.is_dir()) {
            remove_beside(folder)?;
        }
        remove_beside(&self.path)
    }
}

fn make_tables(path: &Path, plan: &RunPlan) -> Result<(), Error> {
    for table in &plan.tables {
        let folder = path.join(table.name());
        fs::create_dir_all(&folder).map_err(Error::io("create", &folder))?;
    }
    Ok(())
}

/// Whether the run that is there was begun under an equal plan.
fn check_identity(path: &Path, plan: &RunPlan) -> Result<(), Error> {
    let file = path.join("run.json");
    let text = fs::read(&file).map_err(Error::io("read", &file))?;
    let there: Value = serde_json::from_slice(&text).map_err(Error::json(&file))?;
    let differing = plan.identity().into_iter().find(|(key, value)| there.get(key) != Some(value));
    match differing {
        Some((what, _)) => Err(Error::Foreign { path: path.to_path_buf(), what }),
        None => Ok(()),
    }
}

/// Whether each file of a shard is there, with its length.
fn is_whole(path: &Path, report: &ShardReport) -> bool {
    report.files.iter().all(|file| fs::metadata(path.join(&file.path)).is_ok_and(|there| there.len() == file.bytes))
}

/// Removes what a run has written, and nothing else.
fn clear(path: &Path) -> Result<(), Error> {
    let journal = path.join("journal.jsonl");
    // A damaged journal is no hindrance: this is the way to be rid of it.
    let done = journal::read(&journal).map(|(done, _)| done).unwrap_or_default();
    for file in done.values().flat_map(|report| &report.files) {
        let inside = Path::new(&file.path).components().all(|part| matches!(part, Component::Normal(_)));
        if inside {
            durable::remove(&path.join(&file.path))?;
        }
    }
    for name in filled() {
        for file in durable::files_in(&path.join(name))?.iter().filter(|file| is_own(file)) {
            durable::remove(file)?;
        }
        // Stays where it holds something else, which is not ours to remove.
        let _ = fs::remove_dir(path.join(name));
    }
    remove_beside(path)?;
    for name in ["journal.jsonl", "datapackage.json", "views.sql", "run.json"] {
        durable::remove(&path.join(name))?;
    }
    Ok(())
}

/// The folders that shards fill.
fn filled() -> impl Iterator<Item = &'static str> {
    Table::ALL.iter().map(|table| table.name()).chain(["meshes"])
}

/// Whether a file in such a folder is one that a shard writes there: a part, a mesh, or one of them half written.
fn is_own(file: &Path) -> bool {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    (name.starts_with("part-") && name.ends_with(".parquet")) || name.ends_with(".ply") || durable::is_beside(file)
}

fn remove_beside(folder: &Path) -> Result<(), Error> {
    durable::files_in(folder)?.iter().filter(|file| durable::is_beside(file)).try_for_each(|file| durable::remove(file))
}
