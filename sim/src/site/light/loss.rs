//! What a beam loses on its way through leaves: 1 − e^(−x), by series and doublings, for one beam and for four at once.
//! Absent: what x is (`beam`, `sweep`).

use crate::math::exp;

/// One number for each of two beams.
pub type Pair = [f64; 2];

/// Below this the series alone is enough.
const SMALL: f64 = 0.1;
/// Below this the series of a sixteenth is, doubled four times.
pub(super) const MIDDLE: f64 = 1.6;
/// The terms of (1 − e^(−x)) / x: 1, −1/2!, 1/3!, …
pub(super) const SERIES: [f64; 8] =
    [1.0, -1.0 / 2.0, 1.0 / 6.0, -1.0 / 24.0, 1.0 / 120.0, -1.0 / 720.0, 1.0 / 5_040.0, -1.0 / 40_320.0];
/// 1 − e^(−x), for x of 0 or more, to 3 · 10⁻¹⁴ of it.
#[inline]
pub fn lost(x: f64) -> f64 {
    if x < SMALL { series([x; 2])[0] } else { 1.0 - exp(-x) }
}

/// The series up to x⁸: off by less than 3 · 10⁻¹⁴ of its value up to a tenth.
#[inline(always)]
fn series(x: Pair) -> Pair {
    let square = times(x, x);
    let fourth = times(square, square);
    let pair = |k: usize| plus([SERIES[k]; 2], times(x, [SERIES[k + 1]; 2]));
    let low = plus(pair(0), times(square, pair(2)));
    let high = plus(pair(4), times(square, pair(6)));
    times(x, plus(low, times(fourth, high)))
}

/// [`lost`] of twice two numbers. Those that are not large are found without an exponential: of 2 x is lost what is
/// lost of x, and the same share of the rest.
#[inline(always)]
pub fn lost_of_each(x: [Pair; 2]) -> [Pair; 2] {
    let [one, other] = x;
    let large = larger(larger(one[0], one[1]), larger(other[0], other[1]));
    if large < MIDDLE {
        return [doubled_up(one), doubled_up(other)];
    }
    x.map(|x| x.map(lost))
}

#[inline(always)]
fn larger(one: f64, other: f64) -> f64 {
    if one > other { one } else { other }
}

#[inline(always)]
fn doubled_up(x: Pair) -> Pair {
    doubled(doubled(doubled(doubled(series(times(x, [0.0625; 2]))))))
}

#[inline(always)]
fn doubled(lost: Pair) -> Pair {
    times(lost, [2.0 - lost[0], 2.0 - lost[1]])
}

/// The sums of two pairs.
#[inline(always)]
pub fn plus(one: Pair, other: Pair) -> Pair {
    [one[0] + other[0], one[1] + other[1]]
}

/// The products of two pairs.
#[inline(always)]
pub fn times(one: Pair, other: Pair) -> Pair {
    [one[0] * other[0], one[1] * other[1]]
}

/// The larger numbers of two pairs.
#[inline(always)]
pub fn larger_of(one: Pair, other: Pair) -> Pair {
    [0, 1].map(|lane| if one[lane] > other[lane] { one[lane] } else { other[lane] })
}

/// The smaller numbers of two pairs.
#[inline(always)]
pub fn smaller_of(one: Pair, other: Pair) -> Pair {
    [0, 1].map(|lane| if one[lane] < other[lane] { one[lane] } else { other[lane] })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_lost_is_known() {
        for k in 0..40_000_u32 {
            let x = f64::from(k) * f64::from(k) * 1e-8;
            let known = -crate::math::expm1(-x);
            let [[one, none], [of_half, other]] = lost_of_each([[x, 0.0], [0.5 * x, x]]);
            for found in [lost(x), one, other] {
                assert!((found - known).abs() <= 3e-14 * known, "{x}: {found} {known}");
            }
            assert_eq!(none, 0.0);
            assert!((of_half + crate::math::expm1(-0.5 * x)).abs() <= 3e-14 * of_half, "{x}");
        }
    }
}
