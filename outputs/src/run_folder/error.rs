//! Errors of a run folder, in words for the person who must set it right.
//!
//! Errors of tables and files keep their own messages. A failed write ends the run; no error is only logged. A message
//! does not repeat its cause, since people are shown the whole chain of causes (`source`).

use super::difference::Differences;
use super::holder::Holder;
use super::merge_fault::MergeFaults;
use super::share::Share;
use crate::storage::FileError;
use crate::tables::TableError;
use std::io;
use std::path::{Path, PathBuf};

/// A failure of a run folder.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The file system returned an error.
    #[error(transparent)]
    File(#[from] FileError),
    /// A table could not be written or read.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A JSON file could not be parsed.
    #[error("cannot understand {}", path.display())]
    Json {
        /// The file.
        path: PathBuf,
        /// The parser's error.
        source: serde_json::Error,
    },
    /// The folder for a new run holds files already.
    #[error(
        "{} already holds files: go on with that run by --resume, replace it by --overwrite, or choose another folder \
         by --out",
        path.display()
    )]
    Occupied {
        /// The folder.
        path: PathBuf,
    },
    /// The folder to resume, replace or read is not a run.
    #[error("{} has no run.json, so it is not a run folder; nothing in it was touched", path.display())]
    NotARun {
        /// The folder.
        path: PathBuf,
    },
    /// The plan of the run to resume differs.
    #[error(
        "{} holds another run: resume it with the scenario and the program that it began with, or choose another folder \
         by --out. What differs:\n{differences}",
        path.display()
    )]
    Foreign {
        /// The folder.
        path: PathBuf,
        /// The differences between both plans.
        differences: Differences,
    },
    /// The identity of the run to resume cannot be read.
    #[error(
        "in {} run.json is missing or damaged, and the journal has no whole line of this run: resume it with the scenario \
         and the program that it began with, or begin anew with --overwrite",
        path.display()
    )]
    Unrecognised {
        /// The folder.
        path: PathBuf,
    },
    /// Another process fills the folder.
    #[error(
        "{} is being filled by {holder}: wait for its end or end it, or choose another folder by --out or --name; nothing \
         was touched",
        path.display()
    )]
    InProgress {
        /// The folder.
        path: PathBuf,
        /// The process.
        holder: Holder,
    },
    /// `run.json` was changed after it was written.
    #[error(
        "{} is damaged: its check does not hold. `phytomer grow` with --resume, and with the scenario and the folder of \
         the run, mends it",
        path.display()
    )]
    Damaged {
        /// The file.
        path: PathBuf,
    },
    /// The run was written by a program version that wrote no checks.
    #[error(
        "{} was written by an older phytomer, which stored no checks, so its files cannot be checked. Grow it again with \
         --overwrite, or use the program that `run.json` names",
        path.display()
    )]
    OlderFormat {
        /// The folder.
        path: PathBuf,
    },
    /// The share of a run would have no part.
    #[error(
        "the shard {share} would be empty: the run has {parts} part files, so that it can be dealt into at most {parts} \
         shards; ask for fewer shards, or for smaller parts by `output = {{ plants_per_part = … }}` in the scenario"
    )]
    EmptyShare {
        /// The share.
        share: Share,
        /// The number of parts of the run.
        parts: u32,
    },
    /// Folders do not make up one run.
    #[error("these folders cannot be merged; nothing was written:\n{0}")]
    Merge(MergeFaults),
    /// Files of folders that are merged are damaged; the parts without damage were copied.
    #[error(
        "files of these folders are damaged; the parts without damage are merged, and --resume goes on when the others are \
         mended:\n{0}"
    )]
    Shares(MergeFaults),
    /// The caller stopped the check of the files.
    #[error("the check of the files was stopped")]
    Stopped,
    /// The plan has no shard with this number.
    #[error("there is no shard {shard}: the run has {shards}")]
    NoSuchShard {
        /// The number that was asked for.
        shard: u32,
        /// The number of shards of the run.
        shards: u32,
    },
    /// A plot of a shard was ended out of order.
    #[error("shard {shard} was given plot {plot} where plot {expected} is next")]
    PlotOutOfTurn {
        /// The shard.
        shard: u32,
        /// The plot that was ended.
        plot: u32,
        /// The next plot of the shard.
        expected: u32,
    },
    /// A shard was committed before all its plots had ended.
    #[error("shard {shard} has {ended} of its {plots} plots: it cannot be committed")]
    UnfinishedShard {
        /// The shard.
        shard: u32,
        /// The number of its plots that have ended.
        ended: u32,
        /// The number of its plots.
        plots: u32,
    },
    /// A failed write left a torn line in the journal that could not be removed.
    #[error(
        "nothing more is entered in {}: a write to it failed and could not be taken back; what is complete is kept: \
         free some space, then go on with --resume",
        path.display()
    )]
    TornJournal {
        /// The journal.
        path: PathBuf,
    },
    /// The run was closed before all its shards were committed.
    #[error("{} lacks {missing} shards: go on with it by --resume", path.display())]
    MissingShards {
        /// The folder.
        path: PathBuf,
        /// The number of missing shards.
        missing: usize,
    },
}

impl Error {
    /// Makes an [`Error::File`] from the system's error: `doing` is what was tried.
    pub(crate) fn io(doing: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Self {
        let told = FileError::io(doing, path);
        move |source| Self::File(told(source))
    }

    pub(crate) fn json(path: &Path) -> impl FnOnce(serde_json::Error) -> Self {
        let path = path.to_path_buf();
        move |source| Self::Json { path, source }
    }
}
