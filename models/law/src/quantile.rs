//! The normal distribution: its quantile, its distribution function and its density.
//!
//! The quantile is Wichura's AS 241 (Applied Statistics 37, 1988), PPND16, to 1e-16; the coefficients have all the
//! digits of the printed ones. Its branch for the far tail is left out: no 32-bit word reaches it. Draws interpolate a
//! table of the quantile for the middle 97 % of the words.

#![allow(clippy::excessive_precision)]

use phytomer_sim::math;
use phytomer_sim::random::share;
use std::sync::LazyLock;

/// Φ, to 1e-16 absolute.
pub(super) fn phi(z: f64) -> f64 {
    0.5 * (1.0 + math::erf(z * std::f64::consts::FRAC_1_SQRT_2))
}

/// φ.
pub(super) fn density(z: f64) -> f64 {
    math::exp(-0.5 * z * z) / (2.0 * std::f64::consts::PI).sqrt()
}

/// Wichura 1988, AS 241, PPND16: numerators and denominators by rising power, centre and near tail.
const CENTRE: [[f64; 8]; 2] = [
    [
        3.387132872796366608,
        133.14166789178437745,
        1971.5909503065514427,
        13731.693765509461125,
        45921.953931549871457,
        67265.770927008700853,
        33430.575583588128105,
        2509.0809287301226727,
    ],
    [
        1.0,
        42.313330701600911252,
        687.1870074920579083,
        5394.1960214247511077,
        21213.794301586595867,
        39307.89580009271061,
        28729.085735721942674,
        5226.495278852854561,
    ],
];
const TAIL: [[f64; 8]; 2] = [
    [
        1.42343711074968357734,
        4.6303378461565452959,
        5.7694972214606914055,
        3.64784832476320460504,
        1.27045825245236838258,
        0.24178072517745061177,
        0.0227238449892691845833,
        7.7454501427834140764e-4,
    ],
    [
        1.0,
        2.05319162663775882187,
        1.6763848301838038494,
        0.68976733498510000455,
        0.14810397642748007459,
        0.0151986665636164571966,
        5.475938084995344946e-4,
        1.05075007164441684324e-9,
    ],
];

fn ratio([above, below]: &[[f64; 8]; 2], r: f64) -> f64 {
    let value = |powers: &[f64; 8]| powers.iter().rev().fold(0.0, |sum, power| sum * r + power);
    value(above) / value(below)
}

/// The normal quantile of a fraction in [2⁻³³, 1 − 2⁻³³].
pub(super) fn quantile(fraction: f64) -> f64 {
    let q = fraction - 0.5;
    if q.abs() <= 0.425 {
        return q * ratio(&CENTRE, 0.180625 - q * q);
    }
    let r = (-math::log(fraction.min(1.0 - fraction))).sqrt();
    let z = ratio(&TAIL, r - 1.6);
    if q < 0.0 { -z } else { z }
}

/// The high bits of a word that name its bin.
const BIN_BITS: u32 = 12;
/// The bits within a bin.
const WITHIN: u32 = 32 - BIN_BITS;
/// The outer bins, at either end, in which a chord is too far from the curve.
const TAIL_BINS: usize = 64;

const BINS: usize = 1 << BIN_BITS;

/// The quantile at the lower end of each bin.
static ENDS: LazyLock<Box<[f64; BINS + 1]>> = LazyLock::new(|| {
    let end = |bin: usize| quantile((bin as f64 / BINS as f64).clamp(1e-9, 1.0 - 1e-9));
    Box::new(std::array::from_fn(end))
});

/// Normal deviates; whoever makes one draws many.
#[derive(Clone, Copy)]
pub(super) struct Deviates(&'static [f64; BINS + 1]);

impl Deviates {
    #[inline]
    pub fn new() -> Self {
        Self(&ENDS)
    }

    /// The normal deviate of a uniform 32-bit word: chords of 2⁻¹² in the middle, within 1.2e-5 of the quantile, and
    /// the quantile itself beyond ±2.15.
    #[inline(always)]
    pub fn of(self, word: u32) -> f64 {
        let bin = (word >> WITHIN) as usize;
        if bin.wrapping_sub(TAIL_BINS) >= BINS - 2 * TAIL_BINS {
            return far(word);
        }
        let (low, high) = (self.0[bin], self.0[bin + 1]);
        let within = f64::from(word & ((1 << WITHIN) - 1)) * (1.0 / f64::from(1_u32 << WITHIN));
        low + (high - low) * within
    }
}

#[inline(never)]
fn far(word: u32) -> f64 {
    quantile(share(word))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deviates_follow_the_quantile_and_rise_with_the_word() {
        let (deviates, mut before) = (Deviates::new(), f64::NEG_INFINITY);
        for i in 0..200_000_u32 {
            let word = i.wrapping_mul(21_474);
            let (drawn, exact) = (deviates.of(word), quantile(share(word)));
            assert!((drawn - exact).abs() < 1.2e-5, "{word}: {drawn} is not {exact}");
            assert!(drawn >= before, "{word}");
            before = drawn;
        }
    }

    #[test]
    fn the_quantile_inverts_the_distribution_function() {
        for i in 0..4096_u32 {
            let fraction = (f64::from((i << 20).saturating_sub(i & 1)) + 0.5) / 4_294_967_296.0;
            assert!((phi(quantile(fraction)) - fraction).abs() < 1e-15, "{fraction}");
        }
        assert!((quantile(0.975) - 1.959963984540054).abs() < 1e-14);
        assert!((quantile(1e-9) + 5.997807015007688).abs() < 1e-12);
    }
}
