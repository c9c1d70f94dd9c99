//! The things that a test needs and a machine may lack: the measured data, which are outside the project, and
//! independent readers.
//!
//! Measured data are sought in the folder that `PHYTOMER_DATA` names, else in `../shared/data` beside the project. In
//! CI (`CI` is set, and neither empty nor `false`) their absence fails the test, unless `PHYTOMER_DATA=none` leaves
//! them out; elsewhere the test is skipped with a message that counts the skipped tests. The messages go to stderr
//! directly, since the harness hides the output of a test that passes. Any crate of the workspace includes this file by
//! its path.

#![allow(dead_code, reason = "each test program uses a part of it")]

use std::env;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// The variable that names the folder of measured data.
pub const DATA: &str = "PHYTOMER_DATA";
/// The value of the variable that leaves the data out.
pub const NONE: &str = "none";

/// Whether this is a run in CI, which must not skip tests.
pub fn in_ci() -> bool {
    env::var_os("CI").is_some_and(|value| !value.is_empty() && value != "false")
}

/// Prints that the test of this thread is skipped, and how many tests of this program were skipped so far.
pub fn skip(reason: &str) {
    static SKIPPED: AtomicUsize = AtomicUsize::new(0);
    let number = SKIPPED.fetch_add(1, Ordering::Relaxed) + 1;
    let thread = std::thread::current();
    let test = thread.name().unwrap_or("a test");
    let _ = io::stderr().lock().write_all(format!("skipped ({number} so far): {test}: {reason}\n").as_bytes());
}

/// The text of a file of measured data; `None`, with a message, where the test is to be skipped.
///
/// # Panics
/// In CI where the file is absent, unless the data are left out.
#[track_caller]
pub fn measured(file: &str) -> Option<String> {
    let Some(folder) = folder() else {
        skip(&format!("measured data are left out by {DATA}={NONE}"));
        return None;
    };
    let path = folder.join(file);
    let error = match std::fs::read_to_string(&path) {
        Ok(text) => return Some(text),
        Err(error) => error,
    };
    let absent = format!("the measured data {} cannot be read: {error}", path.display());
    assert!(
        !in_ci(),
        "{absent}; CI needs them: {DATA} names their folder, or is `{NONE}` where they are to be left out"
    );
    skip(&absent);
    None
}

/// The folder of measured data; `None` where the data are left out.
pub fn folder() -> Option<PathBuf> {
    match env::var_os(DATA).filter(|value| !value.is_empty()) {
        Some(value) if value == NONE => None,
        Some(value) => Some(PathBuf::from(value)),
        None => Some(root().join("../shared/data")),
    }
}

/// The folder of the workspace, from any of its crates.
fn root() -> &'static Path {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.ancestors().find(|folder| folder.join("Cargo.lock").is_file()).unwrap_or(own)
}
