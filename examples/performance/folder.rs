//! The folder of criterion's measurements, found by criterion's own rules.
//!
//! In this order: the folder that `CRITERION_HOME` names; `criterion` below that of `CARGO_TARGET_DIR`, below the
//! target folder that cargo reports, below `target`. Benches run in the folder of the package, so relative names begin
//! there.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The folder of the benches of a package, where the environment has these variables.
pub fn of_benches(package: &Path, variable: impl Fn(&str) -> Option<OsString>) -> PathBuf {
    if let Some(home) = variable("CRITERION_HOME") {
        return package.join(home);
    }
    let target = variable("CARGO_TARGET_DIR").map(PathBuf::from);
    let target =
        target.or_else(|| told_by_cargo(package, variable("CARGO"))).unwrap_or_else(|| PathBuf::from("target"));
    package.join(target).join("criterion")
}

/// The target folder as cargo reports it, which includes its configuration files.
fn told_by_cargo(package: &Path, cargo: Option<OsString>) -> Option<PathBuf> {
    let mut command = Command::new(cargo.unwrap_or_else(|| OsString::from("cargo")));
    command.current_dir(package).env_remove("CARGO_TARGET_DIR").args([
        "metadata",
        "--format-version",
        "1",
        "--no-deps",
        "--offline",
    ]);
    let told: serde_json::Value = serde_json::from_slice(&command.output().ok()?.stdout).ok()?;
    told["target_directory"].as_str().map(PathBuf::from)
}
