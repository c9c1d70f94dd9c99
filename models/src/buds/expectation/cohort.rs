//! Cohorts: the axes of one order and one speed, born at one tick in one state, followed step by step as shares.
//!
//! A cohort's shares live, rest, grow or end by the same compiled laws as a bud; what they bear starts cohorts of its
//! own, at later ticks. Absent: branch deaths and leaf fall, so that what is counted is what has been made.

use super::unit::Unit;
use crate::buds::compile::{Branching, BudModel, OrderLaws, Zones};
use crate::buds::params::ApexEnd;
use crate::law::At;
use phytomer_sim::Tick;
use phytomer_sim::clock::Speed;
use phytomer_sim::expectation::{Expectation, OrderExpectation};
use std::rc::Rc;

/// The most steps of summation: a second or so.
const MOST_WORK: u64 = 40_000_000;

/// A cohort of which less than this is left bears nothing that the sum, in double precision, would show.
const NOTHING_LEFT: f64 = 1e-30;

/// A share of a cohort.
#[derive(Debug, Clone, Copy, Default)]
struct Flow {
    /// Living apices.
    apices: f64,
    /// Those of them whose axis has a node of its own.
    with_node: f64,
    /// Dormant axillary buds on the last nodes of their axes.
    dormant: f64,
}

impl Flow {
    fn share(self, share: f64) -> Self {
        Self { apices: self.apices * share, with_node: self.with_node * share, dormant: self.dormant * share }
    }

    fn add(&mut self, other: Self) {
        self.apices += other.apices;
        self.with_node += other.with_node;
        self.dormant += other.dormant;
    }

    /// After a growth unit: its last node is now the last, unless it had none.
    fn grown(self, unit: &Unit) -> Self {
        Self {
            apices: self.apices,
            with_node: self.apices * (1.0 - unit.empty) + self.with_node * unit.empty,
            dormant: self.apices * unit.dormant + self.dormant * unit.empty,
        }
    }
}

/// The sum over all cohorts.
pub struct Cohorts<'a> {
    model: &'a BudModel,
    until: Tick,
    /// Axes born, by order, class and tick; the class is twice the state, and one more where axes do not lead their sets.
    births: Vec<Vec<Vec<f64>>>,
    expected: Vec<OrderExpectation>,
    /// The growth unit of each order by state, where nothing but the state matters.
    timeless: Vec<Option<Rc<[Unit]>>>,
    /// Whether the axes of the cohort that is followed lead their sets of relays.
    leads: bool,
    work: u64,
}

impl<'a> Cohorts<'a> {
    /// Nothing born yet.
    pub fn new(model: &'a BudModel, until: Tick) -> Self {
        let ticks = vec![0.0; until as usize + 1];
        Self {
            model,
            until,
            births: vec![vec![ticks; 2 * model.states]; model.orders.len()],
            expected: vec![OrderExpectation::zero(until); model.orders.len()],
            timeless: model.orders.iter().map(|laws| timeless_units(model, laws)).collect(),
            leads: true,
            work: 0,
        }
    }

    /// The means of what one axis of `order` and all that it bears make; `None` where the sum would take too long.
    ///
    /// A cohort bears only after its own birth, so cohorts are taken by tick of birth.
    pub fn sum_from(mut self, order: u8) -> Option<Expectation> {
        let first = usize::from(order) - 1;
        self.births[first][0][0] = 1.0;
        self.expected[first].axes[0] = 1.0;
        for birth in 0..=self.until {
            for order in 0..self.model.orders.len() {
                for class in 0..2 * self.model.states {
                    let born = self.births[order][class][birth as usize];
                    let model = self.model;
                    for (speed, share) in model.orders[order].head.speed.shares().filter(|_| born > 0.0) {
                        self.follow((order, speed), class, birth, born * share)?;
                    }
                }
            }
        }
        self.expected.iter_mut().for_each(OrderExpectation::accumulate);
        Some(Expectation { orders: self.expected })
    }

    /// One cohort, of the axes that drew one speed, from its birth to the last age.
    fn follow(&mut self, (order, speed): (usize, Speed), class: usize, birth: Tick, born: f64) -> Option<()> {
        let laws = &self.model.orders[order];
        let state = (class / 2) as u8;
        self.leads = class.is_multiple_of(2);
        let ends = Completion::of(laws, At { age: birth, state, ..At::default() });
        let mut living = vec![vec![Flow::default(); self.model.states]; ends.stages()];
        let mut after = living.clone();
        living[0][usize::from(state)].apices = born;
        let mut cycle = 0;
        for tick in birth + 1..=self.until {
            let dimension = tick - birth;
            while cycle < speed.steps_by(dimension) {
                cycle += 1;
                let at = At { age: tick, dimension, cycle, ..At::default() };
                self.step(order, &living, &mut after, &ends, at);
                std::mem::swap(&mut living, &mut after);
                if self.work > MOST_WORK {
                    return None;
                }
                if living.iter().flatten().all(|flow| flow.apices < NOTHING_LEFT) {
                    return Some(());
                }
            }
        }
        Some(())
    }

    /// One clock step of a cohort: what is still living after it, by growth units made and by state.
    fn step(&mut self, order: usize, living: &[Vec<Flow>], after: &mut [Vec<Flow>], ends: &Completion, at: At) {
        after.iter_mut().for_each(|states| states.fill(Flow::default()));
        let known = self.timeless[order].clone();
        let mut summed;
        for (made, states) in living.iter().enumerate() {
            for (state, flow) in states.iter().enumerate().filter(|(_, flow)| flow.apices > 0.0) {
                let at = At { state: state as u8, ..at };
                let growing = self.fates(order, *flow, &mut after[made][state], at);
                let unit = match &known {
                    Some(units) => &units[state],
                    None => {
                        summed = Unit::at(self.model, &self.model.orders[order], at);
                        &summed
                    }
                };
                self.work += 1 + unit.work;
                self.grow(order, growing, (made, ends), unit, after, at);
            }
        }
    }

    /// Death, pause and terminal flower; what is left to grow.
    fn fates(&mut self, order: usize, flow: Flow, resting: &mut Flow, at: At) -> Flow {
        let laws = &self.model.orders[order];
        let death = laws.step.death.table.probability(at);
        let pause = laws.step.pause.table.probability(at);
        let flower = laws.step.flower.table.probability(at);
        self.end(order, flow.share(death), ApexEnd::Death, at);
        let alive = flow.share(1.0 - death);
        resting.add(alive.share(pause));
        let active = alive.share(1.0 - pause);
        let flowering = active.share(flower);
        let fruits = laws.node.fruit_set.table.probability(at);
        self.expected[order].organs[at.age as usize] += flowering.with_node * (1.0 + fruits);
        self.end(order, flowering, ApexEnd::Flower, at);
        active.share(1.0 - flower)
    }

    /// The growth units of a step, one after another, then the passages between states.
    fn grow(
        &mut self,
        order: usize,
        growing: Flow,
        (made, ends): (usize, &Completion),
        unit: &Unit,
        after: &mut [Vec<Flow>],
        at: At,
    ) {
        let per_step = self.model.orders[order].step.per_step.table.pmf(at);
        let mut at_least: f64 = per_step.iter().sum();
        let mut flow = growing;
        let mut stage = made;
        for (units, &exactly) in per_step.iter().enumerate() {
            if units > 0 {
                self.unit(order, flow.apices * at_least, unit, at);
                flow = flow.grown(unit);
                let completed = ends.hazard(stage);
                self.end(order, flow.share(at_least * completed), ApexEnd::Completed, at);
                flow = flow.share(1.0 - completed);
                stage = ends.next(stage);
            }
            self.pass(order, flow.share(exactly), &mut after[stage], at);
            at_least -= exactly;
        }
    }

    /// What `apices` growth units make.
    fn unit(&mut self, order: usize, apices: f64, unit: &Unit, at: At) {
        let expected = &mut self.expected[order];
        let age = at.age as usize;
        expected.units[age] += apices;
        expected.nodes[age] += apices * unit.nodes;
        expected.organs[age] += apices * unit.organs;
        let model = self.model;
        let node = &model.orders[order].node;
        let bearing = At { rank: 1, ..at };
        self.bear(order + 1, apices * unit.laterals, &node.axillary, bearing);
        for &(state, axes) in &unit.zoned {
            self.bear_in((state, 0), order + 1, apices * axes, &node.axillary, bearing);
        }
        self.bear(usize::from(node.reiteration_order) - 1, apices * unit.reiterations, &node.reiteration, bearing);
    }

    /// Passages between states: the first that happens, in the order in which they are stated.
    fn pass(&mut self, order: usize, flow: Flow, after: &mut [Flow], at: At) {
        let mut stays = flow;
        let (model, leads) = (self.model, self.leads);
        for passage in model.orders[order].step.transitions.iter().filter(|passage| passage.concerns(at.state, leads)) {
            let passes = passage.chance.table.probability(at);
            let passing = stays.share(passes);
            if passage.relayed {
                self.relay(order, passing, at);
            }
            after[usize::from(passage.to)].add(passing);
            stays = stays.share(1.0 - passes);
        }
        after[usize::from(at.state)].add(stays);
    }

    /// What follows the ends of apices: relays, and traumatic reiterations where they died.
    fn end(&mut self, order: usize, ended: Flow, end: ApexEnd, at: At) {
        let model = self.model;
        let laws = &model.orders[order].end;
        if laws.is_relayed(end) {
            self.relay(order, ended, at);
        }
        if end == ApexEnd::Death {
            let released = laws.traumatic.chance.table.probability(at);
            self.bear(order, ended.dormant * released, &laws.traumatic, at);
        }
        if let Some(fork) = laws.fork.as_ref().filter(|_| end == ApexEnd::Completed) {
            self.bear_set(order, ended.with_node, fork, at);
        }
    }

    /// The relays of apices that have ended or passed into another state.
    fn relay(&mut self, order: usize, of: Flow, at: At) {
        let model = self.model;
        self.bear_set(order, of.with_node, &model.orders[order].end.relay, at);
    }

    /// Sets of equal axes: in each set with any the first leads.
    fn bear_set(&mut self, order: usize, sets: f64, branching: &Branching, at: At) {
        let chance = branching.chance.table.probability(at);
        let mean = branching.count.table.mean(at) * chance;
        let mut none_of_so_many = 1.0;
        let mut none = 0.0;
        for share in branching.count.table.pmf(at) {
            none += share * none_of_so_many;
            none_of_so_many *= 1.0 - chance;
        }
        let leaders = (1.0 - none).clamp(0.0, mean);
        self.bear_class(order, sets * leaders, branching, 0, at);
        self.bear_class(order, sets * (mean - leaders), branching, 1, at);
    }

    /// New axes, after their delay.
    fn bear(&mut self, order: usize, axes: f64, branching: &Branching, at: At) {
        self.bear_class(order, axes, branching, 0, at);
    }

    /// The same, of axes that lead their sets (0) or do not (1).
    fn bear_class(&mut self, order: usize, axes: f64, branching: &Branching, follows: usize, at: At) {
        self.bear_in((branching.state.unwrap_or(at.state), follows), order, axes, branching, at);
    }

    /// The same, of axes of a given state.
    fn bear_in(&mut self, (state, follows): (u8, usize), order: usize, axes: f64, branching: &Branching, at: At) {
        if axes <= 0.0 || order >= self.births.len() {
            return;
        }
        self.expected[order].axes[at.age as usize] += axes;
        let class = 2 * usize::from(state) + follows;
        for (delay, share) in branching.delay.table.pmf(at).into_iter().enumerate() {
            if let Some(births) = self.births[order][class].get_mut(at.age as usize + delay) {
                *births += axes * share;
            }
        }
    }
}

/// The means of a growth unit in each state, summed once, where they depend on nothing else.
fn timeless_units(model: &BudModel, laws: &OrderLaws) -> Option<Rc<[Unit]>> {
    let in_state = |state: usize| Unit::at(model, laws, At { state: state as u8, ..At::default() });
    is_timeless(laws).then(|| (0..model.states).map(in_state).collect())
}

fn is_timeless(laws: &OrderLaws) -> bool {
    let (step, node) = (&laws.step, &laws.node);
    let chances = [&step.short, &node.flower_opens, &node.fruit_set, &node.axillary.chance, &node.reiteration.chance];
    let mut zones = node.zones.iter();
    let counts = [
        &step.long_nodes,
        &step.short_nodes,
        &step.neoformed,
        &node.leaves,
        &node.flowers,
        &node.axillary.count,
        &node.reiteration.count,
    ];
    chances.iter().all(|chance| chance.table.is_timeless())
        && counts.iter().all(|count| count.table.is_timeless())
        && step.zone_ranks.are_timeless()
        && zones.all(Zones::are_timeless)
}

/// When apices end by having made all their growth units: the number is drawn once an axis.
struct Completion {
    /// The probability that an apex ends with its next growth unit, by growth units made; empty: never.
    hazards: Vec<f64>,
}

impl Completion {
    fn of(laws: &OrderLaws, at: At) -> Self {
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

    fn stages(&self) -> usize {
        self.hazards.len().max(1)
    }

    fn hazard(&self, made: usize) -> f64 {
        self.hazards.get(made).copied().unwrap_or(0.0)
    }

    fn next(&self, made: usize) -> usize {
        (made + 1).min(self.stages() - 1)
    }
}
