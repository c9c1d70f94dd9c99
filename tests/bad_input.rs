//! Bad input ends with exit code 3 and leaves no file, and the program panics on no input.
//!
//! The files are the bad files of the tests of `config`; then two good scenarios, broken in two hundred drawn ways: the
//! program must tell good from bad ones by exit code and stderr. `tests/mutations.rs` has ten thousand, in process. A
//! failure names its number and shows its text.

#[path = "../config/tests/mutate/mod.rs"]
mod mutate;
mod program;

use mutate::{Draw, broken};
use phytomer::config::{Kind, Resolved, kind_of, validate};
use program::{Said, data, run as phytomer};
use std::fs;
use std::path::{Path, PathBuf};

const MUTATIONS: u64 = 200;
/// A mutant without faults is grown only up to so many components and records; a larger one is only forecast.
const SMALL: f64 = 100_000.0;

/// Two good scenarios; the first names a species beside it.
const GOOD: [&str; 2] = [
    r#"name = "small"
species = "bush.toml"
plants = 4
seed = 7
ages = { until = 8, record = { every = 2 } }
tables = ["components", "summary"]

[meshes]
plants = [0, 3]
ages = [4, 8]
"#,
    r#"name = "shipped"
description = "from the shop"
species = "example1"
plants = 3
spacing_m = 1.5
ages = { until = 6, record = [2, 6] }
limits = { max_components = 20_000, max_memory_mb = 16 }
output = { compression = "zstd3", plants_per_part = 2, float_precision_m = 1e-4 }
"#,
];

fn bad_files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("config/tests/bad");
    let mut files: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|end| end == "toml"));
    files.sort();
    files
}

fn grow(home: &Path, scenario: &str) -> Said {
    phytomer(home, &["grow", "--quiet", "--out", "out/run", scenario])
}

/// The scenario by which the program reads a bad file: the file itself, or a scenario that names it as its species.
fn scenario_of(file: &Path, home: &Path) -> String {
    let path = file.to_str().unwrap();
    if kind_of(path) == Kind::Scenario {
        return path.to_owned();
    }
    let scenario = home.join("scenario.toml");
    let text = format!("name = 'bad'\nspecies = '{path}'\nplants = 1\nages = {{ until = 40 }}\n");
    fs::write(&scenario, text).unwrap();
    scenario.to_str().unwrap().to_owned()
}

#[test]
fn bad_files_are_refused_and_nothing_is_written() {
    let home = tempfile::tempdir().unwrap();
    let files = bad_files();
    assert!(files.len() > 40);
    for file in files {
        let said = grow(home.path(), &scenario_of(&file, home.path()));
        assert_eq!(said.code, Some(3), "{}:\n{}{}", file.display(), said.stdout, said.stderr);
        assert!(said.stderr.contains("error: "), "{}:\n{}", file.display(), said.stderr);
        assert!(!home.path().join("out").exists(), "{} leaves something behind", file.display());
    }
}

/// Whether a run is so small that a test can wait for it.
fn is_small(resolved: &Resolved) -> bool {
    let scenario = &resolved.scenario;
    let Some(a_plant) = resolved.expected_components(scenario.ages.until) else { return false };
    let shown = 1 + scenario.ages.recorded().len();
    scenario.ages.until <= 50 && a_plant * shown as f64 * f64::from(scenario.plants) <= SMALL
}

#[test]
fn broken_scenarios_are_refused_or_grown() {
    let home = tempfile::tempdir().unwrap();
    fs::copy(data("bush.toml"), home.path().join("bush.toml")).unwrap();
    let mutant = home.path().join("mutant.toml");
    let out = home.path().join("out");
    let (mut grown, mut refused) = (0, 0);
    for number in 0..MUTATIONS {
        let text = broken(GOOD[number as usize % GOOD.len()].as_bytes(), &mut Draw::of_mutation(number));
        fs::write(&mutant, &text).unwrap();
        let file = mutant.to_str().unwrap();
        let found = validate(file);
        let small = found.as_ref().is_ok_and(is_small);
        let large = found.is_ok() && !small;
        let said = if large { phytomer(home.path(), &["grow", "--dry-run", file]) } else { grow(home.path(), file) };
        let shown = || format!("mutation {number}:\n{}\n{}", String::from_utf8_lossy(&text), said.stderr);
        // A small run may come to a limit that the mutation has lowered.
        let expected = if found.is_err() { 3..=3 } else { 0..=i32::from(small) };
        assert!(said.code.is_some_and(|code| expected.contains(&code)), "{:?} by {}", said.code, shown());
        assert_eq!(out.join("run/run.json").exists(), small, "{}", shown());
        assert_eq!(out.exists(), small, "{}", shown());
        grown += u64::from(small);
        refused += u64::from(found.is_err());
        if small {
            fs::remove_dir_all(&out).unwrap();
        }
    }
    // If all mutants were refused, or none, this test would show nothing.
    assert!(grown >= MUTATIONS / 20 && refused >= MUTATIONS / 4, "{grown} grown, {refused} refused");
}
