//! The documents that describe a run folder, read back: `run.json` and the journal, with whether their checks hold.
//!
//! Absent: whether the files that they name exist (`check`).

use super::documents::RUN;
use super::error::Error;
use super::journal::{self, FileReport, JOURNAL, Reading, ShardReport};
use super::seal::DOCUMENT;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Component, Path};

/// A `run.json`.
#[derive(Debug)]
pub enum RunJson {
    /// There is no `run.json`.
    Missing,
    /// The check of the file does not hold.
    Damaged {
        /// Whether the file still names this program.
        ours: bool,
    },
    /// The file is of a program version that wrote no checks.
    Older(Value),
    /// The file is as it was written.
    Whole(Value),
}

/// `run.json` and the journal of a run folder.
#[derive(Debug)]
pub struct Papers {
    /// `run.json`.
    pub run: RunJson,
    /// The journal; `None` where there is none.
    pub journal: Option<Reading>,
}

impl Papers {
    /// Reads both documents.
    pub fn read(folder: &Path) -> Result<Self, Error> {
        let file = folder.join(RUN);
        let run = match fs::read(&file) {
            Err(source) if source.kind() == io::ErrorKind::NotFound => RunJson::Missing,
            text => RunJson::of(&text.map_err(Error::io("read", &file))?),
        };
        Ok(Self { run, journal: journal::read(&folder.join(JOURNAL))? })
    }

    /// Whether the folder is that of a run, whole or damaged.
    pub fn is_run(&self) -> bool {
        match self.run {
            RunJson::Older(_) | RunJson::Whole(_) | RunJson::Damaged { ours: true } => true,
            RunJson::Missing | RunJson::Damaged { ours: false } => {
                self.journal.as_ref().is_some_and(|journal| !journal.runs().is_empty())
            }
        }
    }

    /// The content of `run.json`; `None` where its check does not hold.
    pub fn whole(&self) -> Option<&Value> {
        if let RunJson::Whole(run) = &self.run { Some(run) } else { None }
    }

    /// The fingerprint of the run's plan: from `run.json`, else from the journal where all its lines name one run.
    pub fn fingerprint(&self) -> Option<String> {
        let stated = self.whole().and_then(|run| run["fingerprint"].as_str().map(str::to_owned));
        stated.or_else(|| {
            let runs = self.journal.as_ref()?.runs();
            if runs.len() == 1 { runs.first().map(|run| (*run).to_owned()) } else { None }
        })
    }

    /// The paths of the files of the run; `None` where `run.json` is not whole.
    pub fn names(&self) -> Option<Vec<String>> {
        self.whole()?;
        let done = self.journal.as_ref().zip(self.fingerprint()).map(|(journal, run)| journal.done(&run));
        Some(self.named(&done.unwrap_or_default(), false).into_keys().collect())
    }

    /// The files that the run names, by path: its tables and meshes, and the documents whose hashes are in `run.json`.
    pub fn named(&self, done: &BTreeMap<u32, ShardReport>, in_progress: bool) -> BTreeMap<String, FileReport> {
        let of_run = |key: &str| -> Vec<FileReport> {
            let list = self.whole().filter(|_| !in_progress).and_then(|run| run.get(key).cloned());
            list.and_then(|list| serde_json::from_value(list).ok()).unwrap_or_default()
        };
        let stated = of_run("files").into_iter().chain(of_run("documents"));
        let entered = done.values().flat_map(|report| report.files.iter().cloned());
        stated.chain(entered).filter(|file| is_inside(&file.path)).map(|file| (file.path.clone(), file)).collect()
    }
}

impl RunJson {
    fn of(text: &[u8]) -> Self {
        let json = serde_json::from_slice::<Value>(text).ok();
        let ours = |json: &Value| json["format"] == "phytomer run";
        match json {
            Some(json) if DOCUMENT.holds(text) && ours(&json) => Self::Whole(json),
            // Damage at one place leaves at least one of the two keys.
            Some(json) if ours(&json) && json.get("check").is_none() && json.get("format_version").is_none() => {
                Self::Older(json)
            }
            _ => Self::Damaged { ours: text.windows(12).any(|word| word == b"phytomer run") },
        }
    }
}

/// Whether a path leads into the run folder.
pub fn is_inside(path: &str) -> bool {
    Path::new(path).components().all(|part| matches!(part, Component::Normal(_)))
}
