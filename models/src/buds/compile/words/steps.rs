//! Draws of a quantity at many steps of one axis: what is the same at every step is looked up once.
//!
//! Each draw is the one that the record of the step gives (`words`).

use super::{Chance, Number, Outcome};
use crate::law::{At, ProbabilityTable, Threshold, Varies};

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
