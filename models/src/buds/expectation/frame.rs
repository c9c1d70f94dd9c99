//! What the axes of one cohort are told apart by while they are followed: growth units made, nodes made and state.
//!
//! Growth units count up to the last one that an apex of the order can be given, nodes as far as relays need them.
//! Absent: what is followed, means (`cohort`) or the organs that are lost with their branch (`lost`).

use crate::buds::compile::OrderLaws;
use crate::law::At;

/// Relays can stand so many nodes below the last one, or else their axes are taken to be long enough for them.
const MOST_BELOW: u32 = 64;

/// The cells of a cohort.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    pub stages: usize,
    /// Numbers of nodes that are told apart: 0, 1, … and the last one or more.
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

    /// The probability that an axis of so many nodes is long enough for its relays, which stand below its last node.
    pub fn reaches(&self, laws: &OrderLaws, rank: usize, at: At) -> f64 {
        match rank {
            0 => 0.0,
            _ if rank + 1 == self.ranks => 1.0,
            _ => laws.end.below.table.pmf(at).iter().take(rank).sum(),
        }
    }

    /// The number of nodes after `more` of them, as far as it is told apart.
    pub fn after(&self, rank: usize, more: usize) -> usize {
        (rank + more).min(self.ranks - 1)
    }
}

/// Whether an axis of the order can be relayed.
pub fn is_relayed(laws: &OrderLaws) -> bool {
    laws.end.is_ever_relayed() || laws.step.transitions.iter().any(|passage| passage.relayed)
}

/// Whether every axis that is too short for its relays is told apart.
pub fn tells_short_axes(laws: &OrderLaws) -> bool {
    laws.end.below.table.max() <= MOST_BELOW || !is_relayed(laws)
}

/// Numbers of nodes of an axis that matter: none or some, and each too small for relays below the last node.
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
        // An apex that is to make none ends with its first.
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
