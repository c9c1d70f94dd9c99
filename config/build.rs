//! Writes the list of shipped presets: every `*.toml` under `presets/species`, `presets/halle` and `presets/scenarios`,
//! every weather file under `presets/weather`, and every L-system with the texts beside it under `presets/species`.
//!
//! A preset's name is its path below `species` or `scenarios` without `.toml` (`gmt1/5a`); the architectural models are
//! species too and keep their folder's name (`halle/massart`). Names are sorted, so that equal files give an equal
//! program. Absent: parsing. A preset is read and checked at run time, as a user's file is.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").map_err(io::Error::other)?).join("presets");
    let mut code = String::new();
    let weather = ("WEATHER", [("weather", "weather"); 2]);
    let texts = ("TEXTS", [("species", "species"); 2]);
    for (name, folders) in [
        ("SPECIES", [("species", "species"), ("halle", "")]),
        ("SCENARIOS", [("scenarios", "scenarios"); 2]),
        weather,
        texts,
    ] {
        let mut presets = BTreeMap::new();
        for (folder, below) in folders {
            let mut files = Vec::new();
            walk(&root.join(folder), if name == "TEXTS" { &BESIDE } else { &ENDINGS }, &mut files)?;
            for file in files {
                let path = file.strip_prefix(root.join(below)).map_err(io::Error::other)?;
                // What is no parameter file keeps its ending, which tells its format.
                let path = if ["WEATHER", "TEXTS"].contains(&name) { path.to_owned() } else { path.with_extension("") };
                presets.insert(path.to_string_lossy().replace('\\', "/"), file);
            }
        }
        let _ = writeln!(code, "static {name}: &[(&str, &str)] = &[");
        for (preset, file) in presets {
            let _ = writeln!(code, "    ({preset:?}, include_str!({:?})),", file.to_string_lossy());
        }
        code.push_str("];\n");
    }
    let out = PathBuf::from(env::var("OUT_DIR").map_err(io::Error::other)?).join("presets.rs");
    fs::write(out, code)
}

/// The endings of parameter files and weather files.
const ENDINGS: [&str; 5] = ["toml", "WTH", "AgMIP", "met", "csv"];
/// The endings of L-systems and of the texts beside them.
const BESIDE: [&str; 5] = ["l", "v", "s", "func", "fset"];

/// Collects every such file below `folder`, sorted by path. Cargo is told to rebuild when a file is added to a folder.
fn walk(folder: &Path, endings: &[&str], files: &mut Vec<PathBuf>) -> io::Result<()> {
    println!("cargo::rerun-if-changed={}", folder.display());
    if !folder.is_dir() {
        return Ok(());
    }
    let mut entries = fs::read_dir(folder)?.map(|e| e.map(|e| e.path())).collect::<io::Result<Vec<_>>>()?;
    entries.sort();
    for path in entries {
        if path.is_dir() {
            walk(&path, endings, files)?;
        } else if path.extension().is_some_and(|ending| endings.iter().any(|known| ending == *known)) {
            files.push(path);
        }
    }
    Ok(())
}
