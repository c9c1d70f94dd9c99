//! Cohorts: the axes of one order and one speed, born at one tick in one state, followed step by step as shares.
//!
//! The shares of a cohort die, rest, end or grow by the same compiled laws as a bud; the axes that they bear are added
//! to cohorts of later ticks. Absent: the deaths of branches, which end no growth (`lost` has their effect on organs).

use super::asked::{Asked, Key};
use super::frame::{Completion, Frame};
use super::unit::{Lateral, Unit};
use crate::buds::compile::{Branching, BudModel, OrderLaws};
use crate::buds::params::ApexEnd;
use crate::law::At;
use phytomer_sim::Tick;
use phytomer_sim::clock::Speed;
use phytomer_sim::expectation::OrderExpectation;
use std::collections::BTreeMap;
use std::rc::Rc;

/// The most steps of summation: a second or so.
const MOST_WORK: u64 = 40_000_000;

/// What a clock step of a cohort costs beside the work on its cells, in steps of summation: its lists, and the chances
/// of all its laws.
const WORK_OF_STEP: u64 = 6;

/// The most growth units whose sums are kept for each order.
const MOST_UNITS: usize = 50_000;

/// A cohort with fewer living axes than this bears nothing that would show in the sum, in double precision.
pub const NOTHING_LEFT: f64 = 1e-30;

/// Axes born, by order, class and tick. The class is 2 × state, plus 1 for axes that do not lead their sets.
pub type Births = Vec<Vec<Vec<f64>>>;

/// A share of a cohort.
#[derive(Debug, Clone, Copy, Default)]
struct Flow {
    /// Living apices.
    apices: f64,
    /// Dormant axillary buds on the last nodes of their axes.
    dormant: f64,
}

impl Flow {
    fn share(self, share: f64) -> Self {
        Self { apices: self.apices * share, dormant: self.dormant * share }
    }

    fn add(&mut self, other: Self) {
        self.apices += other.apices;
        self.dormant += other.dormant;
    }
}

/// The cohort that is being followed.
struct Cohort<'a> {
    order: usize,
    laws: &'a OrderLaws,
    frame: Frame,
    ends: Completion,
    /// Whether its axes lead their sets of relays.
    leads: bool,
}

/// The sum over all cohorts.
pub struct Cohorts<'a> {
    model: &'a BudModel,
    until: Tick,
    /// The axes born so far.
    pub births: Births,
    /// The components made so far, at each tick.
    pub expected: Vec<OrderExpectation>,
    /// The growth units summed so far, by order and by the variables that units of the order depend on.
    units: Vec<(Asked, BTreeMap<Key, Rc<Unit>>)>,
    work: u64,
}

impl<'a> Cohorts<'a> {
    /// Sums what one axis of `order` and all axes that it bears make; `None` where the sum would take too long.
    ///
    /// A cohort bears only after its own birth, so cohorts are followed in the order of their ticks of birth.
    pub fn from(model: &'a BudModel, order: u8, until: Tick) -> Option<Self> {
        let ticks = vec![0.0; until as usize + 1];
        let mut sum = Self {
            model,
            until,
            births: vec![vec![ticks; 2 * model.states]; model.orders.len()],
            expected: vec![OrderExpectation::zero(until); model.orders.len()],
            units: model.orders.iter().map(|laws| (Asked::by_units_of(laws), BTreeMap::new())).collect(),
            work: 0,
        };
        let first = usize::from(order) - 1;
        sum.births[first][0][0] = 1.0;
        sum.expected[first].axes[0] = 1.0;
        for birth in 0..=until {
            sum.follow_born_at(birth)?;
        }
        Some(sum)
    }

    fn follow_born_at(&mut self, birth: Tick) -> Option<()> {
        let model = self.model;
        for order in 0..model.orders.len() {
            for class in 0..2 * model.states {
                let born = self.births[order][class][birth as usize];
                for (speed, share) in model.orders[order].head.speed.shares().filter(|_| born > 0.0) {
                    self.follow((order, speed), class, birth, born * share)?;
                }
            }
        }
        Some(())
    }

    /// One cohort, of the axes that drew one speed, from its birth to the last age.
    fn follow(&mut self, (order, speed): (usize, Speed), class: usize, birth: Tick, born: f64) -> Option<()> {
        let laws = &self.model.orders[order];
        let state = (class / 2) as u8;
        let ends = Completion::of(laws, At { age: birth, state, ..At::default() });
        let frame = Frame::of(laws, self.model.states, &ends);
        let cohort = Cohort { order, laws, frame, ends, leads: class.is_multiple_of(2) };
        let mut living = vec![Flow::default(); frame.cells()];
        let mut after = living.clone();
        living[frame.cell(0, 0, state)].apices = born;
        let mut cycle = 0;
        // The cost of looking through the cells, in addition to the work on cells that are not empty.
        let cells = frame.cells() as u64 / 16;
        for tick in birth + 1..=self.until {
            let dimension = tick - birth;
            while cycle < speed.steps_by(dimension) {
                cycle += 1;
                let at = At { age: tick, dimension, cycle, ..At::default() };
                self.step(&cohort, &living, &mut after, at);
                self.work += WORK_OF_STEP + cells;
                std::mem::swap(&mut living, &mut after);
                if self.work > MOST_WORK {
                    return None;
                }
                if living.iter().all(|flow| flow.apices < NOTHING_LEFT) {
                    return Some(());
                }
            }
        }
        Some(())
    }

    /// One clock step of a cohort; `after` becomes the share that still lives.
    fn step(&mut self, cohort: &Cohort, living: &[Flow], after: &mut [Flow], at: At) {
        after.fill(Flow::default());
        let frame = cohort.frame;
        let mut growing = vec![Flow::default(); frame.ranks];
        for state in 0..frame.states as u8 {
            let at = At { state, ..at };
            let cells = |made: usize| (0..frame.ranks).map(move |rank| (rank, frame.cell(made, rank, state)));
            let is_empty = |made: &usize| cells(*made).all(|(_, cell)| living[cell].apices <= 0.0);
            let mut unit = None;
            for made in (0..frame.stages).filter(|made| !is_empty(made)) {
                for (rank, cell) in cells(made) {
                    growing[rank] = self.fates(cohort, living[cell], rank, &mut after[cell], at);
                }
                let unit = unit.get_or_insert_with(|| self.unit_at(cohort, at));
                self.work += 1;
                self.grow(cohort, &mut growing, made, unit, after, at);
            }
        }
    }

    fn unit_at(&mut self, cohort: &Cohort, at: At) -> Rc<Unit> {
        let (asked, units) = &mut self.units[cohort.order];
        let (model, until, work) = (self.model, self.until, &mut self.work);
        if units.len() > MOST_UNITS {
            units.clear();
        }
        let sum = || {
            let unit = Unit::at(model, cohort.laws, at, until);
            *work += unit.work;
            Rc::new(unit)
        };
        Rc::clone(units.entry(asked.key(at)).or_insert_with(sum))
    }

    /// Applies death, pause and terminal flower; returns the share that grows.
    fn fates(&mut self, cohort: &Cohort, flow: Flow, rank: usize, resting: &mut Flow, at: At) -> Flow {
        if flow.apices <= 0.0 {
            return flow;
        }
        let laws = &cohort.laws.step;
        let death = laws.death.probability(at);
        let pause = laws.pause.probability(at);
        let flower = laws.flower.probability(at);
        self.end(cohort, (rank, flow.share(death)), ApexEnd::Death, at);
        let alive = flow.share(1.0 - death);
        resting.add(alive.share(pause));
        let active = alive.share(1.0 - pause);
        let flowering = active.share(flower);
        if rank > 0 {
            self.terminal_flowers(cohort, flowering.apices, at);
        }
        self.end(cohort, (rank, flowering), ApexEnd::Flower, at);
        active.share(1.0 - flower)
    }

    /// Adds the flowers that apices have become, and their fruits.
    fn terminal_flowers(&mut self, cohort: &Cohort, flowers: f64, at: At) {
        let laws = &cohort.laws.node;
        let fruits = flowers * laws.fruit_set.probability(at);
        let organs = &mut self.expected[cohort.order].organs;
        organs[at.age as usize] += flowers;
        if fruits > 0.0 {
            for (life, share) in laws.flower_life.table.pmf(at).into_iter().enumerate() {
                if let Some(organs) = organs.get_mut(at.age as usize + life.max(1)) {
                    *organs += fruits * share;
                }
            }
        }
    }

    /// Makes the growth units of a step, one after another, then the passages between states. `growing` is indexed by
    /// the number of nodes.
    fn grow(&mut self, cohort: &Cohort, growing: &mut [Flow], made: usize, unit: &Unit, after: &mut [Flow], at: At) {
        let per_step = cohort.laws.step.per_step.table.pmf(at);
        let mut at_least: f64 = per_step.iter().sum();
        let mut stage = made;
        for (units, &exactly) in per_step.iter().enumerate() {
            if units > 0 {
                self.unit(cohort, growing.iter().map(|flow| flow.apices).sum::<f64>() * at_least, unit, at);
                grown(&cohort.frame, growing, unit);
                self.complete(cohort, growing, (stage, at_least), at);
                stage = cohort.ends.next(stage);
            }
            for (rank, flow) in growing.iter().enumerate().filter(|(_, flow)| flow.apices * exactly > 0.0) {
                self.pass(cohort, (stage, rank), flow.share(exactly), after, at);
            }
            at_least -= exactly;
        }
    }

    /// Ends the apices that have made all their growth units.
    fn complete(&mut self, cohort: &Cohort, growing: &mut [Flow], (stage, share): (usize, f64), at: At) {
        let completed = cohort.ends.hazard(stage);
        for (rank, flow) in growing.iter_mut().enumerate().filter(|_| completed > 0.0) {
            self.end(cohort, (rank, flow.share(share * completed)), ApexEnd::Completed, at);
            *flow = flow.share(1.0 - completed);
        }
    }

    /// Adds the components that `apices` growth units make.
    fn unit(&mut self, cohort: &Cohort, apices: f64, unit: &Unit, at: At) {
        if apices <= 0.0 {
            return;
        }
        let expected = &mut self.expected[cohort.order];
        let age = at.age as usize;
        expected.units[age] += apices;
        expected.nodes[age] += apices * unit.nodes;
        for &(ticks, organs) in &unit.organs {
            if let Some(by) = expected.organs.get_mut(age + ticks as usize) {
                *by += apices * organs;
            }
        }
        let node = &cohort.laws.node;
        let mut bear = |laterals: &[Lateral], order: usize, branching: &Branching| {
            for &Lateral { state, rank, axes } in laterals {
                let state = state.or(branching.state).unwrap_or(at.state);
                self.bear((order, state, 0), apices * axes, branching, At { rank, ..at });
            }
        };
        bear(&unit.laterals, cohort.order + 1, &node.axillary);
        bear(&unit.reiterations, usize::from(node.reiteration_order) - 1, &node.reiteration);
    }

    /// Passages between states: an axis makes the first passage that happens, in the order in which they are stated.
    fn pass(&mut self, cohort: &Cohort, (stage, rank): (usize, usize), flow: Flow, after: &mut [Flow], at: At) {
        let mut stays = flow;
        let passages = cohort.laws.step.transitions.iter();
        for passage in passages.filter(|passage| passage.concerns(at.state, cohort.leads)) {
            let passes = passage.chance.probability(at);
            let passing = stays.share(passes);
            if passage.relayed {
                self.relay(cohort, (rank, passing), at);
            }
            after[cohort.frame.cell(stage, rank, passage.to)].add(passing);
            stays = stays.share(1.0 - passes);
        }
        after[cohort.frame.cell(stage, rank, at.state)].add(stays);
    }

    /// Adds the relays of ended apices, and traumatic reiterations where they died.
    fn end(&mut self, cohort: &Cohort, (rank, ended): (usize, Flow), end: ApexEnd, at: At) {
        let laws = &cohort.laws.end;
        if ended.apices <= 0.0 || rank == 0 {
            return;
        }
        if laws.is_relayed(end) {
            self.relay(cohort, (rank, ended), at);
        }
        if end == ApexEnd::Death {
            let released = ended.dormant * laws.traumatic.chance.probability(at);
            let state = laws.traumatic.state.unwrap_or(at.state);
            self.bear((cohort.order, state, 0), released, &laws.traumatic, at);
        }
        if let Some(fork) = laws.fork.as_ref().filter(|_| end == ApexEnd::Completed) {
            self.bear_set(cohort.order, ended.apices, fork, at);
        }
    }

    /// Adds the relays of apices that have ended or passed into another state.
    fn relay(&mut self, cohort: &Cohort, (rank, of): (usize, Flow), at: At) {
        let sets = of.apices * cohort.frame.reaches(cohort.laws, rank, at);
        self.bear_set(cohort.order, sets, &cohort.laws.end.relay, at);
    }

    /// Adds sets of equal axes. The first axis of a set leads it.
    fn bear_set(&mut self, order: usize, sets: f64, branching: &Branching, at: At) {
        let chance = branching.chance.probability(at);
        let mean = branching.count.table.mean(at) * chance;
        let mut none_of_so_many = 1.0;
        let mut none = 0.0;
        for share in branching.count.table.pmf(at) {
            none += share * none_of_so_many;
            none_of_so_many *= 1.0 - chance;
        }
        let leaders = (1.0 - none).clamp(0.0, mean);
        let state = branching.state.unwrap_or(at.state);
        self.bear((order, state, 0), sets * leaders, branching, at);
        self.bear((order, state, 1), sets * (mean - leaders), branching, at);
    }

    /// New axes of an order and a state, after their delay, that lead their sets (0) or do not (1).
    fn bear(&mut self, (order, state, follows): (usize, u8, usize), axes: f64, branching: &Branching, at: At) {
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

/// Updates shares after a growth unit: axes have more nodes, and other buds lie dormant on the last of them.
fn grown(frame: &Frame, growing: &mut [Flow], unit: &Unit) {
    let empty = unit.counts[0];
    for rank in (0..growing.len()).rev() {
        let before = std::mem::take(&mut growing[rank]);
        if before.apices <= 0.0 {
            continue;
        }
        growing[rank].add(before.share(empty));
        for (more, &share) in unit.counts.iter().enumerate().skip(1).filter(|(_, share)| **share > 0.0) {
            // Dormant buds are shared out over the numbers of nodes: the death that releases them does not depend on
            // these numbers.
            let dormant = before.apices * unit.dormant * share / (1.0 - empty);
            growing[frame.after(rank, more)].add(Flow { apices: before.apices * share, dormant });
        }
    }
}
