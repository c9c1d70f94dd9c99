//! Good files pass; each bad file gives exactly the report beside it.
//!
//! `tests/good/*.toml` and `tests/bad/*.toml` hold species and scenarios. `UPDATE_EXPECTED=1` writes the reports anew;
//! read each of them before it is committed: it must be right, and kind to the reader.

use std::fs;
use std::path::{Path, PathBuf};

use phytomer_config::{Kind, Report, kind_of, presets, validate, validate_species};

/// Species by themselves are checked over this many ticks.
const UNTIL: u32 = 40;

fn files(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(Path::new("tests").join(folder)).expect("the folder of fixtures");
    let mut files: Vec<PathBuf> = entries.map(|e| e.expect("an entry").path()).collect();
    files.retain(|path| path.extension().is_some_and(|e| e == "toml"));
    files.sort();
    files
}

fn check(name: &str) -> Result<(), Report> {
    match kind_of(name) {
        Kind::Scenario => validate(name).map(drop),
        Kind::Species => validate_species(name, UNTIL).map(drop),
    }
}

fn slashed(path: &Path) -> String {
    path.to_string_lossy().replace('\\', "/")
}

#[test]
fn good_files_have_no_fault() {
    for path in files("good") {
        if let Err(report) = check(&slashed(&path)) {
            panic!("{}\n{}", path.display(), report.render(false));
        }
    }
}

#[test]
fn shipped_files_have_no_fault() {
    let species = presets(Kind::Species).iter().filter_map(|(name, _)| validate_species(name, UNTIL).err());
    let scenarios = presets(Kind::Scenario).iter().filter_map(|(name, _)| validate(name).err());
    let reports: Vec<String> = species.chain(scenarios).map(|report| report.render(false)).collect();
    assert!(reports.is_empty(), "{}", reports.join("\n"));
}

#[test]
fn bad_files_give_the_report_beside_them() {
    let update = std::env::var_os("UPDATE_EXPECTED").is_some();
    let mut wrong = Vec::new();
    for path in files("bad") {
        let found = match check(&slashed(&path)) {
            Ok(()) => "no fault\n".to_owned(),
            Err(report) => report.render(false),
        };
        let beside = path.with_extension("expected");
        if update {
            fs::write(&beside, &found).expect("the report can be written");
        }
        let expected = fs::read_to_string(&beside).unwrap_or_default();
        if found != expected || found == "no fault\n" {
            wrong.push(format!("{}\n{found}", path.display()));
        }
    }
    assert!(wrong.is_empty(), "{} of the reports are not as expected:\n\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn there_are_at_least_forty_bad_files() {
    assert!(files("bad").len() >= 40);
}
