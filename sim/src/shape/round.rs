//! Round solids: spheres, ellipsoids, capsules and tori.
//!
//! Distances are exact but for those of ellipsoids, which are of the first order: exact on the surface, and of the
//! right sign everywhere. Absent: turned solids (`placed`).

use super::bounds::Bounds;
use super::{Point, Solid, along_line, from, length};

/// A ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Its centre, metres.
    pub centre: Point,
    /// Its radius, metres.
    pub radius: f64,
}

impl Solid for Sphere {
    fn inside(&self, point: Point) -> bool {
        let [x, y, z] = from(self.centre, point);
        x * x + y * y + z * z <= self.radius * self.radius
    }

    fn distance(&self, point: Point) -> f64 {
        length(from(self.centre, point)) - self.radius
    }

    fn bounds(&self) -> Bounds {
        Bounds::of_ball(self.centre, self.radius)
    }
}

/// An ellipsoid along the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ellipsoid {
    /// Its centre, metres.
    pub centre: Point,
    /// Its half axes in x, y and z, metres.
    pub radii: [f64; 3],
}

impl Ellipsoid {
    /// Σ (xₖ / rₖ)²: 1 on the surface.
    pub fn square(&self, point: Point) -> f64 {
        let at = from(self.centre, point);
        (0..3).map(|k| (at[k] / self.radii[k]) * (at[k] / self.radii[k])).sum()
    }
}

impl Solid for Ellipsoid {
    fn inside(&self, point: Point) -> bool {
        self.square(point) <= 1.0
    }

    /// k (k − 1) / |∇(k²) / 2| with k² = Σ (xᵢ / rᵢ)² (Quilez, "Distance functions", ellipsoid).
    fn distance(&self, point: Point) -> f64 {
        let at = from(self.centre, point);
        let k = self.square(point).sqrt();
        let slope = length([0, 1, 2].map(|i| at[i] / (self.radii[i] * self.radii[i])));
        let least = self.radii[0].min(self.radii[1]).min(self.radii[2]);
        if slope > 0.0 { (k * (k - 1.0) / slope).max(-least) } else { -least }
    }

    fn bounds(&self) -> Bounds {
        Bounds {
            low: [0, 1, 2].map(|k| self.centre[k] - self.radii[k]),
            high: [0, 1, 2].map(|k| self.centre[k] + self.radii[k]),
        }
    }
}

/// All that is not farther than a radius from a line between two points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capsule {
    /// One end of the line, metres.
    pub start: Point,
    /// The other end, metres.
    pub end: Point,
    /// The radius, metres.
    pub radius: f64,
}

impl Solid for Capsule {
    fn inside(&self, point: Point) -> bool {
        self.distance(point) <= 0.0
    }

    fn distance(&self, point: Point) -> f64 {
        let (_, nearest) = along_line(self.start, self.end, point);
        length(from(nearest, point)) - self.radius
    }

    fn bounds(&self) -> Bounds {
        Bounds::of_points([&self.start, &self.end]).with_margin(self.radius)
    }
}

/// A level ring: all that is not farther than a radius from a circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Torus {
    /// The middle of the ring, metres.
    pub centre: Point,
    /// The radius of the circle, metres.
    pub ring: f64,
    /// The radius of the tube, metres.
    pub tube: f64,
}

impl Solid for Torus {
    fn inside(&self, point: Point) -> bool {
        self.distance(point) <= 0.0
    }

    fn distance(&self, point: Point) -> f64 {
        let [x, y, z] = from(self.centre, point);
        let across = (x * x + y * y).sqrt() - self.ring;
        (across * across + z * z).sqrt() - self.tube
    }

    fn bounds(&self) -> Bounds {
        let across = self.ring + self.tube;
        let [x, y, z] = self.centre;
        Bounds { low: [x - across, y - across, z - self.tube], high: [x + across, y + across, z + self.tube] }
    }
}
