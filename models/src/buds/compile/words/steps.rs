//! Draws of a quantity at many steps of one axis: what is the same at every step is looked up once.
//!
//! Each draw is the one that the record of the step gives (`words`).

use super::{Chance, Number, Outcome};
use crate::law::{Along, At, ProbabilityTable, Threshold, Variable, Varies};
use phytomer_sim::clock::Tick;

/// A test that is made at many steps of an axis.
#[derive(Debug, Clone, Copy)]
pub enum Tested<'a> {
    /// It has the same outcome at each.
    Fixed(bool),
    /// Each has a word of its own, at this place of its record, for one threshold.
    Same(Threshold, usize),
    /// Each has a word of its own, at this place of its record, and its threshold is looked up.
    ByPoint(&'a ProbabilityTable, usize),
    /// Responses change the probability.
    Changed(&'a Chance),
}

/// A test whose threshold depends on the age of the plant alone, or on the steps of an axis that makes one a tick.
#[derive(Debug, Clone)]
pub struct TestedAlong {
    along: Along,
    /// Whether it depends on the age: all bits or none.
    by_age: u32,
    /// The place of its word in the record of the step; of any word where it asks for none.
    place: usize,
}

impl TestedAlong {
    /// Whether the event happens at a step (from 1) of the axis of a birth, with the record of the step.
    #[inline(always)]
    pub fn happens(&self, words: &[u32], birth: Tick, step: u32) -> bool {
        self.along.threshold(step + (birth & self.by_age)).is_met(words[self.place])
    }
}

impl Tested<'_> {
    /// Whether the event happens, with the record of the step and its point.
    #[inline(always)]
    pub fn happens(&self, words: &[u32], at: &At) -> bool {
        match *self {
            Self::Fixed(happens) => happens,
            Self::Same(threshold, place) => threshold.is_met(words[place]),
            Self::ByPoint(table, place) => table.happens_at(words[place], at),
            Self::Changed(chance) => chance.happens_at(words, at),
        }
    }
}

impl Chance {
    /// The test for the steps of an axis, which lacks light where `shaded`.
    pub fn looked_up(&self, shaded: bool) -> Tested<'_> {
        let changes = self.change.is_some() && (shaded || !self.light_alone);
        match self.fixed {
            _ if changes => Tested::Changed(self),
            Some(fixed) => Tested::Fixed(fixed),
            None if self.table.varies() == Varies::Never => {
                Tested::Same(self.table.threshold(At::default()), self.slot.first)
            }
            None => Tested::ByPoint(&self.table, self.slot.first),
        }
    }

    /// The test for the steps of axes in full light that make one step a tick, where it depends on the age of the plant
    /// or on the steps of the axis at most and responses change nothing.
    pub fn along(&self) -> Option<TestedAlong> {
        let changes = self.change.is_some() && !self.light_alone;
        let along = self.table.along().filter(|_| !changes)?;
        let by_age = match along.variable {
            Some(Variable::Age) => u32::MAX,
            Some(Variable::Cycle | Variable::Dimension) | None => 0,
            Some(_) => return None,
        };
        // A test without a word has a threshold that every word or no word meets.
        Some(TestedAlong { along, by_age, place: if self.fixed.is_some() { 0 } else { self.slot.first } })
    }

    /// Whether the event happens, the first time in this record.
    #[inline(never)]
    pub fn happens_at(&self, words: &[u32], at: &At) -> bool {
        match self.outcome(*at) {
            Outcome::Fixed(happens) => happens,
            Outcome::Drawn(threshold) => threshold.is_met(self.word(words, 0)),
        }
    }
}

impl Number {
    /// The number, where it is the same at every point and in every draw and responses do not change it.
    pub fn unchanging(&self) -> Option<u32> {
        self.fixed.filter(|_| self.times.as_ref().is_none_or(|(factor, _)| factor.is_of_light_alone()))
    }

    /// The first number of a record.
    #[inline(always)]
    pub fn draw_at(&self, words: &[u32], at: &At) -> u32 {
        match (self.fixed, &self.times) {
            (Some(fixed), None) => fixed,
            _ => self.draw_first(words, at),
        }
    }

    #[inline(never)]
    fn draw_first(&self, words: &[u32], at: &At) -> u32 {
        match &self.times {
            None => self.table.sample_at(self.slot.word(words, 0), at),
            Some(_) => self.draw(words, 0, *at),
        }
    }
}
