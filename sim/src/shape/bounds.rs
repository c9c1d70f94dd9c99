//! Boxes along the axes that hold shapes: the bounds by which a point is known to be outside without asking the shape.
//!
//! Bounds may reach to infinity, and hold nothing where a low corner lies above a high one. Absent: shapes.

use super::Point;

/// A box along the axes, its faces included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// The smallest coordinates, metres.
    pub low: Point,
    /// The largest coordinates, metres.
    pub high: Point,
}

/// [`Bounds::NOTHING`].
impl Default for Bounds {
    fn default() -> Self {
        Self::NOTHING
    }
}

impl Bounds {
    /// All of space.
    pub const EVERYWHERE: Self = Self { low: [f64::NEG_INFINITY; 3], high: [f64::INFINITY; 3] };
    /// No point at all.
    pub const NOTHING: Self = Self { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };

    /// The cube that holds the ball of this radius about a point.
    pub fn of_ball(centre: Point, radius: f64) -> Self {
        Self { low: centre.map(|x| x - radius), high: centre.map(|x| x + radius) }
    }

    /// The smallest box that holds points.
    pub fn of_points<'a>(points: impl IntoIterator<Item = &'a Point>) -> Self {
        points.into_iter().fold(Self::NOTHING, |all, point| all.with(&Self { low: *point, high: *point }))
    }

    /// Whether a point lies in the box or on its faces.
    #[inline]
    pub fn holds(&self, point: Point) -> bool {
        (self.low[0] <= point[0] && point[0] <= self.high[0])
            && (self.low[1] <= point[1] && point[1] <= self.high[1])
            && (self.low[2] <= point[2] && point[2] <= self.high[2])
    }

    /// The smallest box that holds both.
    pub fn with(&self, other: &Self) -> Self {
        Self {
            low: [0, 1, 2].map(|k| self.low[k].min(other.low[k])),
            high: [0, 1, 2].map(|k| self.high[k].max(other.high[k])),
        }
    }

    /// What both hold.
    pub fn common(&self, other: &Self) -> Self {
        Self {
            low: [0, 1, 2].map(|k| self.low[k].max(other.low[k])),
            high: [0, 1, 2].map(|k| self.high[k].min(other.high[k])),
        }
    }

    /// The box with a margin, metres.
    pub fn with_margin(&self, margin: f64) -> Self {
        Self { low: self.low.map(|x| x - margin), high: self.high.map(|x| x + margin) }
    }

    /// The middle of the box along an axis; of a box that reaches to infinity there its finite end, or 0.
    pub fn middle(&self, axis: usize) -> f64 {
        let (low, high) = (self.low[axis], self.high[axis]);
        match (low.is_finite(), high.is_finite()) {
            (true, true) => 0.5 * low + 0.5 * high,
            (true, false) => low,
            (false, true) => high,
            (false, false) => 0.0,
        }
    }

    /// The square of the distance from a point to the box; 0 within it.
    pub fn square_distance(&self, point: Point) -> f64 {
        let beyond = |k: usize| (self.low[k] - point[k]).max(point[k] - self.high[k]).max(0.0);
        (0..3).map(|k| beyond(k) * beyond(k)).sum()
    }

    /// The eight corners.
    pub fn corners(&self) -> [Point; 8] {
        let end = |corner: usize, k: usize| if corner >> k & 1 == 0 { self.low[k] } else { self.high[k] };
        [0, 1, 2, 3, 4, 5, 6, 7].map(|corner| [0, 1, 2].map(|k| end(corner, k)))
    }
}
