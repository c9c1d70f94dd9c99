//! Quantities looked up at a point, for draws that are made between those of other quantities: what one organ draws
//! stands together in its node's record.
//!
//! Each draw is the one that the record of the node gives (`words`). Behind a record stand as many words more as
//! there can be things of one kind on a node: a quantity without words reads and ignores them.
//! Absent: draws of one quantity for many things (`many`).

use super::{Chance, Measure, Number, Outcome, Piece};
use crate::law::{At, CountAt, VariateAt, Varies};

/// A measure at a point.
#[derive(Clone, Copy)]
pub enum MeasureAt<'a> {
    /// It is the same in every draw.
    Fixed(f32),
    /// It is drawn with the word at this place, the next times with the next ones, and multiplied by its unit.
    Drawn(VariateAt<'a>, usize, f32),
    /// Responses multiply it.
    Times(&'a Measure, At),
}

impl Measure {
    /// How often it can change along the nodes of axes, which lack light where `shaded`.
    pub fn varies(&self, shaded: bool) -> Varies {
        let own = if self.fixed.is_some() { Varies::Never } else { self.table.varies() };
        if self.responds(shaded) { own.max(Varies::ByUnit) } else { own }
    }

    /// Whether responses change it.
    fn responds(&self, shaded: bool) -> bool {
        self.times.is_some() && (shaded || !self.light_alone)
    }

    /// The measure at a point.
    #[inline]
    pub fn at_point(&self, at: &At) -> MeasureAt<'_> {
        match (&self.times, self.fixed) {
            (Some(_), _) if self.responds(at.shade > 0) => MeasureAt::Times(self, *at),
            (_, Some(fixed)) => MeasureAt::Fixed(fixed),
            // Without words it is drawn with any word.
            (_, None) => MeasureAt::Drawn(self.table.at_point(at), self.slot.first, self.unit),
        }
    }
}

impl MeasureAt<'_> {
    /// The value, the `nth` time (from 0) in a record.
    #[inline(always)]
    pub fn draw(&self, words: &[u32], nth: u32) -> f32 {
        match self {
            Self::Fixed(fixed) => *fixed,
            Self::Drawn(drawn, first, unit) => drawn.draw(words[first + nth as usize]) * unit,
            Self::Times(measure, at) => measure.draw(words, nth, *at),
        }
    }
}

/// A number at a point. Responses change no number of a node.
#[derive(Clone, Copy)]
pub enum NumberAt<'a> {
    /// It is the same in every draw.
    Fixed(u32),
    /// It is drawn with the word at this place, the next times with the next ones.
    Drawn(CountAt<'a>, usize),
}

impl Number {
    /// How often it can change along the nodes of axes.
    pub fn varies(&self) -> Varies {
        if self.fixed.is_some() { Varies::Never } else { self.table.varies() }
    }

    /// The number at a point; of those that responses do not change.
    #[inline]
    pub fn at_point(&self, at: &At) -> NumberAt<'_> {
        debug_assert!(self.times.is_none());
        match self.fixed {
            Some(fixed) => NumberAt::Fixed(fixed),
            None => NumberAt::Drawn(self.table.at_point(at), self.slot.first),
        }
    }
}

impl NumberAt<'_> {
    /// The number, the `nth` time (from 0) in a record.
    #[inline(always)]
    pub fn draw(&self, words: &[u32], nth: u32) -> u32 {
        match self {
            Self::Fixed(fixed) => *fixed,
            Self::Drawn(drawn, first) => drawn.draw(words[first + nth as usize]),
        }
    }
}

/// A test at a point.
#[derive(Clone, Copy)]
pub struct ChanceAt {
    outcome: Outcome,
    /// The place of the first word.
    first: usize,
}

impl Chance {
    /// How often the outcome can change along the nodes of axes, which lack light where `shaded`.
    pub fn varies(&self, shaded: bool) -> Varies {
        let own = if self.fixed.is_some() { Varies::Never } else { self.table.varies() };
        let responds = self.change.is_some() && (shaded || !self.light_alone);
        if responds { own.max(Varies::ByUnit) } else { own }
    }

    /// The test at a point.
    #[inline]
    pub fn at_point(&self, at: &At) -> ChanceAt {
        ChanceAt { outcome: self.outcome(*at), first: self.slot.first }
    }
}

impl ChanceAt {
    /// Whether the event happens at no word.
    #[inline]
    pub fn is_never(&self) -> bool {
        self.outcome == Outcome::Fixed(false)
    }

    /// Whether the event happens, the `nth` time (from 0) in a record.
    #[inline(always)]
    pub fn happens(&self, words: &[u32], nth: u32) -> bool {
        self.outcome.happens(|| words[self.first + nth as usize])
    }
}

/// A quantity that is the same at neighbouring points.
pub trait AtPoint {
    /// The quantity at a point.
    type Now<'a>: Copy
    where
        Self: 'a;

    /// The quantity at a point.
    fn now(&self, at: &At) -> Self::Now<'_>;

    /// How often it can change along the nodes of axes, which lack light where `shaded`.
    fn changes(&self, shaded: bool) -> Varies;
}

impl AtPoint for Measure {
    type Now<'a> = MeasureAt<'a>;

    #[inline]
    fn now(&self, at: &At) -> MeasureAt<'_> {
        self.at_point(at)
    }

    fn changes(&self, shaded: bool) -> Varies {
        self.varies(shaded)
    }
}

impl AtPoint for Number {
    type Now<'a> = NumberAt<'a>;

    #[inline]
    fn now(&self, at: &At) -> NumberAt<'_> {
        self.at_point(at)
    }

    fn changes(&self, _: bool) -> Varies {
        self.varies()
    }
}

impl AtPoint for Chance {
    type Now<'a> = ChanceAt;

    #[inline]
    fn now(&self, at: &At) -> ChanceAt {
        self.at_point(at)
    }

    fn changes(&self, shaded: bool) -> Varies {
        self.varies(shaded)
    }
}

/// A quantity of nodes of growth units one after another, looked up as often as it can change.
pub struct Along<'a, Q: AtPoint> {
    law: &'a Q,
    varies: Varies,
    pub now: Q::Now<'a>,
}

impl<'a, Q: AtPoint> Along<'a, Q> {
    /// The quantity on the first node of a piece.
    pub fn of(law: &'a Q, first: &Piece) -> Self {
        Self { law, varies: law.changes(first.at.shade > 0), now: law.now(&first.at(first.nodes.0 as usize)) }
    }

    /// How often it can change.
    pub fn varies(&self) -> Varies {
        self.varies
    }

    /// Goes to another growth unit.
    #[inline(always)]
    pub fn go_to(&mut self, piece: &Piece) {
        if self.varies == Varies::ByUnit {
            self.now = self.law.now(&piece.at);
        }
    }

    /// Goes to a node of the growth unit.
    #[inline(always)]
    pub fn stand_on(&mut self, piece: &Piece, node: usize) {
        if self.varies == Varies::ByNode {
            self.now = self.law.now(&piece.at(node));
        }
    }
}
