//! Where a beam first meets an opaque shape: steps along the beam as long as the distance to the shape allows (Hart
//! 1996, *The Visual Computer* 12: 527–545).
//!
//! So the edge of a shadow is that of the shape, whatever the size of the boxes of the grid. Where the plot repeats,
//! so do its shapes: those of the plot and of the eight around it are asked. Absent: shapes that let some light pass.

use super::Borders;
use crate::shape::{Bounds, Point, Shape};
use std::sync::Arc;

/// The farthest that a shape is sought from a place, metres.
const FARTHEST: f64 = 1e5;
/// How near to a surface a beam has met it, metres.
const NEAR: f64 = 1e-5;
/// The most steps to a surface. A beam that has not met it by then passes it at a grazing angle.
const MOST_STEPS: u32 = 2_000;

/// The opaque shapes of a plot.
#[derive(Debug, Clone)]
pub struct Shadows {
    shapes: Vec<(Arc<Shape>, Bounds)>,
    period: Option<[f64; 2]>,
    origin: Point,
}

impl Shadows {
    /// Those of shapes in a plot with such borders, whose corner is `origin`.
    pub fn of(shapes: &[Arc<Shape>], borders: Borders, origin: Point) -> Self {
        let period = match borders {
            Borders::Open => None,
            Borders::Periodic(period) => Some(period),
        };
        Self { shapes: shapes.iter().map(|shape| (Arc::clone(shape), shape.bounds())).collect(), period, origin }
    }

    /// Whether nothing is opaque.
    pub fn is_empty(&self) -> bool {
        self.shapes.is_empty()
    }

    /// The height of the highest shape, metres; infinite where one has no end.
    pub fn top(&self) -> f64 {
        self.shapes.iter().map(|(_, bounds)| bounds.high[2]).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Whether light from a direction is kept from a place.
    pub fn hide(&self, place: Point, towards: Point) -> bool {
        self.first_hit(place, towards, FARTHEST).is_some()
    }

    /// How far along its way a beam first meets a shape, if it does within `end` metres.
    pub fn first_hit(&self, from: Point, way: Point, end: f64) -> Option<f64> {
        let mut first: Option<f64> = None;
        for (shape, bounds) in &self.shapes {
            let until = first.unwrap_or(end);
            let found = match self.period {
                None => march(shape, bounds, from, way, until),
                Some(period) => self.march_among_copies(shape, period, from, way, until),
            };
            first = found.or(first);
        }
        first
    }

    fn march_among_copies(&self, shape: &Shape, period: [f64; 2], from: Point, way: Point, end: f64) -> Option<f64> {
        let (mut gone, step) = (0.0, period[0].min(period[1]) / 2.0);
        for _ in 0..MOST_STEPS {
            let mut at = [0, 1, 2].map(|k| from[k] + way[k] * gone);
            let is_above = at[2] > self.top() && way[2] >= 0.0;
            if gone > end || is_above {
                return None;
            }
            (0..2).for_each(|k| at[k] -= ((at[k] - self.origin[k]) / period[k]).floor() * period[k]);
            let copies = (0..9).map(|copy| {
                let shift = [f64::from(copy / 3 - 1) * period[0], f64::from(copy % 3 - 1) * period[1], 0.0];
                shape.distance([0, 1, 2].map(|k| at[k] + shift[k]))
            });
            let distance = copies.fold(f64::INFINITY, f64::min);
            if distance <= NEAR {
                return Some(gone);
            }
            // Copies beyond the nearest nine may be nearer than half a plot.
            gone += distance.min(step);
        }
        None
    }
}

/// How far along its way a beam meets one shape, if it does within `end` metres.
fn march(shape: &Shape, bounds: &Bounds, from: Point, way: Point, end: f64) -> Option<f64> {
    let (mut gone, end) = passage(bounds, from, way, end)?;
    for _ in 0..MOST_STEPS {
        if gone > end {
            return None;
        }
        let distance = shape.distance([0, 1, 2].map(|k| from[k] + way[k] * gone));
        if distance <= NEAR {
            return Some(gone);
        }
        gone += distance;
    }
    None
}

/// From where to where a beam is in a box, within `end` metres; `None` where it misses it.
pub fn passage(bounds: &Bounds, from: Point, way: Point, end: f64) -> Option<(f64, f64)> {
    let (mut enters, mut leaves) = (0.0_f64, end);
    for k in 0..3 {
        if way[k] == 0.0 {
            if from[k] < bounds.low[k] - NEAR || from[k] > bounds.high[k] + NEAR {
                return None;
            }
            continue;
        }
        let [a, b] = [bounds.low[k] - NEAR, bounds.high[k] + NEAR].map(|side| (side - from[k]) / way[k]);
        enters = enters.max(a.min(b));
        leaves = leaves.min(a.max(b));
    }
    (enters <= leaves).then_some((enters, leaves))
}
