//! What is wrong with an L-system, and where: file, line, column, what was found, what was expected.
//!
//! [`Fault`]s are found while a file is read, all at once; a [`Stopped`] ends a derivation, at the place of the
//! production that cannot be applied. Of more than a hundred faults only the number is kept: one slip may have many
//! consequences.

use std::fmt;

/// Beyond so many faults a file is not one with slips in it.
pub const MOST_FAULTS: usize = 100;

/// Where a character of a file stands; a character that a macro made stands where the macro is named.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Place {
    /// The file by its number: 0 is the file that is read, the others are included files in their order.
    pub file: u32,
    /// The line, from 1.
    pub line: u32,
    /// The column, from 1, in characters.
    pub column: u32,
}

/// One thing that is wrong.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// Where it stands.
    pub place: Place,
    /// What is wrong, in a sentence without a full stop.
    pub problem: String,
    /// What would be right.
    pub expected: String,
}

impl Fault {
    /// A fault at `place`.
    pub fn new(place: Place, problem: impl Into<String>, expected: impl Into<String>) -> Self {
        Self { place, problem: problem.into(), expected: expected.into() }
    }
}

/// Why an L-system cannot be used: every fault, in the order of the file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub struct Refused {
    /// The names of the files, as the caller and the `#include` lines call them.
    pub files: Vec<String>,
    /// At least one fault unless a constant is unknown, and at most [`MOST_FAULTS`].
    pub faults: Vec<Fault>,
    /// How many more there are.
    pub more: usize,
    /// The constants that were set and that no file names.
    pub unknown: Vec<String>,
}

impl Refused {
    /// Orders the faults by their places, and keeps the first of them.
    pub(crate) fn new(files: Vec<String>, mut faults: Vec<Fault>, unknown: Vec<String>) -> Self {
        faults.sort_by_key(|fault| fault.place);
        faults.dedup();
        let more = faults.len().saturating_sub(MOST_FAULTS);
        faults.truncate(MOST_FAULTS);
        Self { files, faults, more, unknown }
    }

    /// The name of the file in which a fault stands.
    pub fn file(&self, fault: &Fault) -> &str {
        self.files.get(fault.place.file as usize).map_or("", String::as_str)
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for fault in &self.faults {
            let Place { line, column, .. } = fault.place;
            writeln!(f, "{}:{line}:{column}: {}; expected {}", self.file(fault), fault.problem, fault.expected)?;
        }
        if self.more > 0 {
            writeln!(f, "and {} more", self.more)?;
        }
        for name in &self.unknown {
            writeln!(f, "no constant is named `{name}`")?;
        }
        Ok(())
    }
}

/// Why a derivation cannot go on.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{file}:{}:{}: step {step}: {problem}; expected {expected}", .place.line, .place.column)]
pub struct Stopped {
    /// The name of the file.
    pub file: String,
    /// Where the production or the statement stands.
    pub place: Place,
    /// The derivation step; 0 is that of the axiom.
    pub step: u32,
    /// What went wrong, in a sentence without a full stop.
    pub problem: String,
    /// What would be right.
    pub expected: String,
}
