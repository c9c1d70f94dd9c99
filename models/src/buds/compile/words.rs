//! The layout of the words of a stream: each random quantity of an order has fixed slots, in a fixed sequence.
//!
//! A stream is read in records of a fixed width: one record an axis and then one a clock step (bud stream), one a node
//! (node stream), one an axis (relay stream). Quantities that are the same at every point take no word. The layout of a
//! record does not depend on how long the run lasts: a quantity that could be drawn in a longer run alone has its words
//! in a shorter run too.

use crate::law::{At, CountTable, ProbabilityTable, VariateTable};

/// Assigns the slots of one record.
#[derive(Debug, Default)]
pub struct Layout {
    width: usize,
}

impl Layout {
    /// The words of a record so far.
    pub fn width(&self) -> usize {
        self.width
    }

    fn take(&mut self, random: bool, times: u32) -> Slot {
        if !random {
            return Slot { first: 0, stride: 0 };
        }
        let slot = Slot { first: self.width, stride: 1 };
        self.width += times as usize;
        slot
    }

    /// Slots for `times` tests of a probability.
    pub fn chance(&mut self, table: ProbabilityTable, times: u32) -> Chance {
        let fixed = (table.is_never() || table.is_certain()).then(|| table.is_certain());
        let slot = self.take(fixed.is_none(), times);
        Chance { table, slot, fixed }
    }

    /// Slots for `times` numbers of things.
    pub fn number(&mut self, table: CountTable, times: u32) -> Number {
        let fixed = table.constant();
        let slot = self.take(fixed.is_none(), times);
        Number { table, slot, fixed }
    }

    /// Slots for `times` measures, each multiplied by `unit`.
    pub fn measure(&mut self, table: VariateTable, unit: f32, times: u32) -> Measure {
        let fixed = table.constant().map(|value| value * unit);
        let slot = self.take(fixed.is_none() && table.is_random(), times);
        Measure { table, slot, unit, fixed }
    }
}

#[derive(Debug, Clone, Copy)]
struct Slot {
    first: usize,
    stride: usize,
}

impl Slot {
    #[inline]
    fn word(self, words: &[u32], nth: u32) -> u32 {
        words[self.first + self.stride * nth as usize]
    }
}

/// A probability with its slot.
#[derive(Debug, Clone)]
pub struct Chance {
    pub table: ProbabilityTable,
    slot: Slot,
    /// The outcome, where it is the same at every point.
    fixed: Option<bool>,
}

impl Chance {
    /// Whether the event happens, the `nth` time (from 0) in this record.
    #[inline]
    pub fn happens(&self, words: &[u32], nth: u32, at: At) -> bool {
        match self.fixed {
            Some(fixed) => fixed,
            None => self.table.happens(self.slot.word(words, nth), at),
        }
    }
}

/// A number of things with its slot.
#[derive(Debug, Clone)]
pub struct Number {
    pub table: CountTable,
    slot: Slot,
    fixed: Option<u32>,
}

impl Number {
    /// The number, where it is the same at every point and in every draw.
    #[inline]
    pub fn fixed(&self) -> Option<u32> {
        self.fixed
    }

    /// The number drawn, the `nth` time (from 0) in this record.
    #[inline]
    pub fn draw(&self, words: &[u32], nth: u32, at: At) -> u32 {
        match self.fixed {
            Some(fixed) => fixed,
            None => self.table.sample(self.slot.word(words, nth), at),
        }
    }
}

/// A measure with its slot and its unit.
#[derive(Debug, Clone)]
pub struct Measure {
    pub table: VariateTable,
    slot: Slot,
    unit: f32,
    fixed: Option<f32>,
}

impl Measure {
    /// The value, where it is the same at every point and in every draw.
    #[inline]
    pub fn fixed(&self) -> Option<f32> {
        self.fixed
    }

    /// The value in SI units or radians, the `nth` time (from 0) in this record.
    #[inline]
    pub fn draw(&self, words: &[u32], nth: u32, at: At) -> f32 {
        match self.fixed {
            Some(fixed) => fixed,
            None => self.table.draw(self.slot.word(words, nth), at) * self.unit,
        }
    }
}
