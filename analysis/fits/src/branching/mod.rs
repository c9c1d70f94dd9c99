//! Fates of the axillary buds along a shoot: zones of independent buds against a chain of zones.
//!
//! `zones` has the law of de Reffye et al. (1988 §4), shares of fates by rank, buds independent; `chain` the hidden
//! semi-Markov chain of Guédon (2003), whose zones have random lengths; `runs` tests either by the number of runs of
//! equal fates, which independent buds have too many of; `order` the Markov order of a sequence of states. Absent:
//! covariates.

pub mod chain;
mod durations;
mod forward;
mod law;
pub mod order;
pub mod runs;
pub mod zones;

use crate::problem::Problem;

/// The fates along shoots, by numbers below `fates`; each shoot from its first rank.
#[derive(Debug, Clone, PartialEq)]
pub struct Shoots {
    /// How many fates there are.
    pub fates: usize,
    /// The fates of each shoot.
    pub shoots: Vec<Vec<usize>>,
}

impl Shoots {
    /// Shoots whose fates are all known.
    ///
    /// # Errors
    /// No shoots, an empty one, or a fate beyond the number of fates.
    pub fn new(fates: usize, shoots: Vec<Vec<usize>>) -> Result<Self, Problem> {
        if shoots.is_empty() || shoots.iter().any(Vec::is_empty) {
            let purpose = "a law of branching";
            return Err(Problem::TooFew { what: "buds on a shoot", found: 0, needed: 1, purpose });
        }
        match shoots.iter().flatten().find(|fate| **fate >= fates) {
            Some(fate) => {
                let what = "the number of a fate".to_owned();
                Err(Problem::Impossible { what, found: *fate as f64, expected: "one of the fates" })
            }
            None => Ok(Self { fates, shoots }),
        }
    }

    /// All buds.
    pub fn buds(&self) -> usize {
        self.shoots.iter().map(Vec::len).sum()
    }

    /// The longest shoot.
    pub fn longest(&self) -> usize {
        self.shoots.iter().map(Vec::len).max().unwrap_or(0)
    }

    /// Runs of equal fates over all shoots.
    pub fn runs(&self) -> usize {
        let of = |shoot: &Vec<usize>| 1 + shoot.windows(2).filter(|pair| pair[0] != pair[1]).count();
        self.shoots.iter().map(of).sum()
    }
}
