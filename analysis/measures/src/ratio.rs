//! The mean of units within plants, with an interval of plants and the design effect (Kish 1965, §5.4 and §8.2;
//! Cochran 1977, §6.13).
//!
//! Buds, axes and leaves of one plant are alike, so n plants of m units hold less than n·m independent units. The mean
//! over all units is a ratio of two sums of plants, R = Σy / Σm, whose variance is that of the residuals y − R m of the
//! plants: n / (n − 1) Σ(y − R m)² / (Σm)². The design effect is that variance over the one that independent units
//! would give. Interval: Student's with n − 1 degrees of freedom. Seven sums are kept, however many plants there are.

use crate::moments::{Estimate, Moments};
use crate::{Interval, Lack, quantile};

/// The units of one plant.
pub type OfPlant = Moments;

/// The sums over plants. Values are taken relative to the first plant's mean, so that little is lost where plants are
/// alike.
#[derive(Debug, Clone, Copy, Default)]
pub struct Ratio {
    plants: u64,
    origin: f64,
    units: Moments,
    yy: f64,
    ym: f64,
    mm: f64,
    y: f64,
}

/// A mean of units within plants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnitMean {
    /// The number of plants that have a unit.
    pub plants: u64,
    /// The number of units.
    pub units: u64,
    /// The mean over all units.
    pub value: f64,
    /// The standard deviation of units.
    pub deviation: Result<f64, Lack>,
    /// Standard error and interval, of plants.
    pub estimate: Result<Estimate, Lack>,
    /// The design effect.
    pub design_effect: Result<f64, Lack>,
}

impl Ratio {
    /// Adds the units of one plant. A plant without a unit is left out, since it tells nothing of units.
    pub fn add(&mut self, plant: &OfPlant) {
        if plant.n == 0 {
            return;
        }
        if self.plants == 0 {
            self.origin = plant.mean;
        }
        self.plants += 1;
        self.units.merge(plant);
        let m = plant.n as f64;
        let y = (plant.mean - self.origin) * m;
        self.y += y;
        self.yy += y * y;
        self.ym += y * m;
        self.mm += m * m;
    }

    /// The mean over all units and its interval at `level`.
    ///
    /// # Errors
    /// [`Lack::Empty`] where no plant has a unit.
    pub fn mean(&self, level: f64) -> Result<UnitMean, Lack> {
        let units = self.units.n as f64;
        if self.units.n == 0 {
            return Err(Lack::Empty);
        }
        let relative = self.y / units;
        let value = self.origin + relative;
        let estimate = self.estimate(value, relative, level);
        let variance = self.units.variance().ok_or(Lack::Values { found: self.units.n, needed: 2 });
        let design_effect = estimate.and_then(|estimate| match variance? / units {
            independent if independent > 0.0 => Ok(estimate.standard_error * estimate.standard_error / independent),
            _ => Err(Lack::NoVariance),
        });
        let deviation = variance.map(f64::sqrt);
        Ok(UnitMean { plants: self.plants, units: self.units.n, value, deviation, estimate, design_effect })
    }

    fn estimate(&self, value: f64, relative: f64, level: f64) -> Result<Estimate, Lack> {
        let n = self.plants as f64;
        if self.plants < 2 {
            return Err(Lack::Plants { found: self.plants, needed: 2 });
        }
        let residuals = self.yy - 2.0 * relative * self.ym + relative * relative * self.mm;
        let standard_error = (n / (n - 1.0) * residuals.max(0.0)).sqrt() / self.units.n as f64;
        let half = quantile::t_for(level, n - 1.0)? * standard_error;
        Ok(Estimate { value, standard_error, interval: Interval::about(value, half) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three plants reckoned by hand: R = 18/6, residuals −3, 1, 2, so that se² = 3/2 · 14 / 36.
    #[test]
    fn three_plants_by_hand() {
        let mut ratio = Ratio::default();
        for plant in [&[1.0, 2.0][..], &[4.0], &[3.0, 5.0, 3.0]] {
            ratio.add(&Moments::of(plant));
        }
        ratio.add(&Moments::default());
        let mean = ratio.mean(0.95).unwrap();
        let estimate = mean.estimate.unwrap();
        assert_eq!((mean.plants, mean.units, mean.value), (3, 6, 3.0));
        assert!((estimate.standard_error - (1.5_f64 * 14.0 / 36.0).sqrt()).abs() < 1e-14);
        assert!((mean.design_effect.unwrap() - (1.5 * 14.0 / 36.0) / (10.0 / 5.0 / 6.0)).abs() < 1e-12);
    }

    /// Units that are copies of one value a plant tell as much as one unit: the design effect is their number.
    #[test]
    fn copies_within_plants_are_worth_one_unit() {
        let mut ratio = Ratio::default();
        let values = [3.0, 5.5, 4.0, 9.0, 7.25];
        values.iter().for_each(|value| ratio.add(&Moments::of(&[*value; 8])));
        let mean = ratio.mean(0.95).unwrap();
        let plants = Moments::of(&values).mean_of_plants(0.95).unwrap();
        assert!((mean.estimate.unwrap().standard_error - plants.standard_error).abs() < 1e-12);
        assert!((mean.design_effect.unwrap() - 8.0 * 39.0 / 40.0 * 5.0 / 4.0).abs() < 1e-9);
    }

    #[test]
    fn what_is_missing_is_said() {
        let mut ratio = Ratio::default();
        assert_eq!(ratio.mean(0.95), Err(Lack::Empty));
        ratio.add(&Moments::of(&[2.0, 2.0]));
        let one = ratio.mean(0.95).unwrap();
        assert_eq!(one.estimate, Err(Lack::Plants { found: 1, needed: 2 }));
        ratio.add(&Moments::of(&[2.0]));
        assert_eq!(ratio.mean(0.95).unwrap().design_effect, Err(Lack::NoVariance));
    }
}
