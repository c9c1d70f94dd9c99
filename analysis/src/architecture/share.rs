//! A share with the counts that it is made of: how many of the axes that could have a character have it.
//!
//! Counts are kept whole, so that a share of nothing is told from a share of 0.

/// How many axes, or sets of axes, have a character, of how many that could have it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Share {
    /// How many have it.
    pub yes: u32,
    /// How many could have it.
    pub of: u32,
}

impl Share {
    /// Counts one more.
    pub fn add(&mut self, has: bool) {
        self.yes += u32::from(has);
        self.of += 1;
    }

    /// The share; `None` of none.
    pub fn value(self) -> Option<f64> {
        (self.of > 0).then(|| f64::from(self.yes) / f64::from(self.of))
    }

    /// Whether at least the share `least` has it; never of none.
    pub fn is_at_least(self, least: f64) -> bool {
        self.value().is_some_and(|share| share >= least)
    }
}
