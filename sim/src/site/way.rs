//! The way of one internode past the solids and the stems of a site: the heading that it wants, or the nearest that is
//! free.
//!
//! An internode keeps its length, so the end of one that would enter a solid is moved out of it along the surface's
//! normal and back to the sphere about its start, by turns, until it is free: it lies along the surface. One that would
//! come too near to a stem is moved so that its nearest point is far enough. One that meets a surface head on has no
//! such end; it turns along the surface, upward if the surface is not level, else to a side. A climber's end is drawn
//! in the same way to the surface that it holds to, and never past its reach. Absent: the cone that a bud feels
//! (`solids`, `stems`), and what a species does where there is no way.

use super::solids::{CLEARANCE, Near, Solids, Surface, along};
use super::stems::{Beside, Spared};
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
/// The least share of an internode by which its end is moved for a point nearer to its start.
const LEAST_SHARE: f64 = 0.25;

/// One internode that is to grow.
#[derive(Debug, Clone, Copy)]
pub struct Step<'a> {
    /// Where it begins, metres in the plot.
    pub from: Point,
    /// The heading that it wants, a unit vector.
    pub heading: Point,
    /// The upper side of the shoot.
    pub up: Point,
    /// Its length, metres.
    pub length: f64,
    /// Its radius, metres: what its middle line keeps from all bark and, where it began so far away, from surfaces.
    pub radius: f64,
    /// What a climber holds to.
    pub hold: Option<Hold>,
    /// The side to which it turns where both are equal.
    pub left: bool,
    /// The stems that it may meet, as far as they are near.
    pub stems: &'a Beside,
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
    /// Where the surface is wood, whose it is not, and the least radius of wood to which it holds, metres.
    pub wood: (Spared, f64),
}

/// One internode among the solids of its site.
struct Trial<'a> {
    solids: &'a Solids,
    step: &'a Step<'a>,
    /// What its middle line keeps from surfaces beside the clearance, metres.
    margin: f64,
}

impl Solids {
    /// The heading of an internode that enters no solid and comes too near to no stem, nearest to the one that it
    /// wants; `None` where there is none.
    ///
    /// What is promised of the end: it lies in no solid, farther than ¼ of [`CLEARANCE`] from each, and by the radius
    /// of the internode farther, or by what more its start had if that is less; where the internode began in no solid,
    /// the line to it passes through none; where it holds, it is within the reach. The line comes no nearer to the bark
    /// of an axis than its radius and ¼ of the clearance, or than it began if that is less. Cost: some dozens of
    /// distances, of solids and stems that are near alone.
    pub fn way(&self, step: &Step) -> Option<Point> {
        let end = along(step.from, step.heading, step.length);
        if step.hold.is_none() && step.stems.is_none() && self.is_beside([step.from, end], CLEARANCE + step.radius) {
            // Nothing moves such an end.
            return Some(step.heading);
        }
        let trial = Trial::of(self, step);
        if let Some(free) = trial.relaxed(step.heading) {
            return Some(free);
        }
        let (surface, outward) = trial.what_stops()?;
        trial.beside(surface, outward).into_iter().flatten().find_map(|side| trial.relaxed(side))
    }

    /// Whether the internode of a step can have a heading: its end is free and within the reach of what it holds to,
    /// and nothing lies on the line to it.
    pub fn is_free(&self, step: &Step, heading: Point) -> bool {
        Trial::of(self, step).is_free(heading)
    }
}

impl<'a> Trial<'a> {
    fn of(solids: &'a Solids, step: &'a Step<'a>) -> Self {
        let near = if step.radius > 0.0 { solids.nearest(step.from, step.radius + FREE) } else { None };
        // As a shoot comes out of the ground, or along a wall nearer than it is thick, its start tells what it can
        // keep.
        let margin = near.map_or(step.radius, |near| step.radius.min((near.distance - FREE).max(0.0)));
        Self { solids, step, margin }
    }

    /// The surface on which an internode has ended that has no way nearly as it wants, with the direction out of it.
    fn what_stops(&self) -> Option<(Surface, Vector)> {
        let Self { solids, step, margin } = self;
        let end = along(step.from, step.heading, step.length);
        let reach = step.length + CLEARANCE + margin;
        let touched = step.stems.touched([step.from, end], CLEARANCE + step.radius, step.left);
        let at_end = solids.nearest(end, reach);
        if let Some(touch) = touched.filter(|_| at_end.is_none_or(|near| near.distance > CLEARANCE + margin)) {
            return Some((Surface::Wood, Vector::of(touch.outward)));
        }
        let Near { surface, .. } = at_end.or_else(|| solids.nearest(step.from, reach))?;
        // Asked at the start, which is in front of the surface: an end that is deep within may be nearer to its back.
        Some((surface, Vector::of(solids.outward(surface, step.from))))
    }

    /// The directions along a surface in which a shoot is tried, the likeliest first.
    fn beside(&self, surface: Surface, outward: Vector) -> [Option<Point>; 6] {
        let step = self.step;
        let heading = Vector::of(step.heading);
        let tangent = |direction: Vector| {
            let across = direction - outward * direction.dot(outward);
            (across.dot(across) > HEAD_ON).then(|| across.unit()).flatten()
        };
        let hold = step.hold.filter(|hold| hold.surface != surface);
        let wall = hold.map(|hold| self.held_at(&hold, step.from).1);
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
    fn relaxed(&self, heading: Point) -> Option<Point> {
        let step = self.step;
        let from = Vector::of(step.from);
        let tried = Vector::of(heading);
        let mut found = tried;
        for _ in 0..ROUNDS {
            let end = from + found * step.length;
            let moved = self.past_stems(self.pushed(self.drawn(end)));
            let by = moved - end;
            if by.dot(by) < 1e-14 {
                break;
            }
            found = (moved - from).unit()?;
        }
        let heading = [found.x, found.y, found.z];
        let free = found.dot(tried) > LEAST_COSINE && self.is_free(heading);
        free.then_some(heading)
    }

    /// The distance of a point from what a climber holds to, metres, and the direction out of it.
    fn held_at(&self, hold: &Hold, at: Point) -> (f64, Vector) {
        if hold.surface == Surface::Wood {
            let (spared, least_radius) = hold.wood;
            let found = self.step.stems.support(at, spared, least_radius);
            return found.map_or((f64::INFINITY, Vector::default()), |(distance, out)| (distance, Vector::of(out)));
        }
        (self.solids.distance(hold.surface, at), Vector::of(self.solids.outward(hold.surface, at)))
    }

    /// The distance of a point from what a climber holds to, metres.
    fn distance_held(&self, hold: &Hold, at: Point) -> f64 {
        match hold.surface {
            Surface::Wood => self.held_at(hold, at).0,
            surface => self.solids.distance(surface, at),
        }
    }

    /// The end of a climber's internode, drawn towards the distance at which it lies. Wood that has grown thicker about
    /// it lets it out again.
    fn drawn(&self, end: Vector) -> Vector {
        let Some(hold) = &self.step.hold else { return end };
        let at = [end.x, end.y, end.z];
        let most = 0.5 * self.step.length;
        if hold.surface != Surface::Wood {
            let beyond = self.solids.distance(hold.surface, at) - hold.cling;
            if beyond <= 0.0 {
                return end;
            }
            return end - Vector::of(self.solids.outward(hold.surface, at)) * beyond.min(most);
        }
        let (distance, outward) = self.held_at(hold, at);
        if distance.is_finite() { end - outward * (distance - hold.cling).clamp(-most, most) } else { end }
    }

    /// An end, moved out of the surface that is nearest.
    fn pushed(&self, end: Vector) -> Vector {
        let at = [end.x, end.y, end.z];
        let least = CLEARANCE + self.margin;
        match self.solids.nearest(at, least) {
            Some(near) => end + Vector::of(self.solids.outward(near.surface, at)) * (least - near.distance),
            None => end,
        }
    }

    /// An end, moved so far that the internode passes the stem that it touches by the most.
    fn past_stems(&self, end: Vector) -> Vector {
        let step = self.step;
        let ends = [step.from, [end.x, end.y, end.z]];
        match step.stems.touched(ends, CLEARANCE + step.radius, step.left) {
            Some(touch) => end + Vector::of(touch.outward) * (touch.lacks / touch.share.max(LEAST_SHARE)),
            None => end,
        }
    }

    fn is_free(&self, heading: Point) -> bool {
        let Self { solids, step, margin } = *self;
        let end = along(step.from, heading, step.length);
        if step.hold.is_some_and(|hold| self.distance_held(&hold, end) > hold.reach) {
            return false;
        }
        let began_free = || solids.nearest(step.from, CLEARANCE).is_none_or(|near| near.distance >= 0.0);
        let passes = || step.stems.touched([step.from, end], FREE + step.radius, step.left).is_none();
        solids.nearest(end, FREE + margin).is_none()
            && (!began_free() || solids.is_clear([step.from, heading], step.length, margin))
            && passes()
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

    fn step(from: Point, heading: Point, length: f64) -> Step<'static> {
        let up = [0.0, 0.0, 1.0];
        Step { from, heading, up, length, radius: 0.0, hold: None, left: true, stems: Beside::NONE }
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
        let hold = Hold { surface: Surface::Solid(0), cling: 0.004, reach: 0.02, wood: Default::default() };
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
