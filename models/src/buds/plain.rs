//! Axes in the open, of an order whose steps are plain and make several nodes, that grow one after another: they go
//! through their steps without an [`Axis`] of each, by the words where they were made, and plan their nodes.
//!
//! The steps are those of [`Axis::grow`], test for test. An [`Axis`] is made for what is rare: the end of an apex,
//! and a growth unit that fills a block. Absent: how the nodes are made (`planned`), and axes that read words at
//! their birth, meet something, lack light or have pests.

use super::bud::ApicalBud;
use super::compile::{BudModel, OrderLaws, Piece, SimpleSteps, StepTests};
use super::grow::{Axis, Full};
use super::params::ApexEnd;
use super::plan::{Plan, Shoot};
use super::planned::make_last;
use super::record::Words;
use super::together::AtHand;
use crate::law::{At, height_in_steps};
use phytomer_sim::clock::{Speed, Tick};
use phytomer_sim::plant::{ApexFate, Event, EventKind, LineageKey, Plant};

/// What axes of one order have in common that grow to one age.
pub(super) struct Alike<'a> {
    pub laws: &'a OrderLaws,
    tests: StepTests<'a>,
    speed: Speed,
    /// The growth units after which an apex ends.
    pub last_unit: u32,
    pub age: Tick,
}

/// An axis while it goes through its steps.
pub(super) struct Way {
    /// Its bud before it grows, but for its last node where nodes have been made meanwhile.
    pub bud: ApicalBud,
    pub key: LineageKey,
    pub birth: Tick,
    /// Whether it is the first of its set of relays or forks, or belongs to no set.
    leads: bool,
    /// The point of its laws.
    pub at: At,
    /// The steps that are due by the tick at which it is.
    due: u32,
}

/// Why an axis stops before its next step.
enum Halt {
    /// It is at the age to which it grows.
    AtAge,
    /// The record of its next step is not at hand.
    NoRecord,
    /// Its apex dies at this step.
    Dies,
    /// Its apex has made its last growth unit.
    Completes,
    /// Its growth unit, long or short, of so many nodes fills the block. Behind the unit it is at the point `then`, and
    /// its apex may have made its last growth unit.
    Fills { short: bool, nodes: u32, then: At, completes: bool },
}

impl OrderLaws {
    /// Whether axes of the order go through their steps in [`BudModel::grow_plain`], where they stand in the open and
    /// in full light. Where no step makes more than one node they do not, unless the steps are simple: that gains
    /// nothing, as measured.
    pub(super) fn are_plain(&self) -> bool {
        let Self { head, step, node, light_alone, .. } = self;
        let is_known = !head.guides_growth && head.speed.only().is_some() && step.is_plain && step.width > 0;
        let responds = !step.spare.places().is_empty() || !node.spare.places().is_empty();
        let gains = node.most_nodes > 1 || self.simple.is_some();
        is_known && node.most_nodes > 0 && gains && (*light_alone || !responds)
    }

    /// The steps of the order in full light, where they are simple: one a tick, of a unit whose nodes are not drawn.
    pub(super) fn simple_steps(&self) -> Option<SimpleSteps> {
        let is_even = self.head.speed.only() == Some(Speed::ONE);
        is_even.then(|| self.step.simple()).flatten()
    }
}

impl BudModel {
    /// Whether axes of one order that grow from their buds go through their steps in [`Self::grow_plain`], where they
    /// stand in the open.
    #[inline]
    pub(super) fn grow_plainly(&self, plant: &Plant, buds: &[ApicalBud]) -> bool {
        let Some(first) = buds.first() else { return false };
        let laws = self.laws(plant.axes.order[first.axis.index()]);
        let is_lit = || !laws.asks_light || buds.iter().all(|bud| plant.shade.of(bud.axis) == 0);
        laws.is_plain && laws.node.block > 0 && plant.exposure.is_none() && is_lit()
    }

    /// Grows axes of one order, which [grow plainly](Self::grow_plainly), as [`Self::grow_alike`].
    pub(super) fn grow_plain(
        &self,
        plant: &mut Plant,
        buds: &[ApicalBud],
        age: Tick,
        words: &mut Words,
    ) -> Result<(), Full> {
        let Some(first) = buds.first() else { return Ok(()) };
        let laws = self.laws(plant.axes.order[first.axis.index()]);
        if !words.plan.goes_on(plant, laws.number) {
            make_last(self, plant, words)?;
        }
        let fixed_units = laws.head.units.as_ref().and_then(|units| units.fixed());
        let of = Alike {
            laws,
            tests: laws.step.tests(false),
            speed: laws.head.speed.only().unwrap_or(Speed::ONE),
            last_unit: fixed_units.unwrap_or(u32::MAX),
            age,
        };
        let height = if laws.asks_height { height_in_steps(f64::from(plant.height)) } else { 0 };
        words.shaded = false;
        let ahead = words.next_ahead();
        for (nth, bud) in buds.iter().enumerate() {
            match &laws.simple {
                Some(simple) => self.grow_simply(plant, words, (&of, simple, height), *bud, ahead + nth)?,
                None => self.grow_one(plant, words, &of, Way::begin(plant, *bud, height), ahead + nth)?,
            }
        }
        words.go_on_ahead_from(ahead + buds.len());
        Ok(())
    }

    /// Grows one axis; the records of its first steps stand at the place `ahead` of those that were read ahead.
    #[inline]
    fn grow_one(
        &self,
        plant: &mut Plant,
        words: &mut Words,
        of: &Alike<'_>,
        mut way: Way,
        ahead: usize,
    ) -> Result<(), Full> {
        let mut ahead = Some(ahead);
        loop {
            let halt = {
                let (records, plan) = words.at_hand(ahead);
                of.go(&mut way, &records, plan, plant.events.as_mut())
            };
            match halt {
                Halt::AtAge => break,
                Halt::NoRecord => {
                    let in_all = of.speed.steps_by(of.age.saturating_sub(way.birth));
                    let steps = (way.at.cycle, in_all.saturating_sub(way.at.cycle));
                    words.read_on(of.laws, &plant.random, way.key, steps, ahead.take().is_some());
                }
                Halt::Dies => return self.axis_at(plant, words, &way).die(way.at).map(|_| ()),
                Halt::Completes => return self.complete(plant, words, &way),
                Halt::Fills { short, nodes, then, completes } => {
                    let mut axis = self.axis_at(plant, words, &way);
                    axis.plan_unit(way.at, short, [nodes, 0])?;
                    axis.note(EventKind::Grew, nodes);
                    (way.bud, way.at) = (axis.bud, then);
                    if completes {
                        return self.complete(plant, words, &way);
                    }
                }
            }
        }
        words.live_on(ApicalBud { age: of.age, ..way.bud_now() });
        Ok(())
    }

    /// The axis on its way.
    pub(super) fn axis_at<'a>(&'a self, plant: &'a mut Plant, words: &'a mut Words, way: &Way) -> Axis<'a> {
        let mut axis = Axis::of(self, plant, words, way.bud_now());
        axis.set_tick(way.at.age);
        axis
    }

    /// Ends an apex that has made its last growth unit.
    pub(super) fn complete(&self, plant: &mut Plant, words: &mut Words, way: &Way) -> Result<(), Full> {
        let mut axis = self.axis_at(plant, words, way);
        axis.end(ApexFate::Completed, EventKind::Completed, ApexEnd::Completed).map(|_| ())
    }
}

impl Way {
    pub(super) fn begin(plant: &Plant, bud: ApicalBud, height: u32) -> Self {
        let place = bud.axis.index();
        let (birth, key, leads) = (plant.axes.birth[place], plant.axes.key[place], !plant.axes.follows[place]);
        let ApicalBud { age, cycle, units: unit, birth: bud_birth, state, .. } = bud;
        let (dimension, bud_dimension) = (age.saturating_sub(birth), bud_birth.saturating_sub(birth));
        let (rank, contact, shade) = (0, 0, 0);
        let at = At { age, dimension, cycle, rank, bud_birth, bud_dimension, unit, height, contact, shade, state };
        // What was due by its age has been made.
        Self { bud, key, birth, leads, at, due: cycle }
    }

    /// Its bud at the point at which it is.
    #[inline]
    fn bud_now(&self) -> ApicalBud {
        let At { cycle, unit: units, bud_birth: birth, state, .. } = self.at;
        ApicalBud { cycle, units, birth, state, ..self.bud }
    }
}

impl Alike<'_> {
    /// Lets an axis go through steps whose records are at hand.
    #[inline]
    fn go(&self, way: &mut Way, records: &AtHand<'_>, plan: &mut Plan, mut events: Option<&mut Vec<Event>>) -> Halt {
        let (step, width) = (&self.laws.step, self.laws.step.width);
        let Way { bud, key, birth, leads, at, due } = way;
        loop {
            if at.cycle >= *due {
                if at.age >= self.age {
                    return Halt::AtAge;
                }
                at.age += 1;
                at.dimension = at.age.saturating_sub(*birth);
                *due = self.speed.steps_by(at.dimension);
                continue;
            }
            let nth = at.cycle.wrapping_sub(records.first);
            if nth >= records.number {
                return Halt::NoRecord;
            }
            let words = &records.words[nth as usize * width..];
            at.cycle += 1;
            if self.tests.death.happens(words, at) {
                return Halt::Dies;
            }
            let mut note = |plan: &mut Plan, kind, count| {
                let Some(events) = &mut events else { return };
                let event = Event { tick: at.age, axis: bud.axis, kind, count, state: at.state };
                if plan.is_empty() { events.push(event) } else { plan.events.push((plan.nodes, event)) }
            };
            if self.tests.pause.happens(words, at) {
                note(plan, EventKind::Paused, 1);
                continue;
            }
            let short = self.tests.short.happens(words, at);
            let number = if short { &step.short_nodes } else { &step.long_nodes };
            let nodes = number.draw_at(words, at);
            let fills = plan.nodes + nodes >= self.laws.node.block;
            if nodes > 0 && !fills {
                plan.add(Piece::of_unit(*at, short, nodes, plan.nodes), bud, *key);
            }
            if !fills {
                note(plan, EventKind::Grew, nodes);
            }
            let before = fills.then_some(*at);
            // The growth unit has a new bud at its tip.
            at.unit += 1;
            (at.bud_birth, at.bud_dimension) = (at.age, at.dimension);
            let completes = at.unit >= self.last_unit;
            if !completes && !step.transitions.is_empty() {
                at.state = step.state_after(words, at, *leads);
            }
            if let Some(before) = before {
                let then = std::mem::replace(at, before);
                return Halt::Fills { short, nodes, then, completes };
            }
            if completes {
                return Halt::Completes;
            }
        }
    }
}

impl Plan {
    /// Whether nodes of an order in full light can be planned beside those that are planned.
    fn goes_on(&self, plant: &Plant, order: u8) -> bool {
        let (Some(shoot), Some(piece)) = (self.shoots.last(), self.pieces.last()) else { return true };
        plant.axes.order[shoot.bud.axis.index()] == order && piece.at.shade == 0
    }

    /// Adds nodes behind those that are planned, of the axis of a bud that has drawn neither zones nor trends.
    #[inline(always)]
    pub(super) fn add(&mut self, piece: Piece, bud: &ApicalBud, key: LineageKey) {
        self.nodes = piece.nodes.1;
        match self.shoots.last_mut() {
            Some(shoot) if shoot.bud.axis == bud.axis => shoot.nodes.1 = piece.nodes.1,
            _ => {
                let trends = self.trends.len() as u32;
                self.shoots.push(Shoot { bud: *bud, key, nodes: piece.nodes, trends: (trends, trends), living: None });
            }
        }
        let zones = self.zones.len() as u32;
        self.pieces.push(Piece { zones: (zones, zones), ..piece });
    }
}
