//! Special functions: logarithms of factorials, tails and quantiles of the χ², normal, Student and beta distributions.
//!
//! The tails are those of the crate statrs, held to scipy at 10⁻¹⁰ (relative) by the table of `tests/scipy.rs`; the
//! logarithms are libm's, by `phytomer_sim::math`. Absent: distributions that no estimator of this crate needs.

use phytomer_sim::math;
use statrs::function::{beta, erf, gamma};
use std::sync::OnceLock;

/// The whole numbers whose factorials are kept.
const KEPT: usize = 1024;

/// ln Γ(x + 1), for x of 0 or more.
pub fn ln_factorial(x: f64) -> f64 {
    static TABLE: OnceLock<Vec<f64>> = OnceLock::new();
    if x < KEPT as f64 && x.fract() == 0.0 && x >= 0.0 {
        let fill = || (0..KEPT).map(|k| math::lgamma(k as f64 + 1.0)).collect();
        return TABLE.get_or_init(fill)[x as usize];
    }
    math::lgamma(x + 1.0)
}

/// ln of n over k.
pub fn ln_choose(n: f64, k: f64) -> f64 {
    ln_factorial(n) - ln_factorial(k) - ln_factorial(n - k)
}

/// x ln y, which is 0 where x is 0.
pub fn x_ln_y(x: f64, y: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x * math::log(y) }
}

/// The probability that χ² with `df` degrees of freedom exceeds `x`.
pub fn chi2_tail(x: f64, df: f64) -> f64 {
    if x <= 0.0 { 1.0 } else { gamma::gamma_ur(df / 2.0, x / 2.0) }
}

/// The probability that a standard normal number is at most `x`.
pub fn normal_below(x: f64) -> f64 {
    0.5 * erf::erfc(-x / std::f64::consts::SQRT_2)
}

/// The standard normal number that a share `p` of all is below, for p in (0, 1).
pub fn normal_quantile(p: f64) -> f64 {
    -std::f64::consts::SQRT_2 * erf::erfc_inv(2.0 * p)
}

/// The probability that a number of the beta distribution of `a` and `b` is at most `x`.
pub fn beta_below(a: f64, b: f64, x: f64) -> f64 {
    beta::beta_reg(a, b, x.clamp(0.0, 1.0))
}

/// The number that a share `p` of the beta distribution of `a` and `b` is below: bisection of [`beta_below`], to the
/// last bit or to 2⁻¹²⁰.
pub fn beta_quantile(a: f64, b: f64, p: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..120 {
        let middle = 0.5 * (low + high);
        if middle == low || middle == high {
            return middle;
        }
        if beta_below(a, b, middle) < p { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The probability that Student's t with `df` degrees of freedom exceeds `t` in size.
pub fn student_both_tails(t: f64, df: f64) -> f64 {
    beta_below(df / 2.0, 0.5, df / (df + t * t))
}

/// The exact interval of a proportion of `successes` in `n` (Clopper & Pearson 1934) with a share `outside` beyond it.
pub fn proportion_interval(successes: f64, n: f64, outside: f64) -> [f64; 2] {
    let low = if successes <= 0.0 { 0.0 } else { beta_quantile(successes, n - successes + 1.0, outside / 2.0) };
    let high = if successes >= n { 1.0 } else { beta_quantile(successes + 1.0, n - successes, 1.0 - outside / 2.0) };
    [low, high]
}
