//! Many draws of one quantity at once: for nodes of one axis, or for what these nodes bear.
//!
//! A law is looked up as often as it can change along the axis: once, once a growth unit, or once a node; then one loop
//! draws it for all things of a stretch. Each draw is the one that the node's own record gives (`words`).

use super::{Chance, Measure, Number, Slot};
use crate::law::{At, Threshold, Varies};
use std::ops::Range;

/// Neighbouring nodes of one growth unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// The point at which laws of the unit are evaluated; its rank is 0.
    pub at: At,
    /// The nodes of the whole growth unit, of which these are some.
    pub unit_nodes: u32,
    /// The rank of the first in the growth unit, from 1.
    pub first: u32,
    /// The place of the first among the nodes of the block, and of the first behind the last.
    pub nodes: (u32, u32),
    /// The last rank that is preformed.
    pub preformed: u32,
    /// Whether the growth unit is of the short type.
    pub short: bool,
    /// The place of the ranks of the unit's zones among those of the block, and of the first behind them; equal where
    /// the unit has drawn none.
    pub zones: (u32, u32),
}

impl Piece {
    /// A whole growth unit of preformed nodes, which begins at the place `first` of the block and has drawn no zones.
    #[inline]
    pub fn of_unit(at: &At, short: bool, nodes: u32, first: u32) -> Self {
        let (unit_nodes, preformed, nodes) = (nodes, nodes, (first, first + nodes));
        Self { at: *at, unit_nodes, first: 1, nodes, preformed, short, zones: (0, 0) }
    }

    /// The point at which laws of its node at the place `node` of the block are evaluated.
    #[inline]
    pub fn at(&self, node: usize) -> At {
        At { rank: self.rank(node), ..self.at }
    }

    /// The rank in the growth unit of the node at the place `node` of the block.
    #[inline]
    pub fn rank(&self, node: usize) -> u32 {
        self.first + node as u32 - self.nodes.0
    }

    /// The places of its nodes in the block.
    #[inline]
    pub fn places(&self) -> Range<usize> {
        self.nodes.0 as usize..self.nodes.1 as usize
    }
}

/// Things of one kind in a block of nodes, in the order of their nodes: the nodes themselves, their leaves or buds.
#[derive(Debug, Default)]
pub struct Things {
    /// For each thing the place of its node's record among the words, plus its number among the things of its node.
    words: Vec<u32>,
    /// For each node the number of things up to its last.
    ends: Vec<u32>,
}

impl Things {
    /// Makes these the `numbers` of things of nodes whose records stand at the places `records`.
    pub fn set(&mut self, numbers: &[u32], records: &[u32]) {
        self.words.clear();
        self.ends.clear();
        let mut sum = 0;
        self.ends.extend(numbers.iter().map(|number| {
            sum += number;
            sum
        }));
        self.words.reserve(sum as usize);
        for (&number, &record) in numbers.iter().zip(records) {
            (record..record + number).for_each(|word| self.words.push(word));
        }
    }

    /// Makes these nodes whose records stand at the places `records`.
    pub fn set_nodes(&mut self, records: &[u32]) {
        self.words.clear();
        self.ends.clear();
        self.words.extend_from_slice(records);
        self.ends.extend(1..=records.len() as u32);
    }

    /// For each node the number of things up to its last.
    #[inline]
    pub fn ends(&self) -> &[u32] {
        &self.ends
    }

    /// Makes these some of the things of the same nodes, at the places `chosen`, which rise.
    pub fn choose(&mut self, of: &Self, chosen: &[u32]) {
        self.words.clear();
        self.ends.clear();
        self.words.extend(chosen.iter().map(|&place| of.words[place as usize]));
        let mut left = chosen.iter().peekable();
        let mut count = 0;
        self.ends.extend(of.ends.iter().map(|&end| {
            while left.next_if(|place| **place < end).is_some() {
                count += 1;
            }
            count
        }));
    }

    /// How many they are.
    #[inline]
    pub fn len(&self) -> usize {
        self.words.len()
    }

    /// The places of the things of a node.
    #[inline]
    pub fn of(&self, node: usize) -> Range<usize> {
        let start = if node == 0 { 0 } else { self.ends[node - 1] as usize };
        start..self.ends[node] as usize
    }
}

/// Things for which quantities are drawn, with their words and the points of their laws.
#[derive(Debug, Clone, Copy)]
pub struct Draws<'a> {
    /// The words in which the records of the nodes stand. Behind them stand as many more as there can be things on a
    /// node.
    pub words: &'a [u32],
    pub pieces: &'a [Piece],
    pub things: &'a Things,
}

impl Draws<'_> {
    /// Calls `draw` for each stretch of things for which a law that varies so is the same: `law` is what a point has of
    /// it. Growth units that follow one another and have the same are one stretch.
    #[inline]
    fn stretches<L: Copy + PartialEq>(
        &self,
        varies: Varies,
        law: impl Fn(&At) -> L,
        mut draw: impl FnMut(L, Range<usize>),
    ) {
        let [first, ..] = self.pieces else { return };
        let all = self.all();
        let (mut begin, mut same) = (all.start, law(&first.at(first.nodes.0 as usize)));
        let mut next = |place: usize, here: L| {
            if here != same {
                draw(same, begin..place);
                (begin, same) = (place, here);
            }
        };
        match varies {
            Varies::Never => {}
            Varies::ByUnit => {
                let pieces = self.pieces[1..].iter();
                pieces.for_each(|piece| next(self.things.of(piece.nodes.0 as usize).start, law(&piece.at)));
            }
            Varies::ByNode => {
                for piece in self.pieces {
                    piece.places().for_each(|node| next(self.things.of(node).start, law(&piece.at(node))));
                }
            }
        }
        draw(same, begin..all.end);
    }

    /// The places of the things of its growth units.
    #[inline]
    fn all(&self) -> Range<usize> {
        match self.pieces {
            [] => 0..0,
            [first, ..] => {
                let last = &self.pieces[self.pieces.len() - 1];
                self.things.of(first.nodes.0 as usize).start..self.things.of(last.nodes.1 as usize - 1).end
            }
        }
    }

    /// The words of some of the things.
    #[inline]
    fn words(&self, slot: Slot, things: Range<usize>) -> impl Iterator<Item = u32> {
        self.things.words[things].iter().map(move |place| self.words[*place as usize + slot.first])
    }

    /// Whether the axis lacks light.
    fn are_shaded(&self) -> bool {
        self.pieces.first().is_some_and(|piece| piece.at.shade > 0)
    }
}

impl Measure {
    /// Draws the measure for each thing, into a field of its entry.
    #[inline]
    pub fn draw_many<T>(&self, draws: Draws<'_>, into: &mut [T], field: impl Fn(&mut T) -> &mut f32 + Copy) {
        match self.fixed {
            Some(fixed) => into[draws.all()].iter_mut().for_each(|entry| *field(entry) = fixed),
            None => draws.stretches(
                self.table.varies(),
                |at| self.table.parameters(at),
                |parameters, things| {
                    let fields = into[things.clone()].iter_mut().map(field);
                    self.table.draw_many(parameters, draws.words(self.slot, things).zip(fields), |own| own * self.unit);
                },
            ),
        }
        if let Some(factor) = self.times.as_ref().filter(|_| draws.are_shaded() || !self.light_alone) {
            draws.stretches(
                Varies::ByUnit,
                |at| Factor(factor.at(*at)),
                |Factor(factor), things| {
                    into[things].iter_mut().for_each(|entry| *field(entry) = times(*field(entry), factor));
                },
            );
        }
    }
}

/// A factor of responses, the same as another to the bit.
#[derive(Clone, Copy)]
struct Factor(f64);

impl PartialEq for Factor {
    fn eq(&self, other: &Self) -> bool {
        self.0.to_bits() == other.0.to_bits()
    }
}

/// A measure under responses.
#[inline]
pub fn times(own: f32, factor: f64) -> f32 {
    own * factor as f32
}

impl Number {
    /// Draws the number for each thing. Numbers of what a node bears are not changed by responses.
    #[inline]
    pub fn draw_many(&self, draws: Draws<'_>, into: &mut Vec<u32>) {
        debug_assert!(self.times.is_none());
        into.clear();
        into.resize(draws.things.len(), self.fixed.unwrap_or(0));
        if self.fixed.is_none() {
            draws.stretches(
                self.table.varies(),
                |at| self.table.distribution(at),
                |number, things| {
                    self.table.sample_many(number, draws.words(self.slot, things.clone()).zip(&mut into[things]));
                },
            );
        }
    }
}

/// Whether an event happens at a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// So at every point and in every draw.
    Fixed(bool),
    /// Where a word meets the threshold.
    Drawn(Threshold),
}

impl Outcome {
    /// Whether it happens, with a word that is read where it is needed.
    #[inline]
    pub fn happens(self, word: impl FnOnce() -> u32) -> bool {
        match self {
            Self::Fixed(happens) => happens,
            Self::Drawn(threshold) => threshold.is_met(word()),
        }
    }
}

impl Chance {
    /// Tests the event for each thing; `told` is called with the place of each thing for which it happens.
    #[inline]
    pub fn test_many(&self, draws: Draws<'_>, mut told: impl FnMut(usize)) {
        if self.is_never() {
            return;
        }
        let responds = self.change.is_some() && (draws.are_shaded() || !self.light_alone);
        let varies = if responds { self.table.varies().max(Varies::ByUnit) } else { self.table.varies() };
        draws.stretches(
            varies,
            |at| self.outcome(*at),
            |outcome, things| match outcome {
                Outcome::Fixed(false) => {}
                Outcome::Fixed(true) => things.for_each(&mut told),
                Outcome::Drawn(threshold) => {
                    let words = draws.words(self.slot, things.clone());
                    things.zip(words).filter(|(_, word)| threshold.is_met(*word)).for_each(|(thing, _)| told(thing));
                }
            },
        );
    }
}
