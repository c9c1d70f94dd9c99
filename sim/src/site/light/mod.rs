//! Light in a plot: how much of the light of open ground reaches each place, and what leaves, wood and obstacles keep.
//!
//! Leaf area fills small boxes of space ([`grid`]); parallel beams from the sky and the sun cross them ([`beam`]),
//! and a box keeps I · (1 − e^(−G a l)) of a beam of the intensity I, where a is the leaf area in a m³ of the box, l
//! the way of the beam in it and G the share of leaf area that the beam meets (Sinoquet et al. 2001, *Plant, Cell &
//! Environment* 24: 395–406, the model RATP; paths in boxes by Amanatides & Woo 1987, *Eurographics*: 3–10). Shapes
//! that are opaque stop a beam at their surface ([`shadow`]). What lights a plot is a list of [`Source`]s ([`sky`],
//! [`sun`]). A [`LightModel`] makes of a [`Canopy`] and its sources a [`Lit`] plot, which buds, tables and tests
//! ask.
//!
//! Light is told as a share of that on open, level ground; amounts are m² of open ground that would catch as much.
//! Absent: light that leaves scatter, colours of light, photosynthesis.

mod added;
pub mod beam;
pub mod canopy;
mod counted;
pub mod field;
#[cfg(target_arch = "x86_64")]
mod four;
pub mod grid;
pub mod lattice;
pub mod loss;
pub mod normals;
pub mod shadow;
pub mod sky;
pub mod spot;
pub mod sun;
pub mod sweep;
mod tiles;
pub mod wanted;

#[cfg(test)]
mod tests_balance;
#[cfg(test)]
mod tests_canopy;
#[cfg(test)]
mod tests_grid;
#[cfg(test)]
mod tests_sphere;
#[cfg(test)]
mod tests_sweep;
#[cfg(test)]
mod tests_wall;

pub use canopy::{Canopy, Piece, Standing};
pub use counted::Counted;
pub use field::Field;
pub use sky::{Sky, SkyKind};
pub use sun::SunPath;

use crate::shape::{Point, Shape};
use std::fmt::Debug;
use std::sync::Arc;

/// A part of the sky, or the sun, that sends parallel light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Source {
    /// The unit vector that points to it; its third part is the sine of its elevation, above 0.
    pub towards: [f64; 3],
    /// Its share of the light on open, level ground; those of all sources sum to 1.
    pub weight: f64,
}

/// How much of the area of leaves, by one side, a beam meets: the factor G of Ross (1981).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// The same in all directions; ½ where leaves have all inclinations as the surface of a sphere has them.
    Even(f64),
    /// That of the leaves themselves, by the directions of their normals.
    OfLeaves,
}

/// What lies beyond the sides of a plot.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Borders {
    /// Open ground.
    #[default]
    Open,
    /// The plot again and again: it has this width along X and along Y, metres.
    Periodic([f64; 2]),
}

/// How a plot is lit.
#[derive(Debug, Clone, PartialEq)]
pub struct Lighting {
    /// The edge of the boxes, metres.
    pub voxel_m: f64,
    /// How much of the area of leaves a beam meets.
    pub projection: Projection,
    /// What lies beyond the sides.
    pub borders: Borders,
    /// The sky.
    pub sky: Sky,
    /// The sun; `None` where all light is that of the sky.
    pub sun: Option<SunPath>,
    /// Whether wood keeps light as leaves do.
    pub wood: bool,
    /// What stops light, in the coordinates of the plot, metres.
    pub opaque: Vec<Arc<Shape>>,
    /// The place of the plot, metres: a corner of boxes.
    pub origin: Point,
}

impl Default for Lighting {
    fn default() -> Self {
        Self {
            voxel_m: 0.1,
            projection: Projection::Even(0.5),
            borders: Borders::Open,
            sky: Sky::default(),
            sun: None,
            wood: false,
            opaque: Vec::new(),
            origin: [0.0; 3],
        }
    }
}

impl Lighting {
    /// The light of a plot at another place, `by` metres farther.
    pub fn moved(&self, by: Point) -> Self {
        let opaque = self.opaque.iter().map(|shape| Arc::new(shape.moved(by))).collect();
        Self { opaque, origin: [0, 1, 2].map(|k| self.origin[k] + by[k]), ..self.clone() }
    }

    /// What lights the plot at a tick.
    pub fn sources(&self, tick: crate::Tick) -> Vec<Source> {
        match &self.sun {
            Some(sun) => sun.with_sky(&self.sky, tick),
            None => self.sky.sources(),
        }
    }
}

/// The light of a plot: how it is lit, who asks, and what was found at the end of the last tick.
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// How the plot is lit.
    pub lighting: Lighting,
    /// Whether buds of some member read it, so that growth must follow the clock.
    pub felt: bool,
    /// Whether it is recorded: then it is found whenever the plants stand.
    pub told: bool,
    /// What was found when the plants last stood.
    pub found: Option<Arc<Field>>,
    /// The leaf area that they had then.
    pub counted: Counted,
}

impl Light {
    /// The light of a plot before its first tick, which nobody asks for yet.
    pub fn of(lighting: Lighting) -> Self {
        Self { lighting, felt: false, told: false, found: None, counted: Counted::default() }
    }

    /// That of a plot at another place, `by` metres farther.
    pub fn moved(&self, by: Point) -> Self {
        Self { felt: self.felt, told: self.told, ..Self::of(self.lighting.moved(by)) }
    }
}

/// A way to find the light in a plot.
pub trait LightModel: Sync {
    /// The light in a canopy under these sources. The same whatever the number of threads.
    fn light(&self, canopy: &dyn Canopy, sources: &[Source]) -> Box<dyn Lit>;
}

/// A plot whose light is known.
pub trait Lit: Debug + Send + Sync {
    /// The share of the light on open ground that reaches a place, in [0, 1].
    fn share_at(&self, place: Point) -> f64;
    /// The light that a piece of the canopy keeps, m² of open ground.
    fn kept_by(&self, piece: &Piece) -> f64;
    /// What becomes of all light that was sent.
    fn balance(&self) -> Balance;
}

/// What becomes of the light that the beams bring, m² of open ground.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Balance {
    /// All that was sent.
    pub sent: f64,
    /// What leaves and wood keep.
    pub kept: f64,
    /// What opaque shapes stop.
    pub stopped: f64,
    /// What passes.
    pub passed: f64,
}

impl Balance {
    fn with(self, other: Self) -> Self {
        Self {
            sent: self.sent + other.sent,
            kept: self.kept + other.kept,
            stopped: self.stopped + other.stopped,
            passed: self.passed + other.passed,
        }
    }
}
