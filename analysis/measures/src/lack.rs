//! Why a quantity could not be estimated.
//!
//! A measure returns its value or a lack of what it needs, in words that a table can show beside an empty cell. Absent:
//! faults of files, which are errors and not results.

use thiserror::Error;

/// What is missing for an estimate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum Lack {
    /// Nothing was measured.
    #[error("nothing was measured")]
    Empty,
    /// Too few plants for an interval.
    #[error("{found} plant{}: an interval of plant values needs {needed} or more", if *found == 1 { "" } else { "s" })]
    Plants {
        /// The number of plants.
        found: u64,
        /// The least number of plants.
        needed: u64,
    },
    /// Too few values.
    #[error("{found} value{}: {needed} or more are needed", if *found == 1 { "" } else { "s" })]
    Values {
        /// The number of values.
        found: u64,
        /// The least number of values.
        needed: u64,
    },
    /// Too few groups.
    #[error("{found} group{} with values: {needed} or more are needed", if *found == 1 { "" } else { "s" })]
    Groups {
        /// The number of groups.
        found: u64,
        /// The least number of groups.
        needed: u64,
    },
    /// All values are equal.
    #[error("all values are equal")]
    NoVariance,
    /// Nothing ended before it was censored.
    #[error("nothing ended: all lives are censored")]
    NoEvents,
    /// The quantity is not reached within what was observed.
    #[error("not reached within what was observed")]
    NotReached,
    /// The directions cancel out.
    #[error("the directions cancel out: there is no mean direction")]
    NoDirection,
    /// A number is outside the range in which the formula holds.
    #[error("a number is outside the range in which the formula holds")]
    OutOfRange,
}
