//! Where a turtle is and how it is turned, in its own coordinates: y is up.
//!
//! H, L and U are unit vectors at right angles, U = H × L (Prusinkiewicz & Lindenmayer 1990 §1.5). At first H is +y and
//! L is −x, so U is +z. Turns go by the rule of the right hand about an axis: `+` about U, `&` about L and `/` about H
//! by the angle, `-`, `^` and `\` by the opposite angle: so `+` turns left, `&` pitches down, and `/` rolls right, by
//! which the left side goes up. Absent: what is drawn.

use super::command::Axis;
use crate::lsystem::vector::{NOTHING, Vector, cross, dot, unit};
use phytomer_sim::math::sincos;

/// Position and axes of a turtle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Its position.
    pub position: Vector,
    /// H.
    pub heading: Vector,
    /// L.
    pub left: Vector,
    /// U.
    pub up: Vector,
}

impl Frame {
    /// At the origin, upright.
    pub const START: Self =
        Self { position: [0.0; 3], heading: [0.0, 1.0, 0.0], left: [-1.0, 0.0, 0.0], up: [0.0, 0.0, 1.0] };

    /// One of the axes.
    pub fn axis(&self, axis: Axis) -> Vector {
        match axis {
            Axis::Heading => self.heading,
            Axis::Left => self.left,
            Axis::Up => self.up,
        }
    }

    /// A vector in the coordinates of the frame: along H, L and U.
    #[inline]
    pub fn coordinates(&self, vector: Vector) -> Vector {
        [dot(self.heading, vector), dot(self.left, vector), dot(self.up, vector)]
    }

    /// Turns by the angle of a sine and a cosine about one of its axes.
    #[inline]
    pub fn turn(&mut self, about: Axis, sin: f64, cos: f64) {
        let (first, second) = match about {
            Axis::Up => (&mut self.heading, &mut self.left),
            Axis::Left => (&mut self.up, &mut self.heading),
            Axis::Heading => (&mut self.left, &mut self.up),
        };
        let (a, b) = (*first, *second);
        *first = [cos * a[0] + sin * b[0], cos * a[1] + sin * b[1], cos * a[2] + sin * b[2]];
        *second = [cos * b[0] - sin * a[0], cos * b[1] - sin * a[1], cos * b[2] - sin * a[2]];
    }

    /// Half a turn about U.
    pub fn turn_around(&mut self) {
        self.heading = self.heading.map(|x| -x);
        self.left = self.left.map(|x| -x);
    }

    /// Goes a length along the heading.
    #[inline]
    pub fn go(&mut self, length: f64) {
        (0..3).for_each(|i| self.position[i] += length * self.heading[i]);
    }

    /// Rolls until L is horizontal: L = V × H / |V × H| and U = H × L, V being the upward vertical (Prusinkiewicz &
    /// Lindenmayer 1990 ch. 2). Where H is vertical nothing turns.
    pub fn roll_upright(&mut self) {
        let [x, _, z] = self.heading;
        let square = x * x + z * z;
        if square > NOTHING {
            let length = square.sqrt();
            self.left = [z / length, 0.0, -x / length];
            self.up = cross(self.heading, self.left);
        }
    }

    /// The tropism: turns by α = e |H × T|, radians, about H × T (ibid.).
    #[inline]
    pub fn bend(&mut self, tropism: Vector, elasticity: f64) {
        let torque = cross(self.heading, tropism);
        let square = dot(torque, torque);
        if square > NOTHING {
            let length = square.sqrt();
            self.rotate([torque[0] / length, torque[1] / length, torque[2] / length], elasticity * length);
        }
    }

    /// Turns the heading to a direction, by the shortest way; nothing turns where it has none.
    pub fn head(&mut self, heading: Vector) {
        let square = dot(heading, heading);
        if !(square > NOTHING && square.is_finite()) {
            return;
        }
        let length = square.sqrt();
        let heading = heading.map(|x| x / length);
        let axis = cross(self.heading, heading);
        let (sin, cos) = (dot(axis, axis).sqrt(), dot(self.heading, heading));
        if sin > 1e-12 {
            self.rotate_by(axis.map(|x| x / sin), sin, cos);
        } else if cos < 0.0 {
            self.turn_around();
        }
        self.heading = heading;
        self.left = unit(cross(self.up, heading)).unwrap_or(self.left);
        self.up = cross(heading, self.left);
    }

    /// Rolls until U is the part of a direction across the heading; nothing turns where that has none.
    pub fn roll_to(&mut self, up: Vector) {
        if let Some(left) = unit(cross(up, self.heading)) {
            self.left = left;
            self.up = cross(self.heading, left);
        }
    }

    /// Turns by an angle about a unit vector.
    #[inline]
    fn rotate(&mut self, axis: Vector, angle: f64) {
        let (sin, cos) = sincos(angle);
        self.rotate_by(axis, sin, cos);
    }

    /// Rodrigues' formula.
    fn rotate_by(&mut self, axis: Vector, sin: f64, cos: f64) {
        for vector in [&mut self.heading, &mut self.left, &mut self.up] {
            let (across, along) = (cross(axis, *vector), (1.0 - cos) * dot(axis, *vector));
            let turned = |i: usize| cos * vector[i] + sin * across[i] + along * axis[i];
            *vector = [turned(0), turned(1), turned(2)];
        }
    }
}
