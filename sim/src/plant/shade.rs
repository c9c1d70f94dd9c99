//! What the buds of a plant lack of the light of open ground, axis by axis, in hundredths.
//!
//! Written by the site at the end of each tick (`crate::lit`), where laws ask. A bud that has appeared since is in full
//! light; it makes no step before the next tick. Absent: how light is found (`crate::site::light`).

use super::handle::AxisId;

/// The shade of buds, in steps from full light (0) to none (100).
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Shade(Vec<u8>);

impl Shade {
    /// The steps from full light to none.
    pub const STEPS: u8 = 100;

    /// That of the bud of an axis.
    #[inline]
    pub fn of(&self, axis: AxisId) -> u32 {
        self.0.get(axis.index()).copied().map_or(0, u32::from)
    }

    /// States what share of light each bud has, by the number of its axis; the others have full light.
    pub fn set(&mut self, axes: usize, lit: impl Iterator<Item = (usize, f64)>) {
        self.0.clear();
        self.0.resize(axes, 0);
        for (axis, light) in lit {
            // The cast saturates, and takes full light where there is no number.
            let steps = ((1.0 - light) * f64::from(Self::STEPS)).round() as u8;
            if let Some(of) = self.0.get_mut(axis) {
                *of = steps.min(Self::STEPS);
            }
        }
    }

    /// Forgets all.
    pub fn clear(&mut self) {
        self.0.clear();
    }
}
