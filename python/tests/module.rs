//! The module as Python has it: the package is laid out in a folder beside the library that cargo has built, and the
//! tests in Python (`test_*.py`) and the notebooks run on it.
//!
//! They need `.venv`, which `.ci/run` fills from `tests/readers/requirements.txt`. Where it is missing they skip and
//! say so, but never in CI. The stubs are held against the module by `stubtest`, of mypy.

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
