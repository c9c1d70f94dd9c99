//! The site as a plant meets it: what is shut to growth, what shades, and how far the nearest surface is.
//!
//! Bodies are the obstacles that kill what is inside them; obstacles that kill what is outside shut space as well, but
//! have no surface to hold to and cast no shade. Absent: other plants (`space`).

use phytomer_sim::site::{Obstacle, Side, Site};

/// A vector of length 1; `None` of one without direction.
pub(super) fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    (length > 1e-12 && length.is_finite()).then(|| vector.map(|x| x / length))
}

/// The site as a plant meets it that stands at `place`.
#[derive(Clone, Copy)]
pub(super) struct Around<'a> {
    pub site: &'a Site,
    pub place: [f64; 3],
}

impl Around<'_> {
    fn world(&self, at: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| at[k] + self.place[k])
    }

    fn bodies(&self) -> impl Iterator<Item = &Obstacle> {
        self.site.obstacles.iter().filter(|obstacle| obstacle.kills == Side::Inside)
    }

    pub fn has_bodies(&self) -> bool {
        self.bodies().next().is_some()
    }

    /// Whether nothing can grow there.
    pub fn is_shut(&self, at: [f64; 3]) -> bool {
        !self.site.obstacles.is_empty() && self.site.bars_at(self.world(at))
    }

    /// Whether a body stands there, which shades.
    pub fn is_solid(&self, at: [f64; 3]) -> bool {
        self.bodies().any(|body| body.bars_at(self.world(at)))
    }

    /// The distance to the nearest surface of a body, metres, negative inside; infinite where there is no body.
    pub fn distance(&self, at: [f64; 3]) -> f64 {
        self.bodies().map(|body| body.shape.distance(self.world(at))).fold(f64::INFINITY, f64::min)
    }

    /// The direction in which space opens at a place on the surface of an obstacle; `None` where nothing is shut there,
    /// and where the field of what shuts it has no slope.
    pub fn opens(&self, at: [f64; 3], step: f64) -> Option<[f64; 3]> {
        let world = self.world(at);
        let obstacle = self.site.obstacles.iter().find(|obstacle| obstacle.bars_at(world))?;
        let field = |axis: usize, by: f64| {
            let beside = [0, 1, 2].map(|k| world[k] + if k == axis { by } else { 0.0 });
            obstacle.shape.field(beside)
        };
        let side = if obstacle.kills == Side::Inside { -1.0 } else { 1.0 };
        unit([0, 1, 2].map(|axis| side * (field(axis, step) - field(axis, -step)) / step))
    }
}
