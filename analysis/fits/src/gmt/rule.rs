//! What a branching is expected to be: angles by growth level, ratios, the turn by rank, and how much each varies.
//!
//! The measures of a branching are those of `MEASURES`, each a line of one or two terms (`regress`). The angles of a
//! course are linear in the greatest and the smallest angle, since the five functions of Table 3 (Aono & Kunii 1984) go
//! from one to the other by a share that the growth level sets. Absent: the exponential functions of Table 3, which ten
//! levels do not tell from the polynomials.

use super::fork::Shape;
use super::regress::Row;
use phytomer_sim::math;
use std::f64::consts::PI;

/// h1, h2, R1, R2, R0, the turn, and three parts that the model has none of.
pub const MEASURES: usize = 9;
pub const H1: usize = 0;
pub const R1: usize = 2;
pub const R0: usize = 4;
pub const TURN: usize = 5;
pub const ASTRAY: usize = 6;

/// How the angles change from the first branching to the last.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Course {
    /// Not at all.
    #[default]
    Constant,
    /// By a category of Table 3, 1 to 5, with the conditions of the text; category 5 has its greatest angle in the
    /// middle.
    Category(u32),
}

impl Course {
    /// The share of the smallest angle at a share `s` of the way.
    pub fn share(self, s: f64) -> f64 {
        match self {
            Self::Constant => 0.0,
            Self::Category(1) => s,
            Self::Category(2) => s * s,
            Self::Category(3) => 1.0 - (1.0 - s) * (1.0 - s),
            Self::Category(4) => s * s * (3.0 - 2.0 * s),
            Self::Category(_) => (2.0 * s - 1.0) * (2.0 * s - 1.0),
        }
    }

    /// What the angles of a growth level are, in the greatest and the smallest.
    pub fn row(self, level: u32, last: u32) -> Row {
        if self == Self::Constant {
            return [1.0, 0.0];
        }
        let s = if last > 1 { f64::from(level - 1) / f64::from(last - 1) } else { 0.0 };
        let share = self.share(s);
        [1.0 - share, share]
    }
}

/// Where a branching stands: the growth level of its children, and the rank of the mother on her axis, from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stand {
    pub level: u32,
    pub rank: u32,
}

/// What is expected of each measure, and its deviation.
#[derive(Debug, Clone, PartialEq)]
pub struct Rule {
    pub course: Course,
    /// The last growth level.
    pub last: u32,
    /// The terms of each measure.
    pub terms: [[f64; 2]; MEASURES],
    /// The standard deviation of each measure.
    pub spread: [f64; MEASURES],
    /// By how much tips are moved (dx, dy, dz).
    pub deviation: [f64; 3],
}

/// Standard deviations of a first guess: some nine degrees, and a seventh of a ratio.
const GUESSED: [f64; MEASURES] = [0.15, 0.15, 0.15, 0.15, 0.15, 0.6, 0.15, 0.15, 0.15];
/// A measure that says nothing.
const NOTHING: f64 = 1e6;

impl Rule {
    /// A guess of the turns alone: δ and the divergence, radians.
    pub fn of_turns(course: Course, last: u32, delta: f64, divergence: f64) -> Self {
        let mut spread = GUESSED;
        spread[..R0 + 1].fill(NOTHING);
        let mut terms = [[0.0; 2]; MEASURES];
        terms[TURN] = [delta, divergence];
        Self { course, last, terms, spread, deviation: [0.0; 3] }
    }

    /// A guess of the angles alone: the left child goes on, the right one leaves.
    pub fn of_angles(course: Course, last: u32) -> Self {
        let mut rule = Self::of_turns(course, last, 0.0, 0.0);
        rule.spread[..2].fill(0.5);
        rule.spread[TURN] = NOTHING;
        rule.terms[H1 + 1] = [-0.5 * PI, -0.5 * PI];
        rule
    }

    /// The numbers that the terms of a measure are multiplied by.
    pub fn row(&self, measure: usize, stand: Stand) -> Row {
        match measure {
            H1 | 1 => self.course.row(stand.level, self.last),
            R1..=R0 => [1.0, 0.0],
            TURN => [1.0, f64::from(stand.rank) - 1.0],
            _ => [0.0; 2],
        }
    }

    /// What is expected of a measure.
    pub fn expected(&self, measure: usize, stand: Stand) -> f64 {
        let ([a, b], [p, q]) = (self.terms[measure], self.row(measure, stand));
        a * p + b * q
    }

    /// How far a branching is from what is expected, in squares of standard deviations.
    pub fn distance(&self, shape: &Shape, stand: Stand) -> f64 {
        let off = |measure: usize, value: f64| {
            let off = value - self.expected(measure, stand);
            let off = if measure == TURN { wrapped(off) } else { off } / self.spread[measure];
            off * off
        };
        values(shape).into_iter().enumerate().filter_map(|(k, value)| Some(off(k, value?))).sum()
    }

    /// The measure of a shape, with a turn within half a turn of what is expected.
    pub fn near(&self, measure: usize, shape: &Shape, stand: Stand) -> Option<f64> {
        let value = values(shape)[measure]?;
        if measure != TURN {
            return Some(value);
        }
        let expected = self.expected(TURN, stand);
        Some(expected + wrapped(value - expected))
    }
}

/// The measures of a shape.
pub fn values(shape: &Shape) -> [Option<f64>; MEASURES] {
    let Shape { angles: [h1, h2], ratios: [r1, r2], centre, turn, astray: [out, inside, outside] } = *shape;
    let of_centre = |value: f64| centre.map(|_| value);
    let [h1, h2, r1, r2, turn, out] = [h1, h2, r1, r2, turn, out].map(Some);
    [h1, h2, r1, r2, centre, turn, out, of_centre(inside), of_centre(outside)]
}

/// An angle in (−π, π].
pub fn wrapped(angle: f64) -> f64 {
    let turned = math::fmod(angle, 2.0 * PI);
    if turned > PI {
        turned - 2.0 * PI
    } else if turned <= -PI {
        turned + 2.0 * PI
    } else {
        turned
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Angles 90 to 20 on ten levels: the fifth, for each category.
    #[test]
    fn the_fifth_of_ten_levels() {
        for (category, expected) in [(1, 58.889), (2, 76.173), (3, 41.605), (4, 60.809), (5, 89.136)] {
            let [a, b] = Course::Category(category).row(5, 10);
            assert!((90.0 * a + 20.0 * b - expected).abs() < 5e-4, "{category}");
        }
        assert_eq!(Course::Category(3).row(1, 1), [1.0, 0.0]);
    }

    #[test]
    fn angles_are_wrapped() {
        for (angle, expected) in [(0.5, 0.5), (PI + 0.5, 0.5 - PI), (-PI, PI), (9.0 * PI, PI), (-3.5, 2.0 * PI - 3.5)] {
            assert!((wrapped(angle) - expected).abs() < 1e-12, "{angle}");
        }
    }
}
