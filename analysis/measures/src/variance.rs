//! Variance within and between groups of plants: the one-way analysis of variance and its components (Searle, Casella &
//! McCulloch 1992, §3.6; for unequal groups §3.6e).
//!
//! F = MSB / MSW. Between groups σ²ₐ = (MSB − MSW) / n₀, n₀ = (N − Σn²/N) / (a − 1); a negative estimate is told as it
//! is. The share between groups is the intraclass correlation, with the interval of Searle (1971, p. 414), which is
//! exact for equal groups. Absent: several crossed factors.

use crate::{Interval, Lack, Moments, quantile};

/// The components of variance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Components {
    /// The number of groups.
    pub groups: u64,
    /// The number of values.
    pub n: u64,
    /// The mean square between groups.
    pub between_square: f64,
    /// The mean square within groups: the variance within.
    pub within: f64,
    /// F with its two degrees of freedom.
    pub f: Result<f64, Lack>,
    /// The degrees of freedom between and within.
    pub df: [u64; 2],
    /// The probability of an F at least as large where groups do not differ.
    pub p: Result<f64, Lack>,
    /// The variance between groups; negative where groups differ less than chance lets them.
    pub between: f64,
    /// The share of the variance between groups.
    pub intraclass: Result<f64, Lack>,
    /// Its interval.
    pub interval: Result<Interval, Lack>,
}

/// The components of variance between and within groups, with an interval at `level`. Groups without values are left
/// out.
///
/// # Errors
/// [`Lack::Groups`] with fewer than two groups, [`Lack::Values`] where no group has two values.
pub fn components(groups: &[Moments], level: f64) -> Result<Components, Lack> {
    let groups: Vec<&Moments> = groups.iter().filter(|group| group.n > 0).collect();
    let a = groups.len() as u64;
    if a < 2 {
        return Err(Lack::Groups { found: a, needed: 2 });
    }
    let mut whole = Moments::default();
    groups.iter().for_each(|group| whole.merge(group));
    let n = whole.n;
    if n <= a {
        return Err(Lack::Values { found: n, needed: a + 1 });
    }
    let df = [a - 1, n - a];
    let squares: f64 = groups.iter().map(|group| group.squares()).sum();
    let apart = |group: &&Moments| (group.mean - whole.mean) * (group.mean - whole.mean) * group.n as f64;
    let between_square = groups.iter().map(apart).sum::<f64>() / df[0] as f64;
    let within = squares / df[1] as f64;
    let of_squares: f64 = groups.iter().map(|group| (group.n * group.n) as f64).sum();
    let n0 = (n as f64 - of_squares / n as f64) / df[0] as f64;
    let f = if within > 0.0 { Ok(between_square / within) } else { Err(Lack::NoVariance) };
    let [df1, df2] = df.map(|df| df as f64);
    let between = (between_square - within) / n0;
    let all = between + within;
    let intraclass = if all > 0.0 { Ok(between / all) } else { Err(Lack::NoVariance) };
    let interval = f.and_then(|f| {
        let tail = 0.5 - 0.5 * level;
        let end = |quantile: f64| (f / quantile - 1.0) / (f / quantile - 1.0 + n0);
        Ok(Interval { low: end(quantile::f(1.0 - tail, df1, df2)?), high: end(quantile::f(tail, df1, df2)?) })
    });
    let p = f.and_then(|f| quantile::f_above(f, df1, df2));
    Ok(Components { groups: a, n, between_square, within, f, df, p, between, intraclass, interval })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rao's (1973) and Snedecor & Cochran's (1989, table 13.3.1) turnip leaves: calcium of four leaves of four
    /// determinations; MSB .2961, MSW .0066, F 44.9, between .0724.
    #[test]
    fn the_turnip_leaves_of_snedecor_and_cochran() {
        let leaves =
            [[3.28, 3.09, 3.03, 3.03], [3.52, 3.48, 3.38, 3.38], [2.88, 2.80, 2.81, 2.76], [3.34, 3.38, 3.23, 3.26]];
        let found = components(&leaves.map(|leaf| Moments::of(&leaf)), 0.95).unwrap();
        assert!((found.between_square - 0.2961).abs() < 5e-5 && (found.within - 0.0066).abs() < 5e-5, "{found:?}");
        assert!((found.f.unwrap() - 44.85).abs() < 0.01 && (found.between - 0.0724).abs() < 5e-5);
        assert!(found.interval.unwrap().holds(found.intraclass.unwrap()) && found.df == [3, 12]);
    }

    #[test]
    fn what_is_missing_is_said() {
        let one = Moments::of(&[1.0]);
        assert_eq!(components(&[one, Moments::default()], 0.95), Err(Lack::Groups { found: 1, needed: 2 }));
        assert_eq!(components(&[one, one], 0.95), Err(Lack::Values { found: 2, needed: 3 }));
        let equal = components(&[Moments::of(&[1.0, 1.0]), Moments::of(&[1.0, 1.0])], 0.95).unwrap();
        assert_eq!(
            (equal.f, equal.intraclass, equal.interval),
            (Err(Lack::NoVariance), Err(Lack::NoVariance), Err(Lack::NoVariance))
        );
    }
}
