//! Many draws of one quantity at once, for nodes of axes of one order.
//!
//! A law is looked up as often as it can change along the axis: once, once a growth unit, or once a node; then one loop
//! draws it for all nodes of a stretch. Each draw is the one that the node's own record gives (`words`).

use super::{Measure, Number, Slot};
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
    #[inline(always)]
    pub fn of_unit(at: At, short: bool, nodes: u32, first: u32) -> Self {
        let (unit_nodes, preformed, nodes) = (nodes, nodes, (first, first + nodes));
        Self { at, unit_nodes, first: 1, nodes, preformed, short, zones: (0, 0) }
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

/// Nodes for which quantities are drawn, with their words and the points of their laws.
#[derive(Debug, Clone, Copy)]
pub struct Draws<'a> {
    /// The words in which the records of the nodes stand.
    pub words: &'a [u32],
    /// The growth units of the nodes.
    pub pieces: &'a [Piece],
    /// The place of the record of each node of the block.
    pub records: &'a [u32],
}

impl Draws<'_> {
    /// Calls `draw` for each stretch of nodes for which a law that varies so is the same: `law` is what a point has of
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
                pieces.for_each(|piece| next(piece.nodes.0 as usize, law(&piece.at)));
            }
            Varies::ByNode => {
                for piece in self.pieces {
                    piece.places().for_each(|node| next(node, law(&piece.at(node))));
                }
            }
        }
        draw(same, begin..all.end);
    }

    /// The places of the nodes of its growth units.
    #[inline]
    fn all(&self) -> Range<usize> {
        match self.pieces {
            [] => 0..0,
            [first, ..] => first.places().start..self.pieces[self.pieces.len() - 1].places().end,
        }
    }

    /// The words of some of the nodes.
    #[inline]
    fn words(&self, slot: Slot, nodes: Range<usize>) -> impl Iterator<Item = u32> {
        self.records[nodes].iter().map(move |place| self.words[*place as usize + slot.first])
    }

    /// Whether the axis lacks light.
    fn are_shaded(&self) -> bool {
        self.pieces.first().is_some_and(|piece| piece.at.shade > 0)
    }
}

impl Measure {
    /// Draws the measure for each node.
    #[inline]
    pub fn draw_many(&self, draws: Draws<'_>, into: &mut [f32]) {
        match self.fixed {
            Some(fixed) => into[draws.all()].fill(fixed),
            None => draws.stretches(
                self.table.varies(),
                |at| self.table.parameters(at),
                |parameters, nodes| {
                    let into = into[nodes.clone()].iter_mut();
                    self.table.draw_many(parameters, draws.words(self.slot, nodes).zip(into), |own| own * self.unit);
                },
            ),
        }
        if let Some(factor) = self.times.as_ref().filter(|_| draws.are_shaded() || !self.light_alone) {
            draws.stretches(
                Varies::ByUnit,
                |at| Factor(factor.at(*at)),
                |Factor(factor), nodes| into[nodes].iter_mut().for_each(|entry| *entry = times(*entry, factor)),
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
    /// Draws the number for each node. Numbers of what a node bears are not changed by responses.
    #[inline]
    pub fn draw_many(&self, draws: Draws<'_>, into: &mut Vec<u32>) {
        debug_assert!(self.times.is_none());
        into.clear();
        into.resize(draws.records.len(), self.fixed.unwrap_or(0));
        if self.fixed.is_none() {
            draws.stretches(
                self.table.varies(),
                |at| self.table.distribution(at),
                |number, nodes| {
                    self.table.sample_many(number, draws.words(self.slot, nodes.clone()).zip(&mut into[nodes]));
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
