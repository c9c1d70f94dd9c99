//! The file of a forest with its rasters: read, and checked with the species that it names.
//!
//! An input is a list of files (`several`), the forest's own with the name `site.toml`. Absent: growing the variants,
//! which the target `species` does.

use super::several::files;
use phytomer::forest::Landscape;
use phytomer_config::forest::forest as resolved;
use std::fs;
use std::path::Path;

/// Reads a forest in a folder of its own below `home`.
pub fn read(home: &Path, data: &[u8]) {
    let folder = tempfile::tempdir_in(home).expect("a folder");
    for (name, content) in files(data) {
        // A name that is broken leads to no other folder.
        let name: String = name.chars().filter(|letter| letter.is_ascii_alphanumeric() || *letter == '.').collect();
        let _ = fs::write(folder.path().join(name), content);
    }
    match resolved(&folder.path().join("site.toml").to_string_lossy()) {
        Err(report) => super::tried::assert_tells(&report),
        Ok(resolved) => match Landscape::read(&resolved) {
            Err(faults) => super::tried::assert_tells(&resolved.report(faults)),
            Ok(landscape) => assert!(landscape.size().into_iter().all(|cells| cells > 0)),
        },
    }
}
