//! Zones of a growth unit: the nodes that ramify in the rhythmic pattern (de Reffye 1988 §2, Fig. 4).
//!
//! A node in several zones belongs to the first. The ranks of a zone are constants, or drawn once a growth unit; drawn
//! ranks have slots in the step's record of words ([`ZoneRanks`]), and the nodes of the unit use them. Absent: the test
//! of a bud.

use super::chain::ChainLaw;
use super::compiler::Compiler;
use super::words::{Chance, Layout, Number};
use crate::buds::params::{End, Order, Pattern, Zone, ZoneState};
use crate::law::{At, Count, CountForm, CountTable, Law, Variable};

/// The most zones of a growth unit.
const MOST_ZONES: usize = 64;

/// The first and the last rank of a zone.
pub type Ranks = (u32, u32);

/// The zones of an order.
#[derive(Debug, Clone)]
pub struct Zones(Vec<ZoneLaw>);

#[derive(Debug, Clone)]
struct ZoneLaw {
    from: End,
    /// The ranks, where they are constant.
    ranks: Ranks,
    /// The law of ramification; `None`: that of the order.
    chance: Option<Chance>,
    /// The states in which its axes start; `None`: the state of the order's axillary buds.
    states: Option<States>,
}

/// The states in which the axes of a zone start.
#[derive(Debug, Clone)]
pub struct States {
    of: Vec<u8>,
    which: Number,
}

/// How the buds of a node ramify.
#[derive(Debug, Clone, Copy)]
pub struct Ramification<'a> {
    pub chance: &'a Chance,
    states: Option<&'a States>,
}

impl<'a> Ramification<'a> {
    /// Ramification by the order's own law, without a zone.
    pub fn of_order(chance: &'a Chance) -> Self {
        Self { chance, states: None }
    }

    /// The state of the axis of the bud at a position, where its zone has one.
    #[inline]
    pub fn state(&self, words: &[u32], position: u32, at: At) -> Option<u8> {
        self.states.and_then(|states| states.of.get(states.which.draw(words, position, at) as usize).copied())
    }

    /// The states that the axes start in, each with its share; `None`: the state of the order's axillary buds.
    pub fn shares(&self, at: At) -> Vec<(Option<u8>, f64)> {
        let Some(states) = self.states else { return vec![(None, 1.0)] };
        states.of.iter().copied().map(Some).zip(states.which.table.pmf(at)).collect()
    }
}

/// The ranks of all zones: constants, or laws where some rank is drawn.
#[derive(Debug, Clone)]
pub struct ZoneRanks {
    constant: Vec<Ranks>,
    drawn: Vec<(Number, Option<Number>)>,
    chain: Option<ChainLaw>,
}

/// What zones of either kind have: the end from which they count, their law of ramification and their states.
type Stated<'a> = (End, Option<&'a Law>, Option<&'a ZoneState>);

fn stated(order: &Order) -> Option<(&'static str, Vec<Stated<'_>>)> {
    match &order.axillary.pattern {
        Pattern::Rhythmic(rhythmic) => {
            let zones = rhythmic.zones.iter().take(MOST_ZONES);
            Some(("zones", zones.map(|zone| (zone.from, zone.ramification.as_ref(), zone.state.as_ref())).collect()))
        }
        Pattern::Chain(chain) => {
            let links = chain.chain.iter().take(MOST_ZONES);
            Some(("chain", links.map(|link| (chain.from, link.ramification.as_ref(), link.state.as_ref())).collect()))
        }
        Pattern::Named(_) => None,
    }
}

impl Zones {
    /// Compiles the zones of an order; `None` where every node may ramify. The zones' own laws of ramification have
    /// words for as many axillary buds as a node can have.
    pub fn compile(
        order: &Order,
        ranks: &ZoneRanks,
        most_buds: u32,
        compiler: &mut Compiler,
        words: &mut Layout,
    ) -> Option<Self> {
        let (list, zones) = stated(order)?;
        let compiled = zones.into_iter().enumerate().map(|(index, (from, ramification, state))| {
            let chance = ramification.map(|law| {
                let table = compiler.probability(law, &format!("axillary.pattern.{list}.{index}.ramification"));
                words.chance(table, most_buds)
            });
            let keys = format!("axillary.pattern.{list}.{index}.state");
            let states = state.and_then(|state| states(state, &keys, compiler));
            let states = states.map(|(of, which)| States { of, which: words.number(which, most_buds) });
            // A unit that draws some rank draws the ranks of every zone.
            ZoneLaw { from, ranks: ranks.constant.get(index).copied().unwrap_or_default(), chance, states }
        });
        Some(Self(compiled.collect()))
    }

    /// How the node at `rank` of a growth unit of `nodes` ramifies; `None` where it is in no zone. `order` is the law
    /// of zones without a law of their own, `drawn` the ranks that the unit has drawn, if any.
    #[inline]
    pub fn ramification<'a>(
        &'a self,
        rank: u32,
        nodes: u32,
        drawn: &[Ranks],
        order: &'a Chance,
    ) -> Option<Ramification<'a>> {
        let holds = |(place, zone): &(usize, &ZoneLaw)| {
            let (first, last) = drawn.get(*place).copied().unwrap_or(zone.ranks);
            (first..=last).contains(&zone.rank(rank, nodes))
        };
        let (_, zone) = self.0.iter().enumerate().find(holds)?;
        Some(zone.ramification(order))
    }

    /// The probabilities of ramification of the zones that state their own.
    pub fn own_chances(&mut self) -> impl Iterator<Item = &mut Chance> {
        self.0.iter_mut().filter_map(|zone| zone.chance.as_mut())
    }

    /// Whether the ramification depends on the state of the axis and the variables `known` at most.
    pub fn ask_only(&self, known: &[Variable]) -> bool {
        self.0.iter().all(|zone| {
            zone.chance.as_ref().is_none_or(|chance| chance.asks_only(known))
                && zone.states.as_ref().is_none_or(|states| states.which.table.asks_only(known))
        })
    }

    /// The states that zones state for the axes of buds on an axis in `state`; `None` stands for the state of the
    /// order's axillary buds. `order` is the law of zones without a law of their own.
    pub fn states_of(&self, state: u8, order: &Chance) -> Vec<Option<u8>> {
        let bearing = self.0.iter().filter(|zone| !zone.ramification(order).chance.is_never_in(state));
        bearing
            .flat_map(|zone| zone.states.as_ref().map_or(vec![None], |of| of.of.iter().copied().map(Some).collect()))
            .collect()
    }

    /// How the node at `rank` of `nodes` ramifies, averaged over the ranks that units draw: for each zone the
    /// probability that it holds the node and no earlier zone does. `holding` is [`ZoneRanks::holding`].
    pub fn ramifications<'a>(
        &'a self,
        (rank, nodes): Ranks,
        holding: &'a [Vec<f64>],
        order: &'a Chance,
    ) -> impl Iterator<Item = (f64, Ramification<'a>)> {
        let mut free = 1.0;
        self.0.iter().zip(holding).map(move |(zone, holding)| {
            let rank = zone.rank(rank, nodes) as usize;
            let holds = holding.get(rank).or(holding.last()).copied().unwrap_or(0.0);
            let share = free * holds;
            free *= 1.0 - holds;
            (share, zone.ramification(order))
        })
    }
}

/// The states of a zone, and the law that draws one of them for an axis; `None` where they are at fault.
fn states(state: &ZoneState, keys: &str, compiler: &mut Compiler) -> Option<(Vec<u8>, CountTable)> {
    let shares = match state {
        ZoneState::Named(name) => return Some((vec![compiler.state(name, keys)], CountTable::always(0))),
        ZoneState::Shares(shares) => shares,
    };
    let of = shares.keys().map(|name| compiler.state(name, &format!("{keys}.{name}"))).collect();
    let weights: Vec<f64> = shares.values().copied().collect();
    let sum: f64 = weights.iter().sum();
    if !sum.is_finite() || sum <= 0.0 || weights.iter().any(|weight| *weight < 0.0) {
        compiler.fault(keys, format!("the shares sum to {sum}"), "shares of 0 or more, one of them above 0");
        return None;
    }
    let which = Count::from(CountForm { empirical: Some(weights), ..CountForm::default() });
    Some((of, compiler.count(&which, keys, u32::MAX)))
}

impl ZoneLaw {
    /// How a node of the zone ramifies; `order` is the law of zones without a law of their own.
    #[inline]
    fn ramification<'a>(&'a self, order: &'a Chance) -> Ramification<'a> {
        Ramification { chance: self.chance.as_ref().unwrap_or(order), states: self.states.as_ref() }
    }

    /// The rank of a node from the end from which the zone counts.
    #[inline]
    fn rank(&self, rank: u32, nodes: u32) -> u32 {
        if self.from == End::Base { rank } else { nodes + 1 - rank }
    }
}

impl ZoneRanks {
    /// Compiles and checks the ranks of every zone, with words for `units` growth units.
    pub fn compile(order: &Order, compiler: &mut Compiler, words: &mut Layout, units: u32) -> Self {
        let zones = match &order.axillary.pattern {
            Pattern::Rhythmic(rhythmic) => rhythmic.zones.iter().take(MOST_ZONES).enumerate(),
            Pattern::Chain(chain) => {
                let chain = Some(ChainLaw::compile(chain, compiler, words, units));
                return Self { constant: Vec::new(), drawn: Vec::new(), chain };
            }
            Pattern::Named(_) => [].iter().take(0).enumerate(),
        };
        let compiled: Vec<_> = zones.map(|(index, zone)| ranks(zone, index, compiler)).collect();
        let constant = |(first, last): &(CountTable, Option<CountTable>)| {
            Some((first.constant()?, last.as_ref().map_or(Some(u32::MAX), CountTable::constant)?))
        };
        if let Some(constant) = compiled.iter().map(constant).collect() {
            return Self { constant, drawn: Vec::new(), chain: None };
        }
        let mut number = |table: CountTable| words.number(table, units);
        let drawn = compiled.into_iter().map(|(first, last)| (number(first), last.map(&mut number)));
        Self { constant: Vec::new(), drawn: drawn.collect(), chain: None }
    }

    /// Whether a growth unit draws ranks.
    #[inline]
    pub fn are_drawn(&self) -> bool {
        !self.drawn.is_empty() || self.chain.is_some()
    }

    /// The ranks of the zones of the `unit`-th growth unit of a step.
    pub fn draw(&self, words: &[u32], unit: u32, at: At, ranks: &mut Vec<Ranks>) {
        ranks.clear();
        if let Some(chain) = &self.chain {
            return chain.draw(words, unit, at, ranks);
        }
        let last = |last: &Option<Number>| last.as_ref().map_or(u32::MAX, |last| last.draw(words, unit, at));
        ranks.extend(self.drawn.iter().map(|(first, end)| (first.draw(words, unit, at), last(end))));
    }

    /// Whether the distributions of the ranks depend on the state and the variables `known` at most.
    pub fn ask_only(&self, known: &[Variable]) -> bool {
        let mut tables = self.drawn.iter().flat_map(|(first, last)| std::iter::once(first).chain(last));
        tables.all(|number| number.table.asks_only(known))
            && self.chain.as_ref().is_none_or(|chain| chain.asks_only(known))
    }

    /// For each zone the probability that it holds the node of rank 0, 1, 2 … from its end of the unit; later nodes
    /// have the last probability.
    pub fn holding(&self, at: At) -> Vec<Vec<f64>> {
        if let Some(chain) = &self.chain {
            return chain.holding(at);
        }
        let begun = |first: &Number| running(&first.table.pmf(at));
        let holding = |(first, last): &(Number, Option<Number>)| {
            let (begun, ended) = (begun(first), last.as_ref().map_or(vec![0.0], |last| running(&last.table.pmf(at))));
            let upto = |sums: &[f64], rank: usize| sums.get(rank).or(sums.last()).copied().unwrap_or(0.0);
            // A zone ends before the rank where its last rank is below it.
            let ended_before = |rank: usize| rank.checked_sub(1).map_or(0.0, |before| upto(&ended, before));
            (0..=begun.len().max(ended.len())).map(|rank| upto(&begun, rank) * (1.0 - ended_before(rank))).collect()
        };
        self.drawn.iter().map(holding).collect()
    }
}

/// The sums of the first 1, 2, 3 … probabilities.
fn running(pmf: &[f64]) -> Vec<f64> {
    let sum = |sum: &mut f64, p: &f64| {
        *sum += p;
        Some(sum.min(1.0))
    };
    pmf.iter().scan(0.0, sum).collect()
}

/// The first and the last rank of a zone, each at least 1. A last rank that is always before the first is a fault.
fn ranks(zone: &Zone, index: usize, compiler: &mut Compiler) -> (CountTable, Option<CountTable>) {
    let keys = format!("axillary.pattern.zones.{index}");
    let first = compiler.rank(&zone.first, &format!("{keys}.first"));
    let last = zone.last.as_ref().map(|last| compiler.rank(last, &format!("{keys}.last")));
    if let Some(last) = last.as_ref().filter(|last| last.max() < first.min()) {
        let found = format!("the zone goes from rank {} to rank {}", first.min(), last.max());
        compiler.fault(&keys, found, "a first rank from 1 and a last rank not before it");
    }
    (first, last)
}
