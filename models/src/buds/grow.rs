//! The growth of one axis through its clock steps (de Reffye 1988 §4, the pseudo-code): mortality test, then break test,
//! then a growth unit with its nodes, its axillary buds, and on each the ramification test.
//!
//! A bud that appears at a tick is first tested at the next clock signal, as in the paper's pseudo-code, which walks the
//! buds alive at the signal: so dimension is 1 at a bud's first test, and a sylleptic lateral is one tick behind its
//! node. The new axillary buds are those of the growth unit just made, hence none where the apex is dead or pauses (§3).
//!
//! [`Axis::grow`] takes an axis from any age to any later one; whether a plant grows axis by axis to the end or tick by
//! tick, each axis makes the same draws at the same steps.

use super::compile::{BudModel, OrderLaws};
use super::law::At;
use super::params::ApexEnd;
use phytomer_sim::clock::{NEVER, Tick};
use phytomer_sim::plant::{ApexFate, ApicalBud, AxisId, Cause, EventKind, Form, Kind, NewOrgan, NodeId, Plant};
use phytomer_sim::random::{Purpose, Stream};

/// The words of one axis: its streams, opened when first read, and the record last read from each.
#[derive(Debug, Default)]
pub(super) struct Words {
    bud: Option<Stream>,
    node: Option<Stream>,
    /// The head record of the bud stream, a step's, a node's, and the end's.
    pub head: Vec<u32>,
    pub step: Vec<u32>,
    pub on_node: Vec<u32>,
    pub end: Vec<u32>,
}

impl Words {
    fn of(&mut self, laws: &OrderLaws) {
        self.bud = None;
        self.node = None;
        // A quantity without words reads word 0 and does not look at it.
        self.head.resize(laws.step.head_width.max(1), 0);
        self.step.resize(laws.step.width.max(1), 0);
        self.on_node.resize(laws.node.width.max(1), 0);
        self.end.resize(laws.end.width.max(1), 0);
    }
}

/// Reads record `number` of `width` words, after a head of `head` words.
fn read(stream: &mut Stream, head: usize, number: u32, width: usize, words: &mut [u32]) {
    stream.seek(head as u64 + u64::from(number) * width as u64);
    stream.read(&mut words[..width]);
}

/// The position of a terminal flower, which is no lateral's.
const TERMINAL: u16 = u16::MAX;

/// Where a flower opens, and when.
#[derive(Debug, Clone, Copy)]
pub(super) struct FlowerSite {
    pub node: NodeId,
    /// Which of the flowers of its node's record, from 0.
    pub nth: u32,
    pub birth: Tick,
    pub azimuth: f32,
    pub position: u16,
}

/// One axis while it grows.
pub(super) struct Axis<'a> {
    pub model: &'a BudModel,
    pub laws: &'a OrderLaws,
    pub plant: &'a mut Plant,
    pub words: &'a mut Words,
    pub bud: ApicalBud,
    pub tick: Tick,
    dimension: u32,
    /// The growth units after which the apex ends.
    last_unit: u32,
}

/// The plant has no room left for what a bud would make.
#[derive(Debug)]
pub(super) struct Full;

impl<'a> Axis<'a> {
    pub fn new(model: &'a BudModel, plant: &'a mut Plant, words: &'a mut Words, bud: ApicalBud) -> Self {
        let laws = model.laws(plant.axes.order[bud.axis.index()]);
        words.of(laws);
        let mut axis = Self { model, laws, plant, words, bud, tick: bud.age, dimension: 0, last_unit: u32::MAX };
        axis.read_head();
        axis
    }

    fn read_head(&mut self) {
        let Some(units) = &self.laws.step.units else {
            return;
        };
        if self.laws.step.head_width > 0 {
            let key = self.plant.axes.key[self.bud.axis.index()];
            let random = &self.plant.random;
            let stream = self.words.bud.get_or_insert_with(|| random.stream(key, Purpose::Bud));
            read(stream, 0, 0, self.laws.step.head_width, &mut self.words.head);
        }
        let birth = self.plant.axes.birth[self.bud.axis.index()];
        let state = self.plant.axes.state[self.bud.axis.index()];
        let at = At { age: birth, state, ..At::default() };
        self.last_unit = units.draw(&self.words.head, 0, at);
    }

    /// Grows the axis to `age`; the bud as it then is, or `None` where the apex has come to its end.
    pub fn grow(mut self, age: Tick) -> Result<Option<ApicalBud>, Full> {
        let birth = self.plant.axes.birth[self.bud.axis.index()];
        for tick in self.bud.age + 1..=age {
            self.tick = tick;
            self.dimension = tick.saturating_sub(birth);
            for _ in self.bud.cycle..self.laws.speed.steps_by(self.dimension) {
                if !self.step()? {
                    return Ok(None);
                }
            }
        }
        self.bud.age = age;
        Ok(Some(self.bud))
    }

    /// Where laws are asked now, for the node at `rank` of its growth unit; 0 for the bud itself.
    pub fn at(&self, rank: u32) -> At {
        At { age: self.tick, dimension: self.dimension, cycle: self.bud.cycle, rank, state: self.bud.state }
    }

    /// One clock step of the apical bud; false where it ended.
    fn step(&mut self) -> Result<bool, Full> {
        self.bud.cycle += 1;
        self.read_step();
        let laws = &self.laws.step;
        let at = self.at(0);
        if laws.death.happens(&self.words.step, 0, at) {
            return self.end(ApexFate::Died, EventKind::Died, ApexEnd::Death);
        }
        if laws.pause.happens(&self.words.step, 0, at) {
            self.plant.note(self.tick, self.bud.axis, EventKind::Paused, 1);
            return Ok(true);
        }
        if laws.flower.happens(&self.words.step, 0, at) {
            let ended = self.end(ApexFate::Flowered, EventKind::Flowered, ApexEnd::Flower);
            self.terminal_flower();
            return ended;
        }
        for unit in 0..laws.per_step.draw(&self.words.step, 0, at) {
            self.growth_unit(unit)?;
            self.bud.units += 1;
            if self.bud.units >= self.last_unit {
                return self.end(ApexFate::Completed, EventKind::Completed, ApexEnd::Completed);
            }
        }
        self.pass_state();
        Ok(true)
    }

    fn read_step(&mut self) {
        if self.laws.step.width == 0 {
            return;
        }
        let key = self.plant.axes.key[self.bud.axis.index()];
        let random = &self.plant.random;
        let stream = self.words.bud.get_or_insert_with(|| random.stream(key, Purpose::Bud));
        let step = self.bud.cycle - 1;
        read(stream, self.laws.step.head_width, step, self.laws.step.width, &mut self.words.step);
    }

    /// A growth unit: its type, the number of its nodes, then node by node.
    fn growth_unit(&mut self, unit: u32) -> Result<(), Full> {
        let laws = &self.laws.step;
        let at = self.at(0);
        let short = laws.short.happens(&self.words.step, unit, at);
        let preformed = match short {
            true => laws.short_nodes.draw(&self.words.step, unit, at),
            false => laws.long_nodes.draw(&self.words.step, unit, at),
        };
        let neoformed = if short { 0 } else { laws.neoformed.draw(&self.words.step, unit, at) };
        let nodes = preformed + neoformed;
        for rank in 1..=nodes {
            self.read_node();
            self.node(rank, nodes, short, rank > preformed)?;
        }
        self.plant.note(self.tick, self.bud.axis, EventKind::Grew, nodes);
        Ok(())
    }

    fn read_node(&mut self) {
        if self.laws.node.width == 0 {
            return;
        }
        let key = self.plant.axes.key[self.bud.axis.index()];
        let random = &self.plant.random;
        let stream = self.words.node.get_or_insert_with(|| random.stream(key, Purpose::Node));
        read(stream, 0, self.bud.rank, self.laws.node.width, &mut self.words.on_node);
    }

    /// At most one passage between states, by one word a passage in the order in which they are stated.
    fn pass_state(&mut self) {
        let at = self.at(0);
        let passage = self
            .laws
            .step
            .transitions
            .iter()
            .find(|(from, _, chance)| *from == self.bud.state && chance.happens(&self.words.step, 0, at));
        if let Some(&(_, to, _)) = passage {
            self.bud.state = to;
        }
    }

    fn end(&mut self, fate: ApexFate, event: EventKind, end: ApexEnd) -> Result<bool, Full> {
        self.plant.axes.end_apex(self.bud.axis, self.tick, fate);
        let count = if fate == ApexFate::Completed { self.bud.units } else { 1 };
        self.plant.note(self.tick, self.bud.axis, event, count);
        self.follow_end(end)?;
        Ok(false)
    }

    /// The flower that an apex has become, on the last node of its axis; the apex is spent when it and its fruit fall.
    fn terminal_flower(&mut self) {
        let Some(node) = self.own_last_node() else {
            return;
        };
        // The record of the node that this bud will never make.
        self.read_node();
        let past =
            self.flower(FlowerSite { node, nth: 0, birth: self.tick, azimuth: 0.0, position: TERMINAL }, self.at(0));
        self.plant.axes.spent[self.bud.axis.index()] = past;
    }

    /// The last node of the axis, where it has one of its own.
    pub fn own_last_node(&self) -> Option<NodeId> {
        (self.bud.rank > 0).then_some(self.bud.last_node)
    }

    /// A flower, and the fruit that it may set; the tick at which the last of them falls. A terminal flower stands in the
    /// direction of its axis, and its laws are asked at rank 0, which is no node's.
    pub fn flower(&mut self, site: FlowerSite, at: At) -> Tick {
        let FlowerSite { node, nth, birth, azimuth, position } = site;
        let laws = &self.laws.node;
        let words = &self.words.on_node;
        let fall = birth.saturating_add(laws.flower_life.draw(words, nth, at).max(1));
        let sets = laws.fruit_set.happens(words, nth, at);
        let insertion = if position == TERMINAL { 0.0 } else { laws.flower.insertion.draw(words, nth, at) };
        let organ = |kind, form: Form, birth, death, cause, length, width| NewOrgan {
            node,
            kind,
            position,
            birth,
            death,
            cause,
            form,
            length,
            width,
            area: 0.0,
            azimuth,
            insertion,
        };
        let (length, width) = (laws.flower.length.draw(words, nth, at), laws.flower.width.draw(words, nth, at));
        let cause = if sets { Cause::FruitSet } else { Cause::LifeLength };
        let flower = organ(Kind::Flower, laws.flower.form, birth, fall, cause, length, width);
        let fruit = sets.then(|| {
            let ripe = fall.saturating_add(laws.fruit_life.draw(words, nth, at).max(1));
            let (length, width) = (laws.fruit.length.draw(words, nth, at), laws.fruit.width.draw(words, nth, at));
            organ(Kind::Fruit, laws.fruit.form, fall, ripe, Cause::LifeLength, length, width)
        });
        self.plant.add_organ(flower);
        fruit.map_or(fall, |fruit| {
            self.plant.add_organ(fruit);
            fruit.death
        })
    }
}

/// A bud at the start of the axis `axis`.
pub(super) fn first_bud(model: &BudModel, plant: &Plant, axis: AxisId) -> ApicalBud {
    let place = axis.index();
    ApicalBud {
        axis,
        age: plant.axes.birth[place],
        cycle: 0,
        units: 0,
        rank: 0,
        last_node: plant.axes.bearer[place],
        azimuth: model.laws(plant.axes.order[place]).first_azimuth,
        state: plant.axes.state[place],
        dormant: 0,
        bud_spacing: 0.0,
    }
}

/// The tick at which a leaf falls, by its life length or by the season, and why.
pub(super) fn leaf_fall(model: &BudModel, birth: Tick, life: Option<u32>) -> (Tick, Cause) {
    let aged = life.map_or(NEVER, |life| birth.saturating_add(life.max(1)));
    let seasonal = model.season.map_or(NEVER, |season| {
        let (year, fall) = (u64::from(season.ticks_per_year), u64::from(season.leaf_fall));
        let wait = (fall + year - u64::from(birth) % year) % year;
        let wait = if wait == 0 { year } else { wait };
        u32::try_from(u64::from(birth) + wait).unwrap_or(NEVER)
    });
    match (aged.min(seasonal), aged <= seasonal) {
        (NEVER, _) => (NEVER, Cause::None),
        (tick, true) => (tick, Cause::LifeLength),
        (tick, false) => (tick, Cause::Season),
    }
}
