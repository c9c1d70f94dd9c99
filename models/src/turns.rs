//! Divergences that have a name: the fractions of a turn of Schimper and Braun, and their limit (Aono & Kunii 1984,
//! "Phyllotaxis").
//!
//! All models that read a phyllotaxis from a text share them. Absent: which texts a model reads besides.

/// The golden angle, degrees: the limit of the divergences 1/2, 1/3, 2/5, 3/8, 5/13 … of Schimper and Braun.
pub(crate) const GOLDEN_ANGLE_DEG: f64 = 137.507_764_050_037_85;

/// The degrees of a Fibonacci fraction of a turn, F(n)/F(n+2): 1/2, 1/3, 2/5, 3/8, 5/13, 8/21, 13/34 …
pub(crate) fn fibonacci(fraction: &str) -> Option<f64> {
    let (turns, leaves) = fraction.split_once('/')?;
    let (turns, leaves): (u64, u64) = (turns.trim().parse().ok()?, leaves.trim().parse().ok()?);
    let (mut a, mut b) = (1, 1);
    while a <= turns && b < 1_000_000 {
        if (turns, leaves) == (a, a + b) {
            return Some(360.0 * turns as f64 / leaves as f64);
        }
        (a, b) = (b, a + b);
    }
    None
}
