//! Shapes that are scaled, then turned, then moved.
//!
//! Scaling that differs between the axes makes distances too small, by at most the ratio of the factors; what is inside
//! stays exact. Absent: shear and mirrors.

use super::bounds::Bounds;
use super::{Point, Shape, from};
use crate::rotation::Rotation;

/// A shape in another place, direction and size.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    shape: Shape,
    to: Point,
    /// Where the axes of the shape point.
    axes: [Point; 3],
    scale: [f64; 3],
}

impl Placed {
    /// `shape` scaled about the origin along each axis, turned about the origin, then moved by `to`, metres.
    pub fn of(shape: Shape, scale: [f64; 3], turn: Rotation, to: Point) -> Self {
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| turn.turned(axis));
        Self { shape, to, axes, scale }
    }

    /// The shape before it was placed.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// A point in the coordinates of the shape before it was placed.
    #[inline]
    pub fn before(&self, point: Point) -> Point {
        let at = from(self.to, point);
        [0, 1, 2].map(|k| super::dot(at, self.axes[k]) / self.scale[k])
    }

    /// Where a point of the shape before it was placed comes to lie.
    pub fn after(&self, point: Point) -> Point {
        let along = [0, 1, 2].map(|axis| point[axis] * self.scale[axis]);
        [0, 1, 2].map(|k| self.to[k] + (0..3).map(|axis| along[axis] * self.axes[axis][k]).sum::<f64>())
    }

    /// The length of what was at least a metre long.
    pub fn least_scale(&self) -> f64 {
        self.scale[0].min(self.scale[1]).min(self.scale[2])
    }

    /// The bounds of the corners of the bounds.
    pub fn bounds(&self) -> Bounds {
        let bounds = self.shape.bounds();
        if (0..3).any(|k| bounds.low[k] > bounds.high[k]) {
            return Bounds::NOTHING;
        }
        let mut placed = Bounds { low: self.to, high: self.to };
        for k in 0..3 {
            for (axis, toward) in self.axes.iter().enumerate().filter(|(_, toward)| toward[k] != 0.0) {
                let ends = [bounds.low[axis], bounds.high[axis]].map(|end| toward[k] * self.scale[axis] * end);
                placed.low[k] += ends[0].min(ends[1]);
                placed.high[k] += ends[0].max(ends[1]);
            }
        }
        placed
    }
}
