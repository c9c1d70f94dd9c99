//! The extent of plants: in the four directions that bound a picture, along the gaze, and along the three axes.
//!
//! In perspective a picture is bounded by four planes through the eye. The farthest point of a plant beyond each plane
//! determines the nearest eye that sees the whole plant. Maxima do not depend on the order of points.

use super::gaze::Gaze;
use glam::Vec3;

/// The extent of points, as seen along a gaze.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// The gaze.
    pub gaze: Gaze,
    /// The tangents of the angles to the sides of the picture, left, right, up and down; zeros in parallel projection.
    pub tangents: [f32; 4],
    /// The largest distance beyond each of the four planes through the origin, left, right, up and down, metres.
    pub most: [f32; 4],
    /// The smallest and the largest distance along the gaze, metres.
    pub depths: [f32; 2],
    /// The smallest and the largest distance to the right, metres.
    pub across: [f32; 2],
    /// The lower corner of the box along the axes.
    pub low: Vec3,
    /// The upper corner of the box along the axes.
    pub high: Vec3,
}

impl Extent {
    /// The extent of no points.
    pub fn new(gaze: Gaze, tangents: [f32; 4]) -> Self {
        Self {
            gaze,
            tangents,
            most: [f32::NEG_INFINITY; 4],
            depths: [f32::INFINITY, f32::NEG_INFINITY],
            across: [f32::INFINITY, f32::NEG_INFINITY],
            low: Vec3::INFINITY,
            high: Vec3::NEG_INFINITY,
        }
    }

    /// Adds a point.
    #[inline]
    pub fn add(&mut self, point: Vec3) {
        let (a, b, c) = (point.dot(self.gaze.right), point.dot(self.gaze.up), point.dot(self.gaze.forward));
        let [left, right, up, down] = self.tangents;
        let beyond = [-a - left * c, a - right * c, b - up * c, -b - down * c];
        (0..4).for_each(|k| self.most[k] = self.most[k].max(beyond[k]));
        self.depths = [self.depths[0].min(c), self.depths[1].max(c)];
        self.across = [self.across[0].min(a), self.across[1].max(a)];
        self.low = self.low.min(point);
        self.high = self.high.max(point);
    }

    /// Adds all places to which a point comes when it is turned around the Z axis. In each direction that bounds a
    /// picture the farthest of them lies at r √(a² + b²), where a and b are the parts of that direction to the right
    /// and along the level, and r is the distance of the point from the axis.
    #[inline]
    pub fn sweep(&mut self, point: Vec3) {
        let radius = (point.x * point.x + point.y * point.y).sqrt();
        let Gaze { up, forward, .. } = self.gaze;
        let ([left, right, above, below], level) = (self.tangents, |v: Vec3| (v.x * v.x + v.y * v.y).sqrt());
        let aside = |tangent: f32| {
            let ahead = tangent * level(forward);
            radius * (1.0 + ahead * ahead).sqrt() - tangent * point.z * forward.z
        };
        let along = |direction: Vec3| radius * level(direction) + point.z * direction.z;
        let beyond = [aside(left), aside(right), along(up - forward * above), along(-up - forward * below)];
        (0..4).for_each(|k| self.most[k] = self.most[k].max(beyond[k]));
        let (far, level) = (point.z * forward.z, radius * level(forward));
        self.depths = [self.depths[0].min(far - level), self.depths[1].max(far + level)];
        self.across = [self.across[0].min(-radius), self.across[1].max(radius)];
        self.low = self.low.min(Vec3::new(-radius, -radius, point.z));
        self.high = self.high.max(Vec3::new(radius, radius, point.z));
    }

    /// The extent of the points of both extents.
    pub fn join(mut self, other: &Self) -> Self {
        (0..4).for_each(|k| self.most[k] = self.most[k].max(other.most[k]));
        self.depths = [self.depths[0].min(other.depths[0]), self.depths[1].max(other.depths[1])];
        self.across = [self.across[0].min(other.across[0]), self.across[1].max(other.across[1])];
        self.low = self.low.min(other.low);
        self.high = self.high.max(other.high);
        self
    }

    /// The number of its measures.
    pub const MEASURES: usize = 14;

    /// How far it reaches in each direction that it knows.
    pub fn measures(&self) -> [f32; Self::MEASURES] {
        let ([a, b, c, d], [near, far], [left, right]) = (self.most, self.depths, self.across);
        let ([u, v, w], [x, y, z]) = ((-self.low).to_array(), self.high.to_array());
        [a, b, c, d, -near, far, -left, right, u, v, w, x, y, z]
    }

    /// Whether it reaches as far as another in each direction.
    pub fn holds(&self, other: &Self) -> bool {
        self.measures().iter().zip(other.measures()).all(|(own, other)| *own >= other)
    }

    /// The extent of the points moved by `offset`.
    pub fn moved(mut self, offset: Vec3) -> Self {
        let mut origin = Self::new(self.gaze, self.tangents);
        origin.add(offset);
        (0..4).for_each(|k| self.most[k] += origin.most[k]);
        (0..2).for_each(|k| {
            self.depths[k] += origin.depths[k];
            self.across[k] += origin.across[k];
        });
        self.low += offset;
        self.high += offset;
        self
    }
}

/// The corners of a box.
pub fn corners([low, high]: [Vec3; 2]) -> impl Iterator<Item = Vec3> {
    (0..8).map(move |corner| {
        let side = |bit: usize| if corner >> bit & 1 == 0 { low } else { high };
        Vec3::new(side(0).x, side(1).y, side(2).z)
    })
}
