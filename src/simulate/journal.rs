//! A journal of simulations: what was simulated stands in a file, so that an analysis that was interrupted goes on
//! where it was.
//!
//! The first line says of which analysis it is, by a hash. Each further line has the key of a simulation, its summaries
//! as bits and a check; a line that was cut off is read over. What comes of an analysis does not depend on the order of
//! lines, nor on how often it was interrupted. Absent: what is simulated.

use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::{self, Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// The first words of a journal.
const KIND: &str = "phytomer simulations";

/// A journal of an analysis.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    found: BTreeMap<u64, Option<Vec<f64>>>,
    file: Mutex<File>,
}

/// Why there is no journal.
#[derive(Debug, thiserror::Error)]
pub enum JournalError {
    /// There is one of an analysis that has not ended.
    #[error("{0}: an analysis was interrupted; --resume goes on with it, or remove the file to begin anew")]
    Unfinished(PathBuf),
    /// The journal is of another analysis.
    #[error(
        "{0}: the journal is of an analysis of other numbers, summaries or settings; remove the file to begin anew"
    )]
    Other(PathBuf),
    /// It cannot be read or written.
    #[error("cannot write {path}")]
    Io {
        /// The file.
        path: PathBuf,
        /// The system's answer.
        source: io::Error,
    },
}

impl Journal {
    /// The journal beside a file that an analysis writes.
    pub fn beside(out: &Path) -> PathBuf {
        let mut name = out.file_name().map(std::ffi::OsStr::to_owned).unwrap_or_default();
        name.push(".journal");
        out.with_file_name(name)
    }

    /// Begins a journal, or goes on with one. `of` is all that the analysis depends on.
    ///
    /// # Errors
    /// [`JournalError`]: one that is there where none is resumed, one of another analysis, a failed write.
    pub fn open(path: &Path, of: &str, resume: bool) -> Result<Self, JournalError> {
        let failed = |source| JournalError::Io { path: path.to_owned(), source };
        let head = format!("{KIND} {}\n", hash(of));
        let mut found = BTreeMap::new();
        let mut text = Vec::new();
        match File::open(path) {
            Ok(_) if !resume => return Err(JournalError::Unfinished(path.to_owned())),
            Ok(mut file) => _ = file.read_to_end(&mut text).map_err(failed)?,
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => return Err(failed(error)),
        }
        let is_cut = !text.is_empty() && !text.ends_with(b"\n");
        // A file without its first line was interrupted before anything was done.
        let has_head = text.contains(&b'\n');
        if has_head {
            if !text.starts_with(head.as_bytes()) {
                return Err(JournalError::Other(path.to_owned()));
            }
            found.extend(String::from_utf8_lossy(&text).lines().skip(1).filter_map(read));
        }
        let mut options = OpenOptions::new();
        options.create(true).write(true).append(has_head).truncate(!has_head);
        let mut file = options.open(path).map_err(failed)?;
        let begin = if !has_head {
            head.as_str()
        } else if is_cut {
            "\n"
        } else {
            ""
        };
        file.write_all(begin.as_bytes()).map_err(failed)?;
        Ok(Self { path: path.to_owned(), found, file: Mutex::new(file) })
    }

    /// How many simulations it had when it was opened.
    pub fn known(&self) -> usize {
        self.found.len()
    }

    /// The summaries of a simulation that was done before; `Some(None)` where it had none.
    pub fn get(&self, key: u64) -> Option<Option<Vec<f64>>> {
        self.found.get(&key).cloned()
    }

    /// Adds a simulation.
    ///
    /// # Errors
    /// A failed write.
    pub fn put(&self, key: u64, summaries: Option<&[f64]>) -> io::Result<()> {
        let values = summaries.map_or_else(
            || "none".to_owned(),
            |all| all.iter().map(|value| format!("{:016x}", value.to_bits())).collect::<Vec<_>>().join(","),
        );
        let line = format!("{key:016x} {values}");
        let line = format!("{line} {}\n", &hash(&line)[..8]);
        let mut file = self.file.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        file.write_all(line.as_bytes())
    }

    /// Removes the journal of an analysis that has ended.
    ///
    /// # Errors
    /// The system's.
    pub fn finish(self) -> io::Result<()> {
        std::fs::remove_file(&self.path)
    }
}

/// The key of a simulation: of its numbers and its seed.
pub fn key(values: &[f64], seed: u64) -> u64 {
    // FNV-1a of the bits.
    let bytes = values.iter().flat_map(|value| value.to_bits().to_le_bytes()).chain(seed.to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

fn hash(text: &str) -> String {
    Sha256::digest(text.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect()
}

fn read(line: &str) -> Option<(u64, Option<Vec<f64>>)> {
    let (said, check) = line.rsplit_once(' ')?;
    if hash(said).get(..8) != Some(check) {
        return None;
    }
    let (key, values) = said.split_once(' ')?;
    let number = |bits: &str| u64::from_str_radix(bits, 16).ok().map(f64::from_bits);
    let values = match values {
        "none" => None,
        values => Some(values.split(',').map(number).collect::<Option<Vec<f64>>>()?),
    };
    Some((u64::from_str_radix(key, 16).ok()?, values))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_simulated_is_found_again() {
        let folder = tempfile::tempdir().unwrap();
        let path = Journal::beside(&folder.path().join("out.csv"));
        assert!(path.ends_with("out.csv.journal"));
        let journal = Journal::open(&path, "a", false).unwrap();
        journal.put(7, Some(&[1.5, f64::MIN_POSITIVE])).unwrap();
        journal.put(8, None).unwrap();
        drop(journal);
        assert!(matches!(Journal::open(&path, "a", false), Err(JournalError::Unfinished(_))));
        assert!(matches!(Journal::open(&path, "b", true), Err(JournalError::Other(_))));
        // A line that was cut off in its middle, and one that was changed.
        let mut text = std::fs::read_to_string(&path).unwrap();
        text.push_str("0000000000000009 3ff0000000000000 00000000\n000000000000000a 3ff0");
        std::fs::write(&path, text).unwrap();
        let journal = Journal::open(&path, "a", true).unwrap();
        assert_eq!(journal.known(), 2);
        assert_eq!(journal.get(7), Some(Some(vec![1.5, f64::MIN_POSITIVE])));
        assert_eq!((journal.get(8), journal.get(9)), (Some(None), None));
        journal.put(10, Some(&[2.0])).unwrap();
        drop(journal);
        let journal = Journal::open(&path, "a", true).unwrap();
        assert_eq!(journal.get(10), Some(Some(vec![2.0])));
        journal.finish().unwrap();
        assert!(!path.exists());
        assert_ne!(key(&[1.0], 2), key(&[2.0], 1));
    }
}
