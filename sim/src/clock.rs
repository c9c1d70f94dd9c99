//! The discrete clock (de Reffye 1988 §3): ticks since the seed, and the growth speed of an order as an exact ratio.
//!
//! The unit of time is the time in which a growth unit grows; axes of different orders may grow at different speeds
//! (Fig. 14). A speed is a rational number, and an axis that is `m` ticks old has undergone ⌊m · speed⌋ clock steps: no
//! rounding drift at any age.

use std::fmt;

/// Ticks since the seed began to grow; the seed itself stands at tick 0, the first clock signal is tick 1.
pub type Tick = u32;

/// The tick of what has not happened.
pub const NEVER: Tick = u32::MAX;

/// The last tick that a scenario may ask for.
pub const LAST_TICK: Tick = 65_535;

/// How many clock steps an axis makes per tick, as an exact ratio: `2/3` is two steps in three ticks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Speed {
    steps: u32,
    ticks: u32,
}

impl Speed {
    /// One step a tick.
    pub const ONE: Self = Self { steps: 1, ticks: 1 };

    /// The largest numerator and denominator: with ages below [`LAST_TICK`] no product leaves 64 bits.
    pub const LIMIT: u32 = 1_000_000;

    /// `steps` clock steps in every `ticks` ticks; `None` where either is zero or above [`Speed::LIMIT`].
    pub fn new(steps: u32, ticks: u32) -> Option<Self> {
        let fits = |x| (1..=Self::LIMIT).contains(&x);
        let divisor = greatest_common_divisor(steps, ticks);
        (fits(steps) && fits(ticks)).then(|| Self { steps: steps / divisor, ticks: ticks / divisor })
    }

    /// The clock steps that an axis has undergone `dimension` ticks after its birth: ⌊dimension · speed⌋.
    #[inline]
    pub fn steps_by(self, dimension: Tick) -> u32 {
        if self.ticks == 1 && self.steps == 1 {
            return dimension;
        }
        let steps = u64::from(dimension) * u64::from(self.steps) / u64::from(self.ticks);
        u32::try_from(steps).unwrap_or(u32::MAX)
    }

    /// Steps per tick, as a real number.
    pub fn ratio(self) -> f64 {
        f64::from(self.steps) / f64::from(self.ticks)
    }
}

impl fmt::Display for Speed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.ticks {
            1 => write!(f, "{}", self.steps),
            _ => write!(f, "{}/{}", self.steps, self.ticks),
        }
    }
}

fn greatest_common_divisor(a: u32, b: u32) -> u32 {
    if b == 0 { a.max(1) } else { greatest_common_divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// De Reffye 1988 Example 4, n = 20: the sum over the laterals of their steps, for r = .5, 1, 1.5, 2, 3.
    #[test]
    fn steps_follow_the_ratio_of_figure_14() {
        let ratios = [(2, 1, 380), (1, 1, 190), (2, 3, 120), (1, 2, 90), (1, 3, 57)];
        for (steps, ticks, expected) in ratios {
            let speed = Speed::new(steps, ticks).unwrap();
            let sum: u32 = (1..=20).map(|birth| speed.steps_by(20 - birth)).sum();
            assert_eq!(sum, expected, "speed {speed}");
        }
    }

    #[test]
    fn a_speed_is_reduced_and_bounded() {
        assert_eq!(Speed::new(4, 6), Speed::new(2, 3));
        assert_eq!(Speed::new(0, 1), None);
        assert_eq!(Speed::new(1, 0), None);
        assert_eq!(Speed::new(Speed::LIMIT + 1, 1), None);
        assert_eq!(Speed::new(Speed::LIMIT, 1).unwrap().steps_by(LAST_TICK), u32::MAX);
    }

    #[test]
    fn no_drift_over_the_longest_life() {
        let third = Speed::new(1, 3).unwrap();
        assert_eq!(third.steps_by(LAST_TICK), LAST_TICK / 3);
    }
}
