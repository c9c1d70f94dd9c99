//! The layout of the words of a stream: each random quantity of an order has fixed slots, in a fixed sequence.
//!
//! A stream is read in records of a fixed width: one record an axis and then one a clock step (bud stream), one a node
//! (node stream), one an axis (relay stream). Quantities that are the same at every point take no word. The layout of a
//! record does not depend on how long the run lasts: a quantity that could be drawn in a longer run alone has its words
//! in a shorter run too. What responses need beyond it has a stream of its own ([`Spare`]).

mod looked_up;
mod many;
mod steps;

pub use looked_up::{Along, ChanceAt, MeasureAt, NumberAt};
pub use many::{Draws, Outcome, Piece};
pub use steps::{Tested, TestedAlong};

use super::change::{ByAge, Change, nodes_times};
use crate::law::{At, CountTable, ProbabilityTable, Threshold, Variable, VariateTable};

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
        Chance { table, slot, fixed, change: None, light_alone: false }
    }

    /// Slots for `times` numbers of things.
    pub fn number(&mut self, table: CountTable, times: u32) -> Number {
        let fixed = table.constant();
        let slot = self.take(fixed.is_none(), times);
        Number { table, slot, fixed, times: None }
    }

    /// Slots for `times` measures, each multiplied by `unit`.
    pub fn measure(&mut self, table: VariateTable, unit: f32, times: u32) -> Measure {
        let fixed = table.constant().map(|value| value * unit);
        let slot = self.take(fixed.is_none() && table.is_random(), times);
        Measure { table, slot, unit, fixed, times: None, light_alone: false }
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

/// The words of the responses of one record. They stand behind the words of the record itself, whose width no response
/// changes, and come from a stream of their own, each from a place that does not depend on which responses there are.
#[derive(Debug, Clone, Default)]
pub struct Spare {
    /// The width of the record.
    width: usize,
    /// The place in the record of the stream of responses for each further word.
    places: Vec<u32>,
}

impl Spare {
    /// No words beyond a record of `width` words.
    pub fn after(width: usize) -> Self {
        Self { width, places: Vec::new() }
    }

    /// The words of the record and of its responses; at least one, which a quantity without words reads and ignores.
    pub fn words(&self) -> usize {
        (self.width + self.places.len()).max(1)
    }

    /// The place of each word in the record of the stream of responses, in their order behind the record itself.
    pub fn places(&self) -> &[u32] {
        &self.places
    }

    fn take(&mut self, place: u32, times: u32) -> Slot {
        let slot = Slot { first: self.width + self.places.len(), stride: 1 };
        self.places.extend((0..times).map(|nth| place + nth));
        slot
    }
}

/// A probability with its slot.
#[derive(Debug, Clone)]
pub struct Chance {
    table: ProbabilityTable,
    slot: Slot,
    /// The outcome, where it is the same at every point.
    fixed: Option<bool>,
    /// The change by responses.
    change: Option<Change>,
    /// Whether nothing but shade changes it.
    light_alone: bool,
}

impl Chance {
    /// Lets responses change the probability. It keeps its word; a probability of 0 or 1, which needs none, is given
    /// `times` words of responses, from `place` on.
    pub fn respond(&mut self, change: Change, (place, times): (u32, u32), spare: &mut Spare) {
        if self.fixed.is_some() && change.can_change(self.table.is_never()) {
            self.slot = spare.take(place, times);
        }
        self.light_alone = change.is_of_light_alone();
        self.change = Some(change).filter(|change| change.can_change(self.table.is_never()));
    }

    /// Whether the event happens, the `nth` time (from 0) in this record.
    // Called for each bud and node: without responses it is what it was without them.
    #[inline(always)]
    pub fn happens(&self, words: &[u32], nth: u32, at: At) -> bool {
        self.outcome(at).happens(|| self.word(words, nth))
    }

    /// Whether the event happens at a point.
    #[inline(always)]
    pub fn outcome(&self, at: At) -> Outcome {
        let changes = self.change.is_some() && !(self.light_alone && at.shade == 0);
        match (changes.then(|| self.responded(at)).flatten(), self.fixed) {
            (Some(threshold), _) => Outcome::Drawn(threshold),
            (None, Some(fixed)) => Outcome::Fixed(fixed),
            (None, None) => Outcome::Drawn(self.table.threshold(at)),
        }
    }

    /// The threshold where responses change the probability; `None` where they do not.
    #[inline(never)]
    fn responded(&self, at: At) -> Option<Threshold> {
        let changes = self.change.as_ref().is_some_and(|change| !change.is_neutral_at(at));
        changes.then(|| Threshold::of(self.probability(at)))
    }

    /// The word of the `nth` test, where it has one.
    #[inline]
    pub fn word(&self, words: &[u32], nth: u32) -> u32 {
        self.slot.word(words, nth)
    }

    /// The word of the first test; `None` where the outcome is the same at every point and no response changes it, or
    /// none but one to light.
    #[inline]
    pub fn first_word(&self, words: &[u32]) -> Option<u32> {
        // In full light the words of responses to light alone have not been read.
        (self.fixed.is_none() || (self.change.is_some() && !self.light_alone)).then(|| self.word(words, 0))
    }

    /// The probability at a point.
    #[inline]
    pub fn probability(&self, at: At) -> f64 {
        let own = self.table.probability(at);
        self.change.as_ref().map_or(own, |change| change.of(own, at))
    }

    /// Whether the probability depends on the state and the variables `known` at most.
    pub fn asks_only(&self, known: &[Variable]) -> bool {
        self.table.asks_only(known) && (self.change.is_none() || self.light_alone || known.contains(&Variable::Age))
    }

    /// Whether the event happens at no point, so that no draw is needed.
    pub fn is_never(&self) -> bool {
        self.table.is_never() && self.change.is_none()
    }

    /// Whether the event happens at no point of a state.
    pub fn is_never_in(&self, state: u8) -> bool {
        self.table.is_never_in(state) && !self.change.as_ref().is_some_and(|change| change.can_change(true))
    }
}

/// A number of things with its slot.
#[derive(Debug, Clone)]
pub struct Number {
    pub table: CountTable,
    slot: Slot,
    fixed: Option<u32>,
    /// The factor of responses, with the slot of the words that round its product.
    times: Option<(ByAge, Slot)>,
}

impl Number {
    /// The number, where it is the same at every point and in every draw.
    #[inline]
    pub fn fixed(&self) -> Option<u32> {
        self.fixed
    }

    /// Multiplies the number by a factor: n becomes ⌊n m + u⌋ with u from `times` words of responses, from `place` on.
    pub fn respond(&mut self, factor: ByAge, (place, times): (u32, u32), spare: &mut Spare) {
        self.times = Some((factor, spare.take(place, times)));
    }

    /// The number drawn, the `nth` time (from 0) in this record.
    // Called several times a step: most numbers are fixed.
    #[inline(always)]
    pub fn draw(&self, words: &[u32], nth: u32, at: At) -> u32 {
        match (self.fixed, &self.times) {
            (Some(fixed), None) => fixed,
            _ => self.drawn(words, nth, at),
        }
    }

    #[inline(never)]
    fn drawn(&self, words: &[u32], nth: u32, at: At) -> u32 {
        let own = match self.fixed {
            Some(fixed) => fixed,
            None => self.table.sample(self.slot.word(words, nth), at),
        };
        match &self.times {
            None => own,
            Some((factor, slot)) => nodes_times(own, factor.at(at), slot.word(words, nth)),
        }
    }

    /// Whether nothing but shade changes it.
    fn is_of_light_alone(&self) -> bool {
        self.times.as_ref().is_none_or(|(factor, _)| factor.is_of_light_alone())
    }

    /// The probabilities of 0, 1, 2 … at a point.
    pub fn pmf(&self, at: At) -> Vec<f64> {
        let own = self.table.pmf(at);
        match &self.times {
            None => own,
            Some((factor, _)) => factor.spread(own, at),
        }
    }

    /// Whether the distribution depends on the state and the variables `known` at most.
    pub fn asks_only(&self, known: &[Variable]) -> bool {
        self.table.asks_only(known) && (self.is_of_light_alone() || known.contains(&Variable::Age))
    }
}

/// A measure with its slot and its unit.
#[derive(Debug, Clone)]
pub struct Measure {
    pub table: VariateTable,
    slot: Slot,
    unit: f32,
    fixed: Option<f32>,
    /// The factor of responses.
    times: Option<ByAge>,
    /// Whether nothing but shade changes it.
    light_alone: bool,
}

impl Measure {
    /// The value, where it is the same at every point and in every draw.
    #[inline]
    pub fn fixed(&self) -> Option<f32> {
        self.fixed
    }

    /// The value in SI units or radians, the `nth` time (from 0) in this record.
    // Called for each node and organ: without responses it is what it was without them.
    #[inline(always)]
    pub fn draw(&self, words: &[u32], nth: u32, at: At) -> f32 {
        let own = match self.fixed {
            Some(fixed) => fixed,
            None => self.table.draw(self.slot.word(words, nth), at) * self.unit,
        };
        let responds = self.times.is_some() && (at.shade > 0 || !self.light_alone);
        if responds { self.responded(own, at) } else { own }
    }

    /// A value under responses.
    #[inline(never)]
    fn responded(&self, own: f32, at: At) -> f32 {
        self.times.as_ref().map_or(own, |factor| many::times(own, factor.at(at)))
    }

    /// No larger value is drawn, in SI units or radians.
    pub fn most(&self) -> f64 {
        let own = self.table.extent()[1] * f64::from(self.unit);
        own * self.times.as_ref().map_or(1.0, ByAge::most)
    }

    /// Multiplies the measure by a factor.
    pub fn respond(&mut self, factor: ByAge) {
        self.light_alone = factor.is_of_light_alone();
        self.times = Some(factor);
    }
}
