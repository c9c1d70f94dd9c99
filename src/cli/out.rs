//! The file that `--out` names: whether its name fits what a verb writes, and where the words about it go.
//!
//! A name without an extension, or with that of the format in any case, is fine; any other would give a file a false
//! name.
//! `-` is stdout, and so is a system's own name for it. Absent: writing, which is `phytomer_outputs::destination`'s.

use super::{Misuse, terminal};
use anyhow::Result;
use phytomer_outputs::destination::{is_folder, is_stdout};
use std::path::Path;

/// A format of a verb's files.
pub struct Format {
    /// What it is called.
    pub name: &'static str,
    /// The extension of its files.
    pub extension: &'static str,
}

/// Refuses a name that cannot be that of a file in one of a verb's formats.
///
/// # Errors
/// A folder, and an extension of no such format, with those that there are.
pub fn check(path: &Path, verb: &str, formats: &[Format]) -> Result<(), Misuse> {
    let shown = path.display();
    if is_stdout(path) {
        return Ok(());
    }
    if is_folder(path) {
        return Err(Misuse(format!("--out {shown}: this is a folder, and the name of a file is expected")));
    }
    let Some(extension) = path.extension() else { return Ok(()) };
    if formats.iter().any(|format| extension.eq_ignore_ascii_case(format.extension)) {
        return Ok(());
    }
    let formats: Vec<String> =
        formats.iter().map(|format| format!("{} (.{})", format.name, format.extension)).collect();
    let extension = extension.display();
    Err(Misuse(format!(
        "--out {shown}: `{verb}` cannot write `.{extension}`; the formats that it has: {}",
        formats.join(", ")
    )))
}

/// Tells what was written: on stdout, or on stderr where stdout carries the file itself.
///
/// # Errors
/// Where stdout cannot be written.
pub fn tell(path: &Path, words: &str) -> Result<()> {
    if is_stdout(path) {
        terminal::say(&format!("stdout: {words}"));
        return Ok(());
    }
    terminal::put(&format!("{}: {words}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLY: [Format; 1] = [Format { name: "PLY", extension: "ply" }];

    #[test]
    fn an_extension_is_that_of_the_format_or_none() {
        for good in ["a.ply", "A.PLY", "b.Ply", "c", ".ply", "-", "/dev/stdout", "/dev/null", "x.y/z"] {
            check(Path::new(good), "mesh", &PLY).unwrap_or_else(|misuse| panic!("{misuse}"));
        }
        for bad in ["a.obj", "a.glb", "a.ply.gz", "a.jpg", "a.ply~", "ply.a"] {
            let told = check(Path::new(bad), "mesh", &PLY).expect_err(bad).0;
            assert!(told.contains("the formats that it has: PLY (.ply)"), "{told}");
        }
        assert!(check(Path::new("folder/"), "mesh", &PLY).expect_err("a folder").0.contains("this is a folder"));
    }
}
