//! Estimation by the largest likelihood: estimates, covariance, profile intervals.
//!
//! The search goes over scales without bounds (ln x, ln x/(1 − x)); the covariance is the inverse of the observed
//! information there, brought to the parameter's own scale by the delta method. Intervals of 95 % are those of the
//! profile likelihood: a limit is where the largest ln L for that value of the parameter is 1.92 below the largest of
//! all (Venzon & Moolgavkar 1988). A limit that is not found within reach does not exist, and is said to be absent.

use crate::fit::{Estimate, Fit};
use crate::matrix::{Matrix, inverse};
use crate::optimum::{Optimum, hessian, largest, near};
use crate::problem::Problem;
use phytomer_sim::math;

/// Half the 95 % quantile of χ² with one degree of freedom.
const DROP: f64 = 1.920_729_410_347_062;

/// How a parameter is bounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scale {
    /// Any number.
    #[allow(dead_code, reason = "a law may have a parameter without bounds")]
    Plain,
    /// Above 0.
    Positive,
    /// Within 0 and 1.
    Share,
}

impl Scale {
    fn inwards(self, value: f64) -> f64 {
        match self {
            Self::Plain => value,
            Self::Positive => math::log(value),
            Self::Share => math::log(value) - math::log1p(-value),
        }
    }

    fn outwards(self, x: f64) -> f64 {
        match self {
            Self::Plain => x,
            Self::Positive => math::exp(x),
            Self::Share => 1.0 / (1.0 + math::exp(-x)),
        }
    }

    /// The slope of the value by x.
    fn slope(self, value: f64) -> f64 {
        match self {
            Self::Plain => 1.0,
            Self::Positive => value,
            Self::Share => value * (1.0 - value),
        }
    }
}

/// A law's parameters and its ln L as a function of them.
pub struct Model<'a> {
    /// The law, in words.
    pub law: &'static str,
    /// Names and scales.
    pub parameters: &'a [(&'static str, Scale)],
    /// ln L at values of the parameters.
    pub log_likelihood: &'a dyn Fn(&[f64]) -> f64,
    /// The number of independent observations.
    pub n: usize,
}

impl Model<'_> {
    /// The place of the largest likelihood, searched for from each of `starts`, and its ln L.
    ///
    /// # Errors
    /// No start has a finite likelihood.
    pub fn top(&self, starts: &[Vec<f64>]) -> Result<(Vec<f64>, f64), Problem> {
        let best = self.best(starts)?;
        Ok((self.outwards(&best.at), best.value))
    }

    /// The top within 10⁻⁶ of ln L, from a place that is near it.
    ///
    /// # Errors
    /// The place has no finite likelihood.
    pub fn nearby(&self, start: &[f64]) -> Result<(Vec<f64>, f64), Problem> {
        let f = |x: &[f64]| (self.log_likelihood)(&self.outwards(x));
        let at: Vec<f64> = start.iter().zip(self.parameters).map(|(value, (_, scale))| scale.inwards(*value)).collect();
        let best = near(&f, &at, 0.05);
        if best.value.is_finite() {
            return Ok((self.outwards(&best.at), best.value));
        }
        Err(Problem::NoMaximum { law: self.law, advice: "see whether the columns are those that the law asks for" })
    }

    fn best(&self, starts: &[Vec<f64>]) -> Result<Optimum, Problem> {
        let f = |x: &[f64]| (self.log_likelihood)(&self.outwards(x));
        let from = |start: &Vec<f64>| {
            let at: Vec<f64> =
                start.iter().zip(self.parameters).map(|(value, (_, scale))| scale.inwards(*value)).collect();
            largest(&f, &at, 0.2)
        };
        let best = starts.iter().map(from).max_by(|a, b| a.value.total_cmp(&b.value));
        let advice = "see whether the columns and their units are those that the law asks for";
        best.filter(|best| best.value.is_finite()).ok_or(Problem::NoMaximum { law: self.law, advice })
    }

    /// The estimates, with covariance and intervals.
    ///
    /// # Errors
    /// As [`Model::top`].
    pub fn fit(&self, starts: &[Vec<f64>]) -> Result<Fit, Problem> {
        let f = |x: &[f64]| (self.log_likelihood)(&self.outwards(x));
        let best = self.best(starts)?;
        let values = self.outwards(&best.at);
        let covariance = self.covariance(&f, &best.at, &values);
        let estimate = |place: usize| {
            let error = covariance.get(place).map(|row| row[place].sqrt());
            let step = error.map_or(0.5, |error| error / self.parameters[place].1.slope(values[place]));
            let limit = |sign: f64| self.limit(&f, &best.at, best.value, place, sign * step.clamp(1e-6, 5.0));
            Estimate {
                name: self.parameters[place].0.to_owned(),
                value: values[place],
                error,
                low: limit(-1.0),
                high: limit(1.0),
            }
        };
        Ok(Fit {
            law: self.law.to_owned(),
            estimates: (0..values.len()).map(estimate).collect(),
            covariance,
            log_likelihood: Some(best.value),
            parameters: values.len(),
            n: self.n,
            tests: Vec::new(),
            notes: Vec::new(),
        })
    }

    fn outwards(&self, x: &[f64]) -> Vec<f64> {
        x.iter().zip(self.parameters).map(|(x, (_, scale))| scale.outwards(*x)).collect()
    }

    /// Empty where the information is singular, or says that the place is no maximum.
    fn covariance(&self, f: &dyn Fn(&[f64]) -> f64, at: &[f64], values: &[f64]) -> Matrix {
        let information: Matrix = hessian(f, at).into_iter().map(|row| row.into_iter().map(|h| -h).collect()).collect();
        let Some(inverted) = inverse(&information) else { return Vec::new() };
        if (0..at.len()).any(|place| inverted[place][place] <= 0.0) {
            return Vec::new();
        }
        let slopes: Vec<f64> = values.iter().zip(self.parameters).map(|(v, (_, scale))| scale.slope(*v)).collect();
        let scaled = |(i, row): (usize, Vec<f64>)| row.iter().zip(&slopes).map(|(c, s)| c * s * slopes[i]).collect();
        inverted.into_iter().enumerate().map(scaled).collect()
    }

    /// The limit of the profile interval on the side of `step`, a standard error, on the parameter's own scale. The
    /// root of the drop is all but straight, so false position finds it in a few steps.
    fn limit(&self, f: &dyn Fn(&[f64]) -> f64, at: &[f64], top: f64, place: usize, step: f64) -> Option<f64> {
        let mut others: Vec<f64> = at.iter().enumerate().filter(|(k, _)| *k != place).map(|(_, x)| *x).collect();
        let mut beyond = |x: f64| {
            let held = |rest: &[f64]| {
                let mut point = rest.to_vec();
                point.insert(place, x);
                f(&point)
            };
            let best = near(&held, &others, 0.05);
            if !best.value.is_finite() {
                return f64::INFINITY;
            }
            others = best.at;
            (top - best.value).max(0.0).sqrt() - DROP.sqrt()
        };
        let (mut inside, mut outside) = ((at[place], -DROP.sqrt()), (at[place], f64::NAN));
        let mut reach = 2.0 * step;
        for _ in 0..14 {
            let x = inside.0 + reach;
            let value = beyond(x);
            if value >= 0.0 {
                outside = (x, value);
                break;
            }
            inside = (x, value);
            reach *= 1.6;
        }
        if outside.1.is_nan() {
            return None;
        }
        for _ in 0..40 {
            let between = if outside.1.is_finite() { inside.1 / (inside.1 - outside.1) } else { 0.5 };
            let x = inside.0 + between.clamp(0.02, 0.98) * (outside.0 - inside.0);
            let value = beyond(x);
            if value >= 0.0 {
                outside = (x, value)
            } else {
                inside = (x, value)
            }
            if value.abs() < 3e-5 || (outside.0 - inside.0).abs() < 1e-7 {
                return Some(self.parameters[place].1.outwards(x));
            }
        }
        Some(self.parameters[place].1.outwards(0.5 * (inside.0 + outside.0)))
    }
}
