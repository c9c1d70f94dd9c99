//! Whether a polygon crosses or touches itself, and what it holds.
//!
//! Corners are compared pair by pair of edges, which is quick enough for the thousand corners that a zone may have.

type Point = [f64; 2];

/// The least area of a zone, m²: a square of a millimetre.
const LEAST_M2: f64 = 1e-6;

/// What is wrong with an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Flaw {
    /// Two corners that follow each other, by their numbers from 0, are the same place.
    Same(usize, usize),
    /// Two edges, each by the number of its first corner, cross or touch.
    Cross(usize, usize),
    /// It has next to no area.
    Flat,
}

/// The first flaw of an outline.
pub fn flaw(corners: &[Point]) -> Option<Flaw> {
    let count = corners.len();
    let edge = |k: usize| (corners[k], corners[(k + 1) % count]);
    let same = (0..count).find(|k| edge(*k).0 == edge(*k).1);
    if let Some(first) = same {
        return Some(Flaw::Same(first, (first + 1) % count));
    }
    for first in 0..count {
        for second in first + 1..count {
            let follows = second == first + 1 || (first == 0 && second == count - 1);
            let crosses = if follows {
                let (before, after) = if second == first + 1 { (first, second) } else { (second, first) };
                goes_back(edge(before), edge(after))
            } else {
                meet(edge(first), edge(second))
            };
            if crosses {
                return Some(Flaw::Cross(first, second));
            }
        }
    }
    let turned: f64 = (1..count.max(1)).map(|k| side(corners[0], corners[k], edge(k).1)).sum();
    (turned.abs() / 2.0 < LEAST_M2).then_some(Flaw::Flat)
}

/// Twice the area of a triangle, positive where it goes counterclockwise.
fn side(a: Point, b: Point, c: Point) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Whether an edge runs back along the one before it.
fn goes_back((a, b): (Point, Point), (_, c): (Point, Point)) -> bool {
    side(a, b, c) == 0.0 && (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]) < 0.0
}

/// Whether two edges without a common corner have a point in common.
fn meet((a, b): (Point, Point), (c, d): (Point, Point)) -> bool {
    let [ac, ad, ca, cb] = [side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b)];
    let between = |p: Point, q: Point, r: Point| (0..2).all(|k| p[k].min(q[k]) <= r[k] && r[k] <= p[k].max(q[k]));
    (opposite(ac, ad) && opposite(ca, cb))
        || (ac == 0.0 && between(a, b, c))
        || (ad == 0.0 && between(a, b, d))
        || (ca == 0.0 && between(c, d, a))
        || (cb == 0.0 && between(c, d, b))
}

fn opposite(a: f64, b: f64) -> bool {
    (a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outlines_that_cross_themselves_are_found() {
        assert_eq!(flaw(&[[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]]), None);
        assert_eq!(flaw(&[[0.0, 0.0], [2.0, 0.0], [4.0, 0.0], [4.0, 3.0]]), None, "a corner may lie on a line");
        assert_eq!(flaw(&[[0.0, 0.0], [4.0, 3.0], [4.0, 0.0], [0.0, 3.0]]), Some(Flaw::Cross(0, 2)), "a bow tie");
        assert_eq!(flaw(&[[0.0, 0.0], [4.0, 0.0], [2.0, 0.0]]), Some(Flaw::Cross(0, 1)), "a line there and back");
        let touching = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 0.0], [0.0, 4.0]];
        assert_eq!(flaw(&touching), Some(Flaw::Cross(0, 2)), "a corner on another edge");
        assert_eq!(flaw(&[[0.0, 0.0], [1.0, 1.0], [1.0, 1.0], [0.0, 1.0]]), Some(Flaw::Same(1, 2)));
        assert_eq!(flaw(&[[0.0, 0.0], [1.0, 1.0]]), Some(Flaw::Cross(0, 1)));
        assert_eq!(flaw(&[]), Some(Flaw::Flat));
        assert_eq!(flaw(&[[0.0, 0.0], [1.0, 0.0], [2.0, 1e-9]]), Some(Flaw::Flat));
        assert_eq!(flaw(&[[0.0, 0.0], [2.0, 1e-3], [1.0, 0.0]]), None, "a sliver");
        // A star of five points, drawn in one go.
        let star = [[0.0, 3.0], [2.0, -3.0], [-3.0, 1.0], [3.0, 1.0], [-2.0, -3.0]];
        assert!(matches!(flaw(&star), Some(Flaw::Cross(..))));
    }
}
