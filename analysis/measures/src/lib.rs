//! Statistics of plants: means with their design effect, proportions, survival, circular means, lines, branching
//! ratios, contrasts, variance components, power, and a bootstrap by plant; the area that discs cover, and forms of
//! trees.
//!
//! The plant is the unit. Buds, axes and leaves of one plant are not independent, so intervals are of the values of
//! plants; what a file offers for single units says so. Each file has a formula with its source. What cannot be
//! estimated is a [`Lack`] with its reason, never NaN. Absent: tables, files and growth; values come from the caller,
//! one plant after the other.

pub mod bootstrap;
pub mod branching;
pub mod circular;
pub mod contrast;
pub mod cover;
pub mod form;
mod lack;
pub mod line;
pub mod moments;
pub mod power;
pub mod proportion;
pub mod quantile;
pub mod ratio;
pub mod shares;
pub mod survival;
pub mod variance;

pub use lack::Lack;
pub use moments::{Estimate, Moments};

/// The ends of an interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

impl Interval {
    /// The interval of this half width about a value.
    pub fn about(value: f64, half_width: f64) -> Self {
        Self { low: value - half_width, high: value + half_width }
    }

    /// Whether a value lies between the ends, or at one of them.
    pub fn holds(self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }

    /// The part of the interval within these bounds.
    #[must_use]
    pub fn within(self, low: f64, high: f64) -> Self {
        Self { low: self.low.clamp(low, high), high: self.high.clamp(low, high) }
    }
}
