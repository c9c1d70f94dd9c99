//! What is wrong with a weather file, and where: line, column and bytes of its text.
//!
//! A fault has a kind beside its words, so that programs and tests can tell a gap from a slip of the pen. Faults are
//! kept in the order of the file; of more than a thousand only the number is kept. Absent: how they are shown, which
//! `config` does for all files alike.

use crate::text::Line;
use serde::Serialize;
use std::fmt;
use std::ops::Range;

/// Beyond so many faults a file is not one with slips in it.
pub const MOST_FAULTS: usize = 1000;

/// What sort of fault it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// The columns are not known: a header that is missing or said twice, values that stand below no column.
    Layout,
    /// A value or a date that cannot be read.
    Unreadable,
    /// A value that no station can have measured.
    Impossible,
    /// A minimum above the maximum of its day.
    Crossed,
    /// So many days in a row have a line, but no maximum or no minimum.
    Missing {
        /// The days.
        days: u32,
    },
    /// So many days in a row have no line.
    Gap {
        /// The days.
        days: u32,
    },
    /// A date that was there before, or that goes back.
    Order,
    /// Weather that is to be repeated and holds no whole year.
    Short,
}

/// One thing that is wrong, and where.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// What sort of fault it is.
    pub kind: Kind,
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
    /// The nearest spelling that would be right.
    pub suggestion: Option<String>,
}

/// Why a weather file cannot be used: every fault, in the order of the file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub struct Refused {
    /// The file, as the caller called it.
    pub name: String,
    /// At least one fault, and at most [`MOST_FAULTS`].
    pub faults: Vec<Fault>,
    /// How many more there are.
    pub more: usize,
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for fault in &self.faults {
            let Fault { line, column, problem, expected, suggestion, .. } = fault;
            write!(f, "{}:{line}:{column}: {problem}; expected {expected}", self.name)?;
            if let Some(name) = suggestion {
                write!(f, " (did you mean `{name}`?)")?;
            }
            writeln!(f)?;
        }
        if self.more > 0 {
            writeln!(f, "and {} more", self.more)?;
        }
        Ok(())
    }
}

/// Bytes of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Place {
    /// The line, from 1.
    pub line: u32,
    /// Where the line begins in the text.
    pub line_start: usize,
    /// Where the place begins in the line.
    pub start: u32,
    /// Where it ends.
    pub end: u32,
}

impl Place {
    /// Bytes of a line.
    pub fn of(line: &Line<'_>, start: usize, end: usize) -> Self {
        Self { line: line.number, line_start: line.start, start: start as u32, end: end as u32 }
    }

    /// The whole line, without the blanks around it.
    pub fn whole(line: &Line<'_>) -> Self {
        let start = line.text.len() - line.text.trim_start().len();
        Self::of(line, start, line.text.trim_end().len().max(start))
    }
}

/// The faults of a text as they are found.
pub(crate) struct Faults<'t> {
    text: &'t str,
    found: Vec<Fault>,
    more: usize,
}

impl<'t> Faults<'t> {
    /// None yet.
    pub fn of(text: &'t str) -> Self {
        Self { text, found: Vec::new(), more: 0 }
    }

    /// Tells a fault.
    pub fn tell(&mut self, kind: Kind, place: Place, problem: impl Into<String>, expected: impl Into<String>) {
        self.tell_near(kind, place, problem, expected, None);
    }

    /// Tells a fault with the nearest spelling.
    pub fn tell_near(
        &mut self,
        kind: Kind,
        place: Place,
        problem: impl Into<String>,
        expected: impl Into<String>,
        suggestion: Option<&str>,
    ) {
        if self.found.len() == MOST_FAULTS {
            self.more += 1;
            return;
        }
        let (start, end) = (place.line_start + place.start as usize, place.line_start + place.end as usize);
        let before = self.text.get(place.line_start..start).map_or(0, |before| before.chars().count());
        self.found.push(Fault {
            kind,
            bytes: start..end.max(start),
            line: place.line.max(1) as usize,
            column: before + 1,
            problem: problem.into(),
            expected: expected.into(),
            suggestion: suggestion.map(str::to_owned),
        });
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// What is at a place, for a message: at most 40 characters, none of which steers a terminal.
    pub fn said(&self, place: Place) -> String {
        let (start, end) = (place.line_start + place.start as usize, place.line_start + place.end as usize);
        let text = self.text.get(start..end).unwrap_or("");
        let clipped: String = text.chars().filter(|c| !c.is_control()).take(40).collect();
        if text.chars().count() > 40 { format!("{clipped}…") } else { clipped }
    }

    /// All of them, in the order of the text.
    pub fn into_refused(mut self, name: &str) -> Refused {
        self.found.sort_by_key(|fault| (fault.line, fault.column));
        Refused { name: name.to_owned(), faults: self.found, more: self.more }
    }
}
