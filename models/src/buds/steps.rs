//! The clock steps of an axis in the open whose steps have at most one growth unit and no terminal flower: those of
//! most species.
//!
//! The steps are those of [`Axis::step`], test for test; here the laws that are the same at every point are looked up
//! once for axes of one order that follow one another, and the point of the laws is written in one place until the axis
//! is at its age. Absent: steps with several units, neoformed nodes, drawn zones, terminal flowers or relays between
//! them (`grow`).

use super::around::Lie;
use super::bud::ApicalBud;
use super::compile::{OrderLaws, Piece};
use super::grow::{Axis, Full};
use super::params::ApexEnd;
use super::record::Words;
use crate::law::At;
use phytomer_sim::clock::Tick;
use phytomer_sim::plant::{ApexFate, Event, EventKind};

impl Axis<'_> {
    /// Whether it goes through its steps by [`Self::take_plain_steps`].
    pub(super) fn takes_plain_steps(&self) -> bool {
        let OrderLaws { step, light_alone, .. } = self.laws;
        let reads_responses = !step.spare.places().is_empty() && (self.words.shaded || !light_alone);
        step.is_plain && !reads_responses && self.begins_free() && self.plant.exposure.is_none()
    }

    /// Goes through the steps up to the tick `last`, `in_all` of them since its birth. Whether the apex lives.
    pub(super) fn take_plain_steps(&mut self, last: Tick, in_all: u32) -> Result<bool, Full> {
        let laws = &self.laws.step;
        let shaded = self.words.shaded;
        let tests = *self.tests.get_or_insert_with(|| laws.tests(shaded));
        let (birth, speed) = (self.birth, self.speed);
        let mut at = self.at(0);
        for tick in self.bud.age + 1..=last {
            (at.age, at.dimension) = (tick, tick.saturating_sub(birth));
            let due = speed.steps_by(at.dimension);
            while at.cycle < due {
                at.cycle += 1;
                self.read_plain_step(at.cycle - 1, in_all);
                if self.around.is_some() {
                    self.feel();
                    at.contact = self.contact;
                }
                let words = self.words.step();
                if tests.death.happens(words, &at) {
                    self.stand_at(&at);
                    return self.die(at);
                }
                if tests.pause.happens(words, &at) {
                    self.note_at(&at, EventKind::Paused, 1);
                    continue;
                }
                let short = tests.short.happens(words, &at);
                let number = if short { &laws.short_nodes } else { &laws.long_nodes };
                let nodes = number.draw_at(words, &at);
                if !self.is_free(&at, short, nodes)? {
                    self.stand_at(&at);
                    self.feel();
                    at.contact = self.contact;
                    if !self.grow_in_step(&mut at)? {
                        return Ok(false);
                    }
                    continue;
                }
                self.grow_unit(&at, short, nodes)?;
                self.note_at(&at, EventKind::Grew, nodes);
                // The growth unit has a new bud at its tip.
                at.unit += 1;
                (at.bud_birth, at.bud_dimension) = (tick, at.dimension);
                if at.unit >= self.last_unit {
                    self.stand_at(&at);
                    return self.end(ApexFate::Completed, EventKind::Completed, ApexEnd::Completed);
                }
                if !laws.transitions.is_empty() {
                    at.state = laws.state_after(self.words.step(), &at, self.leads);
                    self.bud.state = at.state;
                }
            }
        }
        self.stand_at(&at);
        Ok(true)
    }

    /// Puts the bud and its clock to a point of its laws.
    fn stand_at(&mut self, at: &At) {
        let At { age, cycle, unit: units, bud_birth: birth, state, .. } = *at;
        self.bud = ApicalBud { cycle, units, birth, state, ..self.bud };
        self.set_tick(age);
    }

    /// Plans or makes a growth unit of preformed nodes.
    #[inline(always)]
    fn grow_unit(&mut self, at: &At, short: bool, nodes: u32) -> Result<(), Full> {
        if self.plans {
            return self.plan_whole(at, short, nodes);
        }
        self.stand_at(at);
        for rank in 1..=nodes {
            self.read_node();
            let drawn = self.draw_internode(rank, [short, false]);
            self.node(drawn, nodes, Lie::Free)?;
        }
        Ok(())
    }

    /// Plans a growth unit of preformed nodes. One that fills the block is parted between blocks.
    #[inline(always)]
    fn plan_whole(&mut self, at: &At, short: bool, nodes: u32) -> Result<(), Full> {
        let Words { plan, .. } = &mut *self.words;
        let (before, after) = (plan.nodes, plan.nodes + nodes);
        if nodes == 0 || after >= self.laws.node.block {
            self.stand_at(at);
            return self.plan_unit(*at, short, [nodes, 0]);
        }
        let zones = (plan.zones.len() as u32, plan.zones.len() as u32);
        let (unit_nodes, preformed, nodes) = (nodes, nodes, (before, after));
        plan.pieces.push(Piece { at: *at, unit_nodes, first: 1, nodes, preformed, short, zones });
        match plan.shoots.last_mut() {
            Some(shoot) if shoot.bud.axis == self.bud.axis => shoot.nodes.1 = after,
            _ => self.shoot(after),
        }
        self.words.plan.nodes = after;
        Ok(())
    }

    /// Writes down what the bud did at a point of its laws.
    #[inline(always)]
    fn note_at(&mut self, at: &At, kind: EventKind, count: u32) {
        let Some(events) = &mut self.plant.events else { return };
        let (plan, axis) = (&mut self.words.plan, self.bud.axis);
        let event = Event { tick: at.age, axis, kind, count, state: at.state };
        if plan.is_empty() { events.push(event) } else { plan.events.push((plan.nodes, event)) }
    }
}
