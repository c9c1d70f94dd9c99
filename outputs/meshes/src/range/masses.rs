//! Which elements of a list are drawn where a share of them is (Weber & Penn 1995 §5): masses of neighbours, of each of
//! which the first few are drawn.
//!
//! The paper's loop draws `int(number)` elements of each mass and one more of the first `change` masses. Here each
//! element has the least share at which that loop draws it, so that the range of its end follows. Absent: shares at a
//! range (`laws`).

use super::laws::Elements;

impl Elements {
    /// The number of neighbours in a mass: 16 for stems, 4 for polygons of leaves and 8 for their points.
    ///
    /// The text has 4 for all leaves; the 1,664 points of Table 2, one for each mass of 13,312, are those of masses of
    /// 8.
    pub fn mass(self) -> u32 {
        match self {
            Self::LeafPolygons => 4,
            Self::LeafPoints => 8,
            _ => 16,
        }
    }

    /// The least share at which the loop of §5 draws the element at `place` of a list of `total`, in (0, 1]; 0 for what
    /// is drawn at any range.
    ///
    /// The number of masses is total/mass, not rounded, and `change`, the number of masses times the fraction of
    /// `number`, is truncated: the mass k has one more element than `int(number)` from the fraction (k + 1)/masses on.
    /// A part of a mass at the end would need a fraction above 1 and takes its element with the next whole number. Of
    /// points at least one a mass is drawn.
    pub fn least_share(self, place: u32, total: u32) -> f64 {
        let mass = self.mass();
        let (nth, slot) = (place / mass, place % mass);
        if self == Self::LeafPoints && slot == 0 {
            return 0.0;
        }
        let masses = f64::from(total) / f64::from(mass);
        let fraction = (f64::from(nth) + 1.0) / masses;
        (f64::from(slot) + fraction.min(1.0)) / f64::from(mass)
    }
}
