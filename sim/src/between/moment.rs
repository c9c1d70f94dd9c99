//! An age of a plant, or a tick of a plot, that may lie between two ticks.
//!
//! The fraction has 2⁻²⁴ as its unit, so that moments can be compared and told apart and their shares are exact in
//! single precision. What is nearer to a whole tick than a millionth is that tick.

use crate::clock::Tick;

/// The parts of a tick.
const WHOLE: u32 = 1 << 24;

/// How near to a tick an age is the tick.
const NEAR: f64 = 1e-6;

/// An age in ticks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Moment {
    /// The tick at which all that it shows is known: its own, or the one after it.
    tick: Tick,
    /// How much of that tick has passed, from 1 to [`WHOLE`].
    parts: u32,
}

impl From<Tick> for Moment {
    fn from(tick: Tick) -> Self {
        Self { tick, parts: WHOLE }
    }
}

impl Moment {
    /// An age; `None` below 0, above the largest tick, and where it is no number.
    pub fn of(age: f64) -> Option<Self> {
        let whole = age.round();
        if !(0.0..=f64::from(Tick::MAX)).contains(&whole) || age < 0.0 {
            return None;
        }
        if (age - whole).abs() < NEAR {
            return Some(Self::from(whole as Tick));
        }
        let parts = ((age - age.floor()) * f64::from(WHOLE)).round() as u32;
        Some(Self { tick: (age.floor() as Tick).checked_add(1)?, parts: parts.clamp(1, WHOLE - 1) })
    }

    /// The age.
    pub fn age(self) -> f64 {
        match self.share() {
            Some(share) => f64::from(self.tick - 1) + f64::from(share),
            None => f64::from(self.tick),
        }
    }

    /// The tick at which all that it shows is known: its own, or the one after it.
    pub fn tick(self) -> Tick {
        self.tick
    }

    /// The share of that tick that has passed, where it is not the whole.
    pub fn share(self) -> Option<f32> {
        (self.parts < WHOLE).then(|| self.parts as f32 / WHOLE as f32)
    }

    /// The moment so many ticks later.
    #[must_use]
    pub fn later(self, ticks: Tick) -> Self {
        Self { tick: self.tick.saturating_add(ticks), ..self }
    }

    /// The moment so many ticks earlier; the first one there is where that is before it.
    #[must_use]
    pub fn earlier(self, ticks: Tick) -> Self {
        match self.tick.checked_sub(ticks) {
            Some(tick) if tick > 0 || self.parts == WHOLE => Self { tick, ..self },
            _ => Self::from(0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ages_are_read_and_what_is_none_is_refused() {
        for (age, tick, share) in [(0.0, 0, None), (3.0, 3, None), (3.5, 4, Some(0.5)), (0.25, 1, Some(0.25))] {
            let moment = Moment::of(age).unwrap();
            assert_eq!((moment.tick(), moment.share(), moment.age()), (tick, share, age));
        }
        assert_eq!(Moment::of(4.0 - 1e-9), Some(Moment::from(4)));
        assert_eq!(Moment::of(4.0 + 1e-9), Some(Moment::from(4)));
        assert_eq!(Moment::of(4_294_967_295.0), Some(Moment::from(Tick::MAX)));
        for age in [-1.0, -0.25, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 4_294_967_296.0, 4_294_967_295.25, 1e300] {
            assert_eq!(Moment::of(age), None, "{age}");
        }
    }

    #[test]
    fn moments_are_in_the_order_of_time() {
        let ages = [0.0, 1e-5, 0.5, 0.999, 1.0, 1.1, 2.0];
        let moments = ages.map(|age| Moment::of(age).unwrap());
        assert!(moments.is_sorted() && moments.windows(2).all(|pair| pair[0] != pair[1]));
        assert_eq!(moments[2].later(5).earlier(5), moments[2]);
        assert_eq!(moments[2].earlier(1), Moment::from(0));
        assert_eq!((moments[4].earlier(1), moments[5].earlier(1).tick()), (Moment::from(0), 1));
    }
}
