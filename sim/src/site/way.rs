//! The way of one internode past the solids of a site: the heading that it wants, or the nearest that is free.
//!
//! An internode keeps its length, so the end of one that would enter a solid is moved out of it along the surface's
//! normal and back to the sphere about its start, by turns, until it is free: it lies along the surface. One that meets
//! a surface head on has no such end; it turns along the surface, upward if the surface is not level, else to a side.
//! A climber's end is drawn in the same way to the surface that it holds to, and never past its reach. Absent: the cone
//! that a bud feels (`solids`), and what a species does where there is no way.

use super::solids::{CLEARANCE, Near, Solids, Surface, along};
use crate::shape::Point;
use crate::vector::Vector;

/// The most rounds in which the end of an internode is moved.
const ROUNDS: usize = 24;
/// The least distance of an end that counts as free, metres: what rounds leave of the clearance.
const FREE: f64 = 0.25 * CLEARANCE;
/// The least cosine of the angle between the heading that was tried and the one that was found.
const LEAST_COSINE: f64 = 0.2;
/// Below this length a direction along a surface is none.
const HEAD_ON: f64 = 1e-6;

/// One internode that is to grow.
#[derive(Debug, Clone, Copy)]
pub struct Step {
    /// Where it begins, metres in the plot.
    pub from: Point,
    /// The heading that it wants, a unit vector.
    pub heading: Point,
    /// The upper side of the shoot.
    pub up: Point,
    /// Its length, metres.
    pub length: f64,
    /// What a climber holds to.
    pub hold: Option<Hold>,
    /// The side to which it turns where both are equal.
    pub left: bool,
}

/// A surface to which a climber holds.
#[derive(Debug, Clone, Copy)]
pub struct Hold {
    /// The surface.
    pub surface: Surface,
    /// The distance at which the shoot lies, metres.
    pub cling: f64,
    /// The greatest distance of a node, metres.
    pub reach: f64,
}

impl Solids {
    /// The heading of an internode that enters no solid, nearest to the one that it wants; `None` where there is none.
    ///
    /// What is promised of the end: it lies in no solid, farther than ¼ of [`CLEARANCE`] from each; where the internode
    /// began in no solid, the line to it passes through none; where it holds, it is within the reach. Cost: some dozens
    /// of distances, of solids that are near alone.
    pub fn way(&self, step: &Step) -> Option<Point> {
        if let Some(free) = self.relaxed(step, step.heading) {
            return Some(free);
        }
        let end = along(step.from, step.heading, step.length);
        let reach = step.length + CLEARANCE;
        let Near { surface, .. } = self.nearest(end, reach).or_else(|| self.nearest(step.from, reach))?;
        // Asked at the start, which is in front of the surface: an end that is deep within may be nearer to its back.
        let outward = Vector::of(self.outward(surface, step.from));
        self.beside(step, surface, outward).into_iter().flatten().find_map(|side| self.relaxed(step, side))
    }

    /// The directions along a surface in which a shoot is tried, the likeliest first.
    fn beside(&self, step: &Step, surface: Surface, outward: Vector) -> [Option<Point>; 6] {
        let heading = Vector::of(step.heading);
        let tangent = |direction: Vector| {
            let across = direction - outward * direction.dot(outward);
            (across.dot(across) > HEAD_ON).then(|| across.unit()).flatten()
        };
        let hold = step.hold.filter(|hold| hold.surface != surface);
        let wall = hold.map(|hold| Vector::of(self.outward(hold.surface, step.from)));
        let upward = match wall {
            // Along both surfaces.
            Some(wall) => outward.cross(wall).unit(),
            None => tangent(Vector::new(0.0, 0.0, 1.0)).or_else(|| tangent(Vector::of(step.up))),
        };
        let sideward = upward.and_then(|upward| outward.cross(upward).unit());
        let signed = |direction: Option<Vector>, sign: f64| direction.map(|direction| direction * sign);
        let toward = |direction: Option<Vector>| {
            let cosine = direction.map_or(0.0, |direction| direction.dot(heading));
            if cosine.abs() > HEAD_ON { cosine.signum() } else { [-1.0, 1.0][usize::from(step.left)] }
        };
        let up = if wall.is_some() { toward(upward) } else { 1.0 };
        let side = toward(sideward);
        let tried = [
            tangent(heading),
            signed(upward, up),
            signed(sideward, side),
            signed(sideward, -side),
            signed(upward, -up),
            None,
        ];
        tried.map(|direction| direction.map(|Vector { x, y, z }| [x, y, z]))
    }

    /// The heading at which rounds of moving the end come to rest, if the end is free there.
    fn relaxed(&self, step: &Step, heading: Point) -> Option<Point> {
        let from = Vector::of(step.from);
        let tried = Vector::of(heading);
        let mut found = tried;
        for _ in 0..ROUNDS {
            let end = from + found * step.length;
            let moved = self.pushed(self.drawn(end, step));
            let by = moved - end;
            if by.dot(by) < 1e-14 {
                break;
            }
            found = (moved - from).unit()?;
        }
        let heading = [found.x, found.y, found.z];
        let free = found.dot(tried) > LEAST_COSINE && self.is_free(step, heading);
        free.then_some(heading)
    }

    /// The end of a climber's internode, drawn towards the distance at which it lies.
    fn drawn(&self, end: Vector, step: &Step) -> Vector {
        let Some(hold) = step.hold else { return end };
        let at = [end.x, end.y, end.z];
        let beyond = self.distance(hold.surface, at) - hold.cling;
        if beyond <= 0.0 {
            return end;
        }
        end - Vector::of(self.outward(hold.surface, at)) * beyond.min(0.5 * step.length)
    }

    /// An end, moved out of the surface that is nearest.
    fn pushed(&self, end: Vector) -> Vector {
        let at = [end.x, end.y, end.z];
        match self.nearest(at, CLEARANCE) {
            Some(near) => end + Vector::of(self.outward(near.surface, at)) * (CLEARANCE - near.distance),
            None => end,
        }
    }

    /// Whether the internode of a step can have a heading: its end is free and within the reach of what it holds to,
    /// and nothing lies on the line to it.
    pub fn is_free(&self, step: &Step, heading: Point) -> bool {
        let end = along(step.from, heading, step.length);
        let holds = step.hold.is_none_or(|hold| self.distance(hold.surface, end) <= hold.reach);
        let began_free = || self.nearest(step.from, CLEARANCE).is_none_or(|near| near.distance >= 0.0);
        holds && self.nearest(end, FREE).is_none() && (!began_free() || self.is_clear(step.from, heading, step.length))
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Manner, Obstacle, Side};
    use super::*;
    use crate::shape::{Capsule, Cuboid, HalfSpace, Shape, Sphere};
    use crate::site::solids::Cone;
    use std::sync::Arc;

    fn solids(shapes: Vec<(Shape, Side)>, ground: Option<f64>) -> Solids {
        let block = |(shape, kills)| Obstacle { shape: Arc::new(shape), kills, manner: Manner::Blocks { holds: true } };
        Solids::of(&shapes.into_iter().map(block).collect::<Vec<_>>(), ground)
    }

    fn wall() -> Solids {
        let shape = Shape::HalfSpace(HalfSpace { point: [1.0, 0.0, 0.0], normal: [-1.0, 0.0, 0.0] });
        solids(vec![(shape, Side::Inside)], None)
    }

    fn step(from: Point, heading: Point, length: f64) -> Step {
        let up = [0.0, 0.0, 1.0];
        Step { from, heading, up, length, hold: None, left: true }
    }

    /// A plane at 1 m: an end that would lie behind it lies [`CLEARANCE`] before it, and the heading follows from
    /// Pythagoras.
    #[test]
    fn a_shoot_slides_along_a_plane() {
        let (sin, cos) = (0.6, 0.8);
        let found = wall().way(&step([0.95, 0.0, 0.0], [sin, cos, 0.0], 0.1)).expect("a way");
        let x = (0.05 - CLEARANCE) / 0.1;
        assert!((found[0] - x).abs() < 1e-6 && (found[1] - (1.0 - x * x).sqrt()).abs() < 1e-6, "{found:?}");
        // Free ways are kept to the bit.
        for heading in [[-1.0, 0.0, 0.0], [0.0, cos, sin]] {
            assert_eq!(wall().way(&step([0.95, 0.0, 0.0], heading, 0.1)), Some(heading));
        }
        assert_eq!(wall().way(&step([0.8, 0.0, 0.0], [1.0, 0.0, 0.0], 0.1)), Some([1.0, 0.0, 0.0]), "not yet");
    }

    /// Head on it turns up a wall, and beneath a roof to a side.
    #[test]
    fn a_shoot_that_meets_a_surface_head_on_turns_along_it() {
        let found = wall().way(&step([0.99, 0.0, 0.0], [1.0, 0.0, 0.0], 0.1)).expect("a way");
        assert!(found[2] > 0.99, "{found:?}");
        let roof = Shape::HalfSpace(HalfSpace { point: [0.0, 0.0, 1.0], normal: [0.0, 0.0, -1.0] });
        let roof = solids(vec![(roof, Side::Inside)], None);
        let under = Step { up: [1.0, 0.0, 0.0], ..step([0.0, 0.0, 0.99], [0.0, 0.0, 1.0], 0.1) };
        let found = roof.way(&under).expect("a way");
        assert!(found[0] > 0.99, "{found:?}");
        // In a box that is too small there is none.
        let cell = Shape::Sphere(Sphere { centre: [0.0; 3], radius: 0.04 });
        assert_eq!(solids(vec![(cell, Side::Outside)], None).way(&step([0.0; 3], [0.0, 0.0, 1.0], 0.1)), None);
    }

    /// A cone of 30° and 10 cm before a plane: felt where its side or its end passes the plane.
    #[test]
    fn a_cone_is_felt_where_it_passes_a_plane() {
        let cone = Cone { length: 0.1, sine: 0.5 };
        let met = |distance: f64, heading| wall().met([1.0 - distance, 0.0, 0.0], heading, cone).is_some();
        assert!(met(0.0999, [1.0, 0.0, 0.0]) && !met(0.1001, [1.0, 0.0, 0.0]));
        // Along the plane the farthest ball has a radius of 0.1 / 1.5 · 0.5 m.
        let side = 0.05 / 1.5;
        assert!(met(0.999 * side, [0.0, 1.0, 0.0]) && !met(1.001 * side, [0.0, 1.0, 0.0]));
        assert!(!met(0.0, [-1.0, 0.0, 0.0]), "away from it");
    }

    /// At the end of the wire it turns back rather than let go.
    #[test]
    fn a_climber_stays_within_its_reach_of_a_wire() {
        let wire = Capsule { start: [0.0, 0.0, 0.0], end: [0.0, 0.0, 1.0], radius: 0.001 };
        let wire = solids(vec![(Shape::Capsule(wire), Side::Inside)], None);
        let hold = Hold { surface: Surface::Solid(0), cling: 0.004, reach: 0.02 };
        let (mut at, mut heading): (Point, Point) = ([0.015, 0.0, 0.1], [0.6, 0.0, 0.8]);
        let mut highest = 0.0_f64;
        for node in 0..100 {
            let Some(found) = wire.way(&Step { hold: Some(hold), ..step(at, heading, 0.03) }) else { break };
            at = along(at, found, 0.03);
            heading = found;
            highest = highest.max(at[2]);
            let distance = wire.distance(Surface::Solid(0), at);
            assert!((FREE..=0.02).contains(&distance), "{distance} at node {node}");
        }
        assert!(highest > 0.95, "{highest}");
    }

    /// The tree asks solids that are near, and finds what asking each of them finds.
    #[test]
    fn the_nearest_of_many_solids_is_that_of_all() {
        let boxes: Vec<Shape> = (0..200)
            .map(|k| {
                let low = [f64::from(k % 20), f64::from(k / 20), 0.1 * f64::from(k % 7)];
                Shape::Cuboid(Cuboid { low, high: low.map(|x| x + 0.5) })
            })
            .collect();
        let solids = solids(boxes.iter().map(|shape| (shape.clone(), Side::Inside)).collect(), Some(0.0));
        for k in 0..2000 {
            let [a, b, c] = [7.0, 11.0, 13.0].map(|prime| f64::from(k) * prime % 97.0 / 97.0);
            let point = [22.0 * a - 1.0, 12.0 * b - 1.0, 2.0 * c];
            let least = boxes.iter().map(|shape| shape.distance(point)).fold(point[2], f64::min);
            let found = solids.nearest(point, 0.3).map(|near| near.distance);
            assert_eq!(found, (least < 0.3).then_some(least), "{point:?}");
        }
    }
}
