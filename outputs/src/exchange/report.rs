//! What is wrong with a file that is read: faults, for which nothing is taken over, and warnings, with which it is.
//!
//! All are told at once, each with file, line and column. Equal warnings of one kind are told once with their number.
//! Absent: how they are shown, which the command line does for all files alike.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

/// The most faults, and the most kinds of warnings, that are kept; what is beyond is counted.
pub const MOST_TOLD: usize = 1000;

/// A place in a file.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// The file, as the caller called it.
    pub file: Arc<str>,
    /// Line from 1; 0 where the file as a whole is meant.
    pub line: usize,
    /// Column from 1, in characters; 0 where the whole line is meant.
    pub column: usize,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.line, self.column) {
            (0, _) => write!(f, "{}", self.file),
            (line, 0) => write!(f, "{}:{line}", self.file),
            (line, column) => write!(f, "{}:{line}:{column}", self.file),
        }
    }
}

/// One thing for which the file is refused.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// Where.
    pub place: Place,
    /// What is wrong, in a sentence without a full stop.
    pub problem: String,
    /// What would be right.
    pub expected: String,
    /// What to do about it; `None` where `expected` says it.
    pub help: Option<String>,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}; expected {}", self.place, self.problem, self.expected)?;
        match &self.help {
            Some(help) => write!(f, ". {help}"),
            None => Ok(()),
        }
    }
}

/// One thing that was read in spite of being unusual, or left out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// Where it is found first.
    pub place: Place,
    /// What it is and what was made of it, in a sentence without a full stop.
    pub text: String,
    /// How many of its kind there are, this one included.
    pub count: u64,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.text)?;
        if self.count > 1 { write!(f, " (and {} more like it)", self.count - 1) } else { Ok(()) }
    }
}

/// Everything that is wrong with what was read.
#[derive(Debug, Clone)]
pub struct Report {
    file: Arc<str>,
    faults: Vec<Fault>,
    more_faults: u64,
    warnings: Vec<Warning>,
    kinds: BTreeMap<String, usize>,
}

impl Report {
    /// An empty report on a file.
    pub fn new(file: &str) -> Self {
        Self { file: file.into(), faults: Vec::new(), more_faults: 0, warnings: Vec::new(), kinds: BTreeMap::new() }
    }

    /// What is told next is of another file, such as the plant of a scene. Gives back the file before, to return to it.
    pub fn enter(&mut self, file: &str) -> Arc<str> {
        std::mem::replace(&mut self.file, file.into())
    }

    /// A place in the file that is being read; line and column from 1, 0 for none.
    pub fn place(&self, line: usize, column: usize) -> Place {
        Place { file: self.file.clone(), line, column }
    }

    /// Adds a fault.
    pub fn fault(&mut self, at: (usize, usize), problem: impl Into<String>, expected: impl Into<String>) {
        self.tell(at, problem.into(), expected.into(), None);
    }

    /// Adds a fault with what to do about it.
    pub fn fault_with_help(
        &mut self,
        at: (usize, usize),
        problem: impl Into<String>,
        expected: impl Into<String>,
        help: impl Into<String>,
    ) {
        self.tell(at, problem.into(), expected.into(), Some(help.into()));
    }

    fn tell(&mut self, at: (usize, usize), problem: String, expected: String, help: Option<String>) {
        if self.faults.len() == MOST_TOLD {
            self.more_faults += 1;
            return;
        }
        let place = self.place(at.0, at.1);
        self.faults.push(Fault { place, problem, expected, help });
    }

    /// Adds a warning. Those of one kind are told once, by the first of them; `kind` is the text where it is empty.
    pub fn warn(&mut self, at: (usize, usize), kind: &str, text: impl Into<String>) {
        let text = text.into();
        let kind = if kind.is_empty() { text.as_str() } else { kind };
        if let Some(&known) = self.kinds.get(kind) {
            self.warnings[known].count += 1;
        } else if self.warnings.len() < MOST_TOLD {
            self.kinds.insert(kind.to_owned(), self.warnings.len());
            let place = self.place(at.0, at.1);
            self.warnings.push(Warning { place, text, count: 1 });
        }
    }

    /// The faults, in the order of reading; none where the file is taken over.
    pub fn faults(&self) -> &[Fault] {
        &self.faults
    }

    /// How many faults there are beyond those that are kept.
    pub fn more_faults(&self) -> u64 {
        self.more_faults
    }

    /// The warnings, in the order of reading.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// Whether the file is refused.
    pub fn is_refused(&self) -> bool {
        !self.faults.is_empty()
    }
}
