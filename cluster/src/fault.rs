//! What keeps an executor from growing a part, told to the machine that asked for the run.
//!
//! A fault is an answer like any other, so that the other parts are grown all the same. What may pass by itself, such
//! as a network disk that was away for a moment, is no fault but an error of the task: Ballista then tries again.

use serde::{Deserialize, Serialize};
use std::fmt;

/// The kinds of faults.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// The executor is of another version of the program.
    ForeignVersion,
    /// The scenario that the executor reads is not the one that is grown.
    ForeignScenario,
    /// There is not one row for the part, or the row names a part or plots that the run does not have so.
    WrongRow,
    /// The executor does not see the folder of the parts.
    NotShared,
    /// The run was stopped, or asked for anew, while the part was grown.
    Superseded,
    /// The disk is full, or too small for what is expected.
    FullDisk,
    /// Anything else that will not pass by itself.
    Failed,
}

/// A fault, with what it was and what to do.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Fault {
    /// Its kind.
    pub kind: Kind,
    /// What was found, what was expected and what to do.
    pub text: String,
}

impl Fault {
    /// A fault.
    pub fn new(kind: Kind, text: impl Into<String>) -> Self {
        Self { kind, text: text.into() }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}
