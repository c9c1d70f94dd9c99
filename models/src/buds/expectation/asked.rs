//! Which of age, dimension and cycle the laws of an order's growth units depend on, so that equal units are summed
//! once.
//!
//! Absent: rank, over which a unit is summed, and state: units of different states are summed apart.

use crate::buds::compile::OrderLaws;
use crate::law::{At, Variable};

/// What a growth unit depends on: the state, then age, dimension and cycle, each 0 where it does not matter.
pub type Key = (u8, [u32; 3]);

const TIMES: [Variable; 3] = [Variable::Age, Variable::Dimension, Variable::Cycle];

/// For age, dimension and cycle, whether the laws depend on it.
#[derive(Debug, Clone, Copy)]
pub struct Asked([bool; 3]);

impl Asked {
    pub fn by_units_of(laws: &OrderLaws) -> Self {
        let is_asked = |time: Variable| {
            let others: Vec<Variable> =
                TIMES.into_iter().filter(|other| *other != time).chain([Variable::Rank]).collect();
            !units_ask_only(laws, &others)
        };
        Self(TIMES.map(is_asked))
    }

    pub fn key(self, at: At) -> Key {
        let [age, dimension, cycle] = self.0;
        let of = |asked: bool, value: u32| if asked { value } else { 0 };
        (at.state, [of(age, at.age), of(dimension, at.dimension), of(cycle, at.cycle)])
    }
}

fn units_ask_only(laws: &OrderLaws, known: &[Variable]) -> bool {
    let (step, node) = (&laws.step, &laws.node);
    let chances = [&step.short, &node.flower_opens, &node.fruit_set, &node.axillary.chance, &node.reiteration.chance];
    let counts = [
        &step.long_nodes,
        &step.short_nodes,
        &step.neoformed,
        &node.leaves,
        &node.flowers,
        &node.flower_delay,
        &node.flower_life,
        &node.axillary.count,
        &node.axillary.delay,
        &node.reiteration.count,
        &node.reiteration.delay,
    ];
    chances.iter().all(|chance| chance.asks_only(known))
        && counts.iter().all(|count| count.asks_only(known))
        && step.zone_ranks.ask_only(known)
        && node.zones.as_ref().is_none_or(|zones| zones.ask_only(known))
}
