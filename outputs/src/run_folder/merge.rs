//! Merges folders that hold shares of one run into one folder with the bytes of a run that was grown at once.
//!
//! The folders must be of one run (scenario, seed, program, inputs: the fingerprint), be sound byte for byte, and hold
//! each part once. All that is wrong is told together, before anything is written. Then each part is copied beside its
//! final name, hashed on the way, renamed and entered in the journal, so that an interrupted merge can be resumed as a
//! run is. Only the timings in `run.json` are not those of a run that was grown at once: they are the sums of those of
//! the folders. Absent: growing what is missing.

use super::check::{self, Checking, Checkup, Depth, State};
use super::difference::Differences;
use super::documents::RunReport;
use super::error::Error;
use super::identity::plan_of;
use super::journal::{FileReport, ShardReport};
use super::merge_fault::{MergeFault, MergeFaults};
use super::papers::Papers;
use super::share::Share;
use super::{Mode, Opening, RunFolder};
use crate::storage::durable::{self, HashingFile};
use crate::tables::{Provenance, RunPlan};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

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

/// A folder with a share of the run.
struct Source {
    folder: PathBuf,
    run: Value,
    done: BTreeMap<u32, ShardReport>,
    found: Checkup,
}

/// Merges the folders `parts` into the folder `into`. `program` is the version and the commit of this program, which
/// must be those of the program that grew the parts. The progress counts the bytes of the check, then those of the
/// copies.
///
/// # Errors
/// [`Error::Merge`] with all that is wrong with the folders; else as [`RunFolder::open`].
pub fn merge(
    into: &Path,
    parts: &[PathBuf],
    program: (&str, &str),
    (mode, opening): (Mode, &Opening),
) -> Result<Merged, Error> {
    let (sources, plan) = gathered(into, parts, program, opening.checking)?;
    let provided: BTreeMap<u32, (&Path, &ShardReport)> = sources
        .iter()
        .flat_map(|source| source.done.iter().map(|(part, report)| (*part, (source.folder.as_path(), report))))
        .collect();
    let shards = plan.shards();
    let folder = RunFolder::open(into, plan, mode, opening)?;
    let missing = folder.missing_shards();
    let reports = missing.iter().filter_map(|part| provided.get(part));
    opening.checking.begin(reports.map(|(_, report)| report.bytes()).sum());
    missing.par_iter().try_for_each(|part| match provided.get(part) {
        Some((from, report)) => folder.adopt(from, report, opening.checking),
        None => Ok(()),
    })?;
    let timings = timings_of(&sources);
    let timings: Vec<(&str, f64)> = timings.iter().map(|(name, seconds)| (name.as_str(), *seconds)).collect();
    Ok(Merged { report: folder.finish(&timings)?, shards, copied: missing.len() as u32 })
}

/// The folders and the plan of their run, where they make up one.
fn gathered(
    into: &Path,
    parts: &[PathBuf],
    program: (&str, &str),
    checking: &Checking,
) -> Result<(Vec<Source>, RunPlan), Error> {
    let mut faults = Vec::new();
    let mut sources = Vec::new();
    for folder in parts {
        if is_same(folder, into) {
            faults.push(MergeFault::Target { folder: folder.clone() });
            continue;
        }
        match Source::of(folder, checking, &mut faults) {
            Ok(source) => sources.extend(source),
            Err(Error::Stopped) => return Err(Error::Stopped),
            Err(error) => faults.push(MergeFault::Unreadable(in_words(&error))),
        }
    }
    let plan = sources.first().and_then(|first| first.plan(program, &mut faults));
    if let Some(plan) = &plan {
        let (same, others): (Vec<Source>, Vec<Source>) = sources.into_iter().partition(|source| source.is_of(plan));
        faults.extend(others.iter().map(|other| other.differs(&same, plan)));
        sources = same;
        check_overlaps(&sources, &mut faults);
        // What a folder that cannot be used would have is not missing.
        if sources.len() == parts.len() {
            check_gaps(&sources, plan.shards(), &mut faults);
        }
    }
    match plan {
        Some(plan) if faults.is_empty() => Ok((sources, plan)),
        _ => Err(Error::Merge(MergeFaults(faults))),
    }
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
    fn of(folder: &Path, checking: &Checking, faults: &mut Vec<MergeFault>) -> Result<Option<Self>, Error> {
        let found = check::check(folder, Depth::Bytes, checking)?;
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
        let Some(run) = papers.whole().cloned() else {
            return Err(Error::NotARun { path: folder.to_path_buf() });
        };
        Ok(Some(Self { folder: folder.to_path_buf(), run, done: done.unwrap_or_default(), found }))
    }

    /// The plan of its run, which this program must be able to write as the program that grew it.
    fn plan(&self, program: (&str, &str), faults: &mut Vec<MergeFault>) -> Option<RunPlan> {
        let plan = plan_of(&self.run).filter(|plan| {
            let Provenance { version, git_hash, .. } = &plan.provenance;
            (version.as_str(), git_hash.as_str()) == program
        });
        if plan.is_none() {
            let word = |key: &str| self.run[key].as_str().unwrap_or("unknown").to_owned();
            let (version, git_hash) = (word("version"), word("git_hash"));
            faults.push(MergeFault::OtherProgram { folder: self.folder.clone(), version, git_hash });
        }
        plan
    }

    fn is_of(&self, plan: &RunPlan) -> bool {
        Differences::between(&self.run, plan).0.is_empty()
    }

    fn differs(&self, same: &[Self], plan: &RunPlan) -> MergeFault {
        let first = same.first().map(|source| source.folder.clone()).unwrap_or_default();
        MergeFault::OtherRun { folder: self.folder.clone(), first, differences: Differences::between(&self.run, plan) }
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
fn check_gaps(sources: &[Source], parts: u32, faults: &mut Vec<MergeFault>) {
    let there: BTreeSet<u32> = sources.iter().flat_map(|source| source.done.keys().copied()).collect();
    let mut missing: Vec<u32> = (0..parts).filter(|part| !there.contains(part)).collect();
    for Source { folder, found, .. } in sources {
        let own: Vec<u32> = found.to_grow.iter().filter(|part| missing.contains(part)).copied().collect();
        if !own.is_empty() {
            missing.retain(|part| !own.contains(part));
            faults.push(MergeFault::Unfinished { folder: folder.clone(), share: found.share, parts: own });
        }
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

impl RunFolder {
    /// Copies the files of a shard from another folder of the same run and enters the shard in the journal.
    fn adopt(&self, from: &Path, report: &ShardReport, checking: &Checking) -> Result<(), Error> {
        report.files.iter().try_for_each(|file| self.copy(from, file, checking))?;
        self.journal().enter(report.clone())
    }

    fn copy(&self, from: &Path, file: &FileReport, checking: &Checking) -> Result<(), Error> {
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
            Ok(()) => match copy.finish()? {
                (_, sha256) if sha256 == file.sha256 => Ok(durable::rename(&staged, &to)?),
                _ => Err(Error::io("copy", &source)(io::Error::other("it changed while it was copied"))),
            },
        };
        done.inspect_err(|_| _ = fs::remove_file(&staged))
    }
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
