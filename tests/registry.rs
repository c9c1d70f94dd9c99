//! A growth model is its folder, one line in `models` and one line in `config`; no other line of the program names it.
//!
//! The rule is tested for `models/src/parametric`. Of every Rust file of the project outside that folder, except tests
//! (folders and files that are called `tests`, or begin with `tests_`) and this file, each line is read up to its
//! comment; only two lines may contain the name of the model, in small letters or capitals, or the name of the paper's
//! authors by which its presets are called. What reads the files that other programs have of this model, and writes
//! them as its species (`config/peers`), names it too. Absent: documentation and presets, which may name models.

use std::fs;
use std::path::{Path, PathBuf};

/// The words that name the model, in small letters.
const NAMES: [&str; 2] = ["parametric", "weber"];
const OWN: [&str; 2] = ["models/src/parametric", "config/peers/"];
/// The two lines that name it.
const NAMED: [&str; 2] =
    ["config/src/models.rs: Parametric: phytomer_models::parametric::Tree,", "models/src/lib.rs: pub mod parametric;"];

/// The source files below a folder, without tests and what is built or made.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let tests = name == "tests" || name == "tests.rs" || name.starts_with("tests_");
        let skipped = tests || name.starts_with('.') || name == "target" || name == "runs";
        if path.is_dir() && !skipped {
            sources(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") && !skipped {
            found.push(path);
        }
    }
}

/// The lines of a text that name the model outside of comments. A text in quotes with `//` in it ends there too.
fn naming(source: &str) -> Vec<&str> {
    let names = |line: &&str| {
        let code = line.split("//").next().unwrap_or_default().to_lowercase();
        NAMES.iter().any(|name| code.contains(name))
    };
    source.lines().map(str::trim).filter(names).collect()
}

#[test]
fn one_line_in_models_and_one_in_config_name_the_parametric_model() {
    let project = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (mut paths, mut found) = (Vec::new(), Vec::new());
    sources(project, &mut paths);
    paths.sort();
    assert!(paths.len() > 200, "{} files: this is not the whole project", paths.len());
    for path in paths {
        let name = path.strip_prefix(project).unwrap_or(&path).to_string_lossy().replace('\\', "/");
        if !OWN.iter().any(|own| name.starts_with(own)) {
            let source = fs::read_to_string(&path).expect("text");
            found.extend(naming(&source).iter().map(|line| format!("{name}: {line}")));
        }
    }
    assert_eq!(found, NAMED);
}

#[test]
fn a_line_that_names_the_model_is_found_and_a_comment_is_not() {
    let source =
        "//! parametric\nuse a::Parametric; // b\nlet b = 1; // parametric\n    f(\"weber_penn\");\nfn c() {}\n";
    assert_eq!(naming(source), ["use a::Parametric; // b", "f(\"weber_penn\");"]);
}
