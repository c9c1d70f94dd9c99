//! Readers of files that know nothing of the program, in Python, as `.ci/run` installs them in `.venv`.
//!
//! Where they are missing a test skips and says so, but never in CI.

#[path = "absent.rs"]
pub mod absent;

use std::path::{Path, PathBuf};
use std::process::Command;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// The path of the Python with the readers; `None`, with the reason printed, where there is none.
pub fn python() -> Option<PathBuf> {
    let python = Path::new(ROOT).join(".venv/bin/python");
    let readers = Path::new(ROOT).join("tests/readers");
    let found = Command::new(&python).arg(readers.join("present.py")).arg(readers.join("requirements.txt")).output();
    let reason = match found {
        Ok(found) if found.status.success() => return Some(python),
        Ok(found) => String::from_utf8_lossy(&found.stderr).trim().to_owned(),
        Err(error) => format!("{}: {error}", python.display()),
    };
    assert!(!absent::in_ci(), "CI must have the readers: {reason}");
    absent::skip(&format!("no independent readers here ({reason}); .ci/run installs them"));
    None
}

/// Lets a script of `tests/readers` read, which fails where it finds anything wrong.
pub fn read(python: &Path, script: &str, arguments: &[&str]) {
    let done = Command::new(python)
        .arg(Path::new(ROOT).join("tests/readers").join(script))
        .args(arguments)
        .output()
        .expect("python runs");
    let told = format!("{}{}", String::from_utf8_lossy(&done.stdout), String::from_utf8_lossy(&done.stderr));
    assert!(done.status.success(), "{script} {arguments:?}:\n{told}");
    println!("{told}");
}
