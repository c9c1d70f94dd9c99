//! What is wrong with a file of another program, and where: line, column and bytes of its text.
//!
//! Absent: how faults are shown, which `config` does for all files alike.

use std::fmt;
use std::ops::Range;

/// One thing that is wrong, and where.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// The bytes of the text that are at fault.
    pub bytes: Range<usize>,
    /// Line from 1.
    pub line: usize,
    /// Column from 1, in characters.
    pub column: usize,
    /// What is wrong, in a sentence without a full stop.
    pub problem: String,
    /// What would be right.
    pub expected: String,
}

/// Why a file cannot be converted: every fault, in the order of the file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub struct Refused {
    /// The file, as the caller called it.
    pub name: String,
    /// At least one fault.
    pub faults: Vec<Fault>,
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for Fault { line, column, problem, expected, .. } in &self.faults {
            writeln!(f, "{}:{line}:{column}: {problem}; expected {expected}", self.name)?;
        }
        Ok(())
    }
}

/// A fault before its line is known: bytes, problem, what would be right.
#[derive(Debug, Clone)]
pub(crate) struct Wrong {
    /// The bytes that are at fault.
    pub bytes: Range<usize>,
    problem: String,
    expected: String,
}

impl Wrong {
    /// A fault of such bytes.
    pub fn new(bytes: Range<usize>, problem: impl Into<String>, expected: impl Into<String>) -> Self {
        Self { bytes, problem: problem.into(), expected: expected.into() }
    }

    /// The fault in its text.
    pub fn placed(self, text: &str) -> Fault {
        let end = self.bytes.end.min(text.len());
        let start = floor(text, self.bytes.start.min(end));
        let (line, column) = place(text, start);
        Fault { bytes: start..end, line, column, problem: self.problem, expected: self.expected }
    }
}

/// Line and column of a byte, both from 1; the column in characters.
pub(crate) fn place(text: &str, byte: usize) -> (usize, usize) {
    let before = &text[..floor(text, byte.min(text.len()))];
    let start = before.rfind('\n').map_or(0, |end| end + 1);
    (before.matches('\n').count() + 1, before[start..].chars().count() + 1)
}

/// The character of a byte begins here.
fn floor(text: &str, mut byte: usize) -> usize {
    while !text.is_char_boundary(byte) {
        byte -= 1;
    }
    byte
}

/// What stands in a text, for a message: at most 40 characters, none of which steers a terminal.
pub(crate) fn said(text: &str) -> String {
    let clipped: String = text.chars().filter(|c| !c.is_control()).take(40).collect();
    if text.chars().nth(40).is_some() { format!("{clipped}…") } else { clipped }
}
