//! The habit of a species: its rules and tables for pose, shedding and drawing, shared by all its plants.
//!
//! The development trend is de Reffye's (1988 §4, Fig. 15): an axis leaves its bearing axis at the insertion angle and
//! turns smoothly towards its trend. Where a trend is a random variable each axis has one of its own ([`OwnTrends`]).

use super::for_drawing::ForDrawing;
use super::handle::AxisId;
use super::kind::{Class, Kind};
use super::look::{Looks, Shape};
use super::wood::{Thickening, Wood};
use crate::clock::Tick;
use std::ops::Range;

/// The direction that an axis tends to, and how fast it turns there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trend {
    /// The angle between the direction tended to and the upward vertical, radians in [0, π]: 0 orthotropic, π/2
    /// plagiotropic.
    pub inclination: f64,
    /// The share of the angle to that direction that each internode turns, in [0, 1]; 0 keeps the axis straight.
    pub share: f64,
}

impl Trend {
    /// An axis that keeps the direction of its insertion.
    pub const STRAIGHT: Self = Self { inclination: 0.0, share: 0.0 };

    /// The angle to the upward vertical that the axis tends to, degrees, rounded to a thousandth: 0 orthotropic, 90
    /// plagiotropic. `None` where the axis keeps its direction.
    pub fn inclination_deg(&self) -> Option<f32> {
        let thousandths = (self.inclination * 180_000.0 / std::f64::consts::PI).round();
        (self.share > 0.0).then_some((thousandths / 1000.0) as f32)
    }
}

/// How the organs of one kind turn in the vertical plane in which they stand: leaves that sink, fruits that hang,
/// inflorescences that stand upright.
#[derive(Debug, Clone, PartialEq)]
pub struct OrganTrend {
    /// The angle between the direction tended to and the upward vertical, radians in [0, π].
    pub inclination: f64,
    /// The share of the angle to that direction that an organ has turned from its insertion, in [0, 1], by its own age
    /// in ticks; later ages have the last share.
    pub shares: Vec<f32>,
}

impl OrganTrend {
    /// The share that an organ of the age `old` ticks has turned.
    #[inline]
    pub fn at(&self, old: Tick) -> Trend {
        let share = self.shares.get(old as usize).or(self.shares.last()).copied().unwrap_or(0.0);
        Trend { inclination: self.inclination, share: f64::from(share) }
    }
}

/// How the organs of one order turn; `None`: they keep their insertion.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OrganTrends {
    /// Its leaves.
    pub leaf: Option<OrganTrend>,
    /// Its flowers.
    pub flower: Option<OrganTrend>,
    /// Its fruits.
    pub fruit: Option<OrganTrend>,
    /// Whether its leaves twist until their upper side faces the sky, as those of plagiotropic axes do.
    pub leaves_face_the_sky: bool,
}

/// The rules of a species, which its plants share.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Habit {
    /// The development trends; an internode names one by its place here, unless its axis has trends of its own.
    pub trends: Vec<Trend>,
    /// What its components are and look like.
    pub looks: Looks,
    /// How organs turn, by order from 1; empty where no organ turns.
    pub organ_trends: Vec<OrganTrends>,
    /// The data that the species states for drawing, named by number in its looks.
    pub for_drawing: ForDrawing,
    /// The mechanics of its wood; `None` where diameters follow the model's law and nothing bends.
    pub wood: Option<Wood>,
}

impl Habit {
    /// How internodes gain diameter.
    pub fn thickening(&self) -> Thickening {
        self.wood.as_ref().map_or(Thickening::Law, |wood| wood.thickening)
    }

    /// How organs of a kind turn on axes of `order`; `None` where they keep their insertion.
    #[inline]
    pub fn organ_trend(&self, order: u8, kind: Kind) -> Option<&OrganTrend> {
        let of = self.organ_trends.get(usize::from(order).checked_sub(1)?)?;
        match kind.class() {
            Class::Leaf => of.leaf.as_ref(),
            Class::Flower => of.flower.as_ref(),
            Class::Fruit => of.fruit.as_ref(),
            Class::Internode | Class::Bud => None,
        }
    }

    /// Whether leaves on axes of `order` twist towards the sky.
    #[inline]
    pub fn faces_the_sky(&self, order: u8, kind: Kind) -> bool {
        let of = usize::from(order).checked_sub(1).and_then(|order| self.organ_trends.get(order));
        of.is_some_and(|of| of.leaves_face_the_sky) && kind.class() == Class::Leaf
    }

    /// The shape of the internodes of an axis of `order` that started in `state`; orders past the last have the shape
    /// of the last.
    #[inline]
    pub fn shape(&self, order: u8, state: u8) -> Shape {
        self.looks.internode(order, state).shape
    }
}

/// The trends that axes have drawn, beside those of the habit; empty where no order draws any.
#[derive(Debug, Clone, Default)]
pub struct OwnTrends {
    /// The range of each axis's trends in the list, up to the last axis that has its own.
    spans: Vec<Range<u32>>,
    trends: Vec<Trend>,
}

impl OwnTrends {
    /// The own trends of an axis, which its internodes name by place; `None` where they name those of the habit.
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

    /// Adds the trends of the axes of a fragment; `axis` gives the handles of those axes in the whole plant.
    pub(super) fn join(&mut self, more: Self, axis: impl Fn(AxisId) -> AxisId) {
        for (place, span) in more.spans.iter().enumerate().filter(|(_, span)| !span.is_empty()) {
            let trends = &more.trends[span.start as usize..span.end as usize];
            self.give(axis(AxisId(place as u32)), trends.iter().copied());
        }
    }

    pub(super) fn clear(&mut self) {
        self.spans.clear();
        self.trends.clear();
    }
}
