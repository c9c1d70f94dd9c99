//! Errors of the file system, in words for the person who must set it right.
//!
//! A message names the file or folder and what was tried; the cause is the system's own error (`source`).

use std::io;
use std::path::{Path, PathBuf};

/// A file or a folder that could not be read or written.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// The system returned an error.
    #[error("cannot {doing} {}", path.display())]
    Io {
        /// What was tried: "create", "rename", …
        doing: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// A file was to be written where a folder is.
    #[error("cannot write {}: it is a folder, and the name of a file is expected", path.display())]
    IsFolder {
        /// The folder.
        path: PathBuf,
    },
}

impl FileError {
    /// Makes a [`FileError::Io`] from the system's error.
    pub(crate) fn io(doing: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_path_buf();
        move |source| Self::Io { doing, path, source }
    }
}
