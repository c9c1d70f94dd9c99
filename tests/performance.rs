//! The table of `docs/performance.md` is read from the folder into which criterion has written.
//!
//! Absent: the numbers, which depend on the machine.

#[path = "../examples/performance/folder.rs"]
mod folder;

use folder::of_benches;
use std::ffi::OsString;
use std::fs;
use std::path::Path;

fn found(package: &Path, variables: &[(&str, &str)]) -> String {
    let value = |name: &str| variables.iter().find(|(known, _)| *known == name).map(|(_, value)| OsString::from(value));
    of_benches(package, value).display().to_string()
}

#[test]
fn benches_are_read_where_criterion_keeps_them() {
    let folder = tempfile::tempdir().unwrap();
    let package = folder.path().canonicalize().unwrap();
    let below = |name: &str| package.join(name).display().to_string();
    assert_eq!(found(&package, &[("CRITERION_HOME", "/c"), ("CARGO_TARGET_DIR", "/t")]), "/c");
    assert_eq!(found(&package, &[("CARGO_TARGET_DIR", "/t")]), "/t/criterion");
    assert_eq!(found(&package, &[("CARGO_TARGET_DIR", "elsewhere")]), below("elsewhere/criterion"));
    assert_eq!(found(&package, &[("CARGO", "no such program")]), below("target/criterion"));
}

/// A configuration file of cargo may name the folder too.
#[test]
fn cargo_is_asked_for_its_target_folder() {
    let folder = tempfile::tempdir().unwrap();
    let package = folder.path().canonicalize().unwrap();
    fs::create_dir_all(package.join(".cargo")).unwrap();
    fs::create_dir_all(package.join("src")).unwrap();
    fs::write(package.join("src/lib.rs"), "").unwrap();
    fs::write(package.join("Cargo.toml"), "[package]\nname = \"p\"\nversion = \"0.0.0\"\nedition = \"2024\"\n")
        .unwrap();
    fs::write(package.join(".cargo/config.toml"), "[build]\ntarget-dir = \"built\"\n").unwrap();
    assert_eq!(found(&package, &[]), package.join("built/criterion").display().to_string());
}
