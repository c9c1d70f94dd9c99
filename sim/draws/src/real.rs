//! The float that `rand_distr` draws with: a double whose transcendental functions are those of [`math`], so that a
//! draw has the same bits on every platform.
//!
//! What IEEE 754 determines to the bit (the four operations, square roots, rounding) is the hardware's. The standard
//! deviate is drawn by the polar method (G. Marsaglia & T. A. Bray 1964, *SIAM Review* 6: 260–264), the standard
//! exponential by −ln u: `rand_distr` implements its tables for `f64` alone.

use num_traits::{Float, FloatConst, Num, NumCast, One, ToPrimitive, Zero};
use phytomer_sim::math;
use rand::distr::{Distribution, Open01, StandardUniform};
use rand::{Rng, RngExt};
use rand_distr::{Exp1, StandardNormal};
use std::num::FpCategory;
use std::ops::{Add, Div, Mul, Neg, Rem, Sub};

/// A double with the functions of [`math`].
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub struct Real(pub f64);

macro_rules! operations {
    ($($of:ident $name:ident),*) => {$(
        impl $of for Real {
            type Output = Self;
            #[inline]
            fn $name(self, other: Self) -> Self {
                Self(self.0.$name(other.0))
            }
        }
    )*};
}

operations!(Add add, Sub sub, Mul mul, Div div, Rem rem);

impl Neg for Real {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Zero for Real {
    fn zero() -> Self {
        Self(0.0)
    }

    fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
}

impl One for Real {
    fn one() -> Self {
        Self(1.0)
    }
}

impl Num for Real {
    type FromStrRadixErr = num_traits::ParseFloatError;

    fn from_str_radix(text: &str, radix: u32) -> Result<Self, Self::FromStrRadixErr> {
        f64::from_str_radix(text, radix).map(Self)
    }
}

impl ToPrimitive for Real {
    fn to_i64(&self) -> Option<i64> {
        self.0.to_i64()
    }

    fn to_u64(&self) -> Option<u64> {
        self.0.to_u64()
    }

    fn to_f64(&self) -> Option<f64> {
        Some(self.0)
    }
}

impl NumCast for Real {
    fn from<T: ToPrimitive>(number: T) -> Option<Self> {
        number.to_f64().map(Self)
    }
}

macro_rules! constants {
    ($($name:ident)*) => {
        #[allow(non_snake_case)]
        impl FloatConst for Real {
            $(fn $name() -> Self {
                Self(std::f64::consts::$name)
            })*
        }
    };
}

constants!(E FRAC_1_PI FRAC_1_SQRT_2 FRAC_2_PI FRAC_2_SQRT_PI FRAC_PI_2 FRAC_PI_3 FRAC_PI_4 FRAC_PI_6 FRAC_PI_8
    LN_10 LN_2 LOG10_E LOG2_E PI SQRT_2);

/// Functions of one number that IEEE 754 determines, and values.
macro_rules! exact {
    ($($name:ident)*) => {$(
        #[inline]
        fn $name(self) -> Self {
            Self(self.0.$name())
        }
    )*};
}

macro_rules! told {
    ($($name:ident)*) => {$(
        fn $name(self) -> bool {
            self.0.$name()
        }
    )*};
}

macro_rules! values {
    ($($name:ident $value:ident),*) => {$(
        fn $name() -> Self {
            Self(f64::$value)
        }
    )*};
}

/// Functions of one number from [`math`], each with its name there.
macro_rules! from_math {
    ($($name:ident $function:ident),*) => {$(
        #[inline]
        fn $name(self) -> Self {
            Self(math::$function(self.0))
        }
    )*};
}

impl Float for Real {
    exact!(floor ceil round trunc fract abs signum recip sqrt);
    told!(is_nan is_infinite is_finite is_normal is_sign_positive is_sign_negative);
    values!(nan NAN, infinity INFINITY, neg_infinity NEG_INFINITY, min_value MIN, max_value MAX,
        min_positive_value MIN_POSITIVE, epsilon EPSILON);
    from_math!(exp exp, exp2 exp2, exp_m1 expm1, ln log, ln_1p log1p, log2 log2, log10 log10, cbrt cbrt, sin sin,
        cos cos, tan tan, asin asin, acos acos, atan atan, sinh sinh, cosh cosh, tanh tanh, asinh asinh, acosh acosh,
        atanh atanh);

    fn neg_zero() -> Self {
        Self(-0.0)
    }

    fn classify(self) -> FpCategory {
        self.0.classify()
    }

    fn mul_add(self, factor: Self, addend: Self) -> Self {
        Self(math::fma(self.0, factor.0, addend.0))
    }

    /// By repeated squaring: the compiler's own order of multiplications differs between platforms.
    fn powi(self, exponent: i32) -> Self {
        let (mut power, mut square, mut left) = (1.0, self.0, exponent.unsigned_abs());
        while left > 0 {
            if left & 1 == 1 {
                power *= square;
            }
            square *= square;
            left >>= 1;
        }
        Self(if exponent < 0 { 1.0 / power } else { power })
    }

    fn powf(self, exponent: Self) -> Self {
        Self(math::pow(self.0, exponent.0))
    }

    fn log(self, base: Self) -> Self {
        Self(math::log(self.0) / math::log(base.0))
    }

    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }

    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0))
    }

    fn abs_sub(self, other: Self) -> Self {
        Self((self.0 - other.0).max(0.0))
    }

    fn hypot(self, other: Self) -> Self {
        Self(math::hypot(self.0, other.0))
    }

    fn atan2(self, other: Self) -> Self {
        Self(math::atan2(self.0, other.0))
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = math::sincos(self.0);
        (Self(sin), Self(cos))
    }

    fn integer_decode(self) -> (u64, i16, i8) {
        self.0.integer_decode()
    }
}

impl Distribution<Real> for StandardUniform {
    /// In [0, 1), from the upper 53 bits of a word.
    #[inline]
    fn sample<R: Rng + ?Sized>(&self, words: &mut R) -> Real {
        Real((words.next_u64() >> 11) as f64 * (0.5 / (1_u64 << 52) as f64))
    }
}

impl Distribution<Real> for Open01 {
    /// The middles of 2⁵² equal intervals of (0, 1).
    #[inline]
    fn sample<R: Rng + ?Sized>(&self, words: &mut R) -> Real {
        Real(((words.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64)
    }
}

impl Distribution<Real> for Exp1 {
    fn sample<R: Rng + ?Sized>(&self, words: &mut R) -> Real {
        -words.sample::<Real, _>(Open01).ln()
    }
}

impl Distribution<Real> for StandardNormal {
    /// The polar method; the second of its two deviates is given up.
    fn sample<R: Rng + ?Sized>(&self, words: &mut R) -> Real {
        loop {
            let mut side = || 2.0 * words.sample::<Real, _>(Open01).0 - 1.0;
            let (x, y) = (side(), side());
            let square = x * x + y * y;
            if square < 1.0 && square > 0.0 {
                return Real(x * (-2.0 * math::log(square) / square).sqrt());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every function that has bits of its own on other platforms is that of `sim::math`, to the bit.
    #[test]
    fn functions_are_those_of_math() {
        type Ways = (fn(Real) -> Real, fn(f64) -> f64);
        let ways: [Ways; 9] = [
            (Real::exp, math::exp),
            (Real::exp2, math::exp2),
            (Real::exp_m1, math::expm1),
            (Real::ln, math::log),
            (Real::ln_1p, math::log1p),
            (Real::log2, math::log2),
            (Real::log10, math::log10),
            (Real::sin, math::sin),
            (Real::cbrt, math::cbrt),
        ];
        for step in 1..5000_u32 {
            let x = step as f64 * 0.003_7;
            for (place, (ours, math)) in ways.iter().enumerate() {
                assert_eq!(ours(Real(x)).0.to_bits(), math(x).to_bits(), "function {place} at {x}");
            }
            assert_eq!(Real(x).powf(Real(1.7)).0.to_bits(), math::pow(x, 1.7).to_bits());
        }
    }

    #[test]
    fn whole_powers_and_conversions() {
        let powers = [0, 1, 2, 3, 10, -1, -3].map(|n| Real(2.0).powi(n).0);
        assert_eq!(powers, [1.0, 2.0, 4.0, 8.0, 1024.0, 0.5, 0.125]);
        assert_eq!(Real(10.0).powi(i32::MIN).0, 0.0);
        assert_eq!((Real(7.9).to_usize(), Real(-1.0).to_usize(), Real(f64::NAN).to_u64()), (Some(7), None, None));
        assert_eq!((Real(7.5) % Real(2.0), -Real(2.0), Real(3.0) - Real(1.0)), (Real(1.5), Real(-2.0), Real(2.0)));
    }
}
