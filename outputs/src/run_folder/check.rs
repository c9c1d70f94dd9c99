//! The check whether a run folder holds every file that the journal and `run.json` name, as written, and nothing else.
//!
//! `verify`, `describe` and `--resume` all use this check, so they agree on what is wrong and on the shards to grow
//! again. A shard is sound where its line in the journal is whole and each file of the line has the recorded length and
//! hash. A file that is not named is a leftover where a shard or a document of this program would have its name, else
//! it is foreign; `--resume` removes leftovers and keeps foreign files. Absent: repair.

use super::documents::{PACKAGE, RUN, VIEWS};
use super::error::Error;
use super::holder::Holder;
use super::journal::{FileReport, JOURNAL, ShardReport};
use super::lock::{LOCK, holder_of};
use super::papers::{Papers, RunJson};
use super::share::Share;
use crate::storage::durable;
use crate::tables::Table;
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};

/// The files of the run folder itself.
pub const DOCUMENTS: [&str; 4] = [RUN, JOURNAL, PACKAGE, VIEWS];

/// How closely files are checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depth {
    /// Existence and length; no file is read.
    Lengths,
    /// Also the hash of the bytes; every file is read.
    Bytes,
}

/// The progress of a check or of a merge, and the switch that stops it; shared between threads.
#[derive(Debug, Default)]
pub struct Checking {
    bytes: AtomicU64,
    in_all: AtomicU64,
    copies: AtomicBool,
    stop: AtomicBool,
}

impl Checking {
    /// Stops the check at its next block of bytes.
    pub fn stop(&self) {
        self.stop.store(true, Relaxed);
    }

    /// Whether the check is to stop.
    pub fn is_stopped(&self) -> bool {
        self.stop.load(Relaxed)
    }

    /// Begins to count anew, of so many bytes in all.
    pub(super) fn begin(&self, in_all: u64) {
        self.bytes.store(0, Relaxed);
        self.in_all.store(in_all, Relaxed);
    }

    /// The same for files that are copied while they are checked.
    pub(super) fn begin_copying(&self, in_all: u64) {
        self.copies.store(true, Relaxed);
        self.begin(in_all);
    }

    /// Whether files are copied, and not checked alone.
    pub fn copies(&self) -> bool {
        self.copies.load(Relaxed)
    }

    /// The number of bytes read so far.
    pub fn bytes(&self) -> u64 {
        self.bytes.load(Relaxed)
    }

    /// The number of bytes to be read in all.
    pub fn in_all(&self) -> u64 {
        self.in_all.load(Relaxed)
    }

    /// Counts bytes that were read; an error where the check is to stop.
    pub(super) fn read(&self, bytes: u64) -> io::Result<()> {
        self.bytes.fetch_add(bytes, Relaxed);
        if self.stop.load(Relaxed) { Err(io::Error::from(io::ErrorKind::Interrupted)) } else { Ok(()) }
    }
}

/// The fault of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Trouble {
    /// The file is named but does not exist.
    Missing,
    /// The file differs from what was written; the difference in words.
    Damaged(String),
    /// The file is not named, and has the name of a file of a run.
    Leftover,
    /// The file does not belong to the run.
    Foreign,
}

impl Trouble {
    /// The fault as one word, for programs.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Missing => "missing",
            Self::Damaged(_) => "damaged",
            Self::Leftover => "leftover",
            Self::Foreign => "foreign",
        }
    }

    /// The fault in words, for people.
    pub fn in_words(&self) -> &str {
        match self {
            Self::Missing => "missing",
            Self::Damaged(how) => how,
            Self::Leftover => "left over: nothing names it",
            Self::Foreign => "foreign: no file of the run",
        }
    }
}

/// A file with a fault.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// Its path in the run folder, with `/`.
    pub path: String,
    /// The fault.
    pub trouble: Trouble,
}

/// The state of a run folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum State {
    /// A process is filling the folder.
    InProgress,
    /// A named file is missing or damaged, or a finished run has leftovers.
    Damaged,
    /// Shards are still to be grown, or the run is still to be closed; the files that exist are sound.
    Unfinished,
    /// All named files exist, as they were written.
    Complete,
}

/// The result of a check.
#[derive(Debug, Clone)]
pub struct Checkup {
    /// The state of the folder.
    pub state: State,
    /// Every file with a fault, sorted by path. For a run in progress, only files that the journal names.
    pub findings: Vec<Finding>,
    /// The number of named files.
    pub files: usize,
    /// The size of the named files, bytes.
    pub bytes: u64,
    /// How closely the files were checked.
    pub depth: Depth,
    /// The number of shards that belong into the folder; `None` where `run.json` does not state it.
    pub shards: Option<u32>,
    /// The share of the run that the folder has; `None` for a whole run.
    pub share: Option<Share>,
    /// The numbers of the shards whose files are all as they were written.
    pub sound: BTreeSet<u32>,
    /// The numbers of the shards that are to be grown, or grown again, ascending.
    pub to_grow: Vec<u32>,
    /// The process that fills the folder now, if any.
    pub holder: Option<Holder>,
}

impl Checkup {
    /// Whether the run is complete and its folder holds no other file.
    pub fn is_clean(&self) -> bool {
        self.state == State::Complete && self.findings.is_empty()
    }

    /// With `foreign`, the foreign files among the findings; else all other findings.
    pub fn findings(&self, foreign: bool) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(move |finding| (finding.trouble == Trouble::Foreign) == foreign)
    }
}

/// Checks a run folder. With [`Depth::Bytes`] all its files are read once, on as many threads as there are.
///
/// # Errors
/// [`Error::NotARun`], [`Error::OlderFormat`], [`Error::Stopped`], or where the folder cannot be read.
pub fn check(folder: &Path, depth: Depth, checking: &Checking) -> Result<Checkup, Error> {
    // The lock is read before the documents: a run that ends in between is then reported as in progress, not as
    // incomplete.
    let holder = holder_of(folder);
    let papers = Papers::read(folder)?;
    if !papers.is_run() && holder.is_none() {
        return Err(Error::NotARun { path: folder.to_path_buf() });
    }
    if matches!(papers.run, RunJson::Older(_)) {
        return Err(Error::OlderFormat { path: folder.to_path_buf() });
    }
    let run = papers.fingerprint();
    let share = papers.whole().and_then(Share::of_run);
    of(folder, &papers, (run.as_deref().unwrap_or_default(), share), holder, (depth, checking))
}

/// Checks a run folder whose documents were read already; `run` is the fingerprint of the run, `share` what the folder
/// has of it.
pub fn of(
    folder: &Path,
    papers: &Papers,
    (run, share): (&str, Option<Share>),
    holder: Option<Holder>,
    (depth, checking): (Depth, &Checking),
) -> Result<Checkup, Error> {
    let done = papers.journal.as_ref().map(|journal| journal.done(run)).unwrap_or_default();
    let in_progress = holder.is_some();
    let named = papers.named(&done, in_progress);
    let bytes = named.values().map(|file| file.bytes).sum();
    checking.begin(bytes);
    let mut troubles = troubles_of(folder, &named, depth, checking)?;
    let is_sound = |report: &ShardReport| report.files.iter().all(|file| !troubles.contains_key(&file.path));
    let sound: BTreeSet<u32> = done.values().filter(|report| is_sound(report)).map(|report| report.shard).collect();
    let complete = papers.whole().is_some_and(|run| run["status"] == "complete");
    if !in_progress {
        troubles.extend(troubles_of_papers(papers, run, complete));
        troubles.extend(others(folder, &named.keys().map(String::as_str).collect())?);
    }
    let shards = papers.whole().map(shards_of);
    let most = shards.or_else(|| done.keys().max().map(|last| last + 1)).unwrap_or_default();
    let own = || Share::parts(share, most);
    let findings: Vec<Finding> = troubles.into_iter().map(|(path, trouble)| Finding { path, trouble }).collect();
    Ok(Checkup {
        state: state_of(&findings, in_progress, complete),
        findings,
        files: named.len(),
        bytes,
        depth,
        shards: shards.map(|_| own().count() as u32),
        share,
        to_grow: own().filter(|shard| !sound.contains(shard)).collect(),
        sound,
        holder,
    })
}

fn state_of(findings: &[Finding], in_progress: bool, complete: bool) -> State {
    let harms = |trouble: &Trouble| match trouble {
        Trouble::Missing | Trouble::Damaged(_) => true,
        // Files of an interrupted shard are no damage to an unfinished run. In a finished run, views and readers would
        // take them for parts of it.
        Trouble::Leftover => complete,
        Trouble::Foreign => false,
    };
    match findings.iter().any(|finding| harms(&finding.trouble)) {
        _ if in_progress => State::InProgress,
        true => State::Damaged,
        false if complete => State::Complete,
        false => State::Unfinished,
    }
}

/// The number of shards of the whole run, from its `run.json`.
pub fn shards_of(run: &Value) -> u32 {
    let number = |key: &str| run[key].as_u64().and_then(|number| u32::try_from(number).ok()).unwrap_or_default();
    number("plots").div_ceil(number("plots_per_part").max(1))
}

/// The faults of named files, by path; the files are read on as many threads as there are.
fn troubles_of(
    folder: &Path,
    named: &BTreeMap<String, FileReport>,
    depth: Depth,
    checking: &Checking,
) -> Result<BTreeMap<String, Trouble>, Error> {
    let files: Vec<&FileReport> = named.values().collect();
    let looked: Result<Vec<_>, Error> = files
        .into_par_iter()
        .map(|file| Ok((file.path.clone(), trouble_of(&folder.join(&file.path), file, depth, checking)?)))
        .collect();
    Ok(looked?.into_iter().filter_map(|(path, trouble)| Some((path, trouble?))).collect())
}

fn trouble_of(path: &Path, named: &FileReport, depth: Depth, checking: &Checking) -> Result<Option<Trouble>, Error> {
    let unreadable = |error: io::Error| Ok(Some(Trouble::Damaged(format!("it cannot be read: {error}"))));
    let there = match fs::metadata(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Some(Trouble::Missing)),
        Err(error) => return unreadable(error),
        Ok(there) => there,
    };
    if !there.is_file() {
        return Ok(Some(Trouble::Damaged("it is no file".to_owned())));
    }
    if there.len() != named.bytes {
        let how = format!("it has {} bytes, and {} are recorded", there.len(), named.bytes);
        return Ok(Some(Trouble::Damaged(how)));
    }
    if depth == Depth::Lengths {
        return Ok(None);
    }
    match File::open(path).and_then(|mut file| durable::hash(&mut file, |bytes| checking.read(bytes))) {
        Err(_) if checking.stop.load(Relaxed) => Err(Error::Stopped),
        Err(error) => unreadable(error),
        Ok((_, sha256)) if sha256 == named.sha256 => Ok(None),
        Ok((_, sha256)) => Ok(Some(Trouble::Damaged(other_hash(&sha256, named)))),
    }
}

/// How a file with this hash differs from the one that is recorded.
pub fn other_hash(sha256: &str, named: &FileReport) -> String {
    format!("its SHA-256 is {sha256}, and {} is recorded", named.sha256)
}

/// The faults of `run.json` and of the lines of the journal. A torn last line of an unfinished run is no fault: its
/// shard was never entered.
fn troubles_of_papers(papers: &Papers, run: &str, complete: bool) -> BTreeMap<String, Trouble> {
    let mut troubles = BTreeMap::new();
    match &papers.run {
        RunJson::Missing => _ = troubles.insert(RUN.to_owned(), Trouble::Missing),
        RunJson::Damaged { .. } => {
            troubles.insert(RUN.to_owned(), Trouble::Damaged("its check does not hold".to_owned()));
        }
        RunJson::Older(_) | RunJson::Whole(_) => {}
    }
    match &papers.journal {
        None => _ = troubles.insert(JOURNAL.to_owned(), Trouble::Missing),
        Some(journal) => {
            let lines: Vec<String> = journal.damaged(run).iter().map(usize::to_string).collect();
            if !lines.is_empty() {
                let how = format!("the check does not hold in line {}", lines.join(", "));
                troubles.insert(JOURNAL.to_owned(), Trouble::Damaged(how));
            } else if journal.torn && complete {
                troubles.insert(JOURNAL.to_owned(), Trouble::Damaged("its last line is torn".to_owned()));
            }
        }
    }
    troubles
}

/// The files of the folder that are not named, by path, as leftovers or foreign files.
pub fn others(folder: &Path, named: &BTreeSet<&str>) -> Result<BTreeMap<String, Trouble>, Error> {
    let mut found = BTreeMap::new();
    let mut folders = vec![(folder.to_path_buf(), String::new())];
    while let Some((folder, below)) = folders.pop() {
        for entry in fs::read_dir(&folder).map_err(Error::io("read", &folder))? {
            let entry = entry.map_err(Error::io("read", &folder))?;
            let path = format!("{below}{}", entry.file_name().to_string_lossy());
            // A link to a folder is not followed, since it may lead in a circle.
            if entry.file_type().map_err(Error::io("read", &folder))?.is_dir() {
                folders.push((entry.path(), path + "/"));
            } else if !named.contains(path.as_str()) && path != LOCK && !DOCUMENTS.contains(&path.as_str()) {
                let trouble = if is_own(&path) { Trouble::Leftover } else { Trouble::Foreign };
                found.insert(path, trouble);
            }
        }
    }
    Ok(found)
}

/// The folders that shards write to.
pub fn filled() -> impl Iterator<Item = &'static str> {
    Table::ALL.iter().map(|table| table.name()).chain(["meshes"])
}

/// Whether a path in the run folder is one that a run writes: a part, a mesh, or a half-written file of the run.
fn is_own(path: &str) -> bool {
    let beside = |name: &str| name.starts_with('.') && name.ends_with(".tmp");
    match path.split_once('/') {
        None => DOCUMENTS.iter().any(|document| path == format!(".{document}.tmp")),
        Some(("meshes", name)) => {
            let mesh = (name.starts_with("plant-") || name.starts_with("age-")) && name.ends_with(".ply");
            (mesh || beside(name)) && !name.contains('/')
        }
        Some((folder, name)) if filled().any(|filled| filled == folder) => {
            let part = name.starts_with("part-") && name.ends_with(".parquet");
            (part || beside(name)) && !name.contains('/')
        }
        Some(_) => false,
    }
}
