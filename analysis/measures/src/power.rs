//! How many plants show a wanted difference, in pairs that share their draws or in groups that do not.
//!
//! The power of Student's two-sided test by the noncentral t distribution (Cohen 1988, ch. 2): with n pairs the
//! noncentrality is d √n and there are n − 1 degrees of freedom; with n plants in each of two groups d √(n/2) and
//! 2n − 2. d is the difference over the standard deviation, of differences or of plants. Absent: more than two groups.

use crate::{Lack, quantile};

/// How two treatments are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Design {
    /// Pairs of plants.
    Paired,
    /// Two groups with equal numbers of plants.
    Unpaired,
}

/// The most plants that are looked for.
const MOST: u64 = 1 << 40;

impl Design {
    fn df(self, n: f64) -> f64 {
        match self {
            Self::Paired => n - 1.0,
            Self::Unpaired => 2.0 * n - 2.0,
        }
    }

    fn noncentrality(self, d: f64, n: f64) -> f64 {
        match self {
            Self::Paired => d * n.sqrt(),
            Self::Unpaired => d * (0.5 * n).sqrt(),
        }
    }
}

/// The probability that a two-sided test at the error `alpha` finds the standardised difference `d` with `n` pairs, or
/// `n` plants a group.
///
/// # Errors
/// [`Lack::OutOfRange`] where `n` is below 2, `alpha` not between 0 and 1, or `d` no number.
pub fn power(design: Design, d: f64, n: u64, alpha: f64) -> Result<f64, Lack> {
    if n < 2 || !d.is_finite() {
        return Err(Lack::OutOfRange);
    }
    let df = design.df(n as f64);
    let delta = design.noncentrality(d.abs(), n as f64);
    let t = quantile::t_for(1.0 - alpha, df)?;
    let beyond = 1.0 - quantile::noncentral_t_below(t, df, delta) + quantile::noncentral_t_below(-t, df, delta);
    Ok(beyond.clamp(0.0, 1.0))
}

/// The least number of pairs, or of plants a group, with which the standardised difference `d` is found with the
/// probability `wanted`.
///
/// # Errors
/// [`Lack::NoVariance`] for no difference, [`Lack::OutOfRange`] where `wanted` is not between `alpha` and 1, or where
/// more than 2⁴⁰ plants would be needed.
pub fn plants(design: Design, d: f64, wanted: f64, alpha: f64) -> Result<u64, Lack> {
    if d == 0.0 {
        return Err(Lack::NoVariance);
    }
    if !(alpha > 0.0 && wanted > alpha && wanted < 1.0 && d.is_finite()) {
        return Err(Lack::OutOfRange);
    }
    let mut enough = 2;
    while power(design, d, enough, alpha)? < wanted {
        enough *= 2;
        if enough > MOST {
            return Err(Lack::OutOfRange);
        }
    }
    // Too few, or 1 where two are enough.
    let mut few = enough / 2;
    while enough - few > 1 {
        let middle = few + (enough - few) / 2;
        if power(design, d, middle, alpha)? < wanted { few = middle } else { enough = middle }
    }
    Ok(enough)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cohen (1988), tables 2.3 and 2.4: half a standard deviation at 80 %.
    #[test]
    fn half_a_deviation_needs_64_a_group_or_34_pairs() {
        assert_eq!(plants(Design::Unpaired, 0.5, 0.8, 0.05), Ok(64));
        assert_eq!(plants(Design::Paired, 0.5, 0.8, 0.05), Ok(34));
        assert_eq!(plants(Design::Unpaired, 0.2, 0.8, 0.05), Ok(394));
        assert_eq!(plants(Design::Unpaired, 0.8, 0.8, 0.05), Ok(26));
        assert!((power(Design::Unpaired, 0.5, 64, 0.05).unwrap() - 0.801_46).abs() < 1e-5);
    }

    #[test]
    fn what_is_out_of_range_is_said() {
        assert_eq!(plants(Design::Paired, 0.0, 0.8, 0.05), Err(Lack::NoVariance));
        assert_eq!(plants(Design::Paired, 1e-9, 0.8, 0.05), Err(Lack::OutOfRange));
        assert_eq!(plants(Design::Paired, 50.0, 0.8, 0.05), Ok(2));
        assert_eq!(plants(Design::Paired, f64::NAN, 0.8, 0.05), Err(Lack::OutOfRange));
    }
}
