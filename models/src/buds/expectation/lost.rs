//! Organs that never appear because their branch dies before.
//!
//! A flower opens after its delay and a fruit after its flower, unless every bud of the branch is dead by then. So for
//! each axis and each deadline T two numbers are followed: the probability w that the apex lives and that all that it
//! has borne will be dead by T, and the mean number m of the organs due at T that it has made, on that event. An end of
//! the apex at or before T turns w into the probability that the branch is dead by T, and m into organs that are lost.
//! What an axis bears is independent of its fate after that, so w and m are multiplied by the probability that it is
//! dead by T, which cohorts that are born later have told before: cohorts are taken from the last birth to the first.
//!
//! Absent: released dormant buds and drawn zones, whose branches are not independent of one another (`needs`).

use super::cohort::{Births, NOTHING_LEFT};
use super::frame::{Completion, Frame};
use super::gone::{Gone, Made, MadeUnit};
use super::needs::Needs;
use super::unit::longest_wait;
use crate::buds::compile::{BudModel, OrderLaws};
use crate::buds::params::ApexEnd;
use crate::law::At;
use phytomer_sim::Tick;
use phytomer_sim::clock::Speed;

/// The most steps of summation: some hundredths of a second.
const MOST_WORK: u64 = 30_000_000;

/// Axes that live in one state, by deadline.
#[derive(Debug, Clone, Default)]
struct Carried {
    /// The share of the axes, whether or not the axes on them live; 0 where the cell is empty.
    share: f64,
    /// w: the share of the axes on which all axes will be dead by the deadline.
    alone: Vec<f64>,
    /// m: organs due at the deadline on these axes.
    due: Vec<f64>,
}

/// The end of the axes of one birth, by deadline: the probability that the branch is dead, and the organs lost.
struct Ended {
    gone: Vec<f64>,
    lost: Vec<f64>,
}

/// The cohort that is being followed.
struct Cohort<'a> {
    order: usize,
    laws: &'a OrderLaws,
    frame: Frame,
    ends: Completion,
    leads: bool,
    until: Tick,
    /// The last deadline for which organs made by now are due.
    longest: Tick,
}

/// The mean numbers of organs that never appear, by order and by the tick at which they were due; `None` where they
/// have no closed form or the sum would take too long.
pub fn organs(model: &BudModel, births: &Births, until: Tick) -> Option<Vec<Vec<f64>>> {
    let needs = Needs::of(model, births)?;
    let mut lost = vec![vec![0.0; until as usize + 1]; model.orders.len()];
    let mut gone = Gone::new(model, until);
    for birth in (0..until).rev() {
        for &(order, state) in &needs.starts {
            for follows in 0..2 {
                let born = births[order][2 * usize::from(state) + follows][birth as usize];
                if born > 0.0 {
                    let ended = follow_all(model, &mut gone, (order, state, follows), birth)?;
                    // No organ of an axis is lost before the birth of the axis.
                    let ticks = lost[order][birth as usize..].iter_mut().zip(&ended.lost[birth as usize..]);
                    ticks.for_each(|(sum, lost)| *sum += born * lost);
                    gone.tell((order, state, follows), birth, &ended.gone);
                }
            }
        }
    }
    Some(lost)
}

/// Follows the axes that are born alike at one tick, over the speeds that they draw; `None` where the sum takes too
/// long.
fn follow_all(
    model: &BudModel,
    gone: &mut Gone,
    (order, state, follows): (usize, u8, usize),
    birth: Tick,
) -> Option<Ended> {
    let laws = &model.orders[order];
    let until = gone.until();
    let ends = Completion::of(laws, At { age: birth, state, ..At::default() });
    let frame = Frame::of(laws, model.states, &ends);
    let longest = longest_wait(&laws.node);
    let cohort = Cohort { order, laws, frame, ends, leads: follows == 0, until, longest };
    let nothing = vec![0.0; until as usize + 1];
    let mut ended = Ended { gone: nothing.clone(), lost: nothing };
    for (speed, share) in laws.head.speed.shares().filter(|(_, share)| *share > 0.0) {
        cohort.follow(gone, (state, birth), (speed, share), &mut ended);
        if gone.work > MOST_WORK {
            return None;
        }
    }
    Some(ended)
}

impl Cohort<'_> {
    fn follow(&self, gone: &mut Gone, (state, birth): (u8, Tick), (speed, share): (Speed, f64), ended: &mut Ended) {
        let all = self.until as usize + 1;
        let mut living = vec![Carried::default(); self.frame.cells()];
        living[self.frame.cell(0, 0, state)] = Carried { share, alone: vec![share; all], due: vec![0.0; all] };
        let mut cycle = 0;
        for tick in birth + 1..=self.until {
            let dimension = tick - birth;
            while cycle < speed.steps_by(dimension) {
                cycle += 1;
                let mut after = vec![Carried::default(); self.frame.cells()];
                self.step(gone, &living, &mut after, ended, At { age: tick, dimension, cycle, ..At::default() });
                living = after;
                gone.work += self.frame.cells() as u64 / 4 + self.column_work();
                if gone.work > MOST_WORK || living.iter().all(|carried| carried.share < NOTHING_LEFT) {
                    return;
                }
            }
        }
    }

    /// The cost of the new columns of a step: memory that the system gives filled with zeros is far cheaper than sums
    /// over deadlines, but not free, and a long run has many steps.
    fn column_work(&self) -> u64 {
        u64::from(self.until) / 32
    }

    /// One clock step of a cohort; `after` becomes the share that still lives.
    fn step(&self, gone: &mut Gone, living: &[Carried], after: &mut [Carried], ended: &mut Ended, at: At) {
        let frame = self.frame;
        for state in 0..frame.states as u8 {
            let at = At { state, ..at };
            let cells = |made: usize| (0..frame.ranks).map(move |rank| (rank, frame.cell(made, rank, state)));
            let is_empty = |made: &usize| cells(*made).all(|(_, cell)| living[cell].share < NOTHING_LEFT);
            let mut unit = None;
            for made in (0..frame.stages).filter(|made| !is_empty(made)) {
                let mut growing = vec![Carried::default(); frame.ranks];
                for (rank, cell) in cells(made).filter(|(_, cell)| living[*cell].share >= NOTHING_LEFT) {
                    growing[rank] = self.fates(gone, &living[cell], rank, &mut after[cell], ended, at);
                }
                let unit: &MadeUnit = unit.get_or_insert_with(|| gone.unit(self.order, at));
                self.grow(gone, growing, (made, unit), after, ended, at);
            }
        }
    }

    /// Applies death, pause and terminal flower; returns the share that grows.
    fn fates(
        &self,
        gone: &mut Gone,
        of: &Carried,
        rank: usize,
        resting: &mut Carried,
        ended: &mut Ended,
        at: At,
    ) -> Carried {
        let laws = &self.laws.step;
        let death = laws.death.probability(at);
        let pause = laws.pause.probability(at);
        let flower = laws.flower.probability(at);
        self.end(gone, (rank, of, death), ApexEnd::Death, ended, at);
        self.add(resting, of, (1.0 - death) * pause, None, at);
        let active = (1.0 - death) * (1.0 - pause);
        self.end(gone, (rank, of, active * flower), ApexEnd::Flower, ended, at);
        let mut growing = Carried::default();
        self.add(&mut growing, of, active * (1.0 - flower), None, at);
        growing
    }

    /// Makes the growth units of a step, one after another, then the passages between states.
    fn grow(
        &self,
        gone: &mut Gone,
        mut growing: Vec<Carried>,
        (made, unit): (usize, &MadeUnit),
        after: &mut [Carried],
        ended: &mut Ended,
        at: At,
    ) {
        let per_step = self.laws.step.per_step.table.pmf(at);
        let mut at_least: f64 = per_step.iter().sum();
        let mut stage = made;
        for (units, &exactly) in per_step.iter().enumerate() {
            if units > 0 {
                growing = self.grown(gone, &growing, unit, at);
                let completed = self.ends.hazard(stage);
                for (rank, of) in growing.iter_mut().enumerate().filter(|_| completed > 0.0) {
                    self.end(gone, (rank, of, at_least * completed), ApexEnd::Completed, ended, at);
                    of.scale(1.0 - completed);
                }
                stage = self.ends.next(stage);
            }
            for (rank, of) in growing.iter().enumerate().filter(|(_, of)| of.share * exactly > 0.0) {
                self.pass(gone, (stage, rank), (of, exactly), after, at);
            }
            at_least -= exactly;
        }
    }

    /// The shares after a growth unit: axes have more nodes, and other organs are due on them.
    fn grown(&self, gone: &mut Gone, growing: &[Carried], unit: &MadeUnit, at: At) -> Vec<Carried> {
        let mut after = vec![Carried::default(); growing.len()];
        let (now, until) = (at.age as usize, self.until as usize);
        let due_by = self.last_due(at);
        for (rank, of) in growing.iter().enumerate().filter(|(_, of)| of.share > 0.0) {
            for (more, made) in unit.by_nodes.iter().enumerate().filter(|(_, made)| made.share > 0.0) {
                let into = &mut after[self.frame.after(rank, more)];
                self.add_made(into, of, made, at);
                for deadline in now..=due_by.min(now + made.due.len().saturating_sub(1)) {
                    into.due[deadline] += of.alone[deadline] * made.due[deadline - now];
                }
                gone.work += (until - now) as u64;
            }
        }
        after
    }

    /// Passages between states: an axis makes the first passage that happens, in the order in which they are stated.
    fn pass(
        &self,
        gone: &mut Gone,
        (stage, rank): (usize, usize),
        (of, share): (&Carried, f64),
        after: &mut [Carried],
        at: At,
    ) {
        let mut stays = share;
        let passages = self.laws.step.transitions.iter();
        for passage in passages.filter(|passage| passage.concerns(at.state, self.leads)) {
            let passes = stays * passage.chance.probability(at);
            let relays = if passage.relayed && passes > 0.0 { self.relays(gone, rank, at) } else { None };
            self.add(&mut after[self.frame.cell(stage, rank, passage.to)], of, passes, relays.as_deref(), at);
            stays -= passes;
        }
        self.add(&mut after[self.frame.cell(stage, rank, at.state)], of, stays, None, at);
    }

    /// Ends a share of apices: their branches are dead once all axes that follow the end are dead.
    fn end(&self, gone: &mut Gone, (rank, of, share): (usize, &Carried, f64), end: ApexEnd, ended: &mut Ended, at: At) {
        if of.share * share <= 0.0 {
            return;
        }
        let laws = &self.laws.end;
        let has_node = rank > 0;
        let follows = [
            if laws.is_relayed(end) { self.relays(gone, rank, at) } else { None },
            laws.fork
                .as_ref()
                .filter(|_| end == ApexEnd::Completed && has_node)
                .map(|fork| gone.of_set(self.order, fork, at)),
            if has_node { gone.of_apex(self.laws, end, at) } else { None },
        ];
        for deadline in at.age as usize..=self.until as usize {
            let dead = follows.iter().flatten().fold(share, |dead, by| dead * by[deadline]);
            ended.gone[deadline] += of.alone[deadline] * dead;
            ended.lost[deadline] += of.due[deadline] * dead;
        }
        gone.work += u64::from(self.until - at.age);
    }

    /// The probability, by deadline, that all relays of an axis of `rank` nodes are dead; `None`: it has no relays.
    fn relays(&self, gone: &mut Gone, rank: usize, at: At) -> Option<Vec<f64>> {
        let reaches = self.frame.reaches(self.laws, rank, at);
        (reaches > 0.0).then(|| {
            let mut dead = gone.of_set(self.order, &self.laws.end.relay, at);
            dead.iter_mut().for_each(|dead| *dead = 1.0 - reaches + reaches * *dead);
            dead
        })
    }

    /// Adds a share of axes, times the probability, by deadline, that the axes just borne are dead.
    fn add(&self, into: &mut Carried, of: &Carried, share: f64, dead: Option<&[f64]>, at: At) {
        if of.share * share <= 0.0 {
            return;
        }
        if into.alone.is_empty() {
            let all = self.until as usize + 1;
            (into.alone, into.due) = (vec![0.0; all], vec![0.0; all]);
        }
        into.share += of.share * share;
        let (now, due_by) = (at.age as usize, self.last_due(at));
        let of_deadline = |deadline: usize| share * dead.map_or(1.0, |dead| dead[deadline]);
        for deadline in now..=self.until as usize {
            into.alone[deadline] += of.alone[deadline] * of_deadline(deadline);
        }
        for deadline in now..=due_by {
            into.due[deadline] += of.due[deadline] * of_deadline(deadline);
        }
    }

    /// Adds axes that have made the growth unit `made`.
    fn add_made(&self, into: &mut Carried, of: &Carried, made: &Made, at: At) {
        let share = into.share;
        match &made.alone {
            Some(alone) => {
                self.add(into, of, 1.0, Some(alone), at);
                into.share = share + of.share * made.share;
            }
            None => self.add(into, of, made.share, None, at),
        }
    }

    /// The last deadline at which an organ made by now is due.
    fn last_due(&self, at: At) -> usize {
        at.age.saturating_add(self.longest).min(self.until) as usize
    }
}

impl Carried {
    fn scale(&mut self, share: f64) {
        self.share *= share;
        self.alone.iter_mut().chain(&mut self.due).for_each(|by| *by *= share);
    }
}
