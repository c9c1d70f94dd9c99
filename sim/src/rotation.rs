//! Rotations in double precision: how a component stands in the frame of what bears it.
//!
//! The coordinates of a frame are x along its heading, y to its left (up × heading) and z along its upper side. A
//! rotation turns within those: `a.then(b)` is a, and then b in the frame that a has made, as a turtle turns.

use crate::math::{atan2, sincos};
use crate::vector::Vector;

/// The square of the turn from which on it is no longer small, rad².
const FAR: f64 = 0.25;

/// Below this square of its length a vector has no direction.
const NOTHING: f64 = 1e-24;

/// A rotation as a unit quaternion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rotation {
    scalar: f64,
    vector: Vector,
}

impl Rotation {
    /// The rotation by 0.
    pub const NONE: Self = Self { scalar: 1.0, vector: Vector { x: 0.0, y: 0.0, z: 0.0 } };

    /// By `angle`, radians, about an axis by the rule of the right hand; nothing about an axis without direction.
    pub fn about(axis: [f64; 3], angle: f64) -> Self {
        let axis = Vector::of(axis);
        let square = axis.dot(axis);
        if !(square > NOTHING && square.is_finite() && angle.is_finite()) {
            return Self::NONE;
        }
        let (sin, cos) = sincos(0.5 * angle);
        Self { scalar: cos, vector: axis * (sin / square.sqrt()) }
    }

    /// The rotation after which a component has this heading and this upper side, both in the coordinates of the frame
    /// that bears it. Of `up` the part across the heading counts. Where either has no direction, or both have the same,
    /// the turn from x to the heading that is the shortest.
    #[inline]
    pub fn to(heading: [f64; 3], up: [f64; 3]) -> Self {
        let heading = Vector::of(heading);
        let Some(x) = heading.unit() else { return Self::NONE };
        let up = Vector::of(up);
        let Some(z) = (up - x * up.dot(x)).unit() else { return Self::shortest(x) };
        Self::of_basis(x, z.cross(x), z)
    }

    /// The quaternion of a right-handed basis (Shepperd 1978): the largest of its four parts is divided by, so that
    /// nothing is lost near half a turn.
    #[inline]
    fn of_basis(x: Vector, y: Vector, z: Vector) -> Self {
        let squares = [1.0 + x.x + y.y + z.z, 1.0 + x.x - y.y - z.z, 1.0 - x.x + y.y - z.z, 1.0 - x.x - y.y + z.z];
        let [w, a, b, c] = squares;
        let (out, back) = ([y.z - z.y, z.x - x.z, x.y - y.x], [y.z + z.y, z.x + x.z, x.y + y.x]);
        let parts = [
            (w, Vector::new(out[0], out[1], out[2])),
            (out[0], Vector::new(a, back[2], back[1])),
            (out[1], Vector::new(back[2], b, back[0])),
            (out[2], Vector::new(back[1], back[0], c)),
        ];
        // Chosen by its place, without a branch: which is the largest changes from node to node.
        let of_last = if b >= c { 2 } else { 3 };
        let of_vector = if (a >= b) & (a >= c) { 1 } else { of_last };
        let place: usize = if (w >= a) & (w >= b) & (w >= c) { 0 } else { of_vector };
        let (scalar, vector) = parts[place];
        Self { scalar, vector }.normalized()
    }

    /// The rotation that takes one direction to another and turns no more than that, both in the coordinates of one
    /// frame; nothing where either has no direction. Of half a turn any of the axes across is taken.
    pub(crate) fn between(from: Vector, to: Vector) -> Self {
        let (Some(from), Some(to)) = (from.unit(), to.unit()) else { return Self::NONE };
        let scalar = 1.0 + from.dot(to);
        if scalar > 1e-12 {
            return Self { scalar, vector: from.cross(to) }.normalized();
        }
        let level = Vector::new(0.0, 0.0, 1.0).cross(from);
        let axis = level.unit().unwrap_or(Vector::new(1.0, 0.0, 0.0));
        Self { scalar: 0.0, vector: axis }
    }

    /// Whether another rotation is the same but for rounding in single precision: both turn by angles that differ by
    /// less than 10⁻⁶ rad, about.
    pub(crate) fn is_near(self, other: Self) -> bool {
        let cosine = self.scalar * other.scalar + self.vector.dot(other.vector);
        let apart = |sign: f64| {
            let (scalar, vector) = (self.scalar - sign * other.scalar, self.vector - other.vector * sign);
            scalar * scalar + vector.dot(vector)
        };
        apart(if cosine < 0.0 { -1.0 } else { 1.0 }) < 2.5e-13
    }

    /// The rotation a share of the way from this one to another, by the shorter of the two ways and at an even speed
    /// (Shoemake 1985, *Animating rotation with quaternion curves*, §3.3).
    pub(crate) fn toward(self, other: Self, share: f64) -> Self {
        let step = self.inverse().then(other).normalized();
        let sign = if step.scalar < 0.0 { -1.0 } else { 1.0 };
        let sine = step.vector.dot(step.vector).sqrt();
        let angle = 2.0 * atan2(sine, sign * step.scalar);
        let axis = step.vector * sign;
        self.then(Self::about([axis.x, axis.y, axis.z], share * angle)).normalized()
    }

    /// The rotation that takes this one back.
    pub fn inverse(self) -> Self {
        Self { scalar: self.scalar, vector: self.vector * -1.0 }
    }

    fn shortest(x: Vector) -> Self {
        let scalar = 1.0 + x.x;
        if scalar > 1e-12 {
            Self { scalar, vector: Vector::new(0.0, -x.z, x.y) }.normalized()
        } else {
            Self { scalar: 0.0, vector: Vector::new(0.0, 0.0, 1.0) }
        }
    }

    /// This rotation, then `next` in the frame that this one has made.
    #[inline]
    pub fn then(self, next: Self) -> Self {
        self.within(next.scalar, next.vector)
    }

    /// The vector after this rotation.
    pub fn turned(self, vector: [f64; 3]) -> [f64; 3] {
        let Vector { x, y, z } = self.of(Vector::of(vector));
        [x, y, z]
    }

    /// Scalar and vector as they are stored: of a unit quaternion, never all 0.
    #[inline]
    pub(crate) fn parts(self) -> [f64; 4] {
        [self.scalar, self.vector.x, self.vector.y, self.vector.z]
    }

    /// The rotation of stored parts.
    #[inline]
    pub(crate) fn of_parts([scalar, x, y, z]: [f64; 4]) -> Self {
        Self { scalar, vector: Vector::new(x, y, z) }
    }

    /// This, and then within it the rotation by a small vector w. Of tan(θ/2) θ/2 + θ³/24 is taken, and of the length
    /// of the product, which is √(1 + tan²(θ/2)), the first terms of its series: together they are 10⁻⁵ rad short for a
    /// turn of half a radian.
    #[inline]
    pub(crate) fn by(self, turn: Vector) -> Self {
        let square = turn.dot(turn);
        if square > FAR {
            return self.by_far(turn, square);
        }
        let vector = turn * (0.5 + square * (1.0 / 24.0));
        let t = vector.dot(vector);
        let shrink = 1.0 - t * (0.5 - t * (0.375 - t * 0.3125));
        self.within(shrink, vector * shrink)
    }

    /// The same for any turn.
    #[cold]
    fn by_far(self, turn: Vector, square: f64) -> Self {
        let angle = square.sqrt();
        let (sin, cos) = sincos(0.5 * angle);
        self.within(cos, turn * (sin / angle))
    }

    #[inline]
    fn within(self, scalar: f64, vector: Vector) -> Self {
        Self {
            scalar: self.scalar * scalar - self.vector.dot(vector),
            vector: vector * self.scalar + self.vector * scalar + self.vector.cross(vector),
        }
    }

    #[inline]
    pub(crate) fn of(self, direction: Vector) -> Vector {
        let across = self.vector.cross(direction) * 2.0;
        direction + across * self.scalar + self.vector.cross(across)
    }

    /// The same rotation, its quaternion of length 1 again after rounding.
    #[inline]
    pub fn normalized(self) -> Self {
        let scale = 1.0 / (self.scalar * self.scalar + self.vector.dot(self.vector)).sqrt();
        Self { scalar: self.scalar * scale, vector: self.vector * scale }
    }
}

impl Vector {
    #[inline]
    pub(crate) fn of([x, y, z]: [f64; 3]) -> Self {
        Self::new(x, y, z)
    }

    /// Its direction, where it has one.
    #[inline]
    pub(crate) fn unit(self) -> Option<Self> {
        let square = self.dot(self);
        (square > NOTHING && square.is_finite()).then(|| self * (1.0 / square.sqrt()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn near(a: [f64; 3], b: [f64; 3]) {
        assert!((0..3).all(|k| (a[k] - b[k]).abs() < 1e-12), "{a:?} {b:?}");
    }

    #[test]
    fn a_turtle_turns_in_its_own_frame() {
        let left = Rotation::about([0.0, 0.0, 1.0], FRAC_PI_2);
        let rolled = left.then(Rotation::about([1.0, 0.0, 0.0], FRAC_PI_2));
        near(left.turned([1.0, 0.0, 0.0]), [0.0, 1.0, 0.0]);
        near(rolled.turned([1.0, 0.0, 0.0]), [0.0, 1.0, 0.0]);
        near(rolled.turned([0.0, 0.0, 1.0]), [1.0, 0.0, 0.0]);
    }

    /// Whatever the angle, up to half a turn about any axis.
    #[test]
    fn a_rotation_is_found_from_its_directions() {
        for axis in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 2.0, -0.5], [-0.3, 0.1, 0.9]] {
            for angle in [0.0, 1e-9, 0.3, FRAC_PI_2, 3.0, PI - 1e-9, PI, -2.0] {
                let rotation = Rotation::about(axis, angle);
                let (heading, up) = (rotation.turned([1.0, 0.0, 0.0]), rotation.turned([0.0, 0.0, 1.0]));
                let found = Rotation::to(heading, up.map(|x| 3.0 * x));
                near(found.turned([0.2, -0.7, 1.1]), rotation.turned([0.2, -0.7, 1.1]));
            }
        }
    }

    #[test]
    fn the_turn_between_two_directions_is_the_shortest_and_goes_back() {
        let [x, z] = [Vector::new(1.0, 0.0, 0.0), Vector::new(0.0, 0.0, 1.0)];
        for to in [[0.0, 0.6, 0.8], [-1.0, 0.0, 0.0], [0.5, -0.1, 3.0], [1.0, 0.0, 0.0]].map(Vector::of) {
            for from in [x, z, z * -1.0, to * -2.0] {
                let turn = Rotation::between(from, to);
                let (found, expected) = (turn.of(from).unit().unwrap(), to.unit().unwrap());
                near([found.x, found.y, found.z], [expected.x, expected.y, expected.z]);
                let back = turn.then(turn.inverse());
                near(back.turned([0.3, -0.2, 0.5]), [0.3, -0.2, 0.5]);
                // What lies across both stays where it is.
                let across = from.cross(to);
                near(turn.turned([across.x, across.y, across.z]), [across.x, across.y, across.z]);
            }
        }
        assert_eq!(Rotation::between(Vector::default(), x), Rotation::NONE);
    }

    /// Half of the way twice is the whole way, and of two ways around the shorter one is taken.
    #[test]
    fn the_way_to_another_rotation_is_even_and_the_shorter_one() {
        let rotations =
            [([1.0, 2.0, -0.5], 0.4), ([0.0, 0.0, 1.0], 3.0), ([0.3, 0.0, 1.0], -2.9), ([1.0, 0.0, 0.0], 1e-7)];
        for (axis, angle) in rotations {
            for (other, turn) in rotations {
                let [from, to] = [Rotation::about(axis, angle), Rotation::about(other, turn)];
                let half = from.toward(to, 0.5);
                let seen = [0.2, -0.7, 1.1];
                near(half.toward(to, 1.0).turned(seen), to.turned(seen));
                near(from.toward(to, 0.0).turned(seen), from.turned(seen));
                let (one, two) = (from.inverse().then(half), half.inverse().then(to));
                near(one.turned(seen), two.turned(seen));
                assert!(one.scalar >= crate::math::cos(0.25 * PI) - 1e-9, "more than half of half a turn: {one:?}");
            }
        }
    }

    #[test]
    fn what_has_no_direction_turns_nothing_and_no_upper_side_is_the_shortest_turn() {
        assert_eq!(Rotation::to([0.0; 3], [0.0, 0.0, 1.0]), Rotation::NONE);
        assert_eq!(Rotation::to([f64::NAN; 3], [0.0, 0.0, 1.0]), Rotation::NONE);
        assert_eq!(Rotation::about([0.0; 3], 1.0), Rotation::NONE);
        for heading in [[0.0, 0.6, 0.8], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]] {
            near(Rotation::to(heading, heading).turned([1.0, 0.0, 0.0]), heading);
        }
    }
}
