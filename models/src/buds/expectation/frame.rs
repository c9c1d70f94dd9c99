//! The cells in which the axes of one cohort are counted while they are followed: by growth units made, nodes made and
//! state.
//!
//! Growth units are counted up to the last that an apex of the order can make, nodes as far as relays need them.
//! Absent: the quantities in the cells, which are means (`cohort`) or the organs lost with their branch (`lost`).

use crate::buds::compile::OrderLaws;
use crate::law::At;

/// The most nodes below the last one at which relays can stand; beyond it every axis is taken to be long enough.
const MOST_BELOW: u32 = 64;

/// The cells of a cohort.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    pub stages: usize,
    /// The number of cells by number of nodes: 0, 1, …, and a last cell for all larger numbers.
    pub ranks: usize,
    pub states: usize,
}

impl Frame {
    pub fn of(laws: &OrderLaws, states: usize, ends: &Completion) -> Self {
        Self { stages: ends.stages(), ranks: ranks(laws), states }
    }

    pub fn cells(&self) -> usize {
        self.stages * self.ranks * self.states
    }

    pub fn cell(&self, stage: usize, rank: usize, state: u8) -> usize {
        (stage * self.ranks + rank) * self.states + usize::from(state)
    }

    /// The probability that an axis of `rank` nodes is long enough for its relays, which stand below its last node.
    pub fn reaches(&self, laws: &OrderLaws, rank: usize, at: At) -> f64 {
        match rank {
            0 => 0.0,
            _ if rank + 1 == self.ranks => 1.0,
            _ => laws.end.below.table.pmf(at).iter().take(rank).sum(),
        }
    }

    /// The cell of the number of nodes after `more` further nodes.
    pub fn after(&self, rank: usize, more: usize) -> usize {
        (rank + more).min(self.ranks - 1)
    }
}

/// Whether an axis of the order can be relayed.
pub fn is_relayed(laws: &OrderLaws) -> bool {
    laws.end.is_ever_relayed() || laws.step.transitions.iter().any(|passage| passage.relayed)
}

/// Whether every axis that is too short for its relays has a cell of its own.
pub fn tells_short_axes(laws: &OrderLaws) -> bool {
    laws.end.below.table.max() <= MOST_BELOW || !is_relayed(laws)
}

/// The number of cells by number of nodes: none and some, and each number too small for relays below the last node.
pub fn ranks(laws: &OrderLaws) -> usize {
    match tells_short_axes(laws) && is_relayed(laws) {
        true => laws.end.below.table.max() as usize + 2,
        false => 2,
    }
}

/// When apices end by having made all their growth units: the number is drawn once an axis.
pub struct Completion {
    /// The probability that an apex ends with its next growth unit, by growth units made; empty: never.
    hazards: Vec<f64>,
}

impl Completion {
    pub fn of(laws: &OrderLaws, at: At) -> Self {
        let Some(units) = &laws.head.units else {
            return Self { hazards: Vec::new() };
        };
        let mut pmf = units.table.pmf(at);
        // An apex that draws 0 growth units ends with its first.
        let none = pmf[0];
        pmf.resize(pmf.len().max(2), 0.0);
        pmf[1] += none;
        let mut left = 1.0;
        let hazards = pmf[1..].iter().map(|&share| {
            let hazard = if left > 0.0 { (share / left).min(1.0) } else { 1.0 };
            left -= share;
            hazard
        });
        Self { hazards: hazards.collect() }
    }

    pub fn stages(&self) -> usize {
        self.hazards.len().max(1)
    }

    pub fn hazard(&self, made: usize) -> f64 {
        self.hazards.get(made).copied().unwrap_or(0.0)
    }

    pub fn next(&self, made: usize) -> usize {
        (made + 1).min(self.stages() - 1)
    }
}
