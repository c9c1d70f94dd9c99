//! Whether a run folder holds what it says: every file that the journal and `run.json` name, and nothing else.
//!
//! `verify`, `describe` and `--resume` ask here, so that they agree by construction: on what is wrong, and on which
//! shards are to be grown again. A shard is sound where its line in the journal is whole and each file of that line has
//! the length and the hash recorded. What is found beside the named files is a leftover where a shard or a document of
//! this program would bear that name, and foreign elsewhere; `--resume` removes leftovers and leaves what is foreign.
//!
//! Absent: mending.

use super::documents::{PACKAGE, RUN, VIEWS};
use super::error::Error;
use super::holder::Holder;
use super::journal::{FileReport, JOURNAL, ShardReport};
use super::lock::{LOCK, holder_of};
use super::papers::{Papers, RunJson};
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

/// How closely files are looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depth {
    /// Whether they are there, and how long they are.
    Lengths,
    /// Also whether their bytes have the hashes recorded.
    Bytes,
}

/// How far a check has come, and the wish to stop it.
#[derive(Debug, Default)]
pub struct Checking {
    bytes: AtomicU64,
    in_all: AtomicU64,
    stop: AtomicBool,
}

impl Checking {
    /// Asks the check to stop soon.
    pub fn stop(&self) {
        self.stop.store(true, Relaxed);
    }

    /// Bytes read so far.
    pub fn bytes(&self) -> u64 {
        self.bytes.load(Relaxed)
    }

    /// Bytes to be read.
    pub fn in_all(&self) -> u64 {
        self.in_all.load(Relaxed)
    }

    fn read(&self, bytes: u64) -> io::Result<()> {
        self.bytes.fetch_add(bytes, Relaxed);
        if self.stop.load(Relaxed) { Err(io::Error::from(io::ErrorKind::Interrupted)) } else { Ok(()) }
    }
}

/// What is wrong with a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Trouble {
    /// It is named and not there.
    Missing,
    /// It is not as it was written, in words.
    Damaged(String),
    /// Nothing names it, and it bears the name of a file of a run.
    Leftover,
    /// It is none of the run's.
    Foreign,
}

impl Trouble {
    /// One word for programs.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Missing => "missing",
            Self::Damaged(_) => "damaged",
            Self::Leftover => "leftover",
            Self::Foreign => "foreign",
        }
    }

    /// The same for people.
    pub fn in_words(&self) -> &str {
        match self {
            Self::Missing => "missing",
            Self::Damaged(how) => how,
            Self::Leftover => "left over: nothing names it",
            Self::Foreign => "foreign: no file of the run",
        }
    }
}

/// A file that is not as it should be.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// Its path in the run folder, with `/`.
    pub path: String,
    /// What is wrong.
    pub trouble: Trouble,
}

/// What a run folder is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum State {
    /// A process is filling it.
    InProgress,
    /// Something that it names is missing or damaged, or a finished run has leftovers.
    Damaged,
    /// Shards are still to be grown, or the run is still to be closed; what is there is sound.
    Unfinished,
    /// All that it names is there, as it was written.
    Complete,
}

/// What was found.
#[derive(Debug, Clone)]
pub struct Checkup {
    /// What the folder is.
    pub state: State,
    /// Every file that is not as it should be, by path. Of a run in progress those alone that the journal names.
    pub findings: Vec<Finding>,
    /// The named files.
    pub files: usize,
    /// Their bytes.
    pub bytes: u64,
    /// How closely they were looked at.
    pub depth: Depth,
    /// How many shards the run has, where `run.json` can say it.
    pub shards: Option<u32>,
    /// The shards of which everything is as it was written.
    pub sound: BTreeSet<u32>,
    /// The shards that are to be grown, or grown again.
    pub to_grow: Vec<u32>,
    /// The process that fills the folder now.
    pub holder: Option<Holder>,
}

impl Checkup {
    /// Whether the run is complete and nothing else lies in its folder.
    pub fn is_clean(&self) -> bool {
        self.state == State::Complete && self.findings.is_empty()
    }

    /// The findings that are foreign files, or those that are not.
    pub fn findings(&self, foreign: bool) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(move |finding| (finding.trouble == Trouble::Foreign) == foreign)
    }
}

/// Looks at a run folder.
///
/// # Errors
/// [`Error::NotARun`], [`Error::OlderFormat`], [`Error::Stopped`], or where the folder cannot be read.
pub fn check(folder: &Path, depth: Depth, checking: &Checking) -> Result<Checkup, Error> {
    // Before the papers: a run that ends meanwhile is then told as one in progress, not as one that lacks something.
    let holder = holder_of(folder);
    let papers = Papers::read(folder)?;
    if !papers.is_run() && holder.is_none() {
        return Err(Error::NotARun { path: folder.to_path_buf() });
    }
    if matches!(papers.run, RunJson::Older(_)) {
        return Err(Error::OlderFormat { path: folder.to_path_buf() });
    }
    let run = papers.fingerprint();
    of(folder, &papers, run.as_deref().unwrap_or_default(), holder, (depth, checking))
}

/// The same of papers that were read already, of the run with this fingerprint.
pub fn of(
    folder: &Path,
    papers: &Papers,
    run: &str,
    holder: Option<Holder>,
    (depth, checking): (Depth, &Checking),
) -> Result<Checkup, Error> {
    let done = papers.journal.as_ref().map(|journal| journal.done(run)).unwrap_or_default();
    let in_progress = holder.is_some();
    let named = papers.named(&done, in_progress);
    let bytes = named.values().map(|file| file.bytes).sum();
    checking.in_all.store(bytes, Relaxed);
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
    let findings: Vec<Finding> = troubles.into_iter().map(|(path, trouble)| Finding { path, trouble }).collect();
    Ok(Checkup {
        state: state_of(&findings, in_progress, complete),
        findings,
        files: named.len(),
        bytes,
        depth,
        shards,
        to_grow: (0..most).filter(|shard| !sound.contains(shard)).collect(),
        sound,
        holder,
    })
}

fn state_of(findings: &[Finding], in_progress: bool, complete: bool) -> State {
    let harms = |trouble: &Trouble| match trouble {
        Trouble::Missing | Trouble::Damaged(_) => true,
        // What an interrupted shard leaves is no damage, but views and readers would take it for a part of a finished
        // run.
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

/// The parts of the run that a `run.json` tells of.
fn shards_of(run: &Value) -> u32 {
    let number = |key: &str| run[key].as_u64().and_then(|number| u32::try_from(number).ok()).unwrap_or_default();
    number("plots").div_ceil(number("plots_per_part").max(1))
}

/// What is wrong with named files, by path; the files are read on as many threads as there are.
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
        Ok((_, sha256)) => {
            let how = format!("its SHA-256 is {sha256}, and {} is recorded", named.sha256);
            Ok(Some(Trouble::Damaged(how)))
        }
    }
}

/// What is wrong with `run.json` and with lines of the journal. A torn last line of an unfinished run is no damage:
/// that shard was never entered.
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

/// Files of the folder that nothing names.
pub fn others(folder: &Path, named: &BTreeSet<&str>) -> Result<BTreeMap<String, Trouble>, Error> {
    let mut found = BTreeMap::new();
    let mut folders = vec![(folder.to_path_buf(), String::new())];
    while let Some((folder, below)) = folders.pop() {
        for entry in fs::read_dir(&folder).map_err(Error::io("read", &folder))? {
            let entry = entry.map_err(Error::io("read", &folder))?;
            let path = format!("{below}{}", entry.file_name().to_string_lossy());
            // A link to a folder is not followed: it may lead back.
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

/// The folders that shards fill.
pub fn filled() -> impl Iterator<Item = &'static str> {
    Table::ALL.iter().map(|table| table.name()).chain(["meshes"])
}

/// Whether a path in the run folder is one that a shard writes, a part or a mesh, or any file of the run half written.
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
