//! The nearest points of two segments (Ericson 2005, *Real-Time Collision Detection* §5.1.9).

use crate::vector::Vector;

/// A segment from a point along a vector to its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    pub start: Vector,
    pub along: Vector,
}

impl Segment {
    /// The point at a share of its length.
    pub fn at(&self, share: f64) -> Vector {
        self.start + self.along * share
    }

    /// The share of its length at which it is nearest to a point.
    pub fn share_near(&self, point: Vector) -> f64 {
        let square = self.along.dot(self.along);
        if square > 0.0 { (self.along.dot(point - self.start) / square).clamp(0.0, 1.0) } else { 0.0 }
    }

    /// The shares of the lengths of this segment and another one at which they are nearest to each other.
    pub fn shares_near(&self, other: &Self) -> [f64; 2] {
        let (d, e, between) = (self.along, other.along, self.start - other.start);
        let (a, b, c) = (d.dot(d), d.dot(e), e.dot(e));
        // Of parallel segments any share will do to begin with: this one's start.
        let across = a * c - b * b;
        let first = if across > 1e-12 * a * c {
            ((b * e.dot(between) - c * d.dot(between)) / across).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let second = other.share_near(self.at(first));
        let first = self.share_near(other.at(second));
        [first, other.share_near(self.at(first))]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn segment(start: [f64; 3], along: [f64; 3]) -> Segment {
        Segment { start: Vector::of(start), along: Vector::of(along) }
    }

    fn distance(one: &Segment, other: &Segment) -> f64 {
        let [s, t] = one.shares_near(other);
        let between = one.at(s) - other.at(t);
        between.dot(between).sqrt()
    }

    #[test]
    fn the_nearest_points_of_segments_are_known_in_closed_form() {
        let along_x = segment([0.0, 0.0, 0.0], [2.0, 0.0, 0.0]);
        // Skew and across the middle; beyond an end; parallel; a point.
        assert_eq!(distance(&along_x, &segment([1.0, -1.0, 0.5], [0.0, 2.0, 0.0])), 0.5);
        assert_eq!(distance(&along_x, &segment([5.0, 4.0, 0.0], [0.0, 1.0, 0.0])), 5.0);
        assert_eq!(distance(&along_x, &segment([1.0, 0.0, 0.3], [5.0, 0.0, 0.0])), 0.3);
        assert_eq!(distance(&along_x, &segment([-3.0, 0.0, 4.0], [0.0, 0.0, 0.0])), 5.0);
    }

    /// Against a search of both segments on a grid that grows finer about what is best.
    #[test]
    fn no_points_of_two_segments_are_nearer() {
        let mut state = 3_u64;
        let mut fraction = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1 << 24)
        };
        for pair in 0..500 {
            let mut point = || [0, 1, 2].map(|_| 2.0 * fraction() - 1.0);
            let (one, other) = (segment(point(), point()), segment(point(), point()));
            let between = |s: f64, t: f64| {
                let between = one.at(s) - other.at(t);
                between.dot(between).sqrt()
            };
            let (mut least, mut at, mut width) = (f64::INFINITY, [0.5, 0.5], 0.5);
            for _ in 0..12 {
                let middle = at;
                for k in 0..=20 {
                    for l in 0..=20 {
                        let [s, t] = [(middle[0], k), (middle[1], l)]
                            .map(|(middle, k)| (middle + width * (f64::from(k) / 10.0 - 1.0)).clamp(0.0, 1.0));
                        if between(s, t) < least {
                            (least, at) = (between(s, t), [s, t]);
                        }
                    }
                }
                width *= 0.4;
            }
            let found = distance(&one, &other);
            assert!(found <= least + 1e-9 && found >= least - 1e-4, "pair {pair}: {found} and {least}");
        }
    }
}
