//! The sines and cosines of the angles of turns: strings turn by few angles many times.
//!
//! A place for each angle by its bits; an angle that comes to a place puts out the angle that was there. What is told
//! is the same with and without.

use phytomer_sim::math::sincos;

/// How many angles are remembered: a power of two.
const PLACES: usize = 32;

/// Angles with their sines and cosines.
#[derive(Debug, Clone)]
pub(super) struct Angles([(u64, (f64, f64)); PLACES]);

impl Default for Angles {
    /// The angle 0 in every place.
    fn default() -> Self {
        Self([(0, (0.0, 1.0)); PLACES])
    }
}

impl Angles {
    /// The sine and the cosine of an angle, radians.
    #[inline]
    pub fn sincos(&mut self, angle: f64) -> (f64, f64) {
        let bits = angle.to_bits();
        // The upper bits of a product by the golden ratio.
        let place = bits.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - PLACES.ilog2());
        let known = &mut self.0[place as usize];
        if known.0 != bits {
            *known = (bits, sincos(angle));
        }
        known.1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_remembered_is_what_is_computed() {
        let mut angles = Angles::default();
        let mut state = 7_u64;
        for round in 0..20_000 {
            state = phytomer_sim::key::scramble(state);
            // A few angles come often, of either sign; others once.
            let angle = if round % 3 > 0 { (state % 40) as f64 - 20.0 } else { (state >> 40) as f64 * 1e-3 };
            assert_eq!(angles.sincos(angle), sincos(angle), "{angle}");
        }
        assert_eq!((angles.sincos(0.0), angles.sincos(-0.0).1), ((0.0, 1.0), 1.0));
    }
}
