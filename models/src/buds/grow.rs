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

use super::bud::ApicalBud;
use super::compile::{BudModel, OrderLaws, Passage, Ranks};
use super::params::ApexEnd;
use crate::law::At;
use phytomer_sim::clock::{NEVER, Speed, Tick};
use phytomer_sim::plant::{ApexFate, AxisId, Cause, EventKind, Form, Kind, NewAxis, NewOrgan, NodeId, Plant};
use phytomer_sim::random::{Purpose, Stream};

/// The words of one axis: its streams, opened when first read, and the record last read from each.
#[derive(Debug, Default)]
pub(super) struct Words {
    bud: Option<Stream>,
    node: Option<Stream>,
    /// The head record of the bud stream; then the records of a step, of a node and of the end.
    pub head: Vec<u32>,
    pub step: Vec<u32>,
    pub on_node: Vec<u32>,
    pub end: Vec<u32>,
    /// The ranks from which the axis's trends hold, where it draws them, with their places.
    pub trends: Vec<(u32, u8)>,
    /// The ranks of the zones of the growth unit, where it draws them.
    pub zones: Vec<Ranks>,
}

impl Words {
    fn of(&mut self, laws: &OrderLaws) {
        self.bud = None;
        self.node = None;
        // A quantity without words reads word 0 and ignores it.
        self.head.resize(laws.head.width.max(1), 0);
        self.step.resize(laws.step.width.max(1), 0);
        self.on_node.resize(laws.node.width.max(1), 0);
        self.end.resize(laws.end.width.max(1), 0);
        self.trends.clear();
        self.zones.clear();
    }
}

/// Reads record `number` of `width` words, after a head of `head` words.
pub(super) fn read(stream: &mut Stream, head: usize, number: u32, width: usize, words: &mut [u32]) {
    stream.seek(head as u64 + u64::from(number) * width as u64);
    stream.read(&mut words[..width]);
}

/// The position of a terminal flower, which is no lateral's.
const TERMINAL: u16 = u16::MAX;

/// Where a flower opens, and when.
#[derive(Debug, Clone, Copy)]
pub(super) struct FlowerSite {
    pub node: NodeId,
    /// Its place among the flowers in its node's record, from 0.
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
    speed: Speed,
    /// The growth units after which the apex ends.
    last_unit: u32,
    /// Whether the axis is the first of its set of relays or forks, or belongs to no set.
    leads: bool,
    /// The tick from which dimensions count.
    birth: Tick,
}

/// The plant has no room left for a component that a bud would make.
#[derive(Debug)]
pub(super) struct Full;

impl<'a> Axis<'a> {
    pub fn new(model: &'a BudModel, plant: &'a mut Plant, words: &'a mut Words, bud: ApicalBud) -> Self {
        let laws = model.laws(plant.axes.order[bud.axis.index()]);
        words.of(laws);
        let mut axis = Self {
            model,
            laws,
            plant,
            words,
            bud,
            tick: bud.age,
            dimension: 0,
            speed: Speed::ONE,
            last_unit: u32::MAX,
            leads: false,
            birth: 0,
        };
        let place = axis.bud.axis.index();
        (axis.leads, axis.birth) = (!axis.plant.axes.follows[place], axis.plant.axes.birth[place]);
        axis.read_head();
        axis
    }

    /// Reads the quantities that the axis has drawn at its birth and that its growth needs. They are the same each
    /// time.
    fn read_head(&mut self) {
        let laws = &self.laws.head;
        let axis = self.bud.axis.index();
        if laws.guides_growth && laws.width > 0 {
            let random = &self.plant.random;
            let stream = self.words.bud.insert(random.stream(self.plant.axes.key[axis], Purpose::Bud));
            stream.read(&mut self.words.head);
        }
        let at = at_birth(self.birth, self.plant.axes.state[axis]);
        self.speed = laws.speed.draw(&self.words.head);
        self.last_unit = laws.units.as_ref().map_or(u32::MAX, |units| units.draw(&self.words.head, 0, at));
        laws.trends.draw_ranks(&self.words.head, at, &mut self.words.trends);
    }

    /// Grows the axis to `age`. Returns the bud at that age, or `None` where the apex has come to its end. Linear in
    /// the ticks and in the components made.
    pub fn grow(mut self, age: Tick) -> Result<Option<ApicalBud>, Full> {
        for tick in self.bud.age + 1..=age {
            self.tick = tick;
            self.dimension = tick.saturating_sub(self.birth);
            for _ in self.bud.cycle..self.speed.steps_by(self.dimension) {
                if !self.step()? {
                    return Ok(None);
                }
            }
        }
        self.bud.age = age;
        Ok(Some(self.bud))
    }

    /// Kills the bud at `tick` from outside; relays and reiteration follow as after any death of an apex.
    pub fn kill(mut self, tick: Tick) -> Result<(), Full> {
        self.tick = tick;
        self.dimension = tick.saturating_sub(self.birth);
        self.end(ApexFate::Killed, EventKind::Killed, ApexEnd::Death).map(|_| ())
    }

    /// The point at which laws are evaluated now, for the node at `rank` of its growth unit; 0 for the bud itself.
    pub fn at(&self, rank: u32) -> At {
        let ApicalBud { cycle, units: unit, birth: bud_birth, state, .. } = self.bud;
        let bud_dimension = bud_birth.saturating_sub(self.birth);
        At { age: self.tick, dimension: self.dimension, cycle, rank, bud_birth, bud_dimension, unit, state }
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
            return if self.plant.is_overgrown() { Err(Full) } else { ended };
        }
        for unit in 0..laws.per_step.draw(&self.words.step, 0, at) {
            self.growth_unit(unit)?;
            // The growth unit has a new bud at its tip.
            self.bud.units += 1;
            self.bud.birth = self.tick;
            if self.bud.units >= self.last_unit {
                return self.end(ApexFate::Completed, EventKind::Completed, ApexEnd::Completed);
            }
        }
        self.pass_state()?;
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
        read(stream, self.laws.head.width, step, self.laws.step.width, &mut self.words.step);
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
        if laws.zone_ranks.are_drawn() {
            laws.zone_ranks.draw(&self.words.step, unit, at, &mut self.words.zones);
        }
        for rank in 1..=nodes {
            self.read_node();
            self.node(rank, nodes, short, rank > preformed)?;
        }
        self.plant.note(self.tick, self.bud.axis, EventKind::Grew, nodes);
        Ok(())
    }

    #[inline]
    fn read_node(&mut self) {
        if self.laws.node.width == 0 {
            return;
        }
        let key = self.plant.axes.key[self.bud.axis.index()];
        let random = &self.plant.random;
        let stream = self.words.node.get_or_insert_with(|| random.stream(key, Purpose::Node));
        read(stream, 0, self.bud.rank, self.laws.node.width, &mut self.words.on_node);
    }

    /// Makes at most one passage between states. Each passage has one word, in the order in which they are stated.
    fn pass_state(&mut self) -> Result<(), Full> {
        let at = self.at(0);
        let (state, leads) = (self.bud.state, self.leads);
        let laws = self.laws;
        let happens =
            |passage: &&Passage| passage.concerns(state, leads) && passage.chance.happens(&self.words.step, 0, at);
        let Some(passage) = laws.step.transitions.iter().find(happens) else {
            return Ok(());
        };
        // Its relays start in the state that it leaves, unless the species says otherwise.
        if passage.relayed {
            self.follow_passage()?;
        }
        self.bud.state = passage.to;
        Ok(())
    }

    fn end(&mut self, fate: ApexFate, event: EventKind, end: ApexEnd) -> Result<bool, Full> {
        self.plant.axes.end_apex(self.bud.axis, self.tick, fate);
        let count = if fate == ApexFate::Completed { self.bud.units } else { 1 };
        self.plant.note(self.tick, self.bud.axis, event, count);
        self.follow_end(end)?;
        Ok(false)
    }

    /// Adds the flower that an apex has become, on the last node of its axis. The apex is spent when the flower and its
    /// fruit have fallen.
    fn terminal_flower(&mut self) {
        let Some(node) = self.own_last_node() else {
            return;
        };
        // The flower uses the record of the node that this bud will never make.
        self.read_node();
        let at = self.at(self.plant.nodes.unit_rank[node.index()].into());
        let past = self.flower(FlowerSite { node, nth: 0, birth: self.tick, azimuth: 0.0, position: TERMINAL }, at);
        self.plant.axes.spent[self.bud.axis.index()] = past;
    }

    /// The last node of the axis, where it has one of its own.
    pub fn own_last_node(&self) -> Option<NodeId> {
        (self.bud.rank > 0).then_some(self.bud.last_node)
    }

    /// Adds a flower, and the fruit that it may set. Returns the tick at which the last of them falls. A terminal
    /// flower stands in the direction of its axis, and its laws are evaluated at the rank of the node that bears it. An
    /// organ that would appear after the last age of the run is left out: it takes neither memory nor room under the
    /// plant's limit.
    pub fn flower(&mut self, site: FlowerSite, at: At) -> Tick {
        let FlowerSite { node, nth, birth, azimuth, position } = site;
        let laws = &self.laws.node;
        let words = &self.words.on_node;
        let fall = birth.saturating_add(laws.flower_life.draw(words, nth, at).max(1));
        let sets = laws.fruit_set.happens(words, nth, at);
        let insertion = if position == TERMINAL { 0.0 } else { laws.flower.insertion.draw(words, nth, at) };
        let organ = |kind: Kind, form: Form, birth, death, cause, length, width| NewOrgan {
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
        let flower = organ(laws.flower.kind, laws.flower.form, birth, fall, cause, length, width);
        let fruit = sets.then(|| {
            let ripe = fall.saturating_add(laws.fruit_life.draw(words, nth, at).max(1));
            let (length, width) = (laws.fruit.length.draw(words, nth, at), laws.fruit.width.draw(words, nth, at));
            organ(laws.fruit.kind, laws.fruit.form, fall, ripe, Cause::LifeLength, length, width)
        });
        let last = self.model.until();
        let planned = [Some(flower), fruit].into_iter().flatten();
        planned.filter(|organ| organ.birth <= last).for_each(|organ| {
            self.plant.add_organ(organ);
        });
        fruit.map_or(fall, |fruit| fruit.death)
    }
}

/// The point at which the laws of the head of an axis are evaluated.
fn at_birth(birth: Tick, state: u8) -> At {
    At { age: birth, state, ..At::default() }
}

/// Adds an axis, with the quantities drawn at its birth that do not concern its growth: the time from its death to its
/// fall, and the trends of its own.
pub(super) fn add_axis(model: &BudModel, plant: &mut Plant, new: NewAxis) -> AxisId {
    let laws = &model.laws(new.order).head;
    let fixed = laws.shed_after.as_ref().map_or(Some(NEVER), |ticks| ticks.fixed());
    if !laws.marks_birth {
        return plant.add_axis(NewAxis { shed_after: fixed.unwrap_or(NEVER), ..new });
    }
    let words = laws.words(&plant.random, new.key);
    let at = at_birth(new.birth, new.state);
    let shed_after = laws.shed_after.as_ref().map_or(NEVER, |ticks| ticks.draw(&words, 0, at));
    let axis = plant.add_axis(NewAxis { shed_after, ..new });
    if laws.trends.has_own() {
        plant.own_trends.give(axis, laws.trends.draw_own(&words, at));
    }
    axis
}

/// A bud at the start of the axis `axis`.
pub(super) fn first_bud(model: &BudModel, plant: &Plant, axis: AxisId) -> ApicalBud {
    let place = axis.index();
    let (birth, state) = (plant.axes.birth[place], plant.axes.state[place]);
    let laws = &model.laws(plant.axes.order[place]).head;
    let azimuth = laws.first_azimuth.fixed().unwrap_or_else(|| {
        let words = laws.words(&plant.random, plant.axes.key[place]);
        laws.first_azimuth.draw(&words, 0, at_birth(birth, state))
    });
    ApicalBud {
        axis,
        age: birth,
        cycle: 0,
        units: 0,
        birth,
        passages: 0,
        rank: 0,
        last_node: plant.axes.bearer[place],
        azimuth,
        state,
        dormant: 0,
        bud_spacing: 0.0,
    }
}

/// The first tick after a birth that is the tick `fall` of a year of `year` ticks.
pub(super) fn fall_of_year(year: u32, fall: u32, birth: Tick) -> Tick {
    let (year, fall) = (u64::from(year), u64::from(fall));
    let wait = (fall + year - u64::from(birth) % year) % year;
    let wait = if wait == 0 { year } else { wait };
    u32::try_from(u64::from(birth) + wait).unwrap_or(NEVER)
}

/// The tick at which a leaf falls and why, by its life length or by the season, which makes it fall at `seasonal`.
pub(super) fn leaf_fall(seasonal: Tick, birth: Tick, life: Option<u32>) -> (Tick, Cause) {
    let aged = life.map_or(NEVER, |life| birth.saturating_add(life.max(1)));
    match (aged.min(seasonal), aged <= seasonal) {
        (NEVER, _) => (NEVER, Cause::None),
        (tick, true) => (tick, Cause::LifeLength),
        (tick, false) => (tick, Cause::Season),
    }
}
