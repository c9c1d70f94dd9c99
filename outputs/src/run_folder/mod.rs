//! The run folder: made, filled shard by shard, closed; after a crash, gone on with.
//!
//! One process at a time has a folder (`lock`). `run.json` is written first, with what identifies the run, and again at
//! the end, with what came of it. Between the two the journal holds the shards that are whole. A resumed run looks at
//! every file that it keeps (`check`), redoes only what is missing or damaged, and ends with the same bytes as one that
//! was never interrupted, but for the timings in `run.json`.

mod check;
mod difference;
mod documents;
mod error;
mod holder;
mod identity;
mod journal;
mod lock;
mod papers;
mod seal;
mod shard;
#[cfg(test)]
mod tests;

pub use check::{Checking, Checkup, Depth, Finding, State, Trouble, check};
pub use difference::{Difference, Differences};
pub use documents::RunReport;
pub use error::Error;
pub use holder::Holder;
pub use journal::{FileReport, OvergrownPlot, ShardReport};
pub(crate) use papers::{Papers, RunJson};
pub use shard::Shard;

use crate::storage::durable;
use crate::storage::space::{FreeSpace, SystemSpace, Watch};
use crate::tables::RunPlan;
use identity::fingerprint;
use journal::{JOURNAL, Journal};
use lock::{LOCK, Lock};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

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

/// How a run folder is opened, beside its mode.
#[derive(Debug)]
pub struct Opening<'a> {
    /// How far the check of what a resumed run keeps has come.
    pub checking: &'a Checking,
    /// What tells the free space of the disk: the system, or a test.
    pub space: Arc<dyn FreeSpace>,
}

/// A run folder that is being filled; shards of several threads may be open at once.
#[derive(Debug)]
pub struct RunFolder {
    path: PathBuf,
    plan: RunPlan,
    journal: Mutex<Journal>,
    watch: Arc<Watch>,
    found: Option<Checkup>,
    lock: Lock,
}

impl RunFolder {
    /// Makes the folder, or opens that of an earlier start, with the free space that the system tells.
    ///
    /// # Errors
    /// As [`RunFolder::open`].
    pub fn create(path: &Path, plan: RunPlan, mode: Mode) -> Result<Self, Error> {
        let space = Arc::new(SystemSpace);
        Self::open(path, plan, mode, &Opening { checking: &Checking::default(), space })
    }

    /// Makes the folder, or opens that of an earlier start. The lock is taken before anything in it is read or removed,
    /// and held until this is dropped; a folder that is no run is refused before that, and stays as it is.
    ///
    /// # Errors
    /// [`Error::Occupied`], [`Error::NotARun`], [`Error::InProgress`], [`Error::Foreign`], [`Error::Unrecognised`],
    /// [`Error::Stopped`], or a failed write.
    pub fn open(path: &Path, plan: RunPlan, mode: Mode, opening: &Opening) -> Result<Self, Error> {
        if lock::holder_of(path).is_none() {
            refuse(path, mode, Papers::read(path)?.is_run())?;
        }
        fs::create_dir_all(path).map_err(Error::io("create", path))?;
        let lock = Lock::take(path)?;
        let papers = Papers::read(path)?;
        let is_run = papers.is_run();
        refuse(path, mode, is_run)?;
        let mut done = BTreeMap::new();
        let mut found = None;
        if mode == Mode::Resume && is_run {
            let checkup = check_resumed(path, &papers, &plan, opening.checking)?;
            done = kept(&papers, &plan, &checkup);
            found = Some(checkup);
        } else if is_run {
            clear(path, &papers)?;
        }
        let watch = Watch::over(path, &opening.space);
        let journal = prepare(path, &plan, &papers, done)?;
        Ok(Self { path: path.to_path_buf(), plan, journal: Mutex::new(journal), watch, found, lock })
    }

    /// What a resumed run found in its folder before it mended it; `None` of one that was begun.
    pub fn found(&self) -> Option<&Checkup> {
        self.found.as_ref()
    }

    /// Why the file system could not lock the folder, where it could not: another run in it would not be noticed.
    pub fn unlockable(&self) -> Option<&str> {
        self.lock.unlockable()
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
}

/// Refuses a folder that is not to be touched in this mode.
fn refuse(path: &Path, mode: Mode, is_run: bool) -> Result<(), Error> {
    let counts = |file: &PathBuf| !durable::is_beside(file) && !file.ends_with(LOCK);
    let occupied = durable::files_in(path)?.iter().any(counts);
    match mode {
        Mode::New if occupied => Err(Error::Occupied { path: path.to_path_buf() }),
        _ if occupied && !is_run => Err(Error::NotARun { path: path.to_path_buf() }),
        _ => Ok(()),
    }
}

/// Looks at all that a run to be resumed has, if it is this run.
fn check_resumed(path: &Path, papers: &Papers, plan: &RunPlan, checking: &Checking) -> Result<Checkup, Error> {
    let run = fingerprint(plan);
    match &papers.run {
        RunJson::Whole(there) | RunJson::Older(there) => {
            let differences = Differences::between(there, plan);
            if !differences.0.is_empty() {
                return Err(Error::Foreign { path: path.to_path_buf(), differences });
            }
        }
        RunJson::Missing | RunJson::Damaged { .. } => {
            let runs = papers.journal.as_ref().map(journal::Reading::runs).unwrap_or_default();
            if runs != BTreeSet::from([run.as_str()]) {
                return Err(Error::Unrecognised { path: path.to_path_buf() });
            }
        }
    }
    check::of(path, papers, &run, None, (Depth::Bytes, checking))
}

/// The shards that need not be grown again.
fn kept(papers: &Papers, plan: &RunPlan, found: &Checkup) -> BTreeMap<u32, ShardReport> {
    let mut done = papers.journal.as_ref().map(|journal| journal.done(&fingerprint(plan))).unwrap_or_default();
    done.retain(|shard, _| found.sound.contains(shard));
    done
}

/// Makes the folder ready for the shards that are not `done`: documents, folders and journal; what an interrupted or
/// damaged shard left is removed. `run.json` is that of an unfinished run before anything that it named goes.
fn prepare(path: &Path, plan: &RunPlan, papers: &Papers, done: BTreeMap<u32, ShardReport>) -> Result<Journal, Error> {
    if papers.whole().is_some() && done.len() == plan.shards() as usize {
        documents::write_views(path, plan)?;
    } else {
        documents::write_start(path, plan)?;
    }
    make_tables(path, plan)?;
    let journal = Journal::of(&path.join(JOURNAL), fingerprint(plan), done)?;
    let named = journal.done().values().flat_map(|report| &report.files).map(|file| file.path.as_str()).collect();
    for (left, trouble) in check::others(path, &named)? {
        if trouble == Trouble::Leftover {
            durable::remove(&path.join(left))?;
        }
    }
    Ok(journal)
}

fn make_tables(path: &Path, plan: &RunPlan) -> Result<(), Error> {
    for table in &plan.tables {
        let folder = path.join(table.name());
        fs::create_dir_all(&folder).map_err(Error::io("create", &folder))?;
    }
    Ok(())
}

/// Removes what a run has written, and nothing else; the lock stays.
fn clear(path: &Path, papers: &Papers) -> Result<(), Error> {
    // A damaged journal is no hindrance: this is the way to be rid of it.
    let entered = papers.journal.iter().flat_map(journal::Reading::files);
    for file in entered.filter(|file| papers::is_inside(&file.path)) {
        durable::remove(&path.join(&file.path))?;
    }
    for (left, trouble) in check::others(path, &BTreeSet::new())? {
        if trouble == Trouble::Leftover {
            durable::remove(&path.join(left))?;
        }
    }
    for name in check::filled() {
        // Stays where it holds something else, which is not ours to remove.
        let _ = fs::remove_dir(path.join(name));
    }
    // `run.json` last: until then the folder is a run, which can be replaced.
    Ok(check::DOCUMENTS.iter().rev().try_for_each(|name| durable::remove(&path.join(name)))?)
}
