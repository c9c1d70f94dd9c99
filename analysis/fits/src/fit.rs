//! What an estimate is: values with errors and intervals, covariance, log-likelihood, BIC, tests of the fit.
//!
//! BIC = −2 ln L + k ln n (Schwarz 1978), where the n of a binomial part, a shift and the number of parts count as
//! parameters that were chosen. Absent: how any of it is estimated.

use crate::matrix::Matrix;
use phytomer_sim::math;

/// Two parameters of a fit are said to be correlated above this size.
pub const CORRELATED: f64 = 0.9;

/// A parameter as it was estimated.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// Its name in the formula of the law.
    pub name: String,
    /// The estimate.
    pub value: f64,
    /// Its standard error; `None` where it cannot be told.
    pub error: Option<f64>,
    /// The lower limit of the interval of 95 %; `None` where the data set none.
    pub low: Option<f64>,
    /// The upper limit.
    pub high: Option<f64>,
}

impl Estimate {
    /// A value without error or limits.
    pub fn bare(name: &str, value: f64) -> Self {
        Self { name: name.to_owned(), value, error: None, low: None, high: None }
    }

    /// The same with the limits of its interval.
    pub fn within(self, low: f64, high: f64) -> Self {
        let told = |limit: f64| limit.is_finite().then_some(limit);
        Self { low: told(low), high: told(high), ..self }
    }
}

/// A test of the fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Test {
    /// What is tested against what.
    pub name: String,
    /// The statistic, χ² unless the name says otherwise.
    pub statistic: f64,
    /// Degrees of freedom.
    pub df: f64,
    /// The probability of a statistic at least as large where the law holds.
    pub p: f64,
}

impl Test {
    /// A χ² test with its tail.
    pub fn chi2(name: &str, statistic: f64, df: usize) -> Self {
        let p = crate::special::chi2_tail(statistic, df as f64);
        Self { name: name.to_owned(), statistic, df: df as f64, p }
    }
}

/// A law that was fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The law, in words that differ among rivals.
    pub law: String,
    /// Its parameters. Those of the first rows of `covariance` come first.
    pub estimates: Vec<Estimate>,
    /// Covariance of the first estimates; empty where it cannot be told.
    pub covariance: Matrix,
    /// ln L at the estimates; `None` where the estimate is by moments.
    pub log_likelihood: Option<f64>,
    /// The number of parameters that were chosen by the data.
    pub parameters: usize,
    /// The number of independent observations.
    pub n: usize,
    /// Tests of the fit.
    pub tests: Vec<Test>,
    /// What must be known before the numbers are used, in sentences.
    pub notes: Vec<String>,
}

impl Fit {
    /// −2 ln L + k ln n.
    pub fn bic(&self) -> Option<f64> {
        self.log_likelihood.map(|l| self.parameters as f64 * math::log(self.n as f64) - 2.0 * l)
    }

    /// The estimate of a name.
    pub fn estimate(&self, name: &str) -> Option<&Estimate> {
        self.estimates.iter().find(|estimate| estimate.name == name)
    }

    /// The value of a name; NaN where the law has no such parameter.
    pub fn value(&self, name: &str) -> f64 {
        self.estimate(name).map_or(f64::NAN, |estimate| estimate.value)
    }

    /// Pairs of parameters whose estimates are correlated above [`CORRELATED`], with the correlation.
    pub fn correlated(&self) -> Vec<(&str, &str, f64)> {
        let mut pairs = Vec::new();
        for (i, row) in self.covariance.iter().enumerate() {
            for (j, entry) in row.iter().enumerate().take(i) {
                let r = entry / (self.covariance[i][i] * self.covariance[j][j]).sqrt();
                if r.abs() > CORRELATED {
                    pairs.push((self.estimates[j].name.as_str(), self.estimates[i].name.as_str(), r));
                }
            }
        }
        pairs
    }
}
