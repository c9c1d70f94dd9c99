//! What keeps a law from being estimated.
//!
//! Each variant says what was found, what was expected and what to do. The place in a file is added by whoever read it.

/// Why a law could not be estimated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Problem {
    /// Fewer values than the estimate needs.
    #[error("{found} {what}, and at least {needed} are needed for {purpose}: measure more of them")]
    TooFew {
        /// What was counted, in the plural.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many are needed.
        needed: usize,
        /// The law.
        purpose: &'static str,
    },
    /// The counts vary more than independent Bernoulli trials can.
    #[error(
        "the variance of the counts ({variance:.4}) is above their mean ({mean:.4}): no bud that grows with one probability \
         at each tick makes such counts; divide the axes into groups that are alike, or shorten the window"
    )]
    Overdispersed {
        /// The mean of the counts.
        mean: f64,
        /// Their variance.
        variance: f64,
    },
    /// Nothing varies, or nothing happened.
    #[error("{what}: {consequence}")]
    Degenerate {
        /// What the data are.
        what: String,
        /// What cannot be estimated, and what to do.
        consequence: &'static str,
    },
    /// A value outside the range that it can have.
    #[error("{what} is {found}, and {expected} is expected")]
    Impossible {
        /// What was read.
        what: String,
        /// Its value.
        found: f64,
        /// The range.
        expected: &'static str,
    },
    /// The search for the largest likelihood ended nowhere.
    #[error("the likelihood of {law} has no largest value within reach: {advice}")]
    NoMaximum {
        /// The law.
        law: &'static str,
        /// What to do.
        advice: &'static str,
    },
}
