//! Writes the list of shipped presets: every `*.toml` under `presets/species` and `presets/scenarios`.
//!
//! A preset's name is its path below that folder without `.toml` (`gmt1/5a`). The walk is sorted, so that the same
//! files give the same program. Absent: any reading of them; a preset is checked like a user's file.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").map_err(io::Error::other)?).join("presets");
    let mut code = String::new();
    for (name, folder) in [("SPECIES", "species"), ("SCENARIOS", "scenarios")] {
        let mut files = Vec::new();
        walk(&root.join(folder), &mut files)?;
        let _ = writeln!(code, "static {name}: &[(&str, &str)] = &[");
        for file in &files {
            let below = file.strip_prefix(root.join(folder)).map_err(io::Error::other)?.with_extension("");
            let preset = below.to_string_lossy().replace('\\', "/");
            let _ = writeln!(code, "    ({preset:?}, include_str!({:?})),", file.to_string_lossy());
        }
        code.push_str("];\n");
    }
    let out = PathBuf::from(env::var("OUT_DIR").map_err(io::Error::other)?).join("presets.rs");
    fs::write(out, code)
}

/// Every TOML file below `folder`, sorted by path; each folder is watched for new ones.
fn walk(folder: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    println!("cargo::rerun-if-changed={}", folder.display());
    if !folder.is_dir() {
        return Ok(());
    }
    let mut entries = fs::read_dir(folder)?.map(|e| e.map(|e| e.path())).collect::<io::Result<Vec<_>>>()?;
    entries.sort();
    for path in entries {
        if path.is_dir() {
            walk(&path, files)?;
        } else if path.extension().is_some_and(|e| e == "toml") {
            files.push(path);
        }
    }
    Ok(())
}
