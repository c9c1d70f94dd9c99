//! The site as a plant meets it: what is shut to growth, what shades, and how far the nearest surface is.
//!
//! Bodies are the obstacles that kill what is inside them; obstacles that kill what is outside shut space as well, but
//! have no surface to hold to and cast no shade. Absent: other plants.

use phytomer_sim::shape::SURFACE;
use phytomer_sim::site::{Obstacle, Side, Site};

/// The site as a plant meets it that stands at `place`.
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
        !self.site.obstacles.is_empty() && self.site.kills_at(self.world(at))
    }

    /// Whether a body stands there, which shades.
    pub fn is_solid(&self, at: [f64; 3]) -> bool {
        self.bodies().any(|body| body.kills_at(self.world(at)))
    }

    /// The distance to the nearest surface of a body, metres, negative inside; infinite where there is no body. Of soft
    /// objects and blends it is ½ less their field, which is no distance and never exceeds ½ where no part takes away.
    pub fn distance(&self, at: [f64; 3]) -> f64 {
        self.bodies().map(|body| SURFACE - body.shape.field(self.world(at))).fold(f64::INFINITY, f64::min)
    }
}
