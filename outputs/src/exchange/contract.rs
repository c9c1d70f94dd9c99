//! What a format is: its word, its endings, how it is read and how it is written.
//!
//! A format knows bytes and no paths: what else it needs beside its file, as the plants of a scene, it asks for by
//! name.

use super::description::Description;
use super::losses::Losses;
use super::report::Report;
use std::collections::BTreeMap;
use std::io::{self, Write};

/// The most bytes of a file that is read.
pub const MOST_BYTES: usize = 1 << 30;
/// The most entities of a description. A file that stands for more is at fault.
pub const MOST_ENTITIES: usize = 20_000_000;

/// How many metres a unit of a file is, for formats that do not say it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    /// Metres in the unit of lengths and places.
    pub length_m: f64,
    /// Metres in the unit of diameters.
    pub diameter_m: f64,
}

impl Default for Units {
    fn default() -> Self {
        Self { length_m: 1.0, diameter_m: 1.0 }
    }
}

/// A file that is read.
pub struct Incoming<'a> {
    /// What it is called in messages.
    pub name: &'a str,
    /// All of it, at most [`MOST_BYTES`].
    pub bytes: &'a [u8],
    /// The units that the caller states. `None` where the caller states none: a format without units of its own then
    /// reads metres, and warns.
    pub units: Option<Units>,
    /// Another file by its name as the file has it, found from where the file lies.
    pub beside: &'a dyn Fn(&str) -> io::Result<Vec<u8>>,
}

/// What takes the files that are written.
pub trait Outgoing {
    /// The name of the file, without its folder and its ending, after which files beside it are called.
    fn stem(&self) -> &str;

    /// Makes one file: the one that was asked for (`None`), or one beside it with a name. `fill` is called once and
    /// writes it; the file is whole afterwards, or not there.
    ///
    /// # Errors
    /// Those of `fill` and of the system.
    fn file(&mut self, beside: Option<&str>, fill: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>) -> io::Result<()>;
}

/// A format of files of plants.
pub trait Format: Sync {
    /// The word that `--from` and `--to` take.
    fn word(&self) -> &'static str;

    /// What it is, in a few words.
    fn title(&self) -> &'static str;

    /// The endings of its files, without the dot, in lower case.
    fn endings(&self) -> &'static [&'static str];

    /// Whether the first lines look like this format: asked where several formats share an ending.
    fn is_like(&self, bytes: &[u8]) -> bool {
        let _ = bytes;
        false
    }

    /// Whether files of it are read.
    fn reads(&self) -> bool {
        true
    }

    /// Whether files of it are written.
    fn writes(&self) -> bool {
        true
    }

    /// The plants of a file. What is wrong goes into the report; where it then has faults the description is worth
    /// nothing. In time and memory of the order of the file and of what it stands for, up to [`MOST_ENTITIES`]; never
    /// recursive in the depth of the file.
    fn read(&self, incoming: &Incoming<'_>, report: &mut Report) -> Description;

    /// Writes plants, and tells what the format cannot hold.
    ///
    /// # Errors
    /// Where a file cannot be written.
    fn write(&self, description: &Description, out: &mut dyn Outgoing, losses: &mut Losses) -> io::Result<()>;
}

/// Files in memory: for tests, and for the trip from one format to another.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct InMemory {
    /// The name without ending.
    pub stem: String,
    /// The file that was asked for.
    pub main: Vec<u8>,
    /// Those beside it, by name.
    pub beside: BTreeMap<String, Vec<u8>>,
}

impl Outgoing for InMemory {
    fn stem(&self) -> &str {
        &self.stem
    }

    fn file(&mut self, beside: Option<&str>, fill: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
        let mut bytes = Vec::new();
        fill(&mut bytes)?;
        match beside {
            None => self.main = bytes,
            Some(name) => _ = self.beside.insert(name.to_owned(), bytes),
        }
        Ok(())
    }
}
