//! The shares of kinds among units within plants: a distribution with an interval of plants for each of its bars.
//!
//! The share of a kind is the mean of units that are 1 where they are of the kind and else 0, so that its interval is
//! that of `ratio` (Cochran 1977, §6.13), cut to [0, 1]. Kinds are numbered from 0; one that no unit is of yet is no
//! less one of which each plant has none. Absent: tests between distributions.

use crate::moments::Moments;
use crate::ratio::{Ratio, UnitMean};
use crate::{Interval, Lack};

/// The units of plants by their kind.
#[derive(Debug, Clone, Default)]
pub struct Shares {
    /// A kind of which no plant has any.
    none: Ratio,
    kinds: Vec<Ratio>,
    units: u64,
}

impl Shares {
    /// Adds the units of one plant, as how many it has of kind 0, 1, 2 … A plant without units is left out.
    pub fn add(&mut self, units: &[u64]) {
        let all: u64 = units.iter().sum();
        if all == 0 {
            return;
        }
        self.kinds.resize(self.kinds.len().max(units.len()), self.none);
        for (place, kind) in self.kinds.iter_mut().enumerate() {
            kind.add(&Moments::of_share(units.get(place).copied().unwrap_or(0), all));
        }
        self.none.add(&Moments::of_share(0, all));
        self.units += all;
    }

    /// How many kinds there are, the last of which some unit is.
    pub fn kinds(&self) -> usize {
        self.kinds.len()
    }

    /// How many units there are.
    pub fn units(&self) -> u64 {
        self.units
    }

    /// The share of a kind, with its interval at `level` where two plants have units and are not all alike: that no
    /// plant has any is no interval of width 0.
    ///
    /// # Errors
    /// [`Lack::Empty`] without units.
    pub fn share(&self, kind: usize, level: f64) -> Result<(f64, Option<Interval>), Lack> {
        let UnitMean { value, estimate, .. } = self.kinds.get(kind).unwrap_or(&self.none).mean(level)?;
        let estimate = estimate.ok().filter(|estimate| estimate.standard_error > 0.0);
        Ok((value, estimate.map(|estimate| estimate.interval.within(0.0, 1.0))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three plants of 4, 2 and 4 units by hand: R = 3/10 of kind 1, residuals −.2, −.6, .8, se² = 3/2 · 1.04 / 100.
    #[test]
    fn three_plants_by_hand() {
        let mut shares = Shares::default();
        [&[3, 1][..], &[2], &[], &[1, 2, 1]].iter().for_each(|units| shares.add(units));
        assert_eq!((shares.kinds(), shares.units()), (3, 10));
        let (share, interval) = shares.share(1, 0.95).unwrap();
        let interval = interval.unwrap();
        let half = crate::quantile::t_for(0.95, 2.0).unwrap() * (1.5_f64 * 1.04 / 100.0).sqrt();
        assert!((share - 0.3).abs() < 1e-14 && interval.low == 0.0, "{share} {interval:?}");
        assert!((interval.high - 0.3 - half).abs() < 1e-12, "{interval:?} {half}");
        // What the third plant alone has, the first two have none of.
        assert!((shares.share(2, 0.95).unwrap().0 - 0.1).abs() < 1e-14);
        assert_eq!(shares.share(9, 0.95), Ok((0.0, None)));
        let all: f64 = (0..3).map(|kind| shares.share(kind, 0.95).unwrap().0).sum();
        assert!((all - 1.0).abs() < 1e-14);
    }

    #[test]
    fn what_is_missing_is_said() {
        let mut shares = Shares::default();
        assert_eq!(shares.share(0, 0.95), Err(Lack::Empty));
        shares.add(&[2, 2]);
        assert_eq!(shares.share(0, 0.95), Ok((0.5, None)));
    }
}
