//! The workspace of the fuzz targets compiles its dependencies as this one does, so that they share a target folder and
//! nothing is compiled twice.
//!
//! Absent: what is optimised, and why, which `Cargo.toml` says.

use std::fs;
use std::path::Path;

/// The lines of a manifest from the list of optimised packages on.
fn optimised(manifest: &str) -> Vec<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(manifest);
    let text = fs::read_to_string(path).expect("a manifest");
    let list = text.lines().skip_while(|line| *line != "[profile.dev.package]");
    list.map(str::to_owned).collect()
}

#[test]
fn both_workspaces_optimise_the_same_packages() {
    let own = optimised("Cargo.toml");
    assert!(own.len() > 20, "{own:?}");
    assert_eq!(own, optimised("fuzz/Cargo.toml"));
}
