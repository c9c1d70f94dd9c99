//! The habit of a species: what pose, shedding and drawing must know of it, shared by all its plants.
//!
//! The development trend is de Reffye's (1988 §4, Fig. 15): an axis leaves its bearing axis at the insertion angle and
//! turns smoothly towards its trend.

use crate::clock::Tick;
use crate::mechanics::{Thickening, Wood};

/// The direction that an axis tends to, and how fast it turns there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trend {
    /// Cosine of the angle between the direction tended to and the upward vertical: 1 orthotropic, 0 plagiotropic.
    pub cos_inclination: f32,
    /// Sine of the same angle.
    pub sin_inclination: f32,
    /// The share of the way to that direction that each internode turns, in [0, 1]; 0 keeps the axis straight.
    pub share: f32,
}

impl Trend {
    /// An axis that keeps the direction of its insertion.
    pub const STRAIGHT: Self = Self { cos_inclination: 1.0, sin_inclination: 0.0, share: 0.0 };
}

/// The shape of an internode at rest (de Reffye 1988 §4).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// One diameter along the whole internode.
    Cylinder,
    /// The tip has the diameter of the base of the internode that follows it on its axis.
    Cone,
}

/// The rules of a species that its plants carry with them.
#[derive(Debug, Clone, PartialEq)]
pub struct Habit {
    /// The development trends; each internode names one by its place here.
    pub trends: Vec<Trend>,
    /// After how many ticks a dead branch falls, by order from 1; `NEVER` where dead wood stays.
    pub shed_after: Vec<Tick>,
    /// The shape of internodes, by order from 1.
    pub shapes: Vec<Shape>,
    /// The mechanics of its wood; `None` where diameters follow the model's law and nothing bends.
    pub wood: Option<Wood>,
}

impl Habit {
    /// The ticks between the death and the fall of a branch of `order`; orders past the last are as the last.
    pub fn shed_after(&self, order: u8) -> Tick {
        by_order(&self.shed_after, order).copied().unwrap_or(crate::clock::NEVER)
    }

    /// How internodes gain diameter.
    pub fn thickening(&self) -> Thickening {
        self.wood.as_ref().map_or(Thickening::Law, |wood| wood.thickening)
    }

    /// The shape of the internodes of `order`; orders past the last are as the last.
    pub fn shape(&self, order: u8) -> Shape {
        by_order(&self.shapes, order).copied().unwrap_or(Shape::Cylinder)
    }
}

fn by_order<T>(values: &[T], order: u8) -> Option<&T> {
    values.get(usize::from(order).saturating_sub(1)).or(values.last())
}
