//! The range that a law's values must keep to, and how a value outside it is shown.
//!
//! Absent on purpose: units; `what` names them.

/// The interval [min, max] of a law's values, both ends included, and what the values are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValueRange {
    /// Smallest value allowed; [`f64::MIN_POSITIVE`] for anything above 0.
    pub min: f64,
    /// Largest value allowed; infinity for none.
    pub max: f64,
    /// The value in words, with its unit: "an internode length in metres".
    pub what: &'static str,
}

impl ValueRange {
    /// A probability.
    pub const PROBABILITY: Self = Self { min: 0.0, max: 1.0, what: "a probability" };

    /// Whether `value` is a number in the range that a 32-bit float can hold.
    pub fn holds(&self, value: f64) -> bool {
        value.abs() <= f64::from(f32::MAX) && value >= self.min && value <= self.max
    }

    /// "a probability in [0, 1]".
    pub fn expected(&self) -> String {
        if self.min == f64::MIN_POSITIVE {
            let most = if self.max.is_finite() { format!(" and at most {}", self.max) } else { String::new() };
            return format!("{} above 0{most}", self.what);
        }
        match (self.min.is_finite(), self.max.is_finite()) {
            (true, true) => format!("{} in [{}, {}]", self.what, self.min, self.max),
            (true, false) => format!("{} of at least {}", self.what, self.min),
            (false, true) => format!("{} of at most {}", self.what, self.max),
            (false, false) => format!("{} that is finite", self.what),
        }
    }

    /// A value outside the range in few digits, unless they would put it inside.
    pub(super) fn show(&self, value: f64) -> String {
        let full = format!("{value}");
        if full.len() <= 10 || !value.is_finite() {
            return full;
        }
        let short = format!("{value:.4e}");
        let rounded: f64 = short.parse().unwrap_or(value);
        match () {
            () if self.holds(rounded) => full,
            () if (1e-3..1e6).contains(&rounded.abs()) => format!("{rounded}"),
            () => short,
        }
    }
}
