//! Straight lines through values of plants: ordinary least squares, and the standardised major axis for allometry
//! (Warton, Wright, Falster & Westoby 2006, §3 and Appendix F).
//!
//! OLS predicts y from x: slope Sxy / Sxx, Student's interval with n − 2 degrees of freedom. SMA describes how two
//! sizes scale, with error in both: slope ± √(Syy / Sxx) with the sign of the correlation, interval b (√(B + 1) ± √B),
//! B = (1 − r²) / (n − 2) · F(1, n − 2). Each point is a plant. Sums are updated one plant at a time (Welford).

use crate::moments::Estimate;
use crate::{Interval, Lack, quantile};

/// The sums of squares and products of pairs.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Pairs {
    n: u64,
    x: f64,
    y: f64,
    xx: f64,
    xy: f64,
    yy: f64,
}

/// A fitted line, y = intercept + slope x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// The number of pairs.
    pub n: u64,
    /// The slope, with its interval.
    pub slope: Estimate,
    /// The value at x = 0, with its interval.
    pub intercept: Estimate,
    /// The squared correlation.
    pub r2: f64,
}

impl Pairs {
    /// Adds the pair of one plant.
    pub fn add(&mut self, x: f64, y: f64) {
        self.n += 1;
        let n = self.n as f64;
        let (dx, dy) = (x - self.x, y - self.y);
        self.x += dx / n;
        self.y += dy / n;
        self.xx += dx * (x - self.x);
        self.yy += dy * (y - self.y);
        self.xy += dx * (y - self.y);
    }

    /// Adds all pairs of another sample (Chan, Golub & LeVeque 1979).
    pub fn merge(&mut self, other: &Self) {
        if other.n == 0 {
            return;
        }
        let (a, b) = (self.n as f64, other.n as f64);
        let (dx, dy, share) = (other.x - self.x, other.y - self.y, a * b / (a + b));
        self.n += other.n;
        self.x += dx * b / (a + b);
        self.y += dy * b / (a + b);
        self.xx += other.xx + dx * dx * share;
        self.yy += other.yy + dy * dy * share;
        self.xy += other.xy + dx * dy * share;
    }

    /// The number of pairs.
    pub fn len(&self) -> u64 {
        self.n
    }

    /// Whether there is no pair.
    pub fn is_empty(&self) -> bool {
        self.n == 0
    }

    fn check(&self) -> Result<f64, Lack> {
        match self.n {
            0..=2 => Err(Lack::Plants { found: self.n, needed: 3 }),
            _ if !(self.xx > 0.0 && self.yy > 0.0) => Err(Lack::NoVariance),
            n => Ok((n - 2) as f64),
        }
    }

    fn r2(&self) -> f64 {
        (self.xy * self.xy / (self.xx * self.yy)).min(1.0)
    }

    /// The line of ordinary least squares, with intervals at `level`.
    ///
    /// # Errors
    /// [`Lack::Plants`] with fewer than three plants, [`Lack::NoVariance`] where x or y does not vary.
    pub fn least_squares(&self, level: f64) -> Result<Line, Lack> {
        let df = self.check()?;
        let slope = self.xy / self.xx;
        let residual = ((self.yy - slope * self.xy) / df).max(0.0);
        let error = (residual / self.xx).sqrt();
        let t = quantile::t_for(level, df)?;
        let of = |value: f64, error: f64| Estimate {
            value,
            standard_error: error,
            interval: Interval::about(value, t * error),
        };
        let at_zero = (residual * (1.0 / self.n as f64 + self.x * self.x / self.xx)).sqrt();
        let intercept = of(self.y - slope * self.x, at_zero);
        Ok(Line { n: self.n, slope: of(slope, error), intercept, r2: self.r2() })
    }

    /// The standardised major axis, with intervals at `level`. The interval of the intercept is that of Warton et al.
    /// 2006, Appendix F: from the slope's standard error and the residual variance.
    ///
    /// # Errors
    /// As [`Pairs::least_squares`]; [`Lack::NoDirection`] where x and y do not correlate at all.
    pub fn major_axis(&self, level: f64) -> Result<Line, Lack> {
        let df = self.check()?;
        if self.xy == 0.0 {
            return Err(Lack::NoDirection);
        }
        let sign = self.xy.signum();
        let slope = sign * (self.yy / self.xx).sqrt();
        let r2 = self.r2();
        let b = (1.0 - r2) / df * quantile::f(level, 1.0, df)?;
        let ends = [slope * ((b + 1.0).sqrt() - b.sqrt()), slope * ((b + 1.0).sqrt() + b.sqrt())];
        let interval = Interval { low: ends[0].min(ends[1]), high: ends[0].max(ends[1]) };
        let error = slope.abs() * ((1.0 - r2) / df).sqrt();
        let residual = (self.yy - 2.0 * slope * self.xy + slope * slope * self.xx).max(0.0) / df;
        let at_zero = (residual / self.n as f64 + self.x * self.x * error * error).sqrt();
        let value = self.y - slope * self.x;
        let half = quantile::t_for(level, df)? * at_zero;
        let intercept = Estimate { value, standard_error: at_zero, interval: Interval::about(value, half) };
        Ok(Line { n: self.n, slope: Estimate { value: slope, standard_error: error, interval }, intercept, r2 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pairs(of: &[(f64, f64)]) -> Pairs {
        let mut pairs = Pairs::default();
        of.iter().for_each(|(x, y)| pairs.add(*x, *y));
        pairs
    }

    /// Anscombe's (1973) first set: slope .5001 ± .1179, intercept 3.0001 ± 1.1247, r² .667.
    #[test]
    fn anscombes_first_line() {
        let x = [10.0, 8.0, 13.0, 9.0, 11.0, 14.0, 6.0, 4.0, 12.0, 7.0, 5.0];
        let y = [8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68];
        let all: Vec<(f64, f64)> = x.into_iter().zip(y).collect();
        let line = pairs(&all).least_squares(0.95).unwrap();
        assert!((line.slope.value - 0.500_09).abs() < 1e-5 && (line.slope.standard_error - 0.117_91).abs() < 1e-5);
        assert!((line.intercept.value - 3.000_09).abs() < 1e-5);
        assert!((line.intercept.standard_error - 1.124_75).abs() < 1e-5 && (line.r2 - 0.666_54).abs() < 1e-5);
        // The standardised major axis is the least squares slope over the correlation.
        let axis = pairs(&all).major_axis(0.95).unwrap();
        assert!((axis.slope.value - line.slope.value / line.r2.sqrt()).abs() < 1e-12);
        assert!(axis.slope.interval.holds(axis.slope.value));
    }

    #[test]
    fn a_falling_line_has_its_ends_in_order() {
        let axis = pairs(&[(1.0, 5.0), (2.0, 4.2), (3.0, 2.9), (4.0, 2.1)]).major_axis(0.95).unwrap();
        assert!(axis.slope.value < 0.0 && axis.slope.interval.low < axis.slope.interval.high);
    }

    #[test]
    fn two_samples_together_are_one() {
        let all = [(1.0, 2.5), (2.0, 2.0), (4.0, 7.0), (5.5, 6.0), (6.0, 9.0)];
        let mut merged = pairs(&all[..2]);
        merged.merge(&pairs(&all[2..]));
        let (merged, whole) = (merged.least_squares(0.95).unwrap(), pairs(&all).least_squares(0.95).unwrap());
        assert!((merged.slope.value - whole.slope.value).abs() < 1e-13 && (merged.r2 - whole.r2).abs() < 1e-13);
    }

    #[test]
    fn what_is_missing_is_said() {
        let two = pairs(&[(1.0, 1.0), (2.0, 2.0)]);
        assert_eq!(two.least_squares(0.95), Err(Lack::Plants { found: 2, needed: 3 }));
        let level = pairs(&[(1.0, 1.0), (1.0, 2.0), (1.0, 3.0)]);
        assert_eq!(level.major_axis(0.95), Err(Lack::NoVariance));
    }
}
