//! The built program as a test uses it: run it in a folder, and hash what it has written.
//!
//! Absent: anything that depends on growth. These tests read files, streams and exit codes.

#![allow(dead_code, reason = "each test program uses a part of it")]

use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::{TempDir, tempdir};

/// The program that is tested.
pub const PROGRAM: &str = env!("CARGO_BIN_EXE_phytomer");

/// The program, in `folder`, with these words.
pub fn program(folder: &Path, words: &[&str]) -> Command {
    program_at(Path::new(PROGRAM), folder, words)
}

/// A program of these sources, perhaps of another profile, in `folder`, with these words.
pub fn program_at(path: &Path, folder: &Path, words: &[&str]) -> Command {
    let mut command = Command::new(path);
    command.current_dir(folder).args(words).env("NO_COLOR", "1");
    command
}

/// The result of a run of the program.
pub struct Said {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

/// Runs the program to its end.
pub fn run(folder: &Path, words: &[&str]) -> Said {
    said(program(folder, words).output().expect("the program starts"))
}

/// The text of an output.
pub fn said(output: Output) -> Said {
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    Said { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
}

impl Said {
    /// The result itself, after a check of its exit code.
    #[track_caller]
    pub fn ending(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "stdout:\n{}\nstderr:\n{}", self.stdout, self.stderr);
        self
    }

    /// stdout as JSON.
    #[track_caller]
    pub fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("{error}\n{}", self.stdout))
    }
}

/// A folder with a small finished run in `runs/small`.
pub fn grown() -> TempDir {
    let folder = tempdir().expect("a temporary folder");
    run(folder.path(), &["grow", &data("small.toml"), "--quiet"]).ending(0);
    folder
}

/// Writes a text file into a folder.
pub fn write(folder: &Path, name: &str, text: &str) {
    fs::write(folder.join(name), text).expect("the file is written");
}

/// The words for a film of a few small frames, by what is there without an ffmpeg, instead of a large one.
pub fn small_film<'a>(words: &[&'a str]) -> Vec<&'a str> {
    let of_size = |word: &str| ["--size", "--seconds", "--fps"].contains(&word);
    let kept = words.iter().enumerate().filter(|(k, word)| !of_size(word) && !of_size(words[k.saturating_sub(1)]));
    let ending = |word: &'a str| if word.ends_with(".mp4") { "plot.y4m" } else { word };
    let kept = kept.map(|(_, word)| ending(word)).take_while(|word| *word != "|");
    kept.chain(["--size", "48x32", "--seconds", "0.2", "--fps", "20"]).collect()
}

/// A file of the tests' own data.
pub fn data(name: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/runs").join(name).display().to_string()
}

/// The hash of every table and mesh below a run folder, by its path there.
pub fn hashes(run: &Path) -> BTreeMap<String, String> {
    let mut hashes = BTreeMap::new();
    let mut folders = vec![run.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for path in fs::read_dir(&folder).into_iter().flatten().map(|entry| entry.expect("an entry").path()) {
            if path.is_dir() {
                folders.push(path);
            } else if is_result(&path) {
                let name = path.strip_prefix(run).expect("below the run").display().to_string().replace('\\', "/");
                hashes.insert(name, sha256(&path));
            }
        }
    }
    hashes
}

fn is_result(path: &Path) -> bool {
    path.extension().is_some_and(|end| end == "parquet" || end == "ply")
}

/// The hash of a file, in hexadecimal.
pub fn sha256(path: &PathBuf) -> String {
    Sha256::digest(fs::read(path).expect("a readable file")).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Every file of a run folder, by its path there; of `run.json` all but what depends on the time. The lock is left out.
pub fn contents(run: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut contents = BTreeMap::new();
    let mut folders = vec![run.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for path in fs::read_dir(&folder).expect("a folder").map(|entry| entry.expect("an entry").path()) {
            let name = path.strip_prefix(run).expect("below the run").display().to_string().replace('\\', "/");
            if path.is_dir() {
                folders.push(path);
            } else if name != "run.lock" {
                contents.insert(name, fs::read(&path).expect("a readable file"));
            }
        }
    }
    let json = contents.get("run.json").map(|text| serde_json::from_slice::<serde_json::Value>(text).expect("JSON"));
    if let Some(serde_json::Value::Object(mut json)) = json {
        ["timings_s", "check"].iter().for_each(|key| _ = json.remove(*key));
        contents.insert("run.json".to_owned(), serde_json::Value::Object(json).to_string().into_bytes());
    }
    contents
}
