//! Contrasts of two treatments: of pairs of plants that share their draws, and of plants that do not.
//!
//! Paired: the mean of the differences with Student's interval, and d_z = mean / sd of the differences. Unpaired:
//! Welch's interval (1947), and Cohen's d over the pooled deviation. Both effect sizes are corrected for small samples
//! by 1 − 3 / (4 df − 1) (Hedges 1981), with the large-sample interval of Hedges & Olkin (1985, §5.E): variances 1/n₁ +
//! 1/n₂ + d² / (2 (n₁ + n₂)), and for pairs 1/n + d² / (2n). Absent: more than two treatments (`variance`).

use crate::moments::{Estimate, Moments};
use crate::{Interval, Lack, quantile};

/// A difference of two means.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contrast {
    /// The difference, the second less the first.
    pub difference: Estimate,
    /// The degrees of freedom of its interval.
    pub df: f64,
    /// The probability of a difference as large where there is none; a lack where the values do not vary.
    pub p: Result<f64, Lack>,
    /// The standardised difference with its interval.
    pub effect: Result<Estimate, Lack>,
}

/// The contrast of pairs, from the moments of their differences, with intervals at `level`.
///
/// # Errors
/// [`Lack::Plants`] with fewer than two pairs.
pub fn paired(differences: &Moments, level: f64) -> Result<Contrast, Lack> {
    let difference = differences.mean_of_plants(level)?;
    let (n, df) = (differences.n as f64, (differences.n - 1) as f64);
    let deviation = differences.standard_deviation().filter(|deviation| *deviation > 0.0).ok_or(Lack::NoVariance);
    let effect = deviation.and_then(|deviation| effect(difference.value / deviation, df, 1.0 / n, 2.0 * n, level));
    Ok(Contrast { difference, df, p: p_of(&difference, df), effect })
}

/// The contrast of two groups of plants, with intervals at `level`.
///
/// # Errors
/// [`Lack::Plants`] where a group has fewer than two plants.
pub fn unpaired(first: &Moments, second: &Moments, level: f64) -> Result<Contrast, Lack> {
    let least = first.n.min(second.n);
    let variances = first.variance().zip(second.variance());
    let (v1, v2) = variances.ok_or(Lack::Plants { found: least, needed: 2 })?;
    let (n1, n2) = (first.n as f64, second.n as f64);
    let (e1, e2) = (v1 / n1, v2 / n2);
    let value = second.mean - first.mean;
    let standard_error = (e1 + e2).sqrt();
    // Satterthwaite (1946); where nothing varies the interval is a point and the degrees of freedom do not matter.
    let apart = e1 * e1 / (n1 - 1.0) + e2 * e2 / (n2 - 1.0);
    let df = if apart > 0.0 { (e1 + e2) * (e1 + e2) / apart } else { n1 + n2 - 2.0 };
    let half = quantile::t_for(level, df)? * standard_error;
    let difference = Estimate { value, standard_error, interval: Interval::about(value, half) };
    let pooled_df = n1 + n2 - 2.0;
    let pooled = ((first.squares() + second.squares()) / pooled_df).sqrt();
    let effect = match pooled > 0.0 {
        true => effect(value / pooled, pooled_df, 1.0 / n1 + 1.0 / n2, 2.0 * (n1 + n2), level),
        false => Err(Lack::NoVariance),
    };
    Ok(Contrast { difference, df, p: p_of(&difference, df), effect })
}

fn p_of(difference: &Estimate, df: f64) -> Result<f64, Lack> {
    match difference.standard_error > 0.0 {
        true => quantile::t_beyond(difference.value / difference.standard_error, df),
        false => Err(Lack::NoVariance),
    }
}

fn effect(d: f64, df: f64, variance_at_zero: f64, twice: f64, level: f64) -> Result<Estimate, Lack> {
    let value = d * (1.0 - 3.0 / (4.0 * df - 1.0));
    let standard_error = (variance_at_zero + value * value / twice).sqrt();
    let half = quantile::normal_for(level)? * standard_error;
    Ok(Estimate { value, standard_error, interval: Interval::about(value, half) })
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIRST: [f64; 10] = [0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0];
    const SECOND: [f64; 10] = [1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4];

    /// Student's (1908) sleep data. Paired: 1.58, 0.700 to 2.460, t 4.0621, p .002833. Welch: df 17.776, p .07939,
    /// −0.205 to 3.365 (R's `t.test`).
    #[test]
    fn students_sleep() {
        let differences: Vec<f64> = SECOND.iter().zip(FIRST).map(|(b, a)| b - a).collect();
        let pairs = paired(&Moments::of(&differences), 0.95).unwrap();
        assert!((pairs.difference.value - 1.58).abs() < 1e-12 && (pairs.p.unwrap() - 0.002_833).abs() < 1e-6);
        assert!((pairs.difference.interval.low - 0.700_114).abs() < 1e-6, "{pairs:?}");
        let apart = unpaired(&Moments::of(&FIRST), &Moments::of(&SECOND), 0.95).unwrap();
        assert!((apart.df - 17.776).abs() < 1e-3 && (apart.p.unwrap() - 0.079_39).abs() < 1e-5);
        assert!((apart.difference.interval.low + 0.205_483).abs() < 1e-6);
        // Cohen's d .8322; corrected by 1 − 3/71.
        assert!((apart.effect.unwrap().value - 0.832_181 * (1.0 - 3.0 / 71.0)).abs() < 1e-5, "{apart:?}");
    }

    #[test]
    fn what_is_missing_is_said() {
        let (one, equal) = (Moments::of(&[1.0]), Moments::of(&[2.0, 2.0]));
        assert_eq!(paired(&one, 0.95), Err(Lack::Plants { found: 1, needed: 2 }));
        assert_eq!(unpaired(&one, &equal, 0.95), Err(Lack::Plants { found: 1, needed: 2 }));
        let none = unpaired(&equal, &equal, 0.95).unwrap();
        assert_eq!((none.p, none.effect), (Err(Lack::NoVariance), Err(Lack::NoVariance)));
    }
}
