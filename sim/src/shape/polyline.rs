//! Polylines of varying radius: necks, tails and limbs of clipped figures.
//!
//! Between two points the radius changes evenly. A point belongs to a piece if the place nearest to it on the line of
//! the piece is no farther than the radius there; so a piece is a part of a cone with half a ball at either end. The
//! distance is that to the line less the radius, which is exact where the radius does not change.

use super::bounds::Bounds;
use super::tree::Tree;
use super::{Point, Solid, along_line, from, length};

/// A line through points, as thick as is stated at each.
#[derive(Debug, Clone, PartialEq)]
pub struct Polyline {
    points: Vec<(Point, f64)>,
    tree: Tree,
}

impl Polyline {
    /// The polyline through points with radii, metres; of one point a ball.
    pub fn of(points: Vec<(Point, f64)>) -> Self {
        let bounds: Vec<Bounds> =
            pieces(&points).map(|(a, b)| Bounds::of_ball(a.0, a.1).with(&Bounds::of_ball(b.0, b.1))).collect();
        let tree = Tree::of(&bounds);
        Self { points, tree }
    }

    /// The number of its points.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Whether it has no points.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    fn piece(&self, number: usize) -> ((Point, f64), (Point, f64)) {
        (self.points[number], self.points[(number + 1).min(self.points.len() - 1)])
    }
}

/// The pieces between points; of a single point one without length.
fn pieces(points: &[(Point, f64)]) -> impl Iterator<Item = ((Point, f64), (Point, f64))> {
    let single = if let [point] = points { Some((*point, *point)) } else { None };
    points.windows(2).map(|ends| (ends[0], ends[1])).chain(single)
}

fn beyond(((start, first), (end, last)): ((Point, f64), (Point, f64)), point: Point) -> f64 {
    let (share, nearest) = along_line(start, end, point);
    length(from(nearest, point)) - (first + (last - first) * share)
}

impl Solid for Polyline {
    fn inside(&self, point: Point) -> bool {
        self.tree.any(point, |number| beyond(self.piece(number), point) <= 0.0)
    }

    fn distance(&self, point: Point) -> f64 {
        pieces(&self.points).map(|piece| beyond(piece, point)).fold(f64::INFINITY, f64::min)
    }

    fn bounds(&self) -> Bounds {
        self.tree.bounds()
    }
}
