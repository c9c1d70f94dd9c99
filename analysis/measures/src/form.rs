//! The form of a tree: how clear its main axis is, and the outline of its crown (Aono & Kunii 1984, "Phyllotaxis,
//! axiality, and apical dominance").
//!
//! The paper names both and gives neither a formula. Axiality of a branching: (|h_l| − |h_m|)/(|h_l| + |h_m|), of the
//! angles by which the lateral and the main axis leave their mother: 0 where no axis is the main one, 1 where it goes
//! straight on; .429 and .714 for Figs. 5c and 5d, in the order of Table 1. Apical dominance: the half-angle of the
//! upright cone that has the height of the plant and the reach of its widest place, which grows from 6a to 6d and from
//! 7a to 7d, and the height of that place over that of the plant. Absent: what grew.

use phytomer_sim::math::atan2;

/// The axiality of a branching by the angles, of any sign and unit, between the mother and the main axis and between
/// the mother and the lateral; below 0 where the lateral goes on straighter than the main axis. `None` where both go
/// straight on.
pub fn axiality(main: f64, lateral: f64) -> Option<f64> {
    let (main, lateral) = (main.abs(), lateral.abs());
    let sum = main + lateral;
    (sum > 0.0 && sum.is_finite()).then(|| (lateral - main) / sum)
}

/// The outline of a plant that stands at the origin.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Outline {
    /// Its height, metres: the highest place; 0 where all lies below the origin.
    pub height: f64,
    /// The distance of its farthest place from the vertical through the origin, metres.
    pub reach: f64,
    /// The height of that place, metres.
    pub widest: f64,
}

impl Outline {
    /// Adds a place.
    pub fn add(&mut self, [x, y, z]: [f64; 3]) {
        let reach = (x * x + y * y).sqrt();
        self.height = self.height.max(z);
        if reach > self.reach {
            (self.reach, self.widest) = (reach, z);
        }
    }

    /// Half of the angle at the top of the cone, radians; `None` without a height.
    pub fn half_angle(self) -> Option<f64> {
        (self.height > 0.0).then(|| atan2(self.reach, self.height))
    }

    /// The height of the widest place over that of the plant; `None` without a height or a width.
    pub fn widest_share(self) -> Option<f64> {
        (self.height > 0.0 && self.reach > 0.0).then(|| self.widest / self.height)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Table 1: pure dichotomous branching has none, pure monopodial branching all of it.
    #[test]
    fn the_rows_of_figure_5() {
        for (h1, h2, expected) in
            [(35.0, -35.0, 0.0), (20.0, -50.0, 3.0 / 7.0), (10.0, -60.0, 5.0 / 7.0), (0.0, -70.0, 1.0)]
        {
            assert_eq!(axiality(h1, h2), Some(expected));
        }
        assert_eq!(axiality(-50.0, 20.0), Some(-3.0 / 7.0));
        assert_eq!(axiality(0.0, 0.0), None);
        assert_eq!(axiality(f64::NAN, 1.0), None);
    }

    #[test]
    fn an_outline_of_a_few_places() {
        let mut outline = Outline::default();
        assert_eq!((outline.half_angle(), outline.widest_share()), (None, None));
        [[0.0, 0.0, 4.0], [3.0, -4.0, 1.0], [1.0, 1.0, 3.0]].iter().for_each(|place| outline.add(*place));
        assert_eq!(outline, Outline { height: 4.0, reach: 5.0, widest: 1.0 });
        assert_eq!(outline.widest_share(), Some(0.25));
        assert!((outline.half_angle().unwrap() - phytomer_sim::math::atan(1.25)).abs() < 1e-15);
    }
}
