//! What is wrong with a script, and where.
//!
//! All faults of a script are told at once, in their order. Of more than a hundred only the number is kept: one slip
//! may have many consequences.

use std::fmt;

/// Beyond so many faults a script is not one with slips in it.
pub const MOST_FAULTS: usize = 100;

/// Where a character of a script stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Place {
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

    /// A fault at `place` of a word for which the nearest of some known words is told, where one is near.
    pub fn spelling<'a>(
        place: Place,
        problem: impl Into<String>,
        (typed, known): (&str, impl IntoIterator<Item = &'a str>),
        expected: &str,
    ) -> Self {
        let near = phytomer_law::spelling::nearest(typed, known);
        let expected = near.map_or_else(|| expected.to_owned(), |near| format!("{expected}; the nearest is `{near}`"));
        Self::new(place, problem, expected)
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}; expected {}", self.place.line, self.place.column, self.problem, self.expected)
    }
}

/// Why a script cannot run: every fault, in the order of the script.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub struct Refused {
    /// At least one fault, and at most [`MOST_FAULTS`].
    pub faults: Vec<Fault>,
    /// How many more there are.
    pub more: usize,
}

impl Refused {
    /// Orders the faults by their places, and keeps the first of them; `None` where there are none.
    pub fn of(mut faults: Vec<Fault>) -> Option<Self> {
        faults.sort_by_key(|fault| fault.place);
        faults.dedup();
        let more = faults.len().saturating_sub(MOST_FAULTS);
        faults.truncate(MOST_FAULTS);
        (!faults.is_empty()).then_some(Self { faults, more })
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.faults.iter().try_for_each(|fault| writeln!(f, "{fault}"))?;
        if self.more > 0 {
            writeln!(f, "and {} more", self.more)?;
        }
        Ok(())
    }
}
