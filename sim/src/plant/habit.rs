//! The habit of a species: what pose, shedding and drawing must know of it, shared by all its plants.
//!
//! The development trend is de Reffye's (1988 §4, Fig. 15): an axis leaves its bearing axis at the insertion angle and
//! turns smoothly towards its trend. Where a trend is a random variable each axis has one of its own ([`OwnTrends`]).

use super::axis::AxisId;
use super::look::Looks;
use crate::mechanics::{Thickening, Wood};
use std::ops::Range;

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
    /// A plane blade as wide as the diameter, which narrows as a cone does; no wood is in it.
    Blade,
}

impl Shape {
    /// Whether the tip takes the diameter of the internode that follows.
    #[inline]
    pub fn narrows(self) -> bool {
        self != Self::Cylinder
    }
}

/// The rules of a species that its plants carry with them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Habit {
    /// The development trends; an internode names one by its place here, unless its axis has trends of its own.
    pub trends: Vec<Trend>,
    /// What its components are and look like.
    pub looks: Looks,
    /// The mechanics of its wood; `None` where diameters follow the model's law and nothing bends.
    pub wood: Option<Wood>,
}

impl Habit {
    /// How internodes gain diameter.
    pub fn thickening(&self) -> Thickening {
        self.wood.as_ref().map_or(Thickening::Law, |wood| wood.thickening)
    }

    /// The shape of the internodes of an axis of `order` that started in `state`; orders past the last are as the last.
    #[inline]
    pub fn shape(&self, order: u8, state: u8) -> Shape {
        self.looks.internode(order, state).shape
    }
}

/// The trends of the axes that have drawn theirs, beside those of the habit; empty where no order draws any.
#[derive(Debug, Clone, Default)]
pub struct OwnTrends {
    /// Where the trends of each axis stand, up to the last axis that has some.
    spans: Vec<Range<u32>>,
    trends: Vec<Trend>,
}

impl OwnTrends {
    /// The trends of an axis, from which its internodes name theirs; `None` where they name those of the habit.
    #[inline]
    pub fn of(&self, axis: AxisId) -> Option<&[Trend]> {
        let span = self.spans.get(axis.index()).filter(|span| !span.is_empty())?;
        Some(&self.trends[span.start as usize..span.end as usize])
    }

    /// Gives an axis trends of its own, before it has a node.
    pub fn give(&mut self, axis: AxisId, trends: impl IntoIterator<Item = Trend>) {
        let start = self.trends.len() as u32;
        self.trends.extend(trends);
        self.spans.resize(self.spans.len().max(axis.index() + 1), 0..0);
        self.spans[axis.index()] = start..self.trends.len() as u32;
    }

    pub(super) fn clear(&mut self) {
        self.spans.clear();
        self.trends.clear();
    }
}
