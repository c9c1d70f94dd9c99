//! Solids with flat faces: half of space, boxes, upright cylinders and cones.
//!
//! Boxes, cylinders and cones stand on the middle of their base. Distances are exact; those of cones after Quilez,
//! "Distance functions" (capped cone). Absent: turned solids (`placed`).

use super::bounds::Bounds;
use super::{Point, Solid, dot, from, length};

/// All that lies on one side of a plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfSpace {
    /// A point on the plane, metres.
    pub point: Point,
    /// The direction out of the half space; of any length that is not below [`HalfSpace::SHORTEST`].
    pub normal: Point,
}

impl HalfSpace {
    /// The shortest length of a normal: the square of a length far below it is 0, and distances would be no numbers.
    pub const SHORTEST: f64 = 1e-100;

    /// Whether a vector has no direction that can be told, being shorter than any normal may be.
    pub fn is_too_short(normal: Point) -> bool {
        length(normal) < Self::SHORTEST
    }
}

impl Solid for HalfSpace {
    fn inside(&self, point: Point) -> bool {
        dot(from(self.point, point), self.normal) <= 0.0
    }

    fn distance(&self, point: Point) -> f64 {
        dot(from(self.point, point), self.normal) / length(self.normal)
    }

    /// Bounded along an axis that the normal follows.
    fn bounds(&self) -> Bounds {
        let mut bounds = Bounds::EVERYWHERE;
        for axis in 0..3 {
            let follows = (0..3).all(|k| (k == axis) == (self.normal[k] != 0.0));
            if follows && self.normal[axis] > 0.0 {
                bounds.high[axis] = self.point[axis];
            } else if follows {
                bounds.low[axis] = self.point[axis];
            }
        }
        bounds
    }
}

/// A box along the axes. A face may lie at infinity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cuboid {
    /// The smallest coordinates, metres.
    pub low: Point,
    /// The largest coordinates, metres.
    pub high: Point,
}

impl Cuboid {
    /// The box that stands on the point `base`, its extents in x, y and z in metres.
    pub fn on(base: Point, size: [f64; 3]) -> Self {
        let (x, y) = (size[0] / 2.0, size[1] / 2.0);
        Self { low: [base[0] - x, base[1] - y, base[2]], high: [base[0] + x, base[1] + y, base[2] + size[2]] }
    }
}

impl Solid for Cuboid {
    #[inline]
    fn inside(&self, point: Point) -> bool {
        Bounds { low: self.low, high: self.high }.holds(point)
    }

    fn distance(&self, point: Point) -> f64 {
        let beyond = [0, 1, 2].map(|k| (self.low[k] - point[k]).max(point[k] - self.high[k]));
        let outside = length(beyond.map(|x| x.max(0.0)));
        outside + beyond[0].max(beyond[1]).max(beyond[2]).min(0.0)
    }

    fn bounds(&self) -> Bounds {
        Bounds { low: self.low, high: self.high }
    }
}

/// An upright cylinder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    /// The middle of its base, metres.
    pub base: Point,
    /// Its radius, metres.
    pub radius: f64,
    /// Its height, metres.
    pub height: f64,
}

impl Solid for Cylinder {
    fn inside(&self, point: Point) -> bool {
        let [x, y, z] = from(self.base, point);
        0.0 <= z && z <= self.height && x * x + y * y <= self.radius * self.radius
    }

    fn distance(&self, point: Point) -> f64 {
        let [x, y, z] = from(self.base, point);
        let beyond = [(x * x + y * y).sqrt() - self.radius, (z - self.height).max(-z)];
        let outside = beyond.map(|x| x.max(0.0));
        (outside[0] * outside[0] + outside[1] * outside[1]).sqrt() + beyond[0].max(beyond[1]).min(0.0)
    }

    fn bounds(&self) -> Bounds {
        standing(self.base, self.radius, self.height)
    }
}

/// An upright cone, or a part of one between two level planes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cone {
    /// The middle of its base, metres.
    pub base: Point,
    /// The radius of its base, metres.
    pub radius: f64,
    /// The radius of its top, metres; 0 for a point.
    pub top_radius: f64,
    /// Its height, metres.
    pub height: f64,
}

impl Solid for Cone {
    fn inside(&self, point: Point) -> bool {
        let [x, y, z] = from(self.base, point);
        let radius = self.radius + (self.top_radius - self.radius) * (z / self.height);
        0.0 <= z && z <= self.height && radius >= 0.0 && x * x + y * y <= radius * radius
    }

    /// The smaller of the distances to the nearer of base and top and to the mantle, in the half plane through the
    /// axis.
    fn distance(&self, point: Point) -> f64 {
        let [x, y, z] = from(self.base, point);
        let across = (x * x + y * y).sqrt();
        let disc = if z < 0.5 * self.height { self.radius } else { self.top_radius };
        let to_disc = [across - across.min(disc), (z - 0.5 * self.height).abs() - 0.5 * self.height];
        let mantle = [self.top_radius - self.radius, self.height];
        let along =
            ((across - self.radius) * mantle[0] + z * mantle[1]) / (mantle[0] * mantle[0] + mantle[1] * mantle[1]);
        let along = along.clamp(0.0, 1.0);
        let to_mantle = [across - self.radius - mantle[0] * along, z - mantle[1] * along];
        let square = |v: [f64; 2]| v[0] * v[0] + v[1] * v[1];
        let distance = square(to_disc).min(square(to_mantle)).sqrt();
        if self.inside(point) { -distance } else { distance }
    }

    fn bounds(&self) -> Bounds {
        standing(self.base, self.radius.max(self.top_radius), self.height)
    }
}

fn standing(base: Point, radius: f64, height: f64) -> Bounds {
    Cuboid::on(base, [2.0 * radius, 2.0 * radius, height]).bounds()
}
