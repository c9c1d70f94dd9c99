//! Files of USD in the hands of OpenUSD and of Blender, and what is refused.
//!
//! OpenUSD (the package usd-core) stands with the other independent readers in `.venv`; Blender comes as a module of
//! Python in two environments of its own, `.venv-blender-4.2` and `.venv-blender`, which `.ci/run` fills. Where they
//! are missing the tests skip and say so, but never in CI.

#[path = "program/absent.rs"]
mod absent;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// A tree with branches, flowers and fruits, and leaves that fall.
const SCENARIO: &str = "name = \"usd\"\nspecies = \"coffee\"\nplants = 1\nseed = 5\n\
                        ages = { until = 40, record = [4, 13, 22, 31, 40] }\n";

const AGES: [&str; 5] = ["4", "13", "22", "31", "40"];

/// The Python of an environment that has a module; `None`, with the reason printed, where it has not.
fn python(environment: &str, module: &str) -> Option<PathBuf> {
    let python = Path::new(ROOT).join(environment).join("bin/python");
    let found = Command::new(&python).args(["-c", &format!("import {module}")]).output();
    if found.is_ok_and(|found| found.status.success()) {
        return Some(python);
    }
    assert!(!absent::in_ci(), "CI must have {module} in {environment}");
    absent::skip(&format!("no {module} in {environment}; .ci/run installs it"));
    None
}

fn run(words: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_phytomer")).args(words).output().expect("phytomer runs")
}

fn phytomer(words: &[&str]) {
    let done = run(words);
    assert!(done.status.success(), "{words:?}: {}", String::from_utf8_lossy(&done.stderr));
}

fn read(python: &Path, script: &str, arguments: &[&str]) -> String {
    let script = Path::new(ROOT).join("tests/readers").join(script);
    let done = Command::new(python).arg(script).args(arguments).output().expect("python runs");
    let told = String::from_utf8_lossy(&done.stdout).into_owned();
    assert!(done.status.success(), "{arguments:?}:\n{told}{}", String::from_utf8_lossy(&done.stderr));
    told
}

#[test]
fn openusd_and_blender_find_the_organs_of_the_records() {
    let Some(openusd) = python(".venv", "pxr, plyfile, pyarrow, trimesh") else { return };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let at = |name: &str| folder.path().join(name).to_str().expect("a path in UTF-8").to_owned();
    let (scenario, recorded) = (at("usd.toml"), at("run"));
    std::fs::write(&scenario, SCENARIO).expect("a scenario file");
    phytomer(&["grow", "--quiet", "--out", &recorded, &scenario]);
    for age in AGES {
        phytomer(&["mesh", &scenario, "--age", age, "--tolerance", "0.1mm", "--out", &at(&format!("{age}.ply"))]);
    }
    for ending in ["usda", "usdc", "usdz"] {
        let out = at(&format!("still.{ending}"));
        phytomer(&["mesh", &scenario, "--age", "40", "--tolerance", "0.1mm", "--out", &out]);
    }
    phytomer(&["mesh", &scenario, "--ages", "4..40", "--tolerance", "0.5mm", "--out", &at("life.usdc")]);
    let merged = ["--tolerance", "0.5mm", "--leaves", "merged", "--out", &at("merged.usdc")];
    phytomer(&[&["mesh", &scenario, "--ages", "4..40"][..], &merged].concat());
    let told = read(&openusd, "usd.py", &[&[recorded.as_str(), &at("")][..], &AGES].concat());
    let organs = at("organs.json");
    std::fs::write(&organs, told.lines().last().unwrap_or_default()).expect("the organs");
    // Instances play from 4.5 on.
    for (environment, ways) in [(".venv-blender-4.2", &["merged"][..]), (".venv-blender", &["life", "merged"])] {
        let Some(blender) = python(environment, "bpy") else { continue };
        for way in ways {
            read(&blender, "blender.py", &[way, &at(&format!("{way}.usdc")), &organs]);
        }
    }
}

/// A tree of stems tells the range of each segment and each leaf, in the words of each reader.
#[test]
fn openusd_and_blender_read_the_ranges_of_a_tree_of_stems() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let at = |name: &str| folder.path().join(name).to_str().expect("a path in UTF-8").to_owned();
    let whole = ["whole.ply", "whole.usda", "whole.usdc"].map(|name| (name, &[][..]));
    for (name, more) in whole.into_iter().chain([("merged.usdc", &["--leaves", "merged"][..])]) {
        phytomer(&[&["mesh", "wp/quaking_aspen", "--quality", "0.2", "--out", &at(name)], more].concat());
    }
    for (environment, module) in [(".venv", "pxr"), (".venv-blender-4.2", "bpy"), (".venv-blender", "bpy")] {
        if let Some(python) = python(environment, module) {
            read(&python, "ranges.py", &[&at("")]);
        }
    }
}

/// Two species in a plot, one sown later, beside a stone.
const PLOT: &str = r#"
name = "plot"
species = "coffee"
plants = 3
spacing_m = 4
seed = 5
ages = { until = 24, record = [4, 10, 16, 20, 24] }
member = [{ at_m = [-1, 0] }, { at_m = [1, 0.5] }, { species = "frangipani", at_m = [0, -1], sown = 14 }]

[[site.obstacle]]
shape = { form = "box", at_m = [0, 1.5, 0], size_m = [0.5, 0.5, 0.4] }
"#;

/// At five ticks a plot has the organs of the records, plant by plant.
#[test]
fn openusd_finds_the_organs_of_a_whole_plot() {
    let Some(openusd) = python(".venv", "pxr, plyfile, pyarrow, trimesh") else { return };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let at = |name: &str| folder.path().join(name).to_str().expect("a path in UTF-8").to_owned();
    let (scenario, recorded) = (at("plot.toml"), at("run"));
    std::fs::write(&scenario, PLOT).expect("a scenario file");
    phytomer(&["grow", "--quiet", "--out", &recorded, &scenario]);
    let words = ["mesh", &scenario, "--plot", "--ages", "1..24", "--tolerance", "2mm"];
    phytomer(&[&words[..], &["--out", &at("life.usdc")]].concat());
    phytomer(&[&words[..], &["--leaves", "merged", "--out", &at("merged.usda")]].concat());
    read(&openusd, "usd_plot.py", &[&recorded, &at("life.usdc"), &at("merged.usda"), "4", "10", "16", "20", "24"]);
}

/// The same plant gives the same bytes.
#[test]
fn files_are_the_same_at_each_writing() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = |name: &str| folder.path().join(name);
    for ending in ["usda", "usdc", "usdz"] {
        let [first, second] = ["a", "b"].map(|name| {
            let path = file(&format!("{name}.{ending}"));
            phytomer(&["mesh", "coffee", "--ages", "1..9/2", "--out", path.to_str().expect("a path in UTF-8")]);
            std::fs::read(path).expect("a file")
        });
        assert!(first == second, "{ending}");
    }
}

#[test]
fn what_cannot_be_written_is_refused_with_a_reason() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let at = |name: &str| folder.path().join(name).to_str().expect("a path in UTF-8").to_owned();
    let [usd, ply] = [at("a.usdc"), at("a.ply")];
    for (words, told) in [
        (&["--ages", "1..9", "--out", &ply][..], "--ages: PLY (.ply) holds a plant that stands still"),
        (&["--leaves", "merged", "--out", &ply], "--leaves: this is for USD and GLB"),
        (&["--age", "9", "--ages", "1..9", "--out", &usd], "cannot be used with"),
        (&["--ages", "1..9", "--plot", "99999", "--out", &usd], "--plot 99999: the run has the plots"),
        (&["--ages", "1..999", "--plot", "--out", &usd], "--ages 999: the plot has the ticks 0 to"),
        (&["--ages", "1..9", "--plot", "--keys", "4", "--out", &usd], "--keys: this is for a life as GLB"),
        (&["--ages", "1..9", "--rig", "9", "--wind", "8", "--out", &usd], "cannot be used with"),
        (&["--age", "soon", "--out", &usd], "an age in ticks is expected"),
        (&["--ages", "1..9", "--keys", "4", "--out", &usd], "--keys: this is for a life as GLB"),
        (&["--ages", "1..9", "--triangles", "10k", "--out", &usd], "cannot be used with"),
        (&["--ages", "9..1", "--out", &usd], "the first age, 9, is after the last, 1"),
        (&["--ages", "1..999", "--out", &usd], "the run has the ages 0 to"),
        (&["--ages", "1..9/0", "--out", &usd], "a step of at least 0.001 is expected"),
        (&["--ages", "soon", "--out", &usd], "such as 1..96"),
        (&["--seconds", "12", "--out", &usd], "--ages"),
        (&["--ages", "1..9", "--seconds", "0", "--out", &usd], "a length above 0"),
        (&["--ages", "1..9", "--seconds", "NaN", "--out", &usd], "a length above 0"),
        (&["--leaves", "loose", "--out", &usd], "possible values: instances, merged"),
        (&["--ages", "1..9", "--plant", "100000", "--out", &usd], "--plant 100000: the run has the plants"),
        (&["--ages", "1..9", "--out", &at("a.usd")], "USD (.usdc)"),
        (&["--age", "9", "--out", &at("no/such/folder/a.usdz")], "cannot write"),
    ] {
        let done = run(&[&["mesh", "coffee"][..], words].concat());
        let error = String::from_utf8_lossy(&done.stderr).into_owned();
        assert!(!done.status.success() && error.contains(told), "{words:?}: {error}");
        assert!(!Path::new(&usd).exists(), "{words:?}");
    }
}

/// A disk that is full in the middle of a file is told.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told() {
    for ending in ["usda", "usdc", "usdz"] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let link = folder.path().join(format!("full.{ending}"));
        std::os::unix::fs::symlink("/dev/full", &link).expect("a link");
        let done = run(&["mesh", "coffee", "--age", "12", "--out", link.to_str().expect("a path in UTF-8")]);
        let error = String::from_utf8_lossy(&done.stderr).into_owned();
        assert!(!done.status.success() && error.contains("cannot write"), "{error}");
    }
}
