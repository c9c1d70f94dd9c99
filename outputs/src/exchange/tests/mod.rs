//! Trips of plants through the formats, and texts of them, small and measured.

mod faults;
mod measured;
mod mutated;
mod obj;
mod opf;
mod ops;
mod qsm;
mod trips;

use super::{Description, InMemory, Incoming, Losses, Report, by_word};
use std::collections::BTreeMap;
use std::io;
use std::path::PathBuf;

/// Reads a text as a format; other files stand beside it.
fn read_with(word: &str, bytes: &[u8], others: &BTreeMap<String, Vec<u8>>) -> (Description, Report) {
    let mut report = Report::new("plant");
    let beside =
        |name: &str| others.get(name).cloned().ok_or_else(|| io::Error::new(io::ErrorKind::NotFound, "no such file"));
    let incoming = Incoming { name: "plant", bytes, units: None, beside: &beside };
    (by_word(word).unwrap().read(&incoming, &mut report), report)
}

/// Reads a text as a format, alone.
fn read(word: &str, text: &str) -> (Description, Report) {
    read_with(word, text.as_bytes(), &BTreeMap::new())
}

/// The plants of a text without a fault.
fn plants(word: &str, text: &str) -> Description {
    let (description, report) = read(word, text);
    assert!(report.faults().is_empty(), "{:?}", report.faults());
    description
}

/// The files of a description, and what they do not hold.
fn written(word: &str, description: &Description) -> (InMemory, Vec<String>) {
    let (mut out, mut losses) = (InMemory { stem: "plant".to_owned(), ..InMemory::default() }, Losses::default());
    by_word(word).unwrap().write(description, &mut out, &mut losses).unwrap();
    (out, losses.told().iter().map(ToString::to_string).collect())
}

fn text(file: &InMemory) -> String {
    String::from_utf8(file.main.clone()).unwrap()
}

/// Writes and reads again.
fn again(word: &str, description: &Description) -> Description {
    let (out, _) = written(word, description);
    let (found, report) = read_with(word, &out.main, &out.beside);
    assert!(report.faults().is_empty(), "{word}: {:?}", report.faults());
    found
}

/// The folder of measured plants beside the project; `None` where measured data are left out.
fn measured() -> Option<PathBuf> {
    let stated = std::env::var_os("PHYTOMER_DATA").filter(|stated| !stated.is_empty());
    if stated.as_ref().is_some_and(|stated| stated == "none") {
        return None;
    }
    let own = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let root = own.ancestors().find(|folder| folder.join("Cargo.lock").is_file()).unwrap_or(&own).to_owned();
    let sought = [stated.map(PathBuf::from), Some(root.join("../shared/data")), Some(root.join("../../shared/data"))];
    let found = sought.into_iter().flatten().map(|data| data.join("exchange")).find(|folder| folder.is_dir());
    assert!(found.is_some() || std::env::var_os("CI").is_none(), "measured plants are not there");
    found
}
