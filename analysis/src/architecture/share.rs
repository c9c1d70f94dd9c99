//! A share with the counts that it is made of: how many of the axes that could have a character have it.
//!
//! Counts are kept whole, so that a share of nothing is told from a share of 0.

/// How many of those that were asked have a character.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Share {
    /// Those that have it.
    pub yes: u32,
    /// Those that were asked.
    pub of: u32,
}

impl Share {
    /// Counts one more.
    pub fn add(&mut self, has: bool) {
        self.yes += u32::from(has);
        self.of += 1;
    }

    /// The share; `None` where none was asked.
    pub fn value(self) -> Option<f64> {
        (self.of > 0).then(|| f64::from(self.yes) / f64::from(self.of))
    }

    /// Whether some were asked and at least `least` of them have it.
    pub fn is_at_least(self, least: f64) -> bool {
        self.value().is_some_and(|share| share >= least)
    }
}
