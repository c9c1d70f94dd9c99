//! The branching angle of GMT4 by growth level: the characteristic functions of the five categories (Aono & Kunii 1984,
//! "Statistical branching model", Table 3).
//!
//! The angle goes from the greatest near the ground to the smallest at the top. s runs from 0 at the first branching to
//! 1 at the last, and Δ = h_max − h_min. The conditions of Table 3 contradict the five sentences of the text, which are
//! followed:
//!
//! | category | the text | rate of change over s | angle |
//! |---|---|---|---|
//! | 1 | constant | −K | h_max − Δ s |
//! | 2 | gradually, then sharply | −K (s − n₁), n₁ = 0, not 1 | h_max − Δ s² |
//! | 2, exponential | | −K (φ − h), not −K (h − φ) | φ − (φ − h_max) e^(K s) |
//! | 3 | sharply, then gradually | K (s − n₂), n₂ = 1, not 0 | h_min + Δ (1 − s)² |
//! | 3, exponential | | −K h, not K h | h_max e^(−K s) |
//! | 4 | gradually, sharply, gradually | −K (−s² + n₃ s − n₄), n₃ = 1, n₄ = 0, not +s² | h_max − Δ (3 s² − 2 s³) |
//! | 5 | increase to the middle, then decrease | −K (s − n₅) | h_max − Δ (2 s − 1)² |
//!
//! K is such that both ends of the range are reached. Absent: which branch has which angle (`laws`).

use phytomer_sim::math::{exp, log};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The kind of function: Table 3 has a second one for the categories 2 and 3.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Curve {
    /// A polynomial.
    #[default]
    Polynomial,
    /// An exponential function: of the categories 2 and 3.
    Exponential,
}

/// A category with the numbers of its function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Category {
    /// Constant decrease.
    Constant,
    /// Slow, then fast.
    Late,
    /// Slow, then fast: away from the angle φ, degrees, which is above every angle of the range.
    LateExponential(f64),
    /// Fast, then slow.
    Early,
    /// Fast, then slow: by the same share a level.
    EarlyExponential,
    /// Slow, fast, slow.
    Middle,
    /// Up to the greatest angle at this share of the way, in (0, 1), and down again. The smallest angle stands at the
    /// end that is farther from it.
    Peak(f64),
}

impl Category {
    /// The size of the angle at the share `s` of the way, degrees; `greatest` and `smallest` are the ends of the range,
    /// without sign.
    pub fn angle_deg(self, greatest: f64, smallest: f64, s: f64) -> f64 {
        let range = greatest - smallest;
        match self {
            Self::Constant => greatest - range * s,
            Self::Late => greatest - range * (s * s),
            Self::LateExponential(phi) if range > 0.0 => {
                phi - (phi - greatest) * exp(log((phi - smallest) / (phi - greatest)) * s)
            }
            Self::Early => smallest + range * ((1.0 - s) * (1.0 - s)),
            Self::EarlyExponential if range > 0.0 => greatest * exp(-log(greatest / smallest) * s),
            Self::LateExponential(_) | Self::EarlyExponential => greatest,
            Self::Middle => greatest - range * (s * s * (3.0 - 2.0 * s)),
            Self::Peak(peak) => {
                let away = (s - peak) / peak.max(1.0 - peak);
                greatest - range * (away * away)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The angles of Fig. 13.
    const ENDS: [f64; 2] = [90.0, 20.0];
    const ALL: [Category; 9] = [
        Category::Constant,
        Category::Late,
        Category::LateExponential(95.0),
        Category::Early,
        Category::EarlyExponential,
        Category::Middle,
        Category::Peak(0.5),
        Category::Peak(0.3),
        Category::Peak(0.8),
    ];

    fn at(category: Category, s: f64) -> f64 {
        category.angle_deg(ENDS[0], ENDS[1], s)
    }

    /// dh/ds as Table 3 has it, with its conditions corrected as the opening of this file says.
    fn rate(category: Category, s: f64, h: f64) -> f64 {
        let [greatest, smallest] = ENDS;
        let range = greatest - smallest;
        match category {
            Category::Constant => -range,
            Category::Late => -(2.0 * range) * (s - 0.0),
            Category::LateExponential(phi) => -log((phi - smallest) / (phi - greatest)) * (phi - h),
            Category::Early => 2.0 * range * (s - 1.0),
            Category::EarlyExponential => -log(greatest / smallest) * h,
            Category::Middle => -(6.0 * range) * (-(s * s) + (0.0 + 1.0) * s - 0.0 * 1.0),
            Category::Peak(peak) => {
                let far = peak.max(1.0 - peak);
                -(2.0 * range / (far * far)) * (s - peak)
            }
        }
    }

    #[test]
    fn the_fifth_of_ten_levels_has_the_angle_of_its_category() {
        let expected = [58.889, 76.173, 41.605, 60.809, 89.136];
        let polynomials = [Category::Constant, Category::Late, Category::Early, Category::Middle, Category::Peak(0.5)];
        for (category, expected) in polynomials.into_iter().zip(expected) {
            let found = at(category, 4.0 / 9.0);
            assert!((found - expected).abs() < 5e-4, "{category:?}: {found} is not {expected}");
        }
    }

    /// Runge and Kutta's method of the fourth order from the first angle on, 4,096 steps.
    #[test]
    fn each_function_solves_the_equation_of_its_row() {
        const STEPS: u32 = 4096;
        let d = 1.0 / f64::from(STEPS);
        for category in ALL {
            let mut h = at(category, 0.0);
            for step in 0..STEPS {
                let s = f64::from(step) * d;
                let a = rate(category, s, h);
                let b = rate(category, s + d / 2.0, h + a * d / 2.0);
                let c = rate(category, s + d / 2.0, h + b * d / 2.0);
                let e = rate(category, s + d, h + c * d);
                h += (a + 2.0 * b + 2.0 * c + e) * d / 6.0;
                let closed = at(category, f64::from(step + 1) * d);
                assert!((h - closed).abs() < 1e-9, "{category:?} at step {step}: {h} is not {closed}");
            }
        }
    }

    #[test]
    fn both_ends_of_the_range_are_reached_and_no_angle_is_outside() {
        for category in ALL {
            let angles: Vec<f64> = (0..=100).map(|i| at(category, f64::from(i) / 100.0)).collect();
            let least = angles.iter().copied().fold(f64::INFINITY, f64::min);
            let most = angles.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            assert!((least - 20.0).abs() < 1e-9 && (most - 90.0).abs() < 1e-9, "{category:?}: {least} to {most}");
        }
    }

    /// The five sentences of the text: which half is the steep one.
    #[test]
    fn the_steep_half_is_the_one_of_the_text() {
        let fall = |category, from: f64, to: f64| at(category, from) - at(category, to);
        let halves = |category| (fall(category, 0.0, 0.5), fall(category, 0.5, 1.0));
        let (first, second) = halves(Category::Constant);
        assert!((first - second).abs() < 1e-9);
        for late in [Category::Late, Category::LateExponential(95.0)] {
            let (first, second) = halves(late);
            assert!(second > 2.0 * first && first > 0.0, "{late:?} falls sharply after the middle");
        }
        for early in [Category::Early, Category::EarlyExponential] {
            let (first, second) = halves(early);
            assert!(first > 2.0 * second && second > 0.0, "{early:?} falls sharply before the middle");
        }
        let thirds = [0.0, 1.0, 2.0].map(|i| fall(Category::Middle, i / 3.0, (i + 1.0) / 3.0));
        assert!(thirds[1] > 1.5 * thirds[0] && (thirds[0] - thirds[2]).abs() < 1e-9, "{thirds:?}");
        let (first, second) = halves(Category::Peak(0.5));
        assert!(first < 0.0 && second > 0.0, "category 5 rises to the middle and falls");
    }

    #[test]
    fn an_empty_range_is_one_angle() {
        for category in ALL {
            assert_eq!(category.angle_deg(30.0, 30.0, 0.4), 30.0, "{category:?}");
            assert_eq!(category.angle_deg(0.0, 0.0, 0.4), 0.0, "{category:?}");
        }
    }
}
