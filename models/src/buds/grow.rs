//! The growth of one axis through its clock steps (de Reffye 1988 §4, the pseudo-code): mortality test, then break
//! test, then a growth unit with its nodes, its axillary buds, and on each the ramification test.
//!
//! A bud that appears at a tick is first tested at the next clock signal, as in the paper's pseudo-code, which walks
//! the buds alive at the signal: so dimension is 1 at a bud's first test, and a sylleptic lateral is one tick behind
//! its node. The new axillary buds are those of the growth unit just made, so there are none where the apex is dead or
//! pauses (§3).
//!
//! [`Axis::grow`] takes an axis from any age to any later one; whether a plant grows axis by axis to the end or tick by
//! tick, each axis makes the same draws at the same steps.

use super::around::{Around, Lie};
use super::birth::at_birth;
use super::bud::ApicalBud;
use super::compile::{BudModel, OrderLaws, Passage, StepTests};
use super::params::ApexEnd;
use super::record::Words;
use super::start::Start;
use crate::law::{At, height_in_steps};
use phytomer_sim::clock::{NEVER, Speed, Tick};
use phytomer_sim::plant::{ApexFate, Event, EventKind, NodeId, Plant};
use phytomer_sim::random::Purpose;
use phytomer_sim::site::Site;

/// The fewest nodes that a living axis plans alone; it makes fewer as they come.
const FEWEST: u32 = 8;

/// One axis while it grows.
pub(super) struct Axis<'a> {
    pub model: &'a BudModel,
    pub laws: &'a OrderLaws,
    pub plant: &'a mut Plant,
    pub words: &'a mut Words,
    pub bud: ApicalBud,
    pub tick: Tick,
    dimension: u32,
    /// The height of the plant, in the steps in which laws know it; 0 where none asks.
    height: u32,
    /// The site, where shoots meet something on it.
    pub met: Option<&'a Site>,
    /// Where it stood before this tick, as long as it meets nothing there and its nodes need not ask.
    pub start: Option<Start>,
    /// What the bud can meet there, once it has been asked; boxed, since most plants grow in the open.
    pub around: Option<Box<Around<'a>>>,
    /// Whether it meets something at this step: 1 or 0.
    pub contact: u32,
    /// What the bud lacks of full light, in the steps in which laws know it; 0 where none asks.
    pub shade: u32,
    pub speed: Speed,
    /// The growth units after which the apex ends.
    pub last_unit: u32,
    /// Whether the axis is the first of its set of relays or forks, or belongs to no set.
    pub leads: bool,
    /// The tick from which dimensions count.
    pub birth: Tick,
    /// The age at which a pest kills the whole plant.
    pub whole_death: Tick,
    /// Whether it plans its nodes and makes them at once.
    pub plans: bool,
    /// The tests of its plain steps, once they have been looked up for buds that lack light, or for those that do not.
    pub tests: Option<StepTests<'a>>,
}

/// The plant has no room left for a component that a bud would make.
#[derive(Debug)]
pub(super) struct Full;

impl<'a> Axis<'a> {
    /// The axis of a bud.
    #[inline(always)]
    pub fn of(model: &'a BudModel, plant: &'a mut Plant, words: &'a mut Words, bud: ApicalBud) -> Self {
        let laws = model.laws(plant.axes.order[bud.axis.index()]);
        words.of(laws);
        let height = if laws.asks_height { height_in_steps(f64::from(plant.height)) } else { 0 };
        let shade = if laws.asks_light { plant.shade.of(bud.axis) } else { 0 };
        words.shaded = shade > 0;
        let mut axis = Self {
            model,
            laws,
            plant,
            words,
            bud,
            tick: bud.age,
            dimension: 0,
            height,
            met: None,
            start: None,
            around: None,
            contact: 0,
            shade,
            speed: Speed::ONE,
            last_unit: u32::MAX,
            leads: false,
            birth: 0,
            whole_death: NEVER,
            plans: false,
            tests: None,
        };
        let place = axis.bud.axis.index();
        (axis.leads, axis.birth) = (!axis.plant.axes.follows[place], axis.plant.axes.birth[place]);
        axis.whole_death = axis.plant.exposure.as_ref().map_or(NEVER, |exposure| exposure.death);
        axis.read_head();
        axis
    }

    /// Whether its nodes are made at once: where nothing that one of them is asked for depends on how the node before
    /// it lies, or needs words of a stream of responses.
    fn makes_columns(&self) -> bool {
        let responds = !self.laws.node.spare.places().is_empty();
        let in_full_light = self.laws.light_alone && self.shade == 0;
        self.laws.node.block > 0 && self.begins_free() && self.plant.exposure.is_none() && (!responds || in_full_light)
    }

    /// Reads the quantities that the axis has drawn at its birth and that its growth needs. They are the same each
    /// time.
    pub(super) fn read_head(&mut self) {
        let laws = &self.laws.head;
        let axis = self.bud.axis.index();
        if laws.guides_growth && laws.width > 0 {
            let random = &self.plant.random;
            self.words.read_head(random.stream(self.plant.axes.key[axis], Purpose::Bud));
        }
        let at = at_birth(self.birth, self.plant.axes.state[axis]);
        self.speed = laws.speed.draw(&self.words.head);
        self.last_unit = laws.units.as_ref().map_or(u32::MAX, |units| units.draw(&self.words.head, 0, at));
        laws.trends.draw_ranks(&self.words.head, at, &mut self.words.trends);
    }

    /// Grows the axis to `age`. Its bud joins the living ones, unless the apex has come to its end. Linear in the ticks
    /// and in the components made. Nodes that the axis has planned may be left to be made later, with those of the axes
    /// that grow next.
    pub fn grow(&mut self, age: Tick) -> Result<(), Full> {
        let last = age.min(self.whole_death.saturating_sub(1));
        let most_nodes = last.saturating_sub(self.bud.age).saturating_mul(self.laws.node.most_nodes);
        let (joins, begun) = (self.joins_plan(), !self.words.plan.is_empty());
        let fewest = if self.words.many_begin || self.words.many_alike || (joins && begun) { 1 } else { FEWEST };
        self.plans = most_nodes >= fewest && self.makes_columns();
        if most_nodes > 0 && !(self.plans && joins) {
            self.make_planned()?;
        }
        let in_all = self.speed.steps_by(last.saturating_sub(self.birth));
        if !self.plans && most_nodes > 0 && in_all > self.bud.cycle && !self.words.are_ahead() {
            self.read_both();
        }
        let lives = if self.takes_plain_steps() {
            self.take_plain_steps(last, in_all)?
        } else {
            self.take_steps(last, in_all)?
        };
        if !lives {
            return Ok(());
        }
        if age >= self.whole_death {
            self.make_planned()?;
            self.die_whole();
            return Ok(());
        }
        self.bud.age = age;
        self.words.live_on(self.bud);
        Ok(())
    }

    /// Goes through the steps up to the tick `last`, `in_all` of them since its birth. Whether the apex lives.
    fn take_steps(&mut self, last: Tick, in_all: u32) -> Result<bool, Full> {
        let mut at = self.at(0);
        for tick in self.bud.age + 1..=last {
            self.set_tick(tick);
            (at.age, at.dimension) = (tick, self.dimension);
            for _ in at.cycle..self.speed.steps_by(at.dimension) {
                if !self.step(&mut at, in_all)? {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }

    /// Makes the blocks of words in which the next step and the next node stand.
    #[inline]
    fn read_both(&mut self) {
        let key = self.plant.axes.key[self.bud.axis.index()];
        self.words.read_both(self.laws, &self.plant.random, key, (self.bud.cycle, self.bud.rank));
    }

    /// Puts the clock of the axis to `tick`.
    #[inline]
    pub(super) fn set_tick(&mut self, tick: Tick) {
        self.tick = tick;
        self.dimension = tick.saturating_sub(self.birth);
    }

    /// Puts the clock of the axis to `tick`, with all the steps that are due by then made.
    pub fn begin_at(&mut self, tick: Tick) {
        self.set_tick(tick);
        self.bud.cycle = self.speed.steps_by(self.dimension);
    }

    /// Kills the bud at `tick` from outside; relays and reiteration follow as after any death of an apex.
    pub fn kill(mut self, tick: Tick) -> Result<(), Full> {
        self.set_tick(tick);
        self.end(ApexFate::Killed, EventKind::Killed, ApexEnd::Death).map(|_| ())
    }

    /// The point at which laws are evaluated now, for the node at `rank` of its growth unit; 0 for the bud itself.
    pub fn at(&self, rank: u32) -> At {
        let ApicalBud { cycle, units: unit, birth: bud_birth, state, .. } = self.bud;
        let bud_dimension = bud_birth.saturating_sub(self.birth);
        let (age, dimension, height) = (self.tick, self.dimension, self.height);
        let (contact, shade) = (self.contact, self.shade);
        At { age, dimension, cycle, rank, bud_birth, bud_dimension, unit, height, contact, shade, state }
    }

    /// One clock step of the apical bud, of `in_all` that it may go through by the age to which it grows; false where
    /// it ended. `at` is the point of its laws at the step before, and becomes that of this step.
    // The point is handed on: read again from the bud at each step, it would wait for what was just written there.
    #[inline(always)]
    fn step(&mut self, at: &mut At, in_all: u32) -> Result<bool, Full> {
        at.cycle += 1;
        self.bud.cycle = at.cycle;
        self.read_step(at.cycle - 1, in_all);
        if self.met.is_some() {
            self.feel();
            at.contact = self.contact;
        }
        let laws = &self.laws.step;
        if laws.death.happens(self.words.step(), 0, *at) {
            return self.die(*at);
        }
        if self.plant.exposure.is_some() && self.is_attacked(*at) {
            return self.end(ApexFate::Attacked, EventKind::Attacked, ApexEnd::Death);
        }
        if laws.pause.happens(self.words.step(), 0, *at) {
            self.note(EventKind::Paused, 1);
            return Ok(true);
        }
        if laws.flower.happens(self.words.step(), 0, *at) {
            self.make_planned()?;
            let ended = self.end(ApexFate::Flowered, EventKind::Flowered, ApexEnd::Flower)?;
            self.terminal_flower();
            return if self.plant.is_overgrown() { Err(Full) } else { Ok(ended) };
        }
        self.grow_in_step(at)
    }

    /// The rest of a step at which the bud neither dies, pauses nor flowers: its growth units, then its passage into
    /// another state. Whether the apex lives.
    #[inline(always)]
    pub(super) fn grow_in_step(&mut self, at: &mut At) -> Result<bool, Full> {
        if let Some(lives) = self.answer_contact()? {
            return Ok(lives);
        }
        let laws = &self.laws.step;
        for unit in 0..laws.per_step.draw(self.words.step(), 0, *at) {
            let grown = self.growth_unit(unit, *at)?;
            if self.ends_stuck()? {
                return Ok(false);
            }
            if !grown {
                break;
            }
            // The growth unit has a new bud at its tip.
            (at.unit, at.bud_birth, at.bud_dimension) = (at.unit + 1, at.age, at.age.saturating_sub(self.birth));
            (self.bud.units, self.bud.birth) = (at.unit, at.bud_birth);
            if at.unit >= self.last_unit {
                return self.end(ApexFate::Completed, EventKind::Completed, ApexEnd::Completed);
            }
            if self.is_stuck() {
                break;
            }
        }
        if !laws.transitions.is_empty() {
            self.pass_state(*at)?;
            at.state = self.bud.state;
        }
        Ok(true)
    }

    #[inline]
    fn read_step(&mut self, step: u32, in_all: u32) {
        let key = self.plant.axes.key[self.bud.axis.index()];
        self.words.read_step(self.laws, &self.plant.random, key, step, in_all.saturating_sub(step));
    }

    /// Reads the record of a clock step that has no words of responses.
    #[inline(always)]
    pub(super) fn read_plain_step(&mut self, step: u32, in_all: u32) {
        self.words.go_to_step(self.laws, step, |words| {
            let key = self.plant.axes.key[self.bud.axis.index()];
            words.read_steps(self.laws, &self.plant.random, key, step, in_all.saturating_sub(step));
        });
    }

    /// The death of a bud by its mortality; one that would have lived in full light dies of shade.
    pub(super) fn die(&mut self, at: At) -> Result<bool, Full> {
        let in_light = At { shade: 0, ..at };
        if at.shade > 0 && !self.laws.step.death.happens(self.words.step(), 0, in_light) {
            return self.end(ApexFate::Shaded, EventKind::Shaded, ApexEnd::Death);
        }
        self.end(ApexFate::Died, EventKind::Died, ApexEnd::Death)
    }

    /// A growth unit: its type, the number of its nodes, then node by node as far as there is a way. Whether it was
    /// made: a unit whose first node has no way is a pause.
    #[inline(always)]
    fn growth_unit(&mut self, unit: u32, at: At) -> Result<bool, Full> {
        let laws = &self.laws.step;
        let short = laws.short.happens(self.words.step(), unit, at);
        let preformed = match short {
            true => laws.short_nodes.draw(self.words.step(), unit, at),
            false => laws.long_nodes.draw(self.words.step(), unit, at),
        };
        let neoformed = if short { 0 } else { laws.neoformed.draw(self.words.step(), unit, at) };
        let [preformed, neoformed] = match self.plant.exposure.is_some() {
            true => self.weakened(unit, [preformed, neoformed]),
            false => [preformed, neoformed],
        };
        let nodes = preformed + neoformed;
        let is_free = self.is_free(&at, short, nodes)?;
        if laws.zone_ranks.are_drawn() {
            let Words { zones, .. } = &mut *self.words;
            let mut drawn = std::mem::take(zones);
            laws.zone_ranks.draw(self.words.step(), unit, at, &mut drawn);
            self.words.zones = drawn;
        }
        if self.plans {
            self.plan_unit(at, short, [preformed, neoformed])?;
            self.note(EventKind::Grew, nodes);
            return Ok(true);
        }
        let mut made = 0;
        for rank in 1..=nodes {
            self.read_node();
            let drawn = self.draw_internode(rank, [short, rank > preformed]);
            let Some(lie) = (if is_free { Some(Lie::Free) } else { self.lie(&drawn) }) else { break };
            self.node(drawn, nodes, lie)?;
            made = rank;
        }
        if self.is_stuck() && made == 0 {
            self.note(EventKind::Paused, 1);
            return Ok(false);
        }
        self.note(EventKind::Grew, made);
        Ok(true)
    }

    #[inline]
    pub fn read_node(&mut self) {
        let key = self.plant.axes.key[self.bud.axis.index()];
        self.words.read_node(self.laws, &self.plant.random, key, self.bud.rank);
    }

    /// Makes at most one passage between states. Each passage has one word, in the order in which they are stated.
    fn pass_state(&mut self, at: At) -> Result<(), Full> {
        let (state, leads) = (self.bud.state, self.leads);
        let laws = self.laws;
        let happens =
            |passage: &&Passage| passage.concerns(state, leads) && passage.chance.happens(self.words.step(), 0, at);
        let Some(passage) = laws.step.transitions.iter().find(happens) else {
            return Ok(());
        };
        // Its relays start in the state that it leaves, unless the species says otherwise.
        if passage.relayed {
            self.make_planned()?;
            self.follow_passage()?;
        }
        self.bud.state = passage.to;
        Ok(())
    }

    /// Writes down what the bud did, in its present state.
    pub(super) fn note(&mut self, event: EventKind, count: u32) {
        let plan = &mut self.words.plan;
        if plan.is_empty() {
            self.plant.note_in_state(self.bud.state, self.tick, self.bud.axis, event, count);
        } else if self.plant.events.is_some() {
            let (tick, axis, kind, state) = (self.tick, self.bud.axis, event, self.bud.state);
            plan.events.push((plan.nodes, Event { tick, axis, kind, count, state }));
        }
    }

    pub(super) fn end(&mut self, fate: ApexFate, event: EventKind, end: ApexEnd) -> Result<bool, Full> {
        if self.is_followed(end) {
            self.make_planned()?;
        }
        self.plant.axes.end_apex(self.bud.axis, self.tick, fate);
        let count = if fate == ApexFate::Completed { self.bud.units } else { 1 };
        self.note(event, count);
        self.follow_end(end)?;
        Ok(false)
    }

    /// The last node of the axis, where it has one of its own.
    pub fn own_last_node(&self) -> Option<NodeId> {
        (self.bud.rank > 0).then_some(self.bud.last_node)
    }
}
