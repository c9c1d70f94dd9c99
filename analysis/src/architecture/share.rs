//! A share with its two counts: how many axes have a character, of how many that could have it.
//!
//! Both counts are kept, so that a share without any candidates differs from a share of 0.

/// How many axes, or sets of relays, have a character, of how many that could have it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Share {
    /// The number of candidates that have the character.
    pub yes: u32,
    /// The number of candidates.
    pub of: u32,
}

impl Share {
    /// Counts one more candidate, which has the character or not.
    pub fn add(&mut self, has: bool) {
        self.yes += u32::from(has);
        self.of += 1;
    }

    /// The share, from 0 to 1; `None` without candidates.
    pub fn value(self) -> Option<f64> {
        (self.of > 0).then(|| f64::from(self.yes) / f64::from(self.of))
    }

    /// Whether the share is at least `least`; false without candidates.
    pub fn is_at_least(self, least: f64) -> bool {
        self.value().is_some_and(|share| share >= least)
    }
}
