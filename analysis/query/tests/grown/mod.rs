//! The runs over which the tests ask: two runs of one scenario with two treatments, of different seeds.
//!
//! They are grown by the program that `PHYTOMER_RELEASE` names, else by the one of the dev profile, so that nothing of
//! it is built again here; without one the tests skip and say so, but never in CI.

#[path = "../../../../tests/program/absent.rs"]
pub mod absent;

use phytomer_outputs::read::Run;
use phytomer_query::{Engine, Settings};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;
use tempfile::TempDir;

const SCENARIO: &str = "
name = \"two\"
species = \"apple\"
plants = 4
seed = 7
spacing_m = 2
ages = { until = 8, record = \"all\" }
output = { mechanics = true, plants_per_part = 2 }

[[experiment.factor]]
name = \"stand\"
level = [{ name = \"wide\" }, { name = \"dense\", spacing_m = 1 }]
";

pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The program that grows the runs.
pub fn program() -> Option<PathBuf> {
    let named = std::env::var_os("PHYTOMER_RELEASE").map(|path| root().join(path));
    let built = named.unwrap_or_else(|| root().join("target/debug/phytomer"));
    if built.is_file() {
        return Some(built);
    }
    assert!(!absent::in_ci(), "CI must have a program that grows: {}", built.display());
    absent::skip("no program that grows runs; `cargo build` makes one");
    None
}

pub fn phytomer(program: &Path, folder: &Path, words: &[&str]) -> String {
    let done = Command::new(program).current_dir(folder).args(words).output().expect("the program starts");
    assert!(done.status.success(), "{words:?}: {}", String::from_utf8_lossy(&done.stderr));
    String::from_utf8(done.stdout).expect("UTF-8")
}

/// A folder with the runs `one` and `the other's` below runs/; grown once.
pub fn grown() -> Option<&'static Path> {
    static GROWN: OnceLock<Option<TempDir>> = OnceLock::new();
    let grown = GROWN.get_or_init(|| {
        let program = program()?;
        let folder = tempfile::tempdir().expect("a temporary folder");
        fs::write(folder.path().join("two.toml"), SCENARIO).expect("a file");
        for (seed, name) in [("7", "runs/one"), ("8", "runs/the other's")] {
            phytomer(&program, folder.path(), &["grow", "two.toml", "--seed", seed, "--out", name, "--quiet"]);
        }
        Some(folder)
    });
    grown.as_ref().map(TempDir::path)
}

/// An engine over some of the runs.
pub fn engine_over(folder: &Path, runs: &[&str], settings: &Settings) -> Engine {
    let open = |name: &&str| ((*name).to_owned(), Run::open(&folder.join("runs").join(name)).expect("a run"));
    let runs: Vec<(String, Run)> = runs.iter().map(open).collect();
    Engine::over(&runs, settings).unwrap_or_else(|error| panic!("{error}"))
}
