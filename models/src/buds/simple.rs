//! Axes of which each step draws but few words: one step a tick, a unit of a number of nodes that is not drawn, and
//! death and pause by the age of the plant or the steps of the axis at most.
//!
//! Most orders of most species have such steps, and most steps make one node; so what a step takes beside its nodes is
//! kept small here. The steps are those of [`Axis::grow`](super::grow::Axis::grow), test for test.

use super::bud::ApicalBud;
use super::compile::{BudModel, Piece, SimpleSteps};
use super::grow::Full;
use super::plain::{Alike, Way};
use super::plan::Plan;
use super::record::Words;
use super::together::AtHand;
use crate::law::At;
use phytomer_sim::clock::Tick;
use phytomer_sim::plant::{Event, EventKind, LineageKey, Plant};

/// Why an axis stops before its next step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stop {
    /// It is at the age to which it grows.
    AtAge,
    /// The record of its next step is not at hand.
    NoRecord,
    /// Its apex dies at this step.
    Dies,
    /// Its growth unit fills the block.
    Fills,
    /// Its apex has made its last growth unit.
    Completes,
}

/// What guides an axis beside its bud.
#[derive(Clone, Copy)]
struct Guide {
    birth: Tick,
    key: LineageKey,
    /// The height of the plant, in the steps in which laws know it.
    height: u32,
}

impl BudModel {
    /// Grows one axis; the records of its first steps stand at the place `ahead` of those that were read ahead.
    #[inline]
    pub(super) fn grow_simply(
        &self,
        plant: &mut Plant,
        words: &mut Words,
        (of, simple, height): (&Alike<'_>, &SimpleSteps, u32),
        mut bud: ApicalBud,
        ahead: usize,
    ) -> Result<(), Full> {
        let axis = bud.axis.index();
        let guide = Guide { birth: plant.axes.birth[axis], key: plant.axes.key[axis], height };
        let mut ahead = Some(ahead);
        loop {
            let (records, plan) = words.at_hand(ahead);
            let stop = of.walk(simple, &mut bud, guide, &records, (plan, plant.events.as_mut()));
            if stop == Stop::AtAge {
                break;
            }
            if !self.go_past(stop, plant, words, (of, simple, height), &mut bud, &mut ahead)? {
                return Ok(());
            }
        }
        bud.age = of.age;
        words.live_on(bud);
        Ok(())
    }

    /// Goes past what is rare. Whether the apex lives.
    #[inline(never)]
    fn go_past(
        &self,
        stop: Stop,
        plant: &mut Plant,
        words: &mut Words,
        (of, simple, height): (&Alike<'_>, &SimpleSteps, u32),
        bud: &mut ApicalBud,
        ahead: &mut Option<usize>,
    ) -> Result<bool, Full> {
        let way = Way::begin(plant, *bud, height);
        match stop {
            Stop::AtAge => Ok(true),
            Stop::NoRecord => {
                let steps = (bud.cycle, of.age.saturating_sub(way.birth).saturating_sub(bud.cycle));
                words.read_on(of.laws, &plant.random, way.key, steps, ahead.take().is_some());
                Ok(true)
            }
            Stop::Dies => self.axis_at(plant, words, &way).die(way.at),
            Stop::Completes => self.complete(plant, words, &way).map(|()| false),
            Stop::Fills => {
                let mut axis = self.axis_at(plant, words, &way);
                axis.plan_unit(way.at, false, [simple.nodes, 0])?;
                axis.note(EventKind::Grew, simple.nodes);
                *bud = ApicalBud { units: bud.units + 1, birth: bud.age, age: bud.age, cycle: bud.cycle, ..axis.bud };
                if bud.units >= of.last_unit {
                    let way = Way::begin(plant, *bud, height);
                    return self.complete(plant, words, &way).map(|()| false);
                }
                Ok(true)
            }
        }
    }
}

impl Alike<'_> {
    /// Lets an axis go through steps whose records are at hand.
    #[inline]
    fn walk(
        &self,
        simple: &SimpleSteps,
        bud: &mut ApicalBud,
        guide: Guide,
        records: &AtHand<'_>,
        (plan, events): (&mut Plan, Option<&mut Vec<Event>>),
    ) -> Stop {
        let due = self.age.saturating_sub(guide.birth);
        let before = bud.cycle.wrapping_sub(records.first);
        if bud.cycle >= due {
            return Stop::AtAge;
        }
        if before >= records.number {
            return Stop::NoRecord;
        }
        let steps = (due - bud.cycle).min(records.number - before);
        let words = &records.words[before as usize * self.laws.step.width..];
        let mut going = Going { of: self, simple, bud, guide, plan, events };
        let stop = if steps == 1 { going.one(words) } else { going.many(words, steps) };
        match stop {
            Some(stop) => stop,
            None if going.bud.cycle < due => Stop::NoRecord,
            None => Stop::AtAge,
        }
    }
}

/// An axis while it goes through steps whose records are at hand.
struct Going<'a, 'b> {
    of: &'a Alike<'b>,
    simple: &'a SimpleSteps,
    bud: &'a mut ApicalBud,
    guide: Guide,
    plan: &'a mut Plan,
    events: Option<&'a mut Vec<Event>>,
}

impl Going<'_, '_> {
    /// One step: most axes that grow by the clock make no more.
    #[inline(never)]
    fn one(&mut self, words: &[u32]) -> Option<Stop> {
        self.step(words)
    }

    #[inline(never)]
    fn many(&mut self, words: &[u32], steps: u32) -> Option<Stop> {
        let width = self.of.laws.step.width;
        (0..steps as usize).find_map(|step| self.step(&words[step * width..]))
    }

    /// Goes through a step with its record. Why the axis stops there, if it does.
    #[inline(always)]
    fn step(&mut self, words: &[u32]) -> Option<Stop> {
        let Self { of, simple, bud, guide, plan, .. } = self;
        let birth = guide.birth;
        bud.cycle += 1;
        bud.age = birth + bud.cycle;
        if simple.death.happens(words, birth, bud.cycle) {
            return Some(Stop::Dies);
        }
        if simple.pause.happens(words, birth, bud.cycle) {
            self.note(EventKind::Paused, 1);
            return None;
        }
        let nodes = simple.nodes;
        if plan.nodes + nodes >= of.laws.node.block {
            return Some(Stop::Fills);
        }
        if nodes > 0 {
            plan.add(guide.piece(bud, (nodes, plan.nodes)), bud, guide.key);
        }
        // The growth unit has a new bud at its tip.
        bud.units += 1;
        bud.birth = bud.age;
        self.note(EventKind::Grew, nodes);
        (self.bud.units >= self.of.last_unit).then_some(Stop::Completes)
    }

    /// Writes down what the bud did.
    #[inline(always)]
    fn note(&mut self, kind: EventKind, count: u32) {
        let Self { bud, plan, events, .. } = self;
        if let Some(events) = events {
            let event = Event { tick: bud.age, axis: bud.axis, kind, count, state: bud.state };
            if plan.is_empty() { events.push(event) } else { plan.events.push((plan.nodes, event)) }
        }
    }
}

impl Guide {
    /// The growth unit of a bud, of so many nodes from the place `first` of the block on.
    #[inline(always)]
    fn piece(&self, bud: &ApicalBud, (nodes, first): (u32, u32)) -> Piece {
        let ApicalBud { age, cycle, units: unit, birth: bud_birth, state, .. } = *bud;
        let (bud_dimension, height) = (bud_birth.saturating_sub(self.birth), self.height);
        let (rank, contact, shade) = (0, 0, 0);
        let at =
            At { age, dimension: cycle, cycle, rank, bud_birth, bud_dimension, unit, height, contact, shade, state };
        Piece::of_unit(at, false, nodes, first)
    }
}
