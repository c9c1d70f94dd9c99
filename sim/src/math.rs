//! Every transcendental function that the project uses, from `libm`: the same bits on every platform.
//!
//! The standard library's come from the system and differ in the last bit between machines; a clippy list forbids
//! them. Square roots, divisions and the four operations are exact by IEEE 754 and need no wrapper.

pub use libm::{
    acos, asin, atan2, cbrt, cos, erf, exp, exp2, expm1, fmod, lgamma, log, log1p, log2, pow, sin, sincos, tan,
};
pub use libm::{acosf, asinf, atan2f, cosf, expf, logf, powf, sincosf, sinf};
