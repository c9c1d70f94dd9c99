//! The files of a run folder as bytes, and the checks within its documents made right again.
//!
//! `run.json` and each line of the journal end with a check of all that stands before it (`run_folder/seal` of
//! `outputs`). A broken document is refused by its check alone; with a check that holds, what reads its values is tried
//! too. Absent: hashes of whole files, which the journal and `run.json` state of the tables.

use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

/// What stands before and behind the digits of a check: in `run.json`, and in a line of the journal.
const DOCUMENT: [&[u8]; 2] = [b",\n  \"check\": \"", b"\"\n}\n"];
const LINE: [&[u8]; 2] = [b",\"check\":\"", b"\"}\n"];
/// The digits of a check.
const DIGITS: usize = 16;

/// Every file below a folder, sorted by its path there; the lock, which is empty, is left out.
pub fn read(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let (mut files, mut folders) = (Vec::new(), vec![folder.to_path_buf()]);
    while let Some(next) = folders.pop() {
        for path in fs::read_dir(next).expect("a folder").map(|entry| entry.expect("an entry").path()) {
            if path.is_dir() {
                folders.push(path);
            } else if !path.ends_with("run.lock") {
                let name = path.strip_prefix(folder).expect("below the run").to_string_lossy().replace('\\', "/");
                files.push((name, fs::read(&path).expect("a file")));
            }
        }
    }
    files.sort();
    files
}

/// Writes a file of a run folder.
pub fn put(folder: &Path, name: &str, bytes: &[u8]) {
    let path = folder.join(name);
    fs::create_dir_all(path.parent().unwrap_or(folder)).expect("a folder");
    fs::write(path, bytes).expect("a file");
}

/// The same document with checks that hold, where it has any.
pub fn sealed(name: &str, text: &[u8]) -> Vec<u8> {
    match name {
        "run.json" => again(text, DOCUMENT),
        "journal.jsonl" => text.split_inclusive(|byte| *byte == b'\n').flat_map(|line| again(line, LINE)).collect(),
        _ => text.to_vec(),
    }
}

fn again(text: &[u8], [before, after]: [&[u8]; 2]) -> Vec<u8> {
    let content = text.strip_suffix(after).and_then(|rest| rest.get(..rest.len().checked_sub(DIGITS)?));
    let Some(content) = content.and_then(|rest| rest.strip_suffix(before)) else { return text.to_vec() };
    let mut check = Sha256::digest(content).iter().fold(String::new(), |mut digits, byte| {
        _ = write!(digits, "{byte:02x}");
        digits
    });
    check.truncate(DIGITS);
    [content, before, check.as_bytes(), after].concat()
}
