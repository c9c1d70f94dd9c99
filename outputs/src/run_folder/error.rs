//! What can go wrong with a run folder, in words for the person who must set it right.
//!
//! What a table or a file refuses is told in its own words. A failed write ends the run: nothing here is logged and
//! passed over. A message does not repeat its cause, which `source` has: a person is shown the whole chain.

use super::difference::Differences;
use super::holder::Holder;
use crate::storage::FileError;
use crate::tables::TableError;
use std::io;
use std::path::{Path, PathBuf};

/// A failure of a run folder.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The file system refused.
    #[error(transparent)]
    File(#[from] FileError),
    /// A table could not be written or read.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A JSON file could not be understood.
    #[error("cannot understand {}", path.display())]
    Json {
        /// The file.
        path: PathBuf,
        /// Why.
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
    /// The run to resume is another run.
    #[error(
        "{} holds another run: resume it with the scenario and the program that it began with, or choose another folder \
         by --out. What differs:\n{differences}",
        path.display()
    )]
    Foreign {
        /// The folder.
        path: PathBuf,
        /// What differs.
        differences: Differences,
    },
    /// The run to resume cannot be told from another.
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
    /// `run.json` is not as it was written.
    #[error(
        "{} is damaged: its check does not hold. `phytomer grow` with --resume, and with the scenario and the folder of \
         the run, mends it",
        path.display()
    )]
    Damaged {
        /// The file.
        path: PathBuf,
    },
    /// The run was written by a program that kept no checks.
    #[error(
        "{} was written by an older phytomer, without the checks that this one looks for: nothing can be said of it. Grow \
         it again with --overwrite, or use the program that `run.json` names",
        path.display()
    )]
    OlderFormat {
        /// The folder.
        path: PathBuf,
    },
    /// The check of the files was told to stop.
    #[error("the check of the files was told to stop")]
    Stopped,
    /// A shard was asked for that the plan does not have.
    #[error("there is no shard {shard}: the run has {shards}")]
    NoSuchShard {
        /// The one asked for.
        shard: u32,
        /// How many there are.
        shards: u32,
    },
    /// A plot came to a shard out of its turn.
    #[error("shard {shard} was given plot {plot} where plot {expected} is next")]
    PlotOutOfTurn {
        /// The shard.
        shard: u32,
        /// The plot that came.
        plot: u32,
        /// The plot whose turn it was.
        expected: u32,
    },
    /// A shard was to be committed before all its plots had ended.
    #[error("shard {shard} has {ended} of its {plots} plots: it cannot be committed")]
    UnfinishedShard {
        /// The shard.
        shard: u32,
        /// The plots that have ended.
        ended: u32,
        /// The plots that it covers.
        plots: u32,
    },
    /// A line of the journal was torn by a failed write and could not be taken back.
    #[error(
        "nothing more is entered in {}: a write to it failed and could not be taken back; what is complete is kept: \
         free some space, then go on with --resume",
        path.display()
    )]
    TornJournal {
        /// The journal.
        path: PathBuf,
    },
    /// The run was to be finished before all its shards were committed.
    #[error("{} lacks {missing} shards: go on with it by --resume", path.display())]
    MissingShards {
        /// The folder.
        path: PathBuf,
        /// How many.
        missing: usize,
    },
}

impl Error {
    /// The file system's answer, as the file that it is about tells it.
    pub(crate) fn io(doing: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Self {
        let told = FileError::io(doing, path);
        move |source| Self::File(told(source))
    }

    pub(crate) fn json(path: &Path) -> impl FnOnce(serde_json::Error) -> Self {
        let path = path.to_path_buf();
        move |source| Self::Json { path, source }
    }
}
