//! The module as Python has it: the package is laid out in a folder beside the library that cargo has built, and the
//! tests in Python (`test_*.py`) and the notebooks run on it.
//!
//! They need `.venv`, which `.ci/run` fills from `tests/readers/requirements.txt`. Where it is missing they skip and
//! say so, but never in CI. The stubs are held against the module by `stubtest`, of mypy.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const HERE: &str = env!("CARGO_MANIFEST_DIR");

/// The Python of `.venv`; `None`, with the reason printed, where there is none with all packages.
fn python() -> Option<PathBuf> {
    let root = Path::new(HERE).parent().expect("the workspace");
    let python = root.join(".venv/bin/python");
    let readers = root.join("tests/readers");
    let found = Command::new(&python).arg(readers.join("present.py")).arg(readers.join("requirements.txt")).output();
    let reason = match found {
        Ok(found) if found.status.success() => return Some(python),
        Ok(found) => String::from_utf8_lossy(&found.stderr).trim().to_owned(),
        Err(error) => format!("{}: {error}", python.display()),
    };
    assert!(std::env::var_os("CI").is_none(), "CI must have the packages: {reason}");
    println!("skipped: no Python with all packages here ({reason}); .ci/run installs them");
    None
}

/// The library that cargo has built beside this test.
fn library() -> PathBuf {
    let test = std::env::current_exe().expect("the path of the test");
    let name = format!("{}_phytomer{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    let library = test.with_file_name(name);
    assert!(library.is_file(), "cargo builds {}", library.display());
    library
}

/// The package in a folder of its own, as a wheel would install it.
fn installed(folder: &Path) {
    let package = folder.join("phytomer");
    fs::create_dir_all(&package).expect("a folder");
    for entry in fs::read_dir(Path::new(HERE).join("python/phytomer")).expect("the package") {
        let path = entry.expect("a file").path();
        let name = path.file_name().expect("a name");
        if path.is_file() && !name.to_string_lossy().ends_with(".so") {
            fs::copy(&path, package.join(name)).expect("a copy");
        }
    }
    let ending = if cfg!(windows) { "_phytomer.pyd" } else { "_phytomer.abi3.so" };
    fs::copy(library(), package.join(ending)).expect("a copy");
}

fn ran(python: &Path, folder: &Path, words: &[&str]) -> Output {
    let mut command = Command::new(python);
    command.args(words).current_dir(folder).env("PYTHONPATH", folder).env("MPLBACKEND", "agg");
    let output = command.output().expect("Python runs");
    let told = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned()).concat();
    println!("{told}");
    assert!(output.status.success(), "{words:?}:\n{told}");
    output
}

#[test]
fn python_has_every_table_and_mesh() {
    let Some(python) = python() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    installed(folder.path());
    let tests = Path::new(HERE).join("tests");
    ran(&python, folder.path(), &["-m", "unittest", "discover", "-v", "-s", tests.to_str().expect("a path")]);
}

#[test]
fn the_stubs_are_those_of_the_module() {
    let Some(python) = python() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    installed(folder.path());
    ran(&python, folder.path(), &["-m", "mypy.stubtest", "phytomer._phytomer"]);
    ran(&python, folder.path(), &["-m", "mypy", "--strict", "-p", "phytomer"]);
}

#[test]
fn the_notebooks_run() {
    let Some(python) = python() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    installed(folder.path());
    let runner = Path::new(HERE).join("tests/notebooks.py");
    let notebooks = Path::new(HERE).join("notebooks");
    let words = [&runner, &notebooks].map(|path| path.to_str().expect("a path"));
    ran(&python, folder.path(), &words);
}

/// Every CPython from 3.11 on that is on the path or that pyenv has installed, by its version.
fn pythons() -> BTreeMap<String, PathBuf> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let mut folders: Vec<PathBuf> = std::env::split_paths(&path).collect();
    let home = std::env::var_os("PYENV_ROOT").map(PathBuf::from);
    let home = home.or_else(|| std::env::var_os("HOME").map(|home| Path::new(&home).join(".pyenv")));
    let versions = home.and_then(|home| fs::read_dir(home.join("versions")).ok());
    folders.extend(versions.into_iter().flatten().flatten().map(|entry| entry.path().join("bin")));
    let mut found = BTreeMap::new();
    for folder in folders {
        let names = ["python3".to_owned()].into_iter().chain((11..30).map(|minor| format!("python3.{minor}")));
        for python in names.map(|name| folder.join(name)).filter(|python| python.is_file()) {
            let asks = "import sys; v = sys.version_info; \
                        print('%03d.%d' % (v[1], v[2]) if sys.implementation.name == 'cpython' and v >= (3, 11) else '')";
            let Ok(told) = Command::new(&python).args(["-c", asks]).output() else { continue };
            let version = String::from_utf8_lossy(&told.stdout).trim().to_owned();
            if told.status.success() && !version.is_empty() {
                found.entry(version).or_insert(python);
            }
        }
    }
    found
}

/// One module serves all of them, since it is built for the stable interface of 3.11.
#[test]
fn every_python_that_is_found_grows_the_same_plants() {
    let folder = tempfile::tempdir().expect("a folder");
    installed(folder.path());
    let script = Path::new(HERE).join("tests/anywhere.py");
    let mut told = BTreeMap::new();
    for (version, python) in pythons() {
        println!("3.{} at {}", version.trim_start_matches('0'), python.display());
        let output = ran(&python, folder.path(), &["-B", script.to_str().expect("a path")]);
        told.insert(version, String::from_utf8_lossy(&output.stdout).into_owned());
    }
    assert!(!told.is_empty() || std::env::var_os("CI").is_none(), "CI must have a CPython from 3.11 on");
    let all: BTreeSet<&String> = told.values().collect();
    assert!(all.len() <= 1, "{told:#?}");
}
