//! The run folder of a run: created, filled shard by shard, closed, and resumed after a crash.
//!
//! One process at a time fills a folder (`lock`). `run.json` is written first, with the identity of the run, and again
//! at the end, with its results. In between, the journal lists the shards that are whole. A resumed run checks every
//! file that it keeps (`check`), grows again only what is missing or damaged, and ends with the same bytes as a run
//! that was never interrupted, but for the timings in `run.json`.

mod check;
mod difference;
mod documents;
mod error;
mod holder;
mod identity;
mod journal;
mod lock;
mod merge;
mod merge_fault;
mod merged_documents;
mod papers;
mod seal;
mod shard;
mod share;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_merge;

pub use check::{Checking, Checkup, Depth, Finding, State, Trouble, check};
pub use difference::{Difference, Differences};
pub use documents::RunReport;
pub use error::Error;
pub use holder::Holder;
pub use identity::fingerprint;
pub use journal::{FileReport, OvergrownPlot, ShardReport};
pub use merge::{Files, Merged, merge, merge_by};
pub use merge_fault::{MergeFault, MergeFaults};
pub(crate) use papers::{Papers, RunJson};
pub use shard::Shard;
pub use share::Share;

use crate::storage::durable;
use crate::storage::space::{FreeSpace, SystemSpace, WaitFor, Watch};
use crate::tables::RunPlan;
use journal::{JOURNAL, Journal};
use lock::{LOCK, Lock};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// What to do with a folder that already holds files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// Refuse the folder.
    New,
    /// Continue the run in the folder, if its plan is equal; start a run where the folder has none.
    Resume,
    /// Replace the run in the folder.
    Overwrite,
}

/// Options for opening a run folder, beside its mode.
#[derive(Debug)]
pub struct Opening<'a> {
    /// The progress of checking the files that a resumed run keeps, and the switch that stops the check.
    pub checking: &'a Checking,
    /// The source of the free space of the disk: the system, or a test.
    pub space: Arc<dyn FreeSpace>,
    /// The share of the run that the folder gets; `None` for the whole run.
    pub share: Option<Share>,
}

/// A run folder that is being filled. Several threads may each fill a shard at once.
#[derive(Debug)]
pub struct RunFolder {
    path: PathBuf,
    plan: RunPlan,
    share: Option<Share>,
    journal: Mutex<Journal>,
    watch: Arc<Watch>,
    found: Option<Checkup>,
    lock: Lock,
}

impl RunFolder {
    /// Creates the folder, or opens the folder of an earlier start. Free space is that reported by the system.
    ///
    /// # Errors
    /// As [`RunFolder::open`].
    pub fn create(path: &Path, plan: RunPlan, mode: Mode) -> Result<Self, Error> {
        let space = Arc::new(SystemSpace);
        Self::open(path, plan, mode, &Opening { checking: &Checking::default(), space, share: None })
    }

    /// Creates the folder, or opens the folder of an earlier start. Before anything in it is read or removed, the lock
    /// is taken, and it is held until the value is dropped. A folder that is not a run is refused first, and stays
    /// unchanged. Resuming reads all files that are kept.
    ///
    /// # Errors
    /// [`Error::Occupied`], [`Error::NotARun`], [`Error::InProgress`], [`Error::Foreign`], [`Error::Unrecognised`],
    /// [`Error::EmptyShare`], [`Error::Stopped`], or a failed write.
    pub fn open(path: &Path, plan: RunPlan, mode: Mode, opening: &Opening) -> Result<Self, Error> {
        let share = opening.share;
        if let Some(share) = share.filter(|_| Share::parts(share, plan.shards()).next().is_none()) {
            return Err(Error::EmptyShare { share, parts: plan.shards() });
        }
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
            let checkup = check_resumed(path, &papers, (&plan, share), opening.checking)?;
            done = kept(&papers, &plan, &checkup);
            found = Some(checkup);
        } else if is_run {
            clear(path, &papers)?;
        }
        let watch = Watch::over(path, &opening.space);
        let journal = prepare(path, (&plan, share), &papers, done)?;
        Ok(Self { path: path.to_path_buf(), plan, share, journal: Mutex::new(journal), watch, found, lock })
    }

    /// What the check of a resumed run found, before repair; `None` for a new run.
    pub fn found(&self) -> Option<&Checkup> {
        self.found.as_ref()
    }

    /// The reason why the file system cannot lock the folder, if it cannot: a second process in the folder would go
    /// unnoticed.
    pub fn unlockable(&self) -> Option<&str> {
        self.lock.unlockable()
    }

    /// The path of the folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The plan of the run.
    pub fn plan(&self) -> &RunPlan {
        &self.plan
    }

    /// The numbers of the shards that belong into the folder, ascending: all, or those of its share of the run.
    pub fn own_shards(&self) -> impl Iterator<Item = u32> + use<> {
        Share::parts(self.share, self.plan.shards())
    }

    /// The numbers of the shards that are still to be grown, ascending.
    pub fn missing_shards(&self) -> Vec<u32> {
        let journal = self.journal();
        self.own_shards().filter(|shard| !journal.done().contains_key(shard)).collect()
    }

    /// The number of bytes that were written to tables and meshes since the folder was opened.
    pub fn written(&self) -> u64 {
        self.watch.written()
    }

    /// The time that threads have waited since then for something of the writer, all together.
    pub fn waited(&self, what: WaitFor) -> Duration {
        self.watch.waited(what)
    }

    /// Opens a shard for writing.
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

    /// Closes the run: sorts the journal, writes `datapackage.json`, and writes `run.json` with the `timings`, pairs of
    /// a name and seconds.
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
        documents::write_end(&self.path, (&self.plan, self.share), journal.done(), timings)
    }

    fn journal(&self) -> MutexGuard<'_, Journal> {
        self.journal.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Refuses a folder that must not be changed in this mode.
fn refuse(path: &Path, mode: Mode, is_run: bool) -> Result<(), Error> {
    let counts = |file: &PathBuf| !durable::is_beside(file) && !file.ends_with(LOCK);
    let occupied = durable::files_in(path)?.iter().any(counts);
    match mode {
        Mode::New if occupied => Err(Error::Occupied { path: path.to_path_buf() }),
        _ if occupied && !is_run => Err(Error::NotARun { path: path.to_path_buf() }),
        _ => Ok(()),
    }
}

/// Checks all files of a run that is to be resumed, if its plan and its share are equal.
fn check_resumed(
    path: &Path,
    papers: &Papers,
    (plan, share): (&RunPlan, Option<Share>),
    checking: &Checking,
) -> Result<Checkup, Error> {
    let run = fingerprint(plan);
    match &papers.run {
        RunJson::Whole(there) | RunJson::Older(there) => {
            let mut differences = Differences::between(there, plan);
            differences.compare_shares(Share::of_run(there), share);
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
    check::of(path, papers, (&run, share), None, (Depth::Bytes, checking))
}

/// The shards that need not be grown again, by number.
fn kept(papers: &Papers, plan: &RunPlan, found: &Checkup) -> BTreeMap<u32, ShardReport> {
    let mut done = papers.journal.as_ref().map(|journal| journal.done(&fingerprint(plan))).unwrap_or_default();
    done.retain(|shard, _| found.sound.contains(shard));
    done
}

/// Prepares the folder for the shards that are not `done`: documents, folders and journal. Files of interrupted or
/// damaged shards are removed. `run.json` is first set to that of an unfinished run, before any file that it named is
/// removed.
fn prepare(
    path: &Path,
    (plan, share): (&RunPlan, Option<Share>),
    papers: &Papers,
    done: BTreeMap<u32, ShardReport>,
) -> Result<Journal, Error> {
    let all_done = Share::parts(share, plan.shards()).all(|shard| done.contains_key(&shard));
    if papers.whole().is_some() && all_done {
        documents::write_views(path, plan)?;
    } else {
        documents::write_start(path, plan, share)?;
    }
    make_tables(path, plan)?;
    let journal = Journal::of(&path.join(JOURNAL), fingerprint(plan), done)?;
    remove_leftovers(path, &journal)?;
    Ok(journal)
}

/// Removes the files of a run's own naming that the journal does not name.
fn remove_leftovers(path: &Path, journal: &Journal) -> Result<(), Error> {
    let named = journal.done().values().flat_map(|report| &report.files).map(|file| file.path.as_str()).collect();
    for (left, trouble) in check::others(path, &named)? {
        if trouble == Trouble::Leftover {
            durable::remove(&path.join(left))?;
        }
    }
    Ok(())
}

fn make_tables(path: &Path, plan: &RunPlan) -> Result<(), Error> {
    for table in &plan.tables {
        let folder = path.join(table.name());
        fs::create_dir_all(&folder).map_err(Error::io("create", &folder))?;
    }
    Ok(())
}

/// Removes the files that a run has written, and no others; the lock stays.
fn clear(path: &Path, papers: &Papers) -> Result<(), Error> {
    // A damaged journal does not prevent this, since replacing the run is the way to get rid of it.
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
        // A folder with files of others is not empty, and stays.
        let _ = fs::remove_dir(path.join(name));
    }
    // `run.json` is removed last: until then the folder is a run, which can be replaced.
    Ok(check::DOCUMENTS.iter().rev().try_for_each(|name| durable::remove(&path.join(name)))?)
}
