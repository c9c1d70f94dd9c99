//! How buds that stand at one place become axes: how many there are, whether each grows out, when, at what angle and in
//! which state.
//!
//! A node has such laws for its axillary and its reiteration buds, the end of an apex for relays, forks and released
//! buds (de Reffye 1988 §§2–3). Absent: the parameters that state them (`node`, `relay`), and the axes, which
//! `buds::node` adds.

use super::geometry::DEGREE;
use super::words::{Chance, Layout, Measure, Number};
use crate::law::{CountTable, ProbabilityTable, VariateTable};

/// The most buds of one kind at one place: dormant buds are kept as bits.
pub const MOST_BUDS: u32 = 32;

/// How buds at one place become axes.
#[derive(Debug, Clone)]
pub struct Branching {
    pub count: Number,
    pub chance: Chance,
    pub delay: Number,
    /// The insertion angle of the new axis.
    pub insertion: Measure,
    /// The state of the new axis; `None`: the state of the bearing axis.
    pub state: Option<u8>,
}

impl Branching {
    /// Gives each quantity its slots in the record of words.
    pub fn new(
        words: &mut Layout,
        count: CountTable,
        chance: ProbabilityTable,
        delay: CountTable,
        insertion: VariateTable,
        state: Option<u8>,
    ) -> Self {
        let most = count.max_in_any_run();
        Self {
            count: words.number(count, 1),
            chance: words.chance(chance, most),
            delay: words.number(delay, most),
            insertion: words.measure(insertion, DEGREE, most),
            state,
        }
    }
}
