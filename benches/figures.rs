//! The scripts of the figures of Aono & Kunii 1984 (`docs/asystem`) beside their pictures alone: at most 1.2 times as
//! long.
//!
//! `cargo bench --bench figures [-- PAIRS]` runs all scripts from their text to their files, and by turns grows, draws
//! and writes the same trees on stages on which every statement but the last has been taken. So the ratio is what
//! reading, checking and taking statements costs. Absent: the start of the program.

#[path = "specimen/turns.rs"]
mod turns;

use phytomer::asystem::{Stage, Written, checked};
use std::cell::RefCell;
use std::fs;
use std::path::{Path, PathBuf};

/// The pairs of runs where none are asked for.
const PAIRS: usize = 3;

fn scripts() -> Vec<(PathBuf, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/asystem");
    let entries = fs::read_dir(folder).expect("the scripts that ship").map(|entry| entry.expect("an entry").path());
    let mut paths: Vec<PathBuf> =
        entries.filter(|path| path.extension().is_some_and(|ending| ending == "asys")).collect();
    paths.sort();
    paths.into_iter().map(|path| (path.clone(), fs::read_to_string(&path).expect("a script"))).collect()
}

/// A stage after all statements of a script but `exit`, which writes.
fn stage(script: &str, folder: &Path) -> Stage {
    let mut stage = Stage::new(folder);
    let steps = checked(script).unwrap_or_else(|refused| panic!("{refused}")).steps;
    for step in steps.split_last().map_or(&[][..], |(_, before)| before) {
        let written = stage.take(step).expect("a statement");
        assert!(written.files.is_empty(), "a script that writes before its end has more than its picture");
    }
    stage
}

fn end(stage: &mut Stage) {
    let mut written = Written::default();
    stage.end(&mut written).expect("files");
    assert_eq!(written.files.len(), 1);
}

fn main() {
    let pairs = std::env::args().filter_map(|word| word.parse().ok()).next().unwrap_or(PAIRS);
    let folder = tempfile::tempdir().expect("a folder");
    let scripts = scripts();
    assert!(scripts.len() >= 45, "{} scripts", scripts.len());
    let ready: RefCell<Vec<Stage>> = RefCell::default();
    let before = || *ready.borrow_mut() = scripts.iter().map(|(_, text)| stage(text, folder.path())).collect();
    let ours = || scripts.iter().for_each(|(_, text)| end(&mut stage(text, folder.path())));
    let theirs = || ready.borrow_mut().iter_mut().for_each(end);
    turns::by_turns(&format!("{} scripts over their pictures alone", scripts.len()), pairs, before, ours, theirs);
}
