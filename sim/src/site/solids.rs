//! The solids of a site: obstacles that shoots meet instead of dying in them, and the ground.
//!
//! They are asked for the nearest surface within a reach, by a bounding tree over the solids, so that those far away
//! cost nothing; for the direction out of a surface; and for what a bud has ahead ([`Cone`]). The ways past them are
//! found in `way`. A distance is in metres, negative within a solid; of several solids the least counts. Absent: who
//! answers a contact and how, which a model says.

use super::{Manner, Obstacle, Side};
use crate::shape::tree::{Tree, Walk};
use crate::shape::{Bounds, Point, Shape};
use crate::vector::Vector;
use std::sync::Arc;

/// How near a surface a tip may come, metres. Frames are stored in single precision, which is far finer.
pub const CLEARANCE: f64 = 1e-3;

/// The steps in which a line is followed at least, where surfaces are near.
const STEPS: f64 = 64.0;

/// Half of the step by which the slope of a distance is measured, metres.
const BESIDE: f64 = 1e-5;

/// A surface: the ground, or a solid by its number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Surface {
    /// The ground.
    Ground,
    /// The solid of this number, in the order of the obstacles.
    Solid(u32),
    /// The wood of other plants, which is known beside the solids (`stems`).
    Wood,
}

/// The nearest surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Near {
    /// The distance to it, metres, negative within.
    pub distance: f64,
    /// Which it is.
    pub surface: Surface,
}

/// What a bud feels ahead: balls along its heading, whose radius grows as those within a cone do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cone {
    /// How far it reaches from the bud, metres.
    pub length: f64,
    /// The sine of the angle between its axis and its side.
    pub sine: f64,
}

/// The solids of a site, with the tree by which they are found.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Solids {
    solids: Vec<Solid>,
    tree: Tree,
    /// The height of the ground, metres.
    ground: Option<f64>,
    /// Whether all that are solid within are of forms whose distance is exact, so that it is not less than that to
    /// their bounds.
    exact: bool,
}

#[derive(Debug, Clone, PartialEq)]
struct Solid {
    shape: Arc<Shape>,
    /// 1 where the shape is solid within, −1 where it is hollow and solid around.
    sign: f64,
    holds: bool,
}

impl Solids {
    /// Those of obstacles that block, and the ground where it is one.
    pub fn of(obstacles: &[Obstacle], ground: Option<f64>) -> Self {
        let solid = |obstacle: &Obstacle| {
            let Manner::Blocks { holds } = obstacle.manner else { return None };
            let sign = if obstacle.kills == Side::Inside { 1.0 } else { -1.0 };
            Some(Solid { shape: Arc::clone(&obstacle.shape), sign, holds })
        };
        let solids: Vec<Solid> = obstacles.iter().filter_map(solid).collect();
        let bounds = |of: &Solid| if of.sign > 0.0 { of.shape.bounds() } else { Bounds::EVERYWHERE };
        let tree = Tree::of(&solids.iter().map(bounds).collect::<Vec<_>>());
        let is_exact = |shape: &Shape| {
            matches!(shape, Shape::Cuboid(_) | Shape::Sphere(_) | Shape::Capsule(_) | Shape::HalfSpace(_))
        };
        let exact = solids.iter().all(|solid| solid.sign < 0.0 || is_exact(&solid.shape));
        Self { solids, tree, ground, exact }
    }

    /// Whether there is nothing to meet.
    pub fn is_empty(&self) -> bool {
        self.solids.is_empty() && self.ground.is_none()
    }

    /// Whether climbers hold to a surface.
    pub fn holds(&self, surface: Surface) -> bool {
        match surface {
            Surface::Ground => false,
            Surface::Solid(number) => self.solids[number as usize].holds,
            Surface::Wood => true,
        }
    }

    /// The nearest surface whose distance is less than `reach`, metres.
    pub fn nearest(&self, point: Point, reach: f64) -> Option<Near> {
        self.nearest_of(point, reach, |_| true)
    }

    /// The nearest surface within `reach` to which climbers hold.
    pub fn nearest_that_holds(&self, point: Point, reach: f64) -> Option<Near> {
        self.nearest_of(point, reach, |surface| self.holds(surface))
    }

    fn nearest_of(&self, point: Point, reach: f64, counts: impl Fn(Surface) -> bool) -> Option<Near> {
        let mut near: Option<Near> = None;
        let mut least = reach;
        let mut consider = |distance: f64, surface: Surface| {
            if distance < least && counts(surface) {
                least = distance;
                near = Some(Near { distance, surface });
            }
            least
        };
        let mut bound = consider(self.distance(Surface::Ground, point), Surface::Ground);
        self.tree.walk(|_, bounds, item| {
            let square = bounds.square_distance(point);
            if square > 0.0 && square >= bound * bound {
                return Walk::Past;
            }
            if let Some(number) = item {
                let surface = Surface::Solid(number as u32);
                bound = consider(self.distance(surface, point), surface);
            }
            Walk::Below
        });
        near
    }

    /// The distance to a surface, metres, negative within. Of wood nothing is known here.
    pub fn distance(&self, surface: Surface, point: Point) -> f64 {
        match surface {
            Surface::Ground => self.ground.map_or(f64::INFINITY, |height| point[2] - height),
            Surface::Wood => f64::INFINITY,
            Surface::Solid(number) => {
                let Solid { shape, sign, .. } = &self.solids[number as usize];
                sign * shape.distance(point)
            }
        }
    }

    /// The direction out of a surface at a point, a unit vector; upward where the distance has no slope.
    pub fn outward(&self, surface: Surface, point: Point) -> Point {
        const UP: Point = [0.0, 0.0, 1.0];
        if surface == Surface::Ground {
            return UP;
        }
        let slope = [0, 1, 2].map(|axis| {
            let beside = |by: f64| [0, 1, 2].map(|k| point[k] + if k == axis { by } else { 0.0 });
            self.distance(surface, beside(BESIDE)) - self.distance(surface, beside(-BESIDE))
        });
        Vector::of(slope).unit().map_or(UP, |unit| [unit.x, unit.y, unit.z])
    }

    /// The first surface that a cone ahead of a point meets, with the place where it was felt.
    ///
    /// The ball at s along the heading has the radius s sin α, up to s = L / (1 + sin α): the balls fill a cone of the
    /// half-angle α with a round end at the length L. The line is followed by steps of what the distance leaves free
    /// (sphere tracing: Hart 1996), and of a 64th of the length where that is less.
    pub fn met(&self, from: Point, heading: Point, cone: Cone) -> Option<(Surface, Point)> {
        let end = cone.length / (1.0 + cone.sine);
        let least = end / STEPS;
        let mut way = least;
        loop {
            let at = along(from, heading, way);
            let near = self.nearest(at, way * cone.sine + cone.length);
            let free = near.map_or(cone.length, |near| near.distance - way * cone.sine);
            if let Some(near) = near.filter(|_| free < 0.0) {
                return Some((near.surface, at));
            }
            if way >= end || end.is_nan() {
                return None;
            }
            way = (way + (free / (1.0 + cone.sine)).max(least)).min(end);
        }
    }

    /// Whether all of the line between two points is known to be farther than a margin from each surface: it is above
    /// the ground, and beyond one face of the bounds of each solid, where these are boxes, balls and the like. No
    /// distance is asked.
    pub fn is_beside(&self, ends: [Point; 2], margin: f64) -> bool {
        // Far more than rounding moves a point of the line.
        let margin = margin + 1e-9;
        let beyond = |bounds: &Bounds| {
            (0..3).any(|k| {
                let [from, end] = ends.map(|end| end[k]);
                from.max(end) < bounds.low[k] - margin || from.min(end) > bounds.high[k] + margin
            })
        };
        let mut beside = self.exact && self.ground.is_none_or(|height| ends.iter().all(|end| end[2] - height > margin));
        self.tree.walk(|_, bounds, item| {
            if !beside || beyond(bounds) {
                return Walk::Past;
            }
            beside = item.is_none();
            Walk::Below
        });
        beside
    }

    /// Whether each surface is farther than a margin from the way of this length, from a point that is in no solid.
    pub fn is_clear(&self, [from, heading]: [Point; 2], length: f64, margin: f64) -> bool {
        if self.is_beside([from, along(from, heading, length)], margin) {
            return true;
        }
        let least = length / STEPS;
        let mut way = least;
        while way < length {
            let near = self.nearest(along(from, heading, way), length + margin);
            match near {
                Some(near) if near.distance <= margin => return false,
                Some(near) => way += (near.distance - margin).max(least),
                None => way += length,
            }
        }
        true
    }
}

/// The point at a distance along a heading.
pub(super) fn along(from: Point, heading: Point, way: f64) -> Point {
    [0, 1, 2].map(|k| from[k] + heading[k] * way)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Cuboid, Ellipsoid, Sphere};

    /// Numbers in [−1, 1) without an order.
    fn points(mut state: u64) -> impl FnMut() -> Point {
        let mut number = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1 << 23) - 1.0
        };
        move || [number(), number(), number()]
    }

    /// A line that is known to be beside all solids has no point nearer to one, by steps along it; and most lines that
    /// are far enough are known.
    #[test]
    fn a_line_beside_solids_meets_none() {
        let block =
            |shape| Obstacle { shape: Arc::new(shape), kills: Side::Inside, manner: Manner::Blocks { holds: false } };
        let mut point = points(4);
        let (mut known, mut clear) = (0, 0);
        for _ in 0..200 {
            let boxes = (0..4).map(|_| {
                let (low, size) = (point(), point().map(|x| 0.2 * x.abs()));
                block(Shape::Cuboid(Cuboid { low, high: [0, 1, 2].map(|k| low[k] + size[k]) }))
            });
            let mut all: Vec<Obstacle> = boxes.collect();
            all.push(block(Shape::Sphere(Sphere { centre: point(), radius: 0.1 })));
            let solids = Solids::of(&all, Some(-0.9));
            for _ in 0..50 {
                let (from, way) = (point(), point());
                let end = [0, 1, 2].map(|k| from[k] + 0.3 * way[k]);
                let at = |step: u32| [0, 1, 2].map(|k| from[k] + (end[k] - from[k]) * f64::from(step) / 100.0);
                let least = (0..=100).filter_map(|step| solids.nearest(at(step), 9.0)).map(|near| near.distance);
                let least = least.fold(f64::INFINITY, f64::min);
                let beside = solids.is_beside([from, end], 0.02);
                assert!(!beside || least > 0.02, "{from:?} {end:?}: {least}");
                known += usize::from(beside);
                clear += usize::from(least > 0.02);
            }
        }
        assert!(known > 1_000 && 2 * known > clear, "{known} of {clear}");
        let egg = Ellipsoid { centre: [0.0; 3], radii: [0.1, 0.2, 0.3] };
        let solids = Solids::of(&[block(Shape::Ellipsoid(egg))], None);
        assert!(!solids.is_beside([[5.0; 3], [6.0; 3]], 0.0), "its distance is not exact");
    }
}
