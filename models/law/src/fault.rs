//! What is wrong with a parameter: where it stands in its file's tree, what was found, what was expected.
//!
//! Models find faults of meaning (a law that leaves [0, 1], a table too short) without access to files; `config` turns
//! the path into a file, a line and a column.

use std::fmt;

/// One step from a table or an array to a value in it.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Segment {
    /// The key of a table.
    Key(String),
    /// The place in an array, from 0.
    Index(usize),
}

/// Where a value stands in a parameter file: `order[1].death.weibull.shape` (indices from 0).
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Path(pub Vec<Segment>);

impl Path {
    /// The whole file.
    pub fn root() -> Self {
        Self::default()
    }

    /// The value under `key` in the table that this path names.
    pub fn key(&self, key: &str) -> Self {
        self.with(Segment::Key(key.to_owned()))
    }

    /// The value at `index` (from 0) in the array that this path names.
    pub fn index(&self, index: usize) -> Self {
        self.with(Segment::Index(index))
    }

    fn with(&self, segment: Segment) -> Self {
        let mut longer = self.clone();
        longer.0.push(segment);
        longer
    }
}

impl fmt::Display for Path {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, segment) in self.0.iter().enumerate() {
            match segment {
                Segment::Key(key) if i == 0 => write!(f, "{key}")?,
                Segment::Key(key) => write!(f, ".{key}")?,
                Segment::Index(index) => write!(f, "[{index}]")?,
            }
        }
        Ok(())
    }
}

/// One fault of meaning in a model's parameters.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{path}: {problem}; expected {expected}")]
pub struct Fault {
    /// Where the parameter stands.
    pub path: Path,
    /// What is wrong, with the values, in a sentence without a full stop.
    pub problem: String,
    /// What would be right: "a probability in [0, 1]".
    pub expected: String,
}

/// Adds to `told` each fault of `found` that it does not hold yet: a key that is checked in several domains, such as at
/// the nodes of each order, has the same fault in each of them.
pub fn tell_once(told: &mut Vec<Fault>, found: Vec<Fault>) {
    for fault in found {
        if !told.contains(&fault) {
            told.push(fault);
        }
    }
}

impl Fault {
    /// A fault at `path`.
    pub fn new(path: &Path, problem: impl Into<String>, expected: impl Into<String>) -> Self {
        Self { path: path.clone(), problem: problem.into(), expected: expected.into() }
    }
}
