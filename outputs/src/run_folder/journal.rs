//! The journal of a run: one line of JSON for each shard whose files are whole and on the disk.
//!
//! Each line names its run and ends with a check of itself. A crash may tear the last line, which then counts as not
//! written. A damaged line loses its shard, and where its end is damaged also the shard of the next line. Where two
//! lines name the same shard, the later line holds. No line ever follows a torn line: after a failed write the file is
//! shortened to its whole lines, and where that fails too, the journal takes no more lines.

use super::error::Error;
use super::seal::LINE;
use crate::storage::durable;
use crate::tables::Table;
use phytomer_sim::Tick;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The name of the file.
pub const JOURNAL: &str = "journal.jsonl";

/// The report of a committed shard.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ShardReport {
    /// The shard's number, from 0.
    pub shard: u32,
    /// Its files: parts of tables, and meshes.
    pub files: Vec<FileReport>,
    /// The number of its plants that live at the last tick of their plot. A plant that is not sown by then is neither
    /// living nor dead.
    pub living: u64,
    /// The number of its plants that have died.
    pub dead: u64,
    /// The number of components that ever lived.
    pub components: u64,
    /// Its plots that ended because a plant reached its limit.
    pub overgrown: Vec<OvergrownPlot>,
}

/// One file of a run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileReport {
    /// Its path in the run folder, with `/`.
    pub path: String,
    /// Its table, for a part of a table.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub table: Option<Table>,
    /// The number of its rows, for a part of a table.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rows: Option<u64>,
    /// Its size in bytes.
    pub bytes: u64,
    /// Its SHA-256, in hexadecimal.
    pub sha256: String,
}

/// A plot that ended because a plant reached its limit, or because its model came to a stop.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct OvergrownPlot {
    /// The number of the plot.
    pub plot: u32,
    /// The number of the plant that reached its limit.
    pub plant: u32,
    /// The tick that the plot could not finish; the ticks before it are recorded. In older runs the key is `age`.
    #[serde(alias = "age")]
    pub tick: Tick,
    /// The limit, in components.
    pub limit: u32,
    /// Why the model of the plant came to a stop; `None` where the plant reached its limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stopped: Option<String>,
}

impl ShardReport {
    /// The number of its rows, over all tables.
    pub fn rows(&self) -> u64 {
        self.files.iter().filter_map(|file| file.rows).sum()
    }

    /// The size of its files, bytes.
    pub fn bytes(&self) -> u64 {
        self.files.iter().map(|file| file.bytes).sum()
    }
}

/// A line of the journal: a shard, and the fingerprint of its run ([`super::identity::fingerprint`]).
#[derive(Debug, Clone, Serialize, Deserialize)]
struct Line {
    #[serde(flatten)]
    report: ShardReport,
    run: String,
}

/// The journal, open for further lines.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    run: String,
    file: File,
    done: BTreeMap<u32, ShardReport>,
    /// The length of the whole lines, bytes.
    whole: u64,
    /// Whether the file may end with a torn line.
    torn: bool,
}

impl Journal {
    /// Writes the journal of a run with the shards that are done, and keeps it open for further lines.
    pub fn of(path: &Path, run: String, done: BTreeMap<u32, ShardReport>) -> Result<Self, Error> {
        let (file, whole) = written(path, &run, &done)?;
        Ok(Self { path: path.to_path_buf(), run, file, done, whole, torn: false })
    }

    /// The reports of the shards that are done, by number.
    pub fn done(&self) -> &BTreeMap<u32, ShardReport> {
        &self.done
    }

    /// Enters a shard; its line is on the disk when this returns. After an error the journal is unchanged.
    ///
    /// # Errors
    /// A failed write, or [`Error::TornJournal`] after a failed write whose remains could not be removed.
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
        let line = line_of(&self.run, &report).map_err(Error::json(&self.path))?;
        if let Err(source) = write(&mut self.file, &line) {
            self.torn = cut(&mut self.file, self.whole).is_err();
            return Err(Error::io("write", &self.path)(source));
        }
        self.whole += line.len() as u64;
        self.done.insert(report.shard, report);
        Ok(())
    }

    /// Writes the journal anew, with its lines in the order of the shards.
    pub fn put_in_order(&mut self) -> Result<(), Error> {
        (self.file, self.whole) = written(&self.path, &self.run, &self.done)?;
        self.torn = false;
        Ok(())
    }
}

/// Writes a whole journal; returns the file, open at its end, and its length in bytes.
fn written(path: &Path, run: &str, done: &BTreeMap<u32, ShardReport>) -> Result<(File, u64), Error> {
    let lines: Result<Vec<_>, _> = done.values().map(|report| line_of(run, report)).collect();
    let content = lines.map_err(Error::json(path))?.concat();
    durable::write(path, &content)?;
    let mut file = OpenOptions::new().write(true).open(path).map_err(Error::io("open", path))?;
    file.seek(SeekFrom::End(0)).map_err(Error::io("open", path))?;
    Ok((file, content.len() as u64))
}

/// Shortens the file to its whole lines, so that the next line follows them.
fn cut(file: &mut File, whole: u64) -> io::Result<()> {
    file.set_len(whole)?;
    file.seek(SeekFrom::Start(whole))?;
    file.sync_all()
}

fn line_of(run: &str, report: &ShardReport) -> Result<Vec<u8>, serde_json::Error> {
    let line = Line { report: report.clone(), run: run.to_owned() };
    Ok(LINE.put(serde_json::to_vec(&line)?))
}

/// The whole lines of a journal that was read.
#[derive(Debug, Default)]
pub struct Reading {
    lines: Vec<(usize, Line)>,
    damaged: BTreeSet<usize>,
    /// Whether it ends in the middle of a line.
    pub torn: bool,
}

impl Reading {
    /// The fingerprints of the runs that its lines name: a single run, unless the file was edited.
    pub fn runs(&self) -> BTreeSet<&str> {
        self.lines.iter().map(|(_, line)| line.run.as_str()).collect()
    }

    /// Every file that a whole line names, for any run.
    pub fn files(&self) -> impl Iterator<Item = &FileReport> {
        self.lines.iter().flat_map(|(_, line)| &line.report.files)
    }

    /// The reports of the shards of a run, by number.
    pub fn done(&self, run: &str) -> BTreeMap<u32, ShardReport> {
        let own = self.lines.iter().filter(|(_, line)| line.run == run);
        own.map(|(_, line)| (line.report.shard, line.report.clone())).collect()
    }

    /// The numbers, from 1, of all lines that are not whole lines of this run.
    pub fn damaged(&self, run: &str) -> Vec<usize> {
        let others = self.lines.iter().filter(|(_, line)| line.run != run).map(|(number, _)| *number);
        let lines: BTreeSet<usize> = others.chain(self.damaged.iter().copied()).collect();
        lines.into_iter().collect()
    }
}

/// Reads a journal; `None` where there is no such file.
pub fn read(path: &Path) -> Result<Option<Reading>, Error> {
    let content = match fs::read(path) {
        Err(source) if source.kind() == io::ErrorKind::NotFound => return Ok(None),
        content => content.map_err(Error::io("read", path))?,
    };
    let mut reading = Reading::default();
    for (number, line) in (1..).zip(content.split_inclusive(|byte| *byte == b'\n')) {
        let read = if LINE.holds(line) { serde_json::from_slice::<Line>(line).ok() } else { None };
        match read {
            Some(line) => reading.lines.push((number, line)),
            None if !line.ends_with(b"\n") => reading.torn = true,
            None => _ = reading.damaged.insert(number),
        }
    }
    Ok(Some(reading))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::storage::FileError;

    const RUN: &str = "0123456789abcdef";

    fn report(shard: u32) -> ShardReport {
        ShardReport { shard, files: Vec::new(), living: 1, dead: 2, components: 3, overgrown: Vec::new() }
    }

    fn begin(path: &Path) -> Journal {
        Journal::of(path, RUN.to_owned(), BTreeMap::new()).unwrap()
    }

    fn shards_in(path: &Path) -> Vec<u32> {
        read(path).unwrap().unwrap().done(RUN).into_keys().collect()
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
        let mut journal = begin(&path);
        journal.enter(report(0)).unwrap();
        assert!(matches!(journal.enter_by(report(1), half), Err(Error::File(FileError::Io { doing: "write", .. }))));
        assert!(!journal.done().contains_key(&1));
        journal.enter(report(2)).unwrap();
        assert_eq!(shards_in(&path), [0, 2]);
        assert_eq!(journal.whole, fs::metadata(&path).unwrap().len());
    }

    /// The tick that a plot could not finish was called an age while every plant was sown at tick 0.
    #[test]
    fn the_limits_of_older_runs_are_read() {
        let read = serde_json::from_str::<OvergrownPlot>;
        let now = OvergrownPlot { plot: 3, plant: 4, tick: 5, limit: 6, stopped: None };
        assert_eq!(read(r#"{"plot":3,"plant":4,"age":5,"limit":6}"#).unwrap(), now);
        assert_eq!(read(&serde_json::to_string(&now).unwrap()).unwrap(), now);
    }

    #[test]
    fn a_resumed_journal_takes_back_a_torn_line_too() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("journal.jsonl");
        begin(&path).enter(report(0)).unwrap();
        OpenOptions::new().append(true).open(&path).unwrap().write_all(b"{\"shard\":1,").unwrap();
        let reading = read(&path).unwrap().unwrap();
        assert!(reading.torn && reading.damaged(RUN).is_empty());
        let mut journal = Journal::of(&path, RUN.to_owned(), reading.done(RUN)).unwrap();
        journal.enter(report(1)).unwrap();
        journal.enter_by(report(2), half).unwrap_err();
        journal.put_in_order().unwrap();
        journal.enter(report(3)).unwrap();
        assert_eq!(shards_in(&path), [0, 1, 3]);
    }

    /// A file that is open for reading alone can be neither written nor shortened.
    #[test]
    fn a_journal_that_cannot_be_mended_takes_no_more() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("journal.jsonl");
        let mut journal = begin(&path);
        journal.enter(report(0)).unwrap();
        let sound = std::mem::replace(&mut journal.file, File::open(&path).unwrap());
        assert!(matches!(journal.enter(report(1)), Err(Error::File(_))));
        journal.file = sound;
        assert!(matches!(journal.enter(report(2)), Err(Error::TornJournal { .. })));
        assert_eq!(shards_in(&path), [0]);
    }

    #[test]
    fn a_damaged_line_and_one_of_another_run_cost_their_shards_alone() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("journal.jsonl");
        let mut journal = begin(&path);
        (0..4).for_each(|shard| journal.enter(report(shard)).unwrap());
        let mut lines: Vec<String> = fs::read_to_string(&path).unwrap().lines().map(str::to_owned).collect();
        lines[1] = lines[1].replace("\"living\":1", "\"living\":2");
        lines[3] = String::from_utf8(line_of("another run", &report(3)).unwrap()).unwrap().trim_end().to_owned();
        fs::write(&path, lines.join("\n") + "\n").unwrap();
        assert_eq!(shards_in(&path), [0, 2]);
        let reading = read(&path).unwrap().unwrap();
        assert_eq!((reading.damaged(RUN), reading.torn), (vec![2, 4], false));
    }
}
