//! Every transcendental function that the project uses, from `libm`: the same bits on every platform.
//!
//! The standard library's come from the system and differ in the last bit between machines; a clippy list forbids
//! them. Square roots, divisions and the four operations are exact by IEEE 754 and need no wrapper.

pub use libm::{
    acos, acosh, asin, asinh, atan, atan2, atanh, cbrt, cos, cosh, erf, exp, exp2, expm1, fma, fmod, hypot, lgamma,
    log, log1p, log2, log10, pow, sin, sincos, sinh, tan, tanh,
};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

pub use libm::{acosf, asinf, atan2f, cosf, expf, logf, powf, sincosf, sinf};

/// Sine and cosine of an angle in [0, π], exact at 0, π/2 and π and within 10⁻¹⁰ elsewhere: polynomials about the
/// nearest of the three, without the range reduction of [`sincos`], for what turns at every internode.
#[inline(always)]
pub fn sincos_half_turn(angle: f64) -> (f64, f64) {
    if angle < FRAC_PI_4 {
        sincos_near_zero(angle)
    } else if angle < 3.0 * FRAC_PI_4 {
        let (sin, cos) = sincos_near_zero(angle - FRAC_PI_2);
        (cos, 0.0 - sin)
    } else {
        let (sin, cos) = sincos_near_zero(angle - PI);
        (0.0 - sin, -cos)
    }
}

/// The minimax polynomials of FreeBSD's msun for single precision (k_sinf.c, k_cosf.c): within π/4 they are off by
/// 5·10⁻¹² and 5.4·10⁻¹¹ in double precision.
#[inline(always)]
fn sincos_near_zero(x: f64) -> (f64, f64) {
    const SIN: [f64; 4] =
        [-0.166_666_666_416_265_24, 0.008_333_329_385_889_463, -0.000_198_393_348_360_966_32, 2.718_311_493_989_822e-6];
    const COS: [f64; 4] =
        [-0.499_999_997_251_031, 0.041_666_623_323_739_06, -0.001_388_676_377_460_993, 2.439_044_879_627_741e-5];
    let square = x * x;
    let sum = |c: &[f64; 4]| (c[0] + square * c[1]) + square * square * (c[2] + square * c[3]);
    (x + x * square * sum(&SIN), 1.0 + square * sum(&COS))
}

/// The angle in [0, π] of this sine and cosine, which are those of a unit vector: within 2·10⁻¹², exact at 0 and π.
/// Four times the arc tangent of that of its quarter, by the polynomial through the Chebyshev points.
#[inline]
pub fn half_turn_of(sin: f64, cos: f64) -> f64 {
    const SERIES: [f64; 8] = [
        0.999_999_999_999_244_5,
        -0.333_333_332_769_163_7,
        0.199_999_930_531_458_8,
        -0.142_853_865_415_210_17,
        0.111_034_567_232_019_83,
        -0.089_925_514_163_116_17,
        0.069_741_916_761_703_96,
        -0.037_655_009_949_235_4,
    ];
    let half = sin / (1.0 + cos.abs());
    let quarter = half / (1.0 + (1.0 + half * half).sqrt());
    let square = quarter * quarter;
    let [a, b, c, d, e, f, g, h] = SERIES;
    let fourth = square * square;
    let sum = (a + square * b) + fourth * ((c + square * d) + fourth * ((e + square * f) + fourth * (g + square * h)));
    let angle = 4.0 * quarter * sum;
    if cos < 0.0 { PI - angle } else { angle }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_turn_of_sines_and_cosines() {
        for step in 0..=20_000 {
            let angle = PI * f64::from(step) / 20_000.0;
            let ((sin, cos), (s, c)) = (sincos_half_turn(angle), sincos(angle));
            assert!((half_turn_of(s, c) - angle).abs() < 2e-12, "{angle}");
            assert!((sin - s).abs() < 1e-10 && (cos - c).abs() < 1e-10, "{angle}: {sin} {cos}");
        }
        assert_eq!([(0.0, 1.0), (0.0, -1.0)].map(|(sin, cos)| half_turn_of(sin, cos)), [0.0, PI]);
        let exact = [0.0, FRAC_PI_2, PI].map(sincos_half_turn);
        assert_eq!(exact, [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0)]);
    }
}
