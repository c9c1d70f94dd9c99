//! The probability, by deadline, that everything borne by a node, a growth unit or the end of an apex is dead.
//!
//! A branch is dead when its apex and all branches on it are dead. A bud that has not begun to grow is alive. Absent:
//! the axis itself, which `lost` follows.

use super::asked::{Asked, Key};
use super::frame;
use super::unit::{self, Organs};
use crate::buds::compile::{Branching, BudModel, OrderLaws};
use crate::buds::params::ApexEnd;
use crate::law::{At, CountTable};
use phytomer_sim::Tick;
use std::collections::BTreeMap;
use std::rc::Rc;

/// The most growth units whose sums are kept.
const MOST_UNITS: usize = 5_000;

/// Axes that are born alike: the place of their order, their state, and 1 where they follow in their set, 0 where they
/// lead it.
type Class = (usize, u8, usize);

/// The deaths of the branches that are born later than the current tick.
pub struct Gone<'a> {
    model: &'a BudModel,
    until: Tick,
    /// The probability of being dead by each deadline, from the tick of birth on; by class and tick of birth.
    told: BTreeMap<(Class, Tick), Vec<f64>>,
    /// Growth units by order, tick and the other variables that units of the order depend on.
    units: BTreeMap<(usize, Tick, Key), Rc<MadeUnit>>,
    asked: Vec<Asked>,
    /// Steps of summation so far.
    pub work: u64,
}

/// A growth unit, by the cells of [`Frame`](super::frame::Frame) for the number of nodes.
pub struct MadeUnit {
    pub by_nodes: Vec<Made>,
}

/// Growth units of some number of nodes.
#[derive(Clone, Default)]
pub struct Made {
    /// The share of the growth units with this number of nodes.
    pub share: f64,
    /// By deadline, the part of `share` whose buds and branches are all dead by then; `None`: they have borne nothing
    /// that lives.
    pub alone: Option<Vec<f64>>,
    /// The organs due 0, 1, 2 … ticks from now on the units counted in `alone`.
    pub due: Vec<f64>,
}

impl<'a> Gone<'a> {
    pub fn new(model: &'a BudModel, until: Tick) -> Self {
        let asked = model.orders.iter().map(Asked::by_units_of).collect();
        Self { model, until, told: BTreeMap::new(), units: BTreeMap::new(), asked, work: 0 }
    }

    pub fn until(&self) -> Tick {
        self.until
    }

    /// Records by when the branches of the axes of a class that are born at a tick are dead.
    pub fn tell(&mut self, class: Class, birth: Tick, gone: &[f64]) {
        // A branch can be dead one tick after its birth.
        if gone.last().is_some_and(|gone| *gone > 0.0) {
            self.told.insert((class, birth), gone[birth as usize..].to_vec());
        }
    }

    /// The probability, by deadline, that an axis that appears now and is born after its delay is dead.
    fn of_axis(&mut self, class: Class, delay: &CountTable, at: At) -> Vec<f64> {
        let mut dead = vec![0.0; self.until as usize + 1];
        for (delay, share) in delay.pmf(at).into_iter().enumerate().filter(|(_, share)| *share > 0.0) {
            let birth = at.age as usize + delay;
            if birth >= dead.len() {
                break;
            }
            if let Some(told) = self.told.get(&(class, birth as Tick)) {
                dead[birth..].iter_mut().zip(told).for_each(|(sum, told)| *sum += share * told);
                self.work += told.len() as u64;
            }
        }
        dead
    }

    /// The probability, by deadline, that a set of equal axes, of which the first leads, is dead.
    ///
    /// Of n buds that become axes with probability c each, with q and r the probabilities that the leader and that
    /// another axis is dead: N₀ = 1, L₀ = 0; Nₙ₊₁ = (1 − c) Nₙ, none has become an axis; Lₙ₊₁ = (1 − c + c r) Lₙ + c q
    /// Nₙ, some have.
    pub fn of_set(&mut self, order: usize, set: &Branching, at: At) -> Vec<f64> {
        let state = set.state.unwrap_or(at.state);
        let leader = self.of_axis((order, state, 0), &set.delay.table, at);
        let other = self.of_axis((order, state, 1), &set.delay.table, at);
        let chance = set.chance.probability(at);
        let counts = set.count.table.pmf(at);
        let of_deadline = |(q, r): (&f64, &f64)| {
            let (mut dead, mut none, mut some) = (0.0, 1.0, 0.0);
            for share in &counts {
                dead += share * (none + some);
                some = (1.0 - chance + chance * r) * some + chance * q * none;
                none *= 1.0 - chance;
            }
            dead
        };
        self.work += (counts.len() * leader.len()) as u64;
        leader.iter().zip(&other).map(of_deadline).collect()
    }

    /// The probability, by deadline, that an apex that ends now is past the life of its flower and fruit, or of its
    /// completed branch; `None`: at once.
    pub fn of_apex(&mut self, laws: &OrderLaws, end: ApexEnd, at: At) -> Option<Vec<f64>> {
        let lives = match end {
            ApexEnd::Death => return None,
            ApexEnd::Completed => laws.end.persists.as_ref()?.table.pmf(at),
            ApexEnd::Flower => terminal_life(laws, at),
        };
        let mut past = vec![0.0; self.until as usize + 1];
        let mut sum = 0.0;
        for (ticks, by) in past[at.age as usize..].iter_mut().enumerate() {
            sum += lives.get(ticks).copied().unwrap_or(0.0);
            *by = sum;
        }
        Some(past)
    }

    /// A growth unit made now. The axes that it bears are born later than any axis that makes it, so their deaths have
    /// been recorded.
    pub fn unit(&mut self, order: usize, at: At) -> Rc<MadeUnit> {
        let key = (order, at.age, self.asked[order].key(at));
        if let Some(known) = self.units.get(&key) {
            return Rc::clone(known);
        }
        if self.units.len() > MOST_UNITS {
            self.units.clear();
        }
        let made = Rc::new(self.summed(order, at));
        self.units.insert(key, Rc::clone(&made));
        made
    }

    fn summed(&mut self, order: usize, at: At) -> MadeUnit {
        let laws = &self.model.orders[order];
        let most = frame::ranks(laws) - 1;
        let mut by_nodes = vec![Made::default(); most + 1];
        for (share, nodes) in unit::sizes(laws, at) {
            self.add_units(order, (share, &nodes), &mut by_nodes, at);
        }
        MadeUnit { by_nodes }
    }

    fn add_units(&mut self, order: usize, (share, nodes): (f64, &[f64]), by_nodes: &mut [Made], at: At) {
        let laws = &self.model.orders[order];
        let horizon = self.until - at.age;
        let mut organs = Organs::new(&laws.node, horizon);
        let mut dead = None;
        for (count, &p) in nodes.iter().enumerate() {
            let at = At { rank: count as u32, ..at };
            if count > 0 {
                organs.add(&laws.node, 1.0, at);
            }
            dead = match laws.node.zones {
                None if count > 0 => product(dead, self.of_node(order, (count, count), at)),
                None => None,
                Some(_) => (1..=count).filter(|_| p > 0.0).fold(None, |dead, rank| {
                    product(dead, self.of_node(order, (rank, count), At { rank: rank as u32, ..at }))
                }),
            };
            if p > 0.0 {
                by_nodes[count.min(by_nodes.len() - 1)].add(share * p, organs.settle(&laws.node), dead.as_deref(), at);
            }
            self.work += 1 + organs.ticks() / 8 + if dead.is_some() { u64::from(horizon) } else { 0 };
        }
    }

    /// The probability, by deadline, that all that the node at `rank` of a growth unit of `nodes` bears is dead;
    /// `None`: it bears nothing.
    fn of_node(&mut self, order: usize, (rank, nodes): (usize, usize), at: At) -> Option<Vec<f64>> {
        let laws = &self.model.orders[order];
        let (axillary, reiteration) = (&laws.node.axillary, &laws.node.reiteration);
        let next = self.model.has_order(laws.number + 1);
        let ramifies = laws.node.ramification(rank as u32, nodes as u32, &[]).filter(|_| next);
        let chance = ramifies.map_or(0.0, |of| of.chance.probability(at));
        let mut dead = None;
        if let Some(of) = ramifies.filter(|_| chance > 0.0 && axillary.count.table.max() > 0) {
            let states = of.shares(at).into_iter().filter(|(_, share)| *share > 0.0);
            let starts =
                states.map(|(state, share)| ((order + 1, state.or(axillary.state).unwrap_or(at.state), 0), share));
            dead = Some(self.of_buds((axillary, chance), starts.collect(), at));
        }
        let chance = reiteration.chance.probability(at);
        if chance > 0.0 && reiteration.count.table.max() > 0 {
            let start = (usize::from(laws.node.reiteration_order) - 1, reiteration.state.unwrap_or(at.state), 0);
            dead = product(dead, Some(self.of_buds((reiteration, chance), vec![(start, 1.0)], at)));
        }
        dead
    }

    /// The probability, by deadline, that the axes of `buds` are dead. Each bud becomes an axis with probability
    /// `chance`; `starts` are the classes in which the axes start, with their shares.
    fn of_buds(&mut self, (buds, chance): (&Branching, f64), starts: Vec<(Class, f64)>, at: At) -> Vec<f64> {
        let mut bud = vec![1.0 - chance; self.until as usize + 1];
        for (class, share) in starts {
            let axis = self.of_axis(class, &buds.delay.table, at);
            bud.iter_mut().zip(axis).for_each(|(bud, axis)| *bud += chance * share * axis);
        }
        let counts = buds.count.table.pmf(at);
        let of_all = |bud: f64| counts.iter().rev().fold(0.0, |sum, share| sum * bud + share);
        self.work += (counts.len() * bud.len()) as u64;
        bud.into_iter().map(of_all).collect()
    }
}

impl Made {
    /// Adds a share of growth units, and the organs due on each of them.
    fn add(&mut self, share: f64, organs: &[f64], dead: Option<&[f64]>, at: At) {
        if let (None, Some(dead)) = (&self.alone, dead) {
            self.alone = Some(vec![self.share; dead.len()]);
        }
        self.share += share;
        let of_deadline = |deadline: usize| share * dead.map_or(1.0, |dead| dead[deadline]);
        if let Some(alone) = &mut self.alone {
            alone.iter_mut().enumerate().for_each(|(deadline, alone)| *alone += of_deadline(deadline));
        }
        self.due.resize(organs.len().max(self.due.len()), 0.0);
        let due = self.due.iter_mut().zip(organs).zip(at.age as usize..);
        due.for_each(|((due, organs), deadline)| *due += organs * of_deadline(deadline));
    }
}

fn product(a: Option<Vec<f64>>, b: Option<Vec<f64>>) -> Option<Vec<f64>> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.into_iter().zip(b).map(|(a, b)| a * b).collect()),
        (a, b) => a.or(b),
    }
}

/// The distribution of the ticks from the end of an apex as a flower to the fall of its flower, or of the fruit that it
/// sets.
fn terminal_life(laws: &OrderLaws, at: At) -> Vec<f64> {
    let node = &laws.node;
    let sets = node.fruit_set.probability(at);
    let flower = at_least_one(node.flower_life.table.pmf(at));
    let fruit = if sets > 0.0 { at_least_one(node.fruit_life.table.pmf(at)) } else { vec![1.0] };
    let mut lives = vec![0.0; flower.len() + fruit.len()];
    for (flower, p) in flower.iter().enumerate() {
        lives[flower] += p * (1.0 - sets);
        fruit.iter().enumerate().filter(|_| sets > 0.0).for_each(|(fruit, q)| lives[flower + fruit] += p * sets * q);
    }
    lives
}

/// The distribution in which a life of 0 ticks counts as 1 tick.
fn at_least_one(mut pmf: Vec<f64>) -> Vec<f64> {
    pmf.resize(pmf.len().max(2), 0.0);
    pmf[1] += std::mem::take(&mut pmf[0]);
    pmf
}
