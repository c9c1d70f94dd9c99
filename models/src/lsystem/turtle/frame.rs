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
    pub fn coordinates(&self, vector: Vector) -> Vector {
        [self.heading, self.left, self.up].map(|axis| dot(axis, vector))
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
        *first = [0, 1, 2].map(|i| cos * a[i] + sin * b[i]);
        *second = [0, 1, 2].map(|i| cos * b[i] - sin * a[i]);
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
            self.rotate(torque.map(|x| x / length), elasticity * length);
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
    fn rotate(&mut self, axis: Vector, angle: f64) {
        let (sin, cos) = sincos(angle);
        self.rotate_by(axis, sin, cos);
    }

    /// Rodrigues' formula.
    fn rotate_by(&mut self, axis: Vector, sin: f64, cos: f64) {
        for vector in [&mut self.heading, &mut self.left, &mut self.up] {
            let (across, along) = (cross(axis, *vector), (1.0 - cos) * dot(axis, *vector));
            *vector = [0, 1, 2].map(|i| cos * vector[i] + sin * across[i] + along * axis[i]);
        }
    }
}
