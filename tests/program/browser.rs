//! The headless browser of tests that read pages, with playwright-core, which drives it.
//!
//! Absent: what is read, which the scripts in `tests/readers` know.

#[path = "absent.rs"]
mod absent;

use std::path::{Path, PathBuf};
use std::process::Command;

/// The folder of playwright-core and the browser; `None`, with the reason printed, where either is missing.
pub fn browser() -> Option<(PathBuf, PathBuf)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let named = |variable: &str, usual: PathBuf| std::env::var_os(variable).map_or(usual, PathBuf::from);
    let driver = named("PHYTOMER_PLAYWRIGHT", root.join(".venv/node"));
    let browser = named("CHROMIUM", PathBuf::from("/usr/bin/chromium"));
    let needed = [driver.join("node_modules/playwright-core/package.json"), browser.clone()];
    let missing = needed.iter().find(|path| !path.is_file());
    let node = Command::new("node").arg("--version").output().is_ok_and(|done| done.status.success());
    let reason = match missing {
        Some(path) => format!("{} is missing", path.display()),
        None if !node => "node is missing".to_owned(),
        None => return Some((driver, browser)),
    };
    assert!(!absent::in_ci(), "CI must have a browser: {reason}");
    absent::skip(&format!("no browser to read pages with ({reason}); .ci/run installs it"));
    None
}
