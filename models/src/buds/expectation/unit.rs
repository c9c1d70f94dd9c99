//! The means of one growth unit: nodes, organs with the ticks after which they appear, and the axes that its buds
//! become.
//!
//! They are sums over the distribution of the number of nodes and over ranks, since laws may depend on either. Absent:
//! the fates of buds, which `cohort` follows, and the loss of organs, which `lost` follows.

use super::frame;
use crate::buds::compile::{BudModel, NodeLaws, OrderLaws, Ramification, Ranks};
use crate::law::{At, CountTable};
use phytomer_sim::Tick;

/// The means of one growth unit.
#[derive(Debug, Clone, Default)]
pub struct Unit {
    /// Nodes.
    pub nodes: f64,
    /// The probability of 0, 1, 2 … nodes, by the cells in which axes are counted; the last cell has all larger
    /// numbers.
    pub counts: Vec<f64>,
    /// Leaves, flowers and fruits: each entry has the ticks from the growth unit to their appearance, and their mean
    /// number.
    pub organs: Vec<(Tick, f64)>,
    /// Axillary axes.
    pub laterals: Vec<Lateral>,
    /// Adaptive reiterations.
    pub reiterations: Vec<Lateral>,
    /// Dormant axillary buds on its last node, 0 where it has none.
    pub dormant: f64,
    /// The steps of summation spent on this unit.
    pub work: u64,
}

/// Axes that start alike.
#[derive(Debug, Clone, Copy)]
pub struct Lateral {
    /// The state that their zone gives; `None`: the state that the branching states.
    pub state: Option<u8>,
    /// The rank of their nodes, at which their delay is evaluated; 1 where the delay does not depend on it.
    pub rank: u32,
    /// The mean number of axes.
    pub axes: f64,
}

impl Unit {
    /// The means of a growth unit made at `at`; organs that appear after more than `horizon` ticks are left out.
    pub fn at(model: &BudModel, laws: &OrderLaws, at: At, horizon: Tick) -> Self {
        let mut mean = Self { counts: vec![0.0; frame::ranks(laws)], ..Self::default() };
        let mut organs = Organs::new(&laws.node, horizon);
        for (share, nodes) in sizes(laws, at) {
            mean.add(model, laws, (share, &nodes), &mut organs, at);
        }
        mean.work += organs.ticks() / 8;
        let by = organs.settle(&laws.node).iter().enumerate();
        mean.organs = by.filter(|(_, organs)| **organs > 0.0).map(|(ticks, organs)| (ticks as Tick, *organs)).collect();
        mean
    }

    /// Adds a share of growth units whose number of nodes has the distribution `nodes`.
    fn add(&mut self, model: &BudModel, laws: &OrderLaws, (share, nodes): (f64, &[f64]), organs: &mut Organs, at: At) {
        let most = self.counts.len() - 1;
        nodes.iter().enumerate().for_each(|(count, p)| self.counts[count.min(most)] += share * p);
        let mut at_least: f64 = share * nodes.iter().sum::<f64>();
        let reiteration = &laws.node.reiteration;
        for rank in 1..nodes.len() {
            at_least -= share * nodes[rank - 1];
            let at = At { rank: rank as u32, ..at };
            self.nodes += at_least;
            organs.add(&laws.node, at_least, at);
            let axes = reiteration.count.table.mean(at) * reiteration.chance.probability(at);
            bear(&mut self.reiterations, (None, &reiteration.delay.table), at_least * axes, at);
        }
        self.ramify(model, laws, (share, nodes), at);
        self.work += nodes.len() as u64;
    }

    /// Adds lateral axes and dormant buds, for every number of nodes, since zones are counted from either end.
    fn ramify(&mut self, model: &BudModel, laws: &OrderLaws, (share, nodes): (f64, &[f64]), at: At) {
        let axillary = &laws.node.axillary;
        if axillary.count.table.max() == 0 {
            return;
        }
        let next = model.has_order(laws.number + 1);
        // The probabilities of the drawn ranks; not needed where ranks are constant.
        let ranks = &laws.step.zone_ranks;
        let holding = if ranks.are_drawn() { ranks.holding(At { rank: 0, ..at }) } else { Vec::new() };
        for (count, &probability) in nodes.iter().enumerate().skip(1).filter(|(_, p)| **p > 0.0) {
            let (count, probability) = (count as u32, share * probability);
            let buds = |rank| axillary.count.table.mean(At { rank, ..at });
            let mut ramified = 0.0;
            for rank in (1..=count).filter(|_| next) {
                ramified = 0.0;
                let at = At { rank, ..at };
                for (state, chance) in ramification(&laws.node, (rank, count), &holding, at) {
                    ramified += chance;
                    bear(&mut self.laterals, (state, &axillary.delay.table), probability * buds(rank) * chance, at);
                }
            }
            self.dormant += probability * buds(count) * (1.0 - ramified);
            self.work += u64::from(count);
        }
    }
}

fn bear(laterals: &mut Vec<Lateral>, (state, delay): (Option<u8>, &CountTable), axes: f64, at: At) {
    if axes <= 0.0 {
        return;
    }
    let rank = if delay.is_rankless() { 1 } else { at.rank };
    match laterals.iter_mut().find(|of| (of.state, of.rank) == (state, rank)) {
        Some(of) => of.axes += axes,
        None => laterals.push(Lateral { state, rank, axes }),
    }
}

/// The distributions of the number of nodes of long and of short growth units, with the share of either; none of a type
/// that does not occur.
pub fn sizes(laws: &OrderLaws, at: At) -> Vec<(f64, Vec<f64>)> {
    let short = laws.step.short.probability(at);
    let mut sizes = Vec::new();
    if short < 1.0 {
        let neoformed = laws.step.neoformed.pmf(at);
        sizes.push((1.0 - short, convolve(&laws.step.long_nodes.pmf(at), &neoformed)));
    }
    if short > 0.0 {
        sizes.push((short, laws.step.short_nodes.pmf(at)));
    }
    sizes
}

/// The mean numbers of organs that appear 0, 1, 2 … ticks after their node.
#[derive(Debug, Clone)]
pub struct Organs {
    by: Vec<f64>,
    /// Flowers that will open, and the part of them that will set fruit, where their delays do not depend on the rank.
    waiting: Option<[f64; 2]>,
    /// A rank at which flowers stand.
    at: Option<At>,
}

impl Organs {
    pub fn new(node: &NodeLaws, horizon: Tick) -> Self {
        let longest = longest_wait(node).min(horizon) as usize;
        let is_rankless = node.flower_delay.table.is_rankless() && node.flower_life.table.is_rankless();
        Self { by: vec![0.0; longest + 1], waiting: is_rankless.then_some([0.0; 2]), at: None }
    }

    /// The number of ticks over which the organs are spread.
    pub fn ticks(&self) -> u64 {
        self.by.len() as u64
    }

    /// Adds the organs of `nodes` nodes at a rank.
    pub fn add(&mut self, node: &NodeLaws, nodes: f64, at: At) {
        self.by[0] += nodes * node.leaves.table.mean(at);
        let opening = nodes * node.flowers.table.mean(at) * node.flower_opens.probability(at);
        if opening <= 0.0 {
            return;
        }
        let sets = opening * node.fruit_set.probability(at);
        match &mut self.waiting {
            Some([flowers, fruits]) => {
                *flowers += opening;
                *fruits += sets;
                self.at = Some(at);
            }
            None => self.open(node, [opening, sets], at),
        }
    }

    /// Adds flowers and fruits at the ticks of their appearance; organs that do not appear within the horizon are left
    /// out.
    fn open(&mut self, node: &NodeLaws, [flowers, fruits]: [f64; 2], at: At) {
        let life = if fruits > 0.0 { node.flower_life.table.pmf(at) } else { Vec::new() };
        let delays = node.flower_delay.table.pmf(at);
        let wait = self.by.len();
        for (delay, share) in delays.into_iter().enumerate().take(wait).filter(|(_, share)| *share > 0.0) {
            self.by[delay] += flowers * share;
            for (life, p) in life.iter().enumerate().filter(|(_, p)| **p > 0.0) {
                if let Some(by) = self.by.get_mut(delay + life.max(1)) {
                    *by += fruits * share * p;
                }
            }
        }
    }

    /// The mean numbers of organs by ticks after their node.
    pub fn settle(&mut self, node: &NodeLaws) -> &[f64] {
        if let (Some(waiting), Some(at)) = (&mut self.waiting, self.at.take()) {
            let waiting = std::mem::take(waiting);
            self.open(node, waiting, at);
        }
        &self.by
    }
}

/// The longest time from a node to the appearance of an organ on it.
pub fn longest_wait(node: &NodeLaws) -> Tick {
    let opens = if node.flowers.table.max() > 0 { node.flower_delay.table.max() } else { return 0 };
    let sets = !node.fruit_set.is_never();
    if sets { opens.saturating_add(node.flower_life.table.max().max(1)) } else { opens }
}

/// The mean probabilities that a bud of the node at a rank of a growth unit ramifies, each with the state that a zone
/// gives.
fn ramification(node: &NodeLaws, (rank, nodes): Ranks, holding: &[Vec<f64>], at: At) -> Vec<(Option<u8>, f64)> {
    let spread = |(holds, of): (f64, Ramification<'_>)| {
        let probability = holds * of.chance.probability(at);
        of.shares(at).into_iter().map(move |(state, share)| (state, share * probability))
    };
    match &node.zones {
        Some(zones) if !holding.is_empty() => {
            zones.ramifications((rank, nodes), holding, &node.axillary.chance).flat_map(spread).collect()
        }
        _ => node.ramification(rank, nodes, &[]).map(|of| (1.0, of)).into_iter().flat_map(spread).collect(),
    }
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
