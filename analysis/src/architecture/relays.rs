//! Relays of axes: how many there are, at which node and when they arise, whether the apex then lived, and how the
//! relays of one set develop.
//!
//! A set of relays stands on one axis and appears at one tick. By substitution the apex of the bearing axis had ended;
//! by apposition it lived on (Hallé, Oldeman & Tomlinson 1978). Absent: forks of an apex that divides.

use super::axes::{Axis, is_plagiotropic};
use super::share::Share;
use super::tolerance::{FIRST_GENERATIONS, NODES_FROM_TURN};
use phytomer_sim::plant::Origin;

/// The relays of the axes of some orders.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Relays {
    /// The number of relays.
    pub relays: u32,
    /// Of the sets of relays: the share with one relay.
    pub single: Share,
    /// Of the sets in the first generations: the share with two relays or more.
    pub early_several: Share,
    /// Of the sets of relays: the share that appeared while the apex of their axis lived on.
    pub apposition: Share,
    /// Of the relays with a trend: the share that is orthotropic at first.
    pub orthotropic: Share,
    /// Of the relays with a trend: the share that is orthotropic at first and plagiotropic at last, or the other way
    /// round.
    pub turned: Share,
    /// Of the sets of several relays that are all orthotropic at first and of which some are plagiotropic at last: the
    /// share of which exactly one relay stays orthotropic.
    pub one_leads: Share,
    /// Of the axes that flowered or completed their growth: the share that is relayed.
    pub finished: Share,
    /// Of the sets of relays: the share whose bearing axis also bears at least two plagiotropic axillary axes.
    pub bears_branches: Share,
    /// Of the sets of relays: the share whose bearing axis has branches, all of them above the relays and older.
    pub below_older_branches: Share,
    /// Of the sets of relays: the share whose bearing axis turns from orthotropic to plagiotropic at the node of the
    /// relays, or near it.
    pub at_the_turn: Share,
}

/// The relays that appear on one axis at one tick.
struct Set<'a> {
    bearing: &'a Axis,
    generation: u32,
    relays: Vec<&'a Axis>,
    /// The axes that the bearing axis bears from axillary buds.
    branches: Vec<&'a Axis>,
}

/// The relays of the axes whose order satisfies `asked`.
pub fn relays_of(axes: &[Axis], asked: impl Fn(u32) -> bool) -> Relays {
    let mut found = Relays::default();
    let generations = generations(axes);
    for (place, bearing) in axes.iter().enumerate().filter(|(_, axis)| asked(axis.order) && axis.is_judged()) {
        let borne =
            |origin: Origin| bearing.bears.iter().map(|&place| &axes[place]).filter(move |axis| axis.origin == origin);
        let branches: Vec<&Axis> = borne(Origin::Axillary).collect();
        let mut relays: Vec<&Axis> = borne(Origin::Relay).collect();
        relays.sort_by_key(|relay| relay.birth);
        if bearing.finished() {
            found.finished.add(!relays.is_empty());
        }
        for set in relays.chunk_by(|a, b| a.birth == b.birth) {
            let generation = generations[place];
            found.add(&Set { bearing, generation, relays: set.to_vec(), branches: branches.clone() });
        }
    }
    found
}

/// The generation of each axis: the number of relays from the first axis of its line to it.
fn generations(axes: &[Axis]) -> Vec<u32> {
    let mut generations = vec![0; axes.len()];
    for (place, axis) in axes.iter().enumerate() {
        if let (Origin::Relay, Some(bearing)) = (axis.origin, axis.bearing) {
            generations[place] = generations[bearing] + 1;
        }
    }
    generations
}

impl Relays {
    fn add(&mut self, set: &Set<'_>) {
        let Set { bearing, relays, .. } = set;
        let birth = relays[0].birth;
        self.relays += relays.len() as u32;
        self.single.add(relays.len() == 1);
        if set.generation < FIRST_GENERATIONS {
            self.early_several.add(relays.len() > 1);
        }
        self.apposition.add(bearing.lives_past(birth));
        for relay in relays {
            if let (Some(first), Some(last)) = (relay.first_trend(), relay.last_trend()) {
                self.orthotropic.add(!is_plagiotropic(first));
                self.turned.add(is_plagiotropic(first) != is_plagiotropic(last));
            }
        }
        self.judge_leader(relays);
        self.judge_branches(set);
        if let Some(turn) = turn(bearing) {
            self.at_the_turn.add(turn.abs_diff(relays[0].bearer_rank) <= NODES_FROM_TURN);
        } else {
            self.at_the_turn.add(false);
        }
    }

    fn judge_leader(&mut self, relays: &[&Axis]) {
        let equal = relays.iter().all(|relay| relay.first_trend().is_some_and(|trend| !is_plagiotropic(trend)));
        let lying = relays.iter().filter(|relay| relay.last_trend().is_some_and(is_plagiotropic)).count();
        if relays.len() > 1 && equal && lying > 0 {
            self.one_leads.add(lying + 1 == relays.len());
        }
    }

    fn judge_branches(&mut self, set: &Set<'_>) {
        let plagiotropic = |branch: &&&Axis| branch.first_trend().is_some_and(is_plagiotropic);
        self.bears_branches.add(set.branches.iter().filter(plagiotropic).count() >= 2);
        let below = |branch: &&Axis| set.relays.iter().all(|relay| relay.bearer_rank < branch.bearer_rank);
        let older = |branch: &&Axis| set.relays.iter().all(|relay| relay.birth > branch.birth);
        self.below_older_branches.add(!set.branches.is_empty() && set.branches.iter().all(|b| below(b) && older(b)));
    }
}

/// The last rank before the first plagiotropic internode of an axis; `None` where it has no plagiotropic internode, or
/// where its first internode is plagiotropic.
fn turn(axis: &Axis) -> Option<u32> {
    let plagiotropic = |rank: usize| axis.nodes.get(rank).and_then(|node| node.trend).is_some_and(is_plagiotropic);
    let first = (0..axis.nodes.len()).find(|&rank| plagiotropic(rank))?;
    (first > 0).then_some(first as u32)
}
