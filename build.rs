//! Tells the program which commit it was built from: `PHYTOMER_GIT_HASH`, or `unknown` outside a git checkout.
//!
//! It runs again only when the checkout's HEAD moves. Absent: anything that could fail a build; a source archive
//! without git builds like a checkout.

use std::path::Path;
use std::process::Command;

fn main() {
    let hash = git(&["rev-parse", "--short=12", "HEAD"]).unwrap_or_else(|| "unknown".to_owned());
    println!("cargo::rustc-env=PHYTOMER_GIT_HASH={hash}");
    println!("cargo::rerun-if-changed=build.rs");
    // HEAD names a branch or a commit; a commit on the branch moves the branch's own log.
    for name in ["HEAD", "logs/HEAD"] {
        if let Some(path) = git(&["rev-parse", "--git-path", name]).filter(|path| Path::new(path).exists()) {
            println!("cargo::rerun-if-changed={path}");
        }
    }
}

/// What git says of the checkout that has this package at its top; another repository around it is not asked.
fn git(arguments: &[&str]) -> Option<String> {
    if !Path::new(".git").exists() {
        return None;
    }
    let output = Command::new("git").args(arguments).output().ok().filter(|output| output.status.success())?;
    String::from_utf8(output.stdout).ok().map(|text| text.trim().to_owned()).filter(|text| !text.is_empty())
}
