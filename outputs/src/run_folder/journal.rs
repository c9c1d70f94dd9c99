//! The journal of a run: one line of JSON for each shard whose files are whole and on the disk.
//!
//! A crash may tear the last line, which then counts as not written; a damaged line before it is an error. Where two
//! lines name the same shard the later one holds. No line ever follows a torn one: what a failed write left is taken
//! back, and where even that fails the journal takes no more.

use super::durable;
use crate::Error;
use crate::tables::Table;
use phytomer_sim::Tick;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// What a committed shard has written.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ShardReport {
    /// The shard's number, from 0.
    pub shard: u32,
    /// Its files.
    pub files: Vec<FileReport>,
    /// Its plants that live at the last age.
    pub living: u64,
    /// Its plants that have died.
    pub dead: u64,
    /// The components that ever were.
    pub components: u64,
    /// Its plots that ended by a limit.
    pub overgrown: Vec<OvergrownPlot>,
}

/// One file of a run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileReport {
    /// Its path in the run folder, with `/`.
    pub path: String,
    /// Its table, if it is a part of one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub table: Option<Table>,
    /// Its rows, if it is a part of a table.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rows: Option<u64>,
    /// Its bytes.
    pub bytes: u64,
    /// Its hash, in hexadecimal.
    pub sha256: String,
}

/// A plot that came to its limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct OvergrownPlot {
    /// The plot.
    pub plot: u32,
    /// The plant that came to its limit.
    pub plant: u32,
    /// The age that it could not finish; the ages before it are recorded.
    pub age: Tick,
    /// The limit, in components.
    pub limit: u32,
}

impl ShardReport {
    /// The rows that it has written, over all tables.
    pub fn rows(&self) -> u64 {
        self.files.iter().filter_map(|file| file.rows).sum()
    }

    /// The bytes of its files.
    pub fn bytes(&self) -> u64 {
        self.files.iter().map(|file| file.bytes).sum()
    }
}

/// The journal, open for more.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
    done: BTreeMap<u32, ShardReport>,
    /// The length of the whole lines, bytes.
    whole: u64,
    /// Whether the file may end with a torn line.
    torn: bool,
}

impl Journal {
    /// Begins an empty journal.
    pub fn begin(path: &Path) -> Result<Self, Error> {
        let file = File::create(path).map_err(Error::io("create", path))?;
        file.sync_all().map_err(Error::io("write to disk", path))?;
        durable::sync_folder_of(path)?;
        Ok(Self { path: path.to_path_buf(), file, done: BTreeMap::new(), whole: 0, torn: false })
    }

    /// Reads the journal of an earlier start and goes on with it; a torn last line is cut off.
    pub fn go_on(path: &Path) -> Result<Self, Error> {
        if !path.exists() {
            return Self::begin(path);
        }
        let (done, whole) = read(path)?;
        let mut file = OpenOptions::new().write(true).open(path).map_err(Error::io("open", path))?;
        cut(&mut file, whole).map_err(Error::io("shorten", path))?;
        Ok(Self { path: path.to_path_buf(), file, done, whole, torn: false })
    }

    /// The shards that are done, by number.
    pub fn done(&self) -> &BTreeMap<u32, ShardReport> {
        &self.done
    }

    /// Strikes out a shard whose files are not there any more.
    pub fn forget(&mut self, shard: u32) {
        self.done.remove(&shard);
    }

    /// Enters a shard; it is on the disk when this returns. After an error the journal is as it was before.
    ///
    /// # Errors
    /// A failed write, or [`Error::TornJournal`] after one that could not be taken back.
    pub fn enter(&mut self, report: ShardReport) -> Result<(), Error> {
        self.enter_by(report, |file, line| {
            file.write_all(line)?;
            file.sync_all()
        })
    }

    fn enter_by(
        &mut self,
        report: ShardReport,
        write: impl FnOnce(&mut File, &[u8]) -> io::Result<()>,
    ) -> Result<(), Error> {
        if self.torn {
            return Err(Error::TornJournal { path: self.path.clone() });
        }
        let line = line_of(&report).map_err(Error::json(&self.path))?;
        if let Err(source) = write(&mut self.file, &line) {
            self.torn = cut(&mut self.file, self.whole).is_err();
            return Err(Error::io("write", &self.path)(source));
        }
        self.whole += line.len() as u64;
        self.done.insert(report.shard, report);
        Ok(())
    }

    /// Writes the whole journal anew, in the order of the shards.
    pub fn put_in_order(&mut self) -> Result<(), Error> {
        let lines: Result<Vec<_>, _> = self.done.values().map(line_of).collect();
        let content = lines.map_err(Error::json(&self.path))?.concat();
        durable::write(&self.path, &content)?;
        let mut file = OpenOptions::new().write(true).open(&self.path).map_err(Error::io("open", &self.path))?;
        file.seek(SeekFrom::End(0)).map_err(Error::io("open", &self.path))?;
        (self.file, self.whole, self.torn) = (file, content.len() as u64, false);
        Ok(())
    }
}

/// Shortens the file to its whole lines; the next line goes there.
fn cut(file: &mut File, whole: u64) -> io::Result<()> {
    file.set_len(whole)?;
    file.seek(SeekFrom::Start(whole))?;
    file.sync_all()
}

fn line_of(report: &ShardReport) -> Result<Vec<u8>, serde_json::Error> {
    let mut line = serde_json::to_vec(report)?;
    line.push(b'\n');
    Ok(line)
}

/// The shards in a journal, and the length of its whole lines in bytes.
pub fn read(path: &Path) -> Result<(BTreeMap<u32, ShardReport>, u64), Error> {
    let content = fs::read(path).map_err(Error::io("read", path))?;
    let mut done = BTreeMap::new();
    let mut whole = 0;
    let lines: Vec<&[u8]> = content.split_inclusive(|byte| *byte == b'\n').collect();
    for (at, line) in lines.iter().enumerate() {
        let report = if line.ends_with(b"\n") { serde_json::from_slice::<ShardReport>(line).ok() } else { None };
        match report {
            Some(report) => done.insert(report.shard, report),
            None if at + 1 == lines.len() => break,
            None => return Err(Error::Journal { path: path.to_path_buf(), line: at + 1 }),
        };
        whole += line.len() as u64;
    }
    Ok((done, whole))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(shard: u32) -> ShardReport {
        ShardReport { shard, files: Vec::new(), living: 1, dead: 2, components: 3, overgrown: Vec::new() }
    }

    /// Half of a line, then a full disk.
    fn half(file: &mut File, line: &[u8]) -> io::Result<()> {
        file.write_all(&line[..line.len() / 2])?;
        Err(io::Error::from(io::ErrorKind::StorageFull))
    }

    #[test]
    fn no_line_follows_a_torn_one() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("journal.jsonl");
        let mut journal = Journal::begin(&path).unwrap();
        journal.enter(report(0)).unwrap();
        assert!(matches!(journal.enter_by(report(1), half), Err(Error::Io { doing: "write", .. })));
        assert!(!journal.done().contains_key(&1));
        journal.enter(report(2)).unwrap();
        let (done, whole) = read(&path).unwrap();
        assert_eq!(done.into_keys().collect::<Vec<_>>(), [0, 2]);
        assert_eq!(whole, fs::metadata(&path).unwrap().len());
    }

    #[test]
    fn a_resumed_journal_takes_back_a_torn_line_too() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("journal.jsonl");
        Journal::begin(&path).unwrap().enter(report(0)).unwrap();
        OpenOptions::new().append(true).open(&path).unwrap().write_all(b"{\"shard\":1,").unwrap();
        let mut journal = Journal::go_on(&path).unwrap();
        journal.enter(report(1)).unwrap();
        journal.enter_by(report(2), half).unwrap_err();
        journal.put_in_order().unwrap();
        journal.enter(report(3)).unwrap();
        assert_eq!(read(&path).unwrap().0.into_keys().collect::<Vec<_>>(), [0, 1, 3]);
    }

    /// A file that is open for reading alone can be neither written nor shortened.
    #[test]
    fn a_journal_that_cannot_be_mended_takes_no_more() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("journal.jsonl");
        let mut journal = Journal::begin(&path).unwrap();
        journal.enter(report(0)).unwrap();
        let sound = std::mem::replace(&mut journal.file, File::open(&path).unwrap());
        assert!(matches!(journal.enter(report(1)), Err(Error::Io { .. })));
        journal.file = sound;
        assert!(matches!(journal.enter(report(2)), Err(Error::TornJournal { .. })));
        assert_eq!(read(&path).unwrap().0.into_keys().collect::<Vec<_>>(), [0]);
    }
}
