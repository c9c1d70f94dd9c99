//! Mean and variance in one pass, and the estimate of a mean from the values of plants.
//!
//! Welford (1962) for one value more, Chan, Golub & LeVeque (1979, eq. 2.1) for two samples together. The interval of a
//! mean is Student's: mean ± t(n − 1) sd / √n. In a simulation sd / √n is the Monte-Carlo error of the mean. Absent:
//! units within plants (`ratio`).

use crate::{Interval, Lack, quantile};

/// Mean and standard deviation of values that came one after the other.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Moments {
    /// The number of values.
    pub n: u64,
    /// The mean; 0 where nothing was measured.
    pub mean: f64,
    /// The sum of squared deviations from the mean.
    squares: f64,
}

/// An estimate of a mean.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The estimate.
    pub value: f64,
    /// Its standard error.
    pub standard_error: f64,
    /// Its interval.
    pub interval: Interval,
}

impl Moments {
    /// The moments of some values.
    pub fn of(values: &[f64]) -> Self {
        let mut moments = Self::default();
        values.iter().for_each(|value| moments.add(*value));
        moments
    }

    /// The moments of units of which so many are 1 and the others 0.
    pub(crate) fn of_share(ones: u64, all: u64) -> Self {
        let (of, n) = (ones as f64, all as f64);
        Self { n: all, mean: of / n, squares: of * (n - of) / n }
    }

    /// Adds one value.
    pub fn add(&mut self, value: f64) {
        self.n += 1;
        let before = value - self.mean;
        self.mean += before / self.n as f64;
        self.squares += before * (value - self.mean);
    }

    /// Adds all values of another sample.
    pub fn merge(&mut self, other: &Self) {
        let (a, b) = (self.n as f64, other.n as f64);
        if other.n == 0 {
            return;
        }
        let apart = other.mean - self.mean;
        self.n += other.n;
        self.mean += apart * b / (a + b);
        self.squares += other.squares + apart * apart * a * b / (a + b);
    }

    /// The sum of squared deviations from the mean.
    pub fn squares(&self) -> f64 {
        self.squares
    }

    /// The sample variance (n − 1); `None` with fewer than two values.
    pub fn variance(&self) -> Option<f64> {
        (self.n > 1).then(|| self.squares / (self.n - 1) as f64)
    }

    /// The sample standard deviation, in the unit of the values; `None` with fewer than two values.
    pub fn standard_deviation(&self) -> Option<f64> {
        self.variance().map(f64::sqrt)
    }

    /// The mean of plants, with Student's interval at `level`. Each value must be that of one plant.
    ///
    /// # Errors
    /// [`Lack::Plants`] with fewer than two plants. With equal values the interval is a point.
    pub fn mean_of_plants(&self, level: f64) -> Result<Estimate, Lack> {
        let deviation = self.standard_deviation().ok_or(Lack::Plants { found: self.n, needed: 2 })?;
        let standard_error = deviation / (self.n as f64).sqrt();
        let half = quantile::t_for(level, (self.n - 1) as f64)? * standard_error;
        Ok(Estimate { value: self.mean, standard_error, interval: Interval::about(self.mean, half) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_those_of_the_textbook() {
        let moments = Moments::of(&[2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0]);
        assert_eq!(moments.mean, 5.0);
        assert!((moments.standard_deviation().unwrap() - (32.0_f64 / 7.0).sqrt()).abs() < 1e-12);
        assert_eq!(Moments::default().standard_deviation(), None);
    }

    #[test]
    fn two_samples_together_are_one() {
        let (all, split) = ([1.5, 2.0, -3.0, 8.0, 0.25, 4.0], 2);
        let mut first = Moments::of(&all[..split]);
        first.merge(&Moments::of(&all[split..]));
        first.merge(&Moments::default());
        let whole = Moments::of(&all);
        assert!(
            first.n == 6 && (first.mean - whole.mean).abs() < 1e-14 && (first.squares - whole.squares).abs() < 1e-12
        );
        let mut empty = Moments::default();
        empty.merge(&whole);
        assert_eq!(empty, whole);
    }

    /// Student's (1908) sleep data, second drug: mean 2.33, sd 2.002, n 10; interval 0.898 to 3.762 (R's `sleep`).
    #[test]
    fn the_interval_of_students_second_drug() {
        let drug = Moments::of(&[1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4]);
        let mean = drug.mean_of_plants(0.95).unwrap();
        assert!((mean.value - 2.33).abs() < 1e-12 && (mean.standard_error - 0.633_166).abs() < 1e-5);
        assert!((mean.interval.low - 0.897_677_5).abs() < 1e-6 && (mean.interval.high - 3.762_322_5).abs() < 1e-6);
        assert_eq!(Moments::of(&[1.0]).mean_of_plants(0.95), Err(Lack::Plants { found: 1, needed: 2 }));
        assert_eq!(Moments::of(&[1.0, 1.0]).mean_of_plants(0.95).unwrap().interval, Interval { low: 1.0, high: 1.0 });
    }
}
