//! Merges folders that hold shares of one run into one folder with the bytes of a run that was grown at once.
//!
//! The folders must be of one run (scenario, seed, program, inputs: the fingerprint), be sound byte for byte, and hold
//! each part once. All that the documents and the lengths of the files tell to be wrong is told together, before
//! anything is written; then every byte is read as well, so that nothing that is wrong stays untold. Else each part is
//! copied beside its final name, hashed on the way, renamed and entered in the journal, so that an interrupted merge
//! can be resumed as a run is. So a merge of sound folders reads each byte once. A part whose hash is another one is
//! told with all others of its kind, and is not entered. Before a run is replaced, and before files are linked, every
//! byte is read: what is lost or shared then must not be lost for a damaged file. Only the timings in `run.json` are
//! not those of a run that was grown at once: they are the sums of those of the folders. Absent: growing what is
//! missing.

use super::check::{self, Checking, Checkup, Depth, State};
use super::difference::Differences;
use super::documents::RunReport;
use super::error::Error;
use super::identity::FORMAT_VERSION;
use super::journal::{FileReport, JOURNAL, Journal, ShardReport};
use super::lock::{Lock, holder_of};
use super::merge_fault::{MergeFault, MergeFaults};
use super::merged_documents::Drafts;
use super::papers::{Papers, is_inside};
use super::share::Share;
use super::{Mode, Opening, clear, refuse, remove_leftovers};
use crate::storage::durable::{self, HashingFile};
use crate::storage::space::Watch;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Shards that are copied at once: most of the time is spent in waiting for the disk, which writes several files as
/// fast as one.
const COPIES_AT_ONCE: usize = 8;

/// What came of a merge.
#[derive(Debug, Clone)]
pub struct Merged {
    /// The report of the whole run.
    pub report: RunReport,
    /// The number of its shards.
    pub shards: u32,
    /// The number of shards that were copied now; fewer than `shards` where a merge was resumed.
    pub copied: u32,
}

/// How the files of the shares come into the folder of the run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Files {
    /// Each is copied, and hashed on the way: the folders of the shares may be on other disks, and may be changed.
    Copied,
    /// Each gets a second name (a hard link), and no byte is copied; a copy where the file system has no links. A
    /// change of one would be a change of both, so the folders of the shares are to be removed afterwards.
    Linked,
}

/// A folder with a share of the run.
struct Source {
    folder: PathBuf,
    run: Value,
    done: BTreeMap<u32, ShardReport>,
    found: Checkup,
}

/// Merges the folders `parts` into the folder `into`. The progress counts the bytes of the check, then those of the
/// copies.
///
/// # Errors
/// [`Error::Merge`] with all that is wrong with the folders; [`Error::Shares`] with the damaged files that were found
/// while the others were copied; else as [`RunFolder::open`](super::RunFolder::open).
pub fn merge(into: &Path, parts: &[PathBuf], mode: Mode, opening: &Opening) -> Result<Merged, Error> {
    merge_by(Files::Copied, into, parts, (mode, opening))
}

/// As [`merge`], where the files are copied or linked.
///
/// # Errors
/// As [`merge`].
pub fn merge_by(
    files: Files,
    into: &Path,
    parts: &[PathBuf],
    (mode, opening): (Mode, &Opening),
) -> Result<Merged, Error> {
    let replaces = mode == Mode::Overwrite && Papers::read(into).is_ok_and(|papers| papers.is_run());
    let sources = match files {
        Files::Copied if !replaces => match gathered(into, parts, (Depth::Lengths, opening.checking)) {
            Err(Error::Merge(_)) => gathered(into, parts, (Depth::Bytes, opening.checking)),
            gathered => gathered,
        },
        _ => gathered(into, parts, (Depth::Bytes, opening.checking)),
    }?;
    let Some(first) = sources.first() else { return Err(Error::Merge(MergeFaults(Vec::new()))) };
    let drafts = Drafts::of(&first.folder, &first.run)?;
    let target = Target::open(into, &drafts, &first.run, (mode, opening))?;
    let of_sources =
        sources.iter().flat_map(|source| source.done.values().map(|shard| (source.folder.as_path(), shard)));
    let all: Vec<(&Path, &ShardReport)> = of_sources.collect();
    let is_missing = |(_, shard): &&(&Path, &ShardReport)| !target.journal().done().contains_key(&shard.shard);
    let missing: Vec<_> = all.iter().filter(is_missing).collect();
    opening.checking.begin_copying(missing.iter().map(|(_, shard)| shard.bytes()).sum());
    let adopted = || -> Result<Vec<Option<MergeFault>>, Error> {
        missing.par_iter().map(|(from, shard)| target.adopt(files, from, shard, opening.checking)).collect()
    };
    let adopted = match rayon::ThreadPoolBuilder::new().num_threads(COPIES_AT_ONCE).build() {
        Ok(pool) => pool.install(adopted)?,
        Err(_) => adopted()?,
    };
    let damaged: Vec<MergeFault> = adopted.into_iter().flatten().collect();
    if !damaged.is_empty() {
        return Err(Error::Shares(MergeFaults(damaged)));
    }
    let timings = timings_of(&sources);
    let timings: Vec<(&str, f64)> = timings.iter().map(|(name, seconds)| (name.as_str(), *seconds)).collect();
    let mut journal = target.journal();
    journal.put_in_order()?;
    let report = drafts.write_end(into, journal.done(), &timings)?;
    Ok(Merged { report, shards: all.len() as u32, copied: missing.len() as u32 })
}

/// The folders, where they make up one run, as far as a look of this depth tells.
fn gathered(into: &Path, parts: &[PathBuf], look: (Depth, &Checking)) -> Result<Vec<Source>, Error> {
    let mut faults = Vec::new();
    let mut sources: Vec<Source> = Vec::new();
    for folder in parts {
        if is_same(folder, into) {
            faults.push(MergeFault::Target { folder: folder.clone() });
            continue;
        }
        match Source::of(folder, look, &mut faults) {
            Ok(None) => {}
            Ok(Some(source)) => match sources.first().and_then(|first| source.differs(first)) {
                Some(fault) => faults.push(fault),
                None => sources.push(source),
            },
            Err(Error::Stopped) => return Err(Error::Stopped),
            Err(error) => faults.push(MergeFault::Unreadable(in_words(&error))),
        }
    }
    check_overlaps(&sources, &mut faults);
    // What a folder that cannot be used would have is not missing.
    if sources.len() == parts.len() {
        check_gaps(&sources, &mut faults);
    }
    if faults.is_empty() { Ok(sources) } else { Err(Error::Merge(MergeFaults(faults))) }
}

/// The message of an error with those of its causes.
fn in_words(error: &dyn std::error::Error) -> String {
    let causes = std::iter::successors(error.source(), |cause| cause.source());
    causes.fold(error.to_string(), |words, cause| format!("{words}: {cause}"))
}

/// Whether two paths lead to one folder.
fn is_same(a: &Path, b: &Path) -> bool {
    match (fs::canonicalize(a), fs::canonicalize(b)) {
        (Ok(a), Ok(b)) => a == b,
        _ => a == b,
    }
}

impl Source {
    /// Reads and checks a folder; `None` where it cannot be used, which the faults tell.
    fn of(
        folder: &Path,
        (depth, checking): (Depth, &Checking),
        faults: &mut Vec<MergeFault>,
    ) -> Result<Option<Self>, Error> {
        let found = check::check(folder, depth, checking)?;
        if let (State::InProgress, Some(holder)) = (found.state, &found.holder) {
            faults.push(MergeFault::InProgress { folder: folder.to_path_buf(), holder: holder.clone() });
            return Ok(None);
        }
        if found.state == State::Damaged {
            faults.extend(found.findings(false).map(|finding| MergeFault::Damaged {
                folder: folder.to_path_buf(),
                file: finding.path.clone(),
                how: finding.trouble.in_words().to_owned(),
            }));
            return Ok(None);
        }
        let papers = Papers::read(folder)?;
        let done = papers.journal.as_ref().zip(papers.fingerprint()).map(|(journal, run)| journal.done(&run));
        let (Some(run), mut done) = (papers.whole().cloned(), done.unwrap_or_default()) else {
            return Err(Error::NotARun { path: folder.to_path_buf() });
        };
        if run["format_version"] != FORMAT_VERSION {
            let word = |key: &str| run[key].as_str().unwrap_or("unknown").to_owned();
            let (version, git_hash) = (word("version"), word("git_hash"));
            faults.push(MergeFault::OtherProgram { folder: folder.to_path_buf(), version, git_hash });
            return Ok(None);
        }
        // A shard with a path that leads out of the folder was not written by a run, and is not copied.
        done.retain(|_, report| report.files.iter().all(|file| is_inside(&file.path)));
        Ok(Some(Self { folder: folder.to_path_buf(), run, done, found }))
    }

    /// The fault of a folder that is of another run than the first.
    fn differs(&self, first: &Self) -> Option<MergeFault> {
        (self.run["fingerprint"] != first.run["fingerprint"]).then(|| MergeFault::OtherRun {
            folder: self.folder.clone(),
            first: first.folder.clone(),
            differences: Differences::between_runs(&self.run, &first.run),
        })
    }
}

/// Adds the faults of parts that two folders have.
fn check_overlaps(sources: &[Source], faults: &mut Vec<MergeFault>) {
    for (place, second) in sources.iter().enumerate() {
        for first in &sources[..place] {
            let both: Vec<u32> = second.done.keys().filter(|part| first.done.contains_key(part)).copied().collect();
            if !both.is_empty() {
                let [first, second] = [first, second].map(|source| source.folder.clone());
                faults.push(MergeFault::Overlap { first, second, parts: both });
            }
        }
    }
}

/// Adds the faults of parts that no folder has.
fn check_gaps(sources: &[Source], faults: &mut Vec<MergeFault>) {
    let parts = sources.first().map_or(0, |first| check::shards_of(&first.run));
    let there: BTreeSet<u32> = sources.iter().flat_map(|source| source.done.keys().copied()).collect();
    let mut missing: Vec<u32> = (0..parts).filter(|part| !there.contains(part)).collect();
    for Source { folder, found, .. } in sources.iter().filter(|source| source.found.state != State::Complete) {
        let own = found.to_grow.clone();
        missing.retain(|part| !own.contains(part));
        faults.push(MergeFault::Unfinished { folder: folder.clone(), share: found.share, parts: own });
    }
    if !missing.is_empty() {
        let shares = shares_of(sources, &missing);
        faults.push(MergeFault::Gap { parts: missing, of: parts, shares });
    }
}

/// The shares that have the missing parts, where all folders have shares of one number.
fn shares_of(sources: &[Source], missing: &[u32]) -> Vec<Share> {
    let numbers: BTreeSet<Option<u32>> = sources.iter().map(|source| source.found.share.map(Share::of)).collect();
    let [Some(of)] = numbers.into_iter().collect::<Vec<_>>()[..] else { return Vec::new() };
    let having = (1..=of).filter_map(|number| Share::new(number, of));
    having.filter(|share| missing.iter().any(|part| share.has(*part))).collect()
}

/// The sums of the timings of the folders, in the order of the first.
fn timings_of(sources: &[Source]) -> Vec<(String, f64)> {
    let mut sums: Vec<(String, f64)> = Vec::new();
    let timings = sources.iter().filter_map(|source| source.run["timings_s"].as_object());
    for (name, seconds) in timings.flatten() {
        let seconds = seconds.as_f64().unwrap_or_default();
        match sums.iter_mut().find(|(known, _)| known == name) {
            Some((_, sum)) => *sum += seconds,
            None => sums.push((name.clone(), seconds)),
        }
    }
    sums
}

/// The folder of the merged run while it is filled.
struct Target {
    path: PathBuf,
    journal: Mutex<Journal>,
    watch: Arc<Watch>,
    _lock: Lock,
}

impl Target {
    /// Makes the folder ready, or opens that of an interrupted merge; `run` is the `run.json` of a share.
    fn open(path: &Path, drafts: &Drafts, run: &Value, (mode, opening): (Mode, &Opening)) -> Result<Self, Error> {
        if holder_of(path).is_none() {
            refuse(path, mode, Papers::read(path)?.is_run())?;
        }
        fs::create_dir_all(path).map_err(Error::io("create", path))?;
        let lock = Lock::take(path)?;
        let papers = Papers::read(path)?;
        refuse(path, mode, papers.is_run())?;
        let fingerprint = run["fingerprint"].as_str().unwrap_or_default();
        let mut done = BTreeMap::new();
        if mode == Mode::Resume && papers.is_run() {
            done = kept(path, &papers, (run, fingerprint), opening.checking)?;
        } else if papers.is_run() {
            clear(path, &papers)?;
        }
        drafts.write_start(path)?;
        let journal = Journal::of(&path.join(JOURNAL), fingerprint.to_owned(), done)?;
        remove_leftovers(path, &journal)?;
        let watch = Watch::over(path, &opening.space);
        Ok(Self { path: path.to_path_buf(), journal: Mutex::new(journal), watch, _lock: lock })
    }

    fn journal(&self) -> MutexGuard<'_, Journal> {
        self.journal.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Takes the files of a shard from another folder of the same run and enters the shard in the journal; where one
    /// is damaged, its fault, and the shard is not entered.
    fn adopt(
        &self,
        files: Files,
        from: &Path,
        report: &ShardReport,
        checking: &Checking,
    ) -> Result<Option<MergeFault>, Error> {
        for (place, file) in report.files.iter().enumerate() {
            if files == Files::Linked && self.link(from, file)? {
                continue;
            }
            let sha256 = self.copy(from, file, checking)?;
            if sha256 != file.sha256 {
                // Nothing of a part that is not entered stays.
                let others = &report.files[..place];
                others.iter().try_for_each(|other| durable::remove(&self.path.join(&other.path)))?;
                let how = check::other_hash(&sha256, file);
                return Ok(Some(MergeFault::Damaged { folder: from.to_path_buf(), file: file.path.clone(), how }));
            }
        }
        self.journal().enter(report.clone())?;
        Ok(None)
    }

    /// Gives a file its name in this folder too; `false` where the file system has no links. The check of the sources
    /// has read the file.
    fn link(&self, from: &Path, file: &FileReport) -> Result<bool, Error> {
        let (source, to) = (from.join(&file.path), self.path.join(&file.path));
        if let Some(folder) = to.parent() {
            fs::create_dir_all(folder).map_err(Error::io("create", folder))?;
        }
        let staged = durable::beside(&to);
        durable::remove(&staged)?;
        if fs::hard_link(&source, &staged).is_err() {
            return Ok(false);
        }
        durable::rename(&staged, &to)?;
        Ok(true)
    }

    /// Copies a file, and tells its hash. It has its name in this folder only if that is the recorded one.
    fn copy(&self, from: &Path, file: &FileReport, checking: &Checking) -> Result<String, Error> {
        let (source, to) = (from.join(&file.path), self.path.join(&file.path));
        if let Some(folder) = to.parent() {
            fs::create_dir_all(folder).map_err(Error::io("create", folder))?;
        }
        let staged = durable::beside(&to);
        let mut copy = HashingFile::create(&staged, &self.watch)?;
        let copied = blocks(&source, |block| copy.write_all(block).and_then(|()| checking.read(block.len() as u64)));
        let done = match copied {
            Err(_) if checking.is_stopped() => Err(Error::Stopped),
            Err(error) => Err(Error::io("copy", &source)(error)),
            Ok(()) => copy.finish().map_err(Error::from).and_then(|(_, sha256)| {
                if sha256 == file.sha256 {
                    durable::rename(&staged, &to)?
                } else {
                    durable::remove(&staged)?
                }
                Ok(sha256)
            }),
        };
        done.inspect_err(|_| _ = fs::remove_file(&staged))
    }
}

/// The shards that an interrupted merge has copied, where it was of the same run.
fn kept(
    path: &Path,
    papers: &Papers,
    (run, fingerprint): (&Value, &str),
    checking: &Checking,
) -> Result<BTreeMap<u32, ShardReport>, Error> {
    let mut differences = papers.whole().map(|there| Differences::between_runs(there, run)).unwrap_or_default();
    differences.compare_shares(papers.whole().and_then(Share::of_run), None);
    if !differences.0.is_empty() {
        return Err(Error::Foreign { path: path.to_path_buf(), differences });
    }
    let found = check::of(path, papers, (fingerprint, None), None, (Depth::Bytes, checking))?;
    let mut done = papers.journal.as_ref().map(|journal| journal.done(fingerprint)).unwrap_or_default();
    done.retain(|shard, _| found.sound.contains(shard));
    Ok(done)
}

/// Reads a file block by block.
fn blocks(path: &Path, mut each: impl FnMut(&[u8]) -> io::Result<()>) -> io::Result<()> {
    let mut file = File::open(path)?;
    let mut block = vec![0; 1 << 20];
    loop {
        match file.read(&mut block)? {
            0 => return Ok(()),
            read => each(&block[..read])?,
        }
    }
}
