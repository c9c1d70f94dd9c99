//! Quantiles and tails of the normal, t, F and chi-squared distributions, by `statrs`, and Student's distribution about
//! another centre, whose tail `statrs` does not have.
//!
//! A level of 0.95 asks for the point that leaves 0.025 on each side. Absent: densities.

use crate::Lack;
use phytomer_sim::math::{erf, exp, lgamma, log};
use statrs::distribution::{ChiSquared, Continuous, ContinuousCDF, FisherSnedecor, Normal, StudentsT};
use std::f64::consts::SQRT_2;

/// With more degrees of freedom Student's quantile is taken from the series about the normal one (Abramowitz & Stegun
/// 26.7.5), within 1e-10; the search of `statrs` loses digits with their number, and does not end for very many.
const MANY: f64 = 1000.0;

/// The share of the standard normal distribution below `z`.
pub fn normal_below(z: f64) -> f64 {
    0.5 * (1.0 + erf(z / SQRT_2))
}

/// The quantile of the standard normal distribution below which lies the share `p`.
///
/// # Errors
/// [`Lack::OutOfRange`] where `p` is not between 0 and 1.
pub fn normal(p: f64) -> Result<f64, Lack> {
    if !(p > 0.0 && p < 1.0) {
        return Err(Lack::OutOfRange);
    }
    finite(Normal::new(0.0, 1.0).ok().map(|normal| normal.inverse_cdf(p)))
}

/// The half width, in standard errors, of an interval at `level` by the normal distribution.
///
/// # Errors
/// [`Lack::OutOfRange`] where the level is not between 0 and 1.
pub fn normal_for(level: f64) -> Result<f64, Lack> {
    normal(0.5 + 0.5 * level)
}

/// The half width, in standard errors, of an interval at `level` by Student's t with `df` degrees of freedom.
///
/// # Errors
/// [`Lack::OutOfRange`] where the level is not between 0 and 1 or there is no degree of freedom.
pub fn t_for(level: f64, df: f64) -> Result<f64, Lack> {
    if !(level > 0.0 && level < 1.0 && df > 0.0) {
        return Err(Lack::OutOfRange);
    }
    if df > MANY {
        let z = normal_for(level)?;
        let z2 = z * z;
        let first = (z2 + 1.0) / 4.0;
        let second = ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0;
        let third = (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0;
        return Ok(z * (1.0 + (first + (second + third / df) / df) / df));
    }
    let student = StudentsT::new(0.0, 1.0, df).map_err(|_| Lack::OutOfRange)?;
    let start = student.inverse_cdf(0.5 + 0.5 * level);
    // Two steps of Newton give back the digits that the search loses.
    finite(Some((0..2).fold(start, |t, _| t + (student.sf(t) - (0.5 - 0.5 * level)) / student.pdf(t))))
}

/// The probability of a t at least as far from 0.
///
/// # Errors
/// [`Lack::OutOfRange`] where there is no degree of freedom or `t` is no number.
pub fn t_beyond(t: f64, df: f64) -> Result<f64, Lack> {
    if !(t.is_finite() && df > 0.0) {
        return Err(Lack::OutOfRange);
    }
    finite(StudentsT::new(0.0, 1.0, df).ok().map(|student| 2.0 * student.sf(t.abs())))
}

/// The probability of an F at least as large.
///
/// # Errors
/// [`Lack::OutOfRange`] where a number of degrees of freedom is not positive or `f` is negative.
pub fn f_above(f: f64, df1: f64, df2: f64) -> Result<f64, Lack> {
    if !(f >= 0.0 && f.is_finite() && df1 > 0.0 && df2 > 0.0) {
        return Err(Lack::OutOfRange);
    }
    finite(FisherSnedecor::new(df1, df2).ok().map(|fisher| fisher.sf(f)))
}

/// The quantile of F below which lies the share `p`.
///
/// # Errors
/// [`Lack::OutOfRange`] where `p` is not between 0 and 1 or a number of degrees of freedom is not positive.
pub fn f(p: f64, df1: f64, df2: f64) -> Result<f64, Lack> {
    if !(p > 0.0 && p < 1.0 && df1 > 0.0 && df2 > 0.0) {
        return Err(Lack::OutOfRange);
    }
    if df1 == 1.0 {
        return t_for(p, df2).map(|t| t * t);
    }
    // Bisection of the tail, since the search of `statrs` does not end for many degrees of freedom.
    let fisher = FisherSnedecor::new(df1, df2).map_err(|_| Lack::OutOfRange)?;
    let below = |f: f64| fisher.sf(f) > 1.0 - p;
    let (mut low, mut high) = (0.0, 1.0);
    while below(high) && high < 1e12 {
        (low, high) = (high, 2.0 * high);
    }
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if below(middle) { low = middle } else { high = middle }
    }
    finite(Some(0.5 * (low + high)))
}

/// The probability of a χ² at least as large.
///
/// # Errors
/// [`Lack::OutOfRange`] where there is no degree of freedom or `chi2` is negative.
pub fn chi2_above(chi2: f64, df: f64) -> Result<f64, Lack> {
    if !(chi2 >= 0.0 && chi2.is_finite() && df > 0.0) {
        return Err(Lack::OutOfRange);
    }
    finite(ChiSquared::new(df).ok().map(|squared| squared.sf(chi2)))
}

/// The share below `t` of Student's distribution with `df` degrees of freedom about the noncentrality `delta`: ∫ Φ(t s
/// − δ) f(s) ds, where s = √(χ²/ν) (Johnson, Kotz & Balakrishnan 1995, ch. 31). Simpson's rule over ten standard
/// deviations of s; within 1e-9 for 2 degrees of freedom and more.
pub fn noncentral_t_below(t: f64, df: f64, delta: f64) -> f64 {
    const STEPS: usize = 2000;
    let spread = 10.0 / (2.0 * df).sqrt();
    let (low, high) = ((1.0 - spread).max(0.0), 1.0 + spread);
    let step = (high - low) / STEPS as f64;
    let constant = std::f64::consts::LN_2 + 0.5 * df * log(0.5 * df) - lgamma(0.5 * df);
    let at = |s: f64| match s > 0.0 {
        true => exp(constant + (df - 1.0) * log(s) - 0.5 * df * s * s) * normal_below(t * s - delta),
        false => 0.0,
    };
    let weight = |i: usize| [1.0, 2.0, 4.0][if i == 0 || i == STEPS { 0 } else { 1 + i % 2 }];
    let sum: f64 = (0..=STEPS).map(|i| weight(i) * at(low + i as f64 * step)).sum();
    (sum * step / 3.0).clamp(0.0, 1.0)
}

fn finite(value: Option<f64>) -> Result<f64, Lack> {
    value.filter(|value| value.is_finite()).ok_or(Lack::OutOfRange)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of scipy 1.17 (`stats.t.ppf`, `stats.norm.ppf`, `stats.f.sf`, `stats.f.ppf`, `stats.chi2.sf`,
    /// `stats.nct.cdf`).
    #[test]
    fn quantiles_are_those_of_scipy() {
        let near = |value: f64, scipy: f64| assert!((value / scipy - 1.0).abs() < 1e-9, "{value} is not {scipy}");
        near(t_for(0.95, 1.0).unwrap(), 12.706204736174694);
        near(t_for(0.95, 7.0).unwrap(), 2.364624251592785);
        near(t_for(0.99, 255.0).unwrap(), 2.5952464847916277);
        near(t_for(0.95, 999.0).unwrap(), 1.9623414611334493);
        near(t_for(0.95, 1001.0).unwrap(), 1.9623367052808798);
        near(t_for(0.95, 1e9).unwrap(), 1.959963986912325);
        near(f(0.975, 30.0, 200.0).unwrap(), 1.640281872367043);
        // The tail of `statrs` loses digits with the degrees of freedom.
        assert!((f(0.025, 9.0, 20_000_000.0).unwrap() - 0.30004324552387107).abs() < 1e-7);
        near(normal_for(0.95).unwrap(), 1.959963984540054);
        near(f_above(40.1219, 2.0, 135.0).unwrap(), 2.1120804397126132e-14);
        near(f(0.95, 1.0, 562.0).unwrap(), 3.85805829948464);
        near(chi2_above(16.793, 1.0).unwrap(), 4.168679471886338e-05);
        near(noncentral_t_below(1.979, 126.0, 2.828), 0.1986677052962854);
    }

    #[test]
    fn what_is_out_of_range_is_said() {
        for bad in [f64::NAN, 0.0, 1.0, -1.0] {
            assert_eq!((normal(bad), t_for(bad, 3.0)), (Err(Lack::OutOfRange), Err(Lack::OutOfRange)));
        }
        assert_eq!((t_for(0.95, 0.0), f_above(1.0, 0.0, 3.0)), (Err(Lack::OutOfRange), Err(Lack::OutOfRange)));
    }
}
