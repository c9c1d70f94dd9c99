//! The means of one growth unit: nodes, organs, and the axes that its buds become.
//!
//! They are sums over the distribution of the number of nodes and over ranks, since laws may depend on either. Absent:
//! the fates of buds, which `cohort` follows.

use crate::buds::compile::{BudModel, NodeLaws, OrderLaws, Ramification, Ranks};
use crate::law::At;

/// The means of one growth unit.
#[derive(Debug, Clone, Default)]
pub struct Unit {
    /// Nodes.
    pub nodes: f64,
    /// Leaves, flowers and fruits.
    pub organs: f64,
    /// Axillary axes that start in the state of the order's axillary buds.
    pub laterals: f64,
    /// Those that start in the state of their zone.
    pub zoned: Vec<(u8, f64)>,
    /// Adaptive reiterations.
    pub reiterations: f64,
    /// The probability that it has no node.
    pub empty: f64,
    /// Dormant axillary buds on its last node, 0 where it has none.
    pub dormant: f64,
    /// Steps of summation that it took.
    pub work: u64,
}

impl Unit {
    /// The means of a growth unit made at `at`.
    pub fn at(model: &BudModel, laws: &OrderLaws, at: At) -> Self {
        let short = laws.step.short.table.probability(at);
        let neoformed = laws.step.neoformed.table.pmf(at);
        let mut mean = Self::default();
        if short < 1.0 {
            let nodes = convolve(&laws.step.long_nodes.table.pmf(at), &neoformed);
            mean.add(1.0 - short, &Self::of(model, laws, &nodes, at));
        }
        if short > 0.0 {
            mean.add(short, &Self::of(model, laws, &laws.step.short_nodes.table.pmf(at), at));
        }
        mean
    }

    fn of(model: &BudModel, laws: &OrderLaws, nodes: &[f64], at: At) -> Self {
        let mut mean = Self { empty: nodes.first().copied().unwrap_or(0.0), ..Self::default() };
        let mut at_least: f64 = nodes.iter().sum();
        for rank in 1..nodes.len() {
            at_least -= nodes[rank - 1];
            let at = At { rank: rank as u32, ..at };
            let node = &laws.node;
            mean.nodes += at_least;
            mean.organs += at_least * organs(node, at);
            mean.reiterations +=
                at_least * node.reiteration.count.table.mean(at) * node.reiteration.chance.table.probability(at);
        }
        mean.ramify(model, laws, nodes, at);
        mean.work += nodes.len() as u64;
        mean
    }

    /// Laterals and dormant buds, for every number of nodes, since zones are counted from either end.
    fn ramify(&mut self, model: &BudModel, laws: &OrderLaws, nodes: &[f64], at: At) {
        if laws.node.axillary.count.table.max() == 0 {
            return;
        }
        let next = model.has_order(laws.number + 1);
        // What units draw of their zones: nothing of it where ranks are constant.
        let ranks = &laws.step.zone_ranks;
        let holding = if ranks.are_drawn() { ranks.holding(At { rank: 0, ..at }) } else { Vec::new() };
        for (count, &probability) in nodes.iter().enumerate().skip(1).filter(|(_, p)| **p > 0.0) {
            let count = count as u32;
            let buds = |rank| laws.node.axillary.count.table.mean(At { rank, ..at });
            let mut ramified = 0.0;
            for rank in (1..=count).filter(|_| next) {
                ramified = 0.0;
                for (state, chance) in ramification(&laws.node, (rank, count), &holding, At { rank, ..at }) {
                    ramified += chance;
                    self.bear(state, probability * buds(rank) * chance);
                }
            }
            self.dormant += probability * buds(count) * (1.0 - ramified);
            self.work += u64::from(count);
        }
    }

    fn bear(&mut self, state: Option<u8>, axes: f64) {
        let Some(state) = state else { return self.laterals += axes };
        match self.zoned.iter_mut().find(|(known, _)| *known == state) {
            Some((_, sum)) => *sum += axes,
            None => self.zoned.push((state, axes)),
        }
    }

    fn add(&mut self, share: f64, other: &Self) {
        self.nodes += share * other.nodes;
        self.organs += share * other.organs;
        self.laterals += share * other.laterals;
        other.zoned.iter().for_each(|(state, axes)| self.bear(Some(*state), share * axes));
        self.reiterations += share * other.reiterations;
        self.empty += share * other.empty;
        self.dormant += share * other.dormant;
        self.work += other.work;
    }
}

/// The mean probabilities that a bud of the node at a rank of a growth unit of so many nodes ramifies, with the state that
/// a zone gives.
fn ramification(node: &NodeLaws, (rank, nodes): Ranks, holding: &[Vec<f64>], at: At) -> Vec<(Option<u8>, f64)> {
    let spread = |(holds, of): (f64, Ramification<'_>)| {
        let probability = holds * of.chance.table.probability(at);
        of.shares(at).into_iter().map(move |(state, share)| (state, share * probability))
    };
    match &node.zones {
        Some(zones) if !holding.is_empty() => {
            zones.ramifications((rank, nodes), holding, &node.axillary.chance).flat_map(spread).collect()
        }
        _ => node.ramification(rank, nodes, &[]).map(|of| (1.0, of)).into_iter().flat_map(spread).collect(),
    }
}

fn organs(node: &NodeLaws, at: At) -> f64 {
    let opening = node.flowers.table.mean(at) * node.flower_opens.table.probability(at);
    node.leaves.table.mean(at) + opening * (1.0 + node.fruit_set.table.probability(at))
}

/// The distribution of a sum of two independent counts.
fn convolve(a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0; (a.len() + b.len()).saturating_sub(1)];
    for (i, x) in a.iter().enumerate().filter(|(_, x)| **x > 0.0) {
        for (j, y) in b.iter().enumerate() {
            sum[i + j] += x * y;
        }
    }
    sum
}
