//! Directions: mean angle, resultant length and spread (Mardia & Jupp 2000, §2.2–2.3), with an interval of plants.
//!
//! R = |Σ e^{iθ}| / n, mean angle = arg Σ e^{iθ}, circular standard deviation √(−2 ln R). The interval of the mean
//! angle takes the influence of each plant, the part of its sum across the mean direction over the length of the whole
//! sum, with Student's t. Not where R is near 0: there is no mean direction then, and the interval says so by its
//! width. Rayleigh's test of uniformity (Mardia & Jupp, eq. 6.3.5, to O(n⁻²)) takes directions as independent.

use crate::{Interval, Lack, quantile};
use phytomer_sim::math::{atan2, exp, log, sincos};

/// Sums over plants.
#[derive(Debug, Clone, Copy, Default)]
pub struct Directions {
    plants: u64,
    n: u64,
    cos: f64,
    sin: f64,
    cos_cos: f64,
    cos_sin: f64,
    sin_sin: f64,
}

/// The directions of one plant.
#[derive(Debug, Clone, Copy, Default)]
pub struct OfPlant {
    n: u64,
    cos: f64,
    sin: f64,
}

/// A mean direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanDirection {
    /// The number of plants that have a direction.
    pub plants: u64,
    /// The number of directions.
    pub n: u64,
    /// The mean angle, radians in (−π, π].
    pub angle: Result<f64, Lack>,
    /// The mean resultant length: 0 where directions cancel out, 1 where all are equal.
    pub resultant: f64,
    /// The circular standard deviation, radians.
    pub deviation: Result<f64, Lack>,
    /// The standard error of the mean angle, of plants, radians.
    pub standard_error: Result<f64, Lack>,
    /// The interval of the mean angle, of plants, radians; it may reach beyond ±π.
    pub interval: Result<Interval, Lack>,
    /// The probability of a resultant as long where directions are uniform and independent.
    pub rayleigh: f64,
}

impl OfPlant {
    /// Adds an angle, radians.
    pub fn add(&mut self, angle: f64) {
        let (sin, cos) = sincos(angle);
        self.n += 1;
        self.cos += cos;
        self.sin += sin;
    }
}

impl Directions {
    /// Adds the directions of one plant; a plant without any is left out.
    pub fn add(&mut self, plant: &OfPlant) {
        if plant.n == 0 {
            return;
        }
        self.plants += 1;
        self.n += plant.n;
        self.cos += plant.cos;
        self.sin += plant.sin;
        self.cos_cos += plant.cos * plant.cos;
        self.cos_sin += plant.cos * plant.sin;
        self.sin_sin += plant.sin * plant.sin;
    }

    /// The mean direction, with an interval at `level`.
    ///
    /// # Errors
    /// [`Lack::Empty`] without directions.
    pub fn mean(&self, level: f64) -> Result<MeanDirection, Lack> {
        /// A resultant that is no longer than rounding leaves of directions that cancel out.
        const NOTHING: f64 = 1e-9;
        if self.n == 0 {
            return Err(Lack::Empty);
        }
        let n = self.n as f64;
        let length = (self.cos * self.cos + self.sin * self.sin).sqrt();
        let resultant = (length / n).min(1.0);
        let angle = if resultant > NOTHING { Ok(atan2(self.sin, self.cos)) } else { Err(Lack::NoDirection) };
        let standard_error = angle.and_then(|angle| self.error_about(angle, length));
        let interval = angle.and_then(|angle| {
            let error = standard_error?;
            Ok(Interval::about(angle, quantile::t_for(level, (self.plants - 1) as f64)? * error))
        });
        Ok(MeanDirection {
            plants: self.plants,
            n: self.n,
            angle,
            resultant,
            deviation: angle.map(|_| (-2.0 * log(resultant)).max(0.0).sqrt()),
            standard_error,
            interval,
            rayleigh: rayleigh(resultant, n),
        })
    }

    fn error_about(&self, angle: f64, length: f64) -> Result<f64, Lack> {
        let k = self.plants as f64;
        if self.plants < 2 {
            return Err(Lack::Plants { found: self.plants, needed: 2 });
        }
        let (sin, cos) = sincos(angle);
        let across = self.sin_sin * cos * cos - 2.0 * self.cos_sin * sin * cos + self.cos_cos * sin * sin;
        Ok((k / (k - 1.0) * across.max(0.0)).sqrt() / length)
    }
}

/// The tail of Rayleigh's statistic n R².
fn rayleigh(resultant: f64, n: f64) -> f64 {
    let z = n * resultant * resultant;
    let series = 1.0 + (2.0 * z - z * z) / (4.0 * n)
        - (24.0 * z - 132.0 * z * z + 76.0 * z * z * z - 9.0 * z * z * z * z) / (288.0 * n * n);
    (exp(-z) * series).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(plants: &[&[f64]]) -> Directions {
        let mut directions = Directions::default();
        for plant in plants {
            let mut own = OfPlant::default();
            plant.iter().for_each(|degrees| own.add(degrees.to_radians()));
            directions.add(&own);
        }
        directions
    }

    /// Mardia & Jupp (2000), Example 2.1: a roulette wheel came to rest at these angles; mean 51°, R = .711.
    #[test]
    fn the_roulette_wheel_of_mardia_and_jupp() {
        let wheel: [&[f64]; 9] = [&[43.0], &[45.0], &[52.0], &[61.0], &[75.0], &[88.0], &[88.0], &[279.0], &[357.0]];
        let mean = of(&wheel).mean(0.95).unwrap();
        assert!((mean.angle.unwrap().to_degrees() - 51.0).abs() < 0.5 && (mean.resultant - 0.711).abs() < 5e-4);
        assert!((mean.deviation.unwrap() - (-2.0 * log(0.711)).sqrt()).abs() < 1e-3);
    }

    /// Where directions hardly differ, the mean angle is the mean of angles and the interval Student's.
    #[test]
    fn a_narrow_sample_is_a_sample_of_numbers() {
        let angles = [10.0, 10.2, 9.9, 10.4, 9.6];
        let plants: Vec<&[f64]> = angles.iter().map(std::slice::from_ref).collect();
        let mean = of(&plants).mean(0.95).unwrap();
        let plain = crate::Moments::of(&angles).mean_of_plants(0.95).unwrap();
        assert!((mean.angle.unwrap().to_degrees() - plain.value).abs() < 1e-4);
        assert!((mean.interval.unwrap().low.to_degrees() - plain.interval.low).abs() < 1e-3);
    }

    #[test]
    fn what_is_missing_is_said() {
        assert_eq!(Directions::default().mean(0.95), Err(Lack::Empty));
        let opposite = of(&[&[0.0], &[180.0]]).mean(0.95).unwrap();
        assert_eq!((opposite.angle, opposite.interval), (Err(Lack::NoDirection), Err(Lack::NoDirection)));
        let one = of(&[&[30.0, 40.0]]).mean(0.95).unwrap();
        assert_eq!(one.interval, Err(Lack::Plants { found: 1, needed: 2 }));
        assert!(one.rayleigh <= 1.0 && one.rayleigh >= 0.0);
    }
}
