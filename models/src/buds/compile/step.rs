//! The laws of a clock step: death, pause, flowering, growth units and their nodes, passages between states.
//!
//! De Reffye 1988 §4: the mortality test, the break test, then the growth unit. Each has its slot in the step's record
//! of words. Absent: the organs and buds of a node (`node`), and the clock (`buds::grow`).

use super::change::{ByAge, Change};
use super::compiler::{Compiler, Ranks};
use super::words::{Chance, Layout, Number, Spare, Tested, TestedAlong};
use super::zone::ZoneRanks;
use crate::buds::params::{Order, Sibling, Transition};
use crate::law::{At, CountTable, ProbabilityTable};

/// The most growth units of one step.
const MOST_UNITS: u32 = 64;
/// The places of the words of a step in its record in the stream of responses, and the width of that record.
pub const PLACE_OF_DEATH: u32 = 0;
const PLACE_OF_PAUSE: u32 = 1;
const PLACE_OF_FLOWER: u32 = 2;
const PLACE_OF_NODES: u32 = 16;
pub const PLACE_OF_WEAKNESS: u32 = PLACE_OF_NODES + 2 * MOST_UNITS;
pub const STEP_OF_RESPONSES: u32 = PLACE_OF_WEAKNESS + 2 * MOST_UNITS;
/// The most nodes of a growth unit.
pub const MOST_NODES: u32 = 65_535;

/// The laws of one clock step of an order.
#[derive(Debug, Clone)]
pub struct StepLaws {
    /// The number of words of a step's record.
    pub width: usize,
    /// The words of responses behind it.
    pub spare: Spare,
    pub death: Chance,
    pub pause: Chance,
    /// The terminal flower.
    pub flower: Chance,
    pub per_step: Number,
    /// Whether a growth unit is short; drawn once a unit.
    pub short: Chance,
    pub long_nodes: Number,
    pub short_nodes: Number,
    pub neoformed: Number,
    /// The passages between states; each has one word.
    pub transitions: Vec<Passage>,
    /// The ranks of the zones; drawn once a unit.
    pub zone_ranks: ZoneRanks,
    /// Whether each step has at most one growth unit, of preformed nodes and zones that are not drawn, and neither a
    /// terminal flower nor relays.
    pub is_plain: bool,
}

/// A passage between states.
#[derive(Debug, Clone)]
pub struct Passage {
    pub from: u8,
    pub to: u8,
    pub chance: Chance,
    /// Which relays of a set can make the passage; `None`: all of them.
    pub sibling: Option<Sibling>,
    /// Whether relays follow the passage.
    pub relayed: bool,
}

impl Passage {
    /// Whether an axis in `state` can make the passage; `leads` tells whether it leads its set of relays.
    #[inline]
    pub fn concerns(&self, state: u8, leads: bool) -> bool {
        self.from == state && self.sibling.is_none_or(|sibling| (sibling == Sibling::Leader) == leads)
    }
}

/// The tests of a plain step, each looked up as far as it is the same at every step.
#[derive(Debug, Clone, Copy)]
pub struct StepTests<'a> {
    pub death: Tested<'a>,
    pub pause: Tested<'a>,
    pub short: Tested<'a>,
}

/// Plain steps in full light whose tests depend on one variable each at most, and whose numbers are not drawn.
#[derive(Debug, Clone)]
pub struct SimpleSteps {
    pub death: TestedAlong,
    pub pause: TestedAlong,
    /// The nodes of each growth unit, which is long.
    pub nodes: u32,
}

impl StepLaws {
    /// Compiles the laws of a step. An axis makes at most `last` growth units in all: in the run at hand, and in a run
    /// of any length.
    pub fn compile(order: &Order, last: [u32; 2], compiler: &mut Compiler) -> Self {
        let mut layout = Layout::default();
        let unit = &order.growth_unit;
        compiler.set_units([MOST_UNITS; 2], last);
        let per_step = compiler.places(&unit.per_step, "growth_unit.per_step", MOST_UNITS);
        let most_units = per_step.max_in_any_run();
        compiler.set_units([per_step.max(), most_units], last);
        let death = layout.chance(compiler.probability(&order.death, "death"), 1);
        let pause = layout.chance(compiler.probability(&order.pause, "pause"), 1);
        let flower = layout.chance(compiler.probability(&order.flower.terminal, "flower.terminal"), 1);
        let per_step = layout.number(per_step, 1);
        let (short, short_nodes) = match &unit.short {
            Some(short) => (
                compiler.probability(&short.probability, "growth_unit.short.probability"),
                compiler.count(&short.nodes, "growth_unit.short.nodes", MOST_NODES),
            ),
            None => (ProbabilityTable::certain_or_never(false), CountTable::always(0)),
        };
        let long_nodes = compiler.count(&unit.nodes, "growth_unit.nodes", MOST_NODES);
        let neoformed = compiler.count(&unit.neoformed, "growth_unit.neoformed", MOST_NODES);
        if long_nodes.max() + neoformed.max() > MOST_NODES {
            let found = format!("a growth unit can have {} nodes", long_nodes.max() + neoformed.max());
            compiler.fault("growth_unit.neoformed", found, "at most 65535 nodes, preformed and neoformed together");
        }
        let mut laws = Self {
            death,
            pause,
            flower,
            per_step,
            short: layout.chance(short, most_units),
            long_nodes: layout.number(long_nodes, most_units),
            short_nodes: layout.number(short_nodes, most_units),
            neoformed: layout.number(neoformed, most_units),
            transitions: transitions(order, compiler, &mut layout),
            zone_ranks: ZoneRanks::compile(order, compiler, &mut layout, most_units),
            width: layout.width(),
            spare: Spare::after(layout.width()),
            is_plain: false,
        };
        laws.is_plain = laws.are_plain();
        laws
    }

    /// Whether each step has at most one growth unit, of preformed nodes and zones that are not drawn, and neither a
    /// terminal flower nor relays. No response makes a number or a flower out of none.
    fn are_plain(&self) -> bool {
        let one_unit = self.per_step.fixed() == Some(1) && self.neoformed.fixed() == Some(0);
        let flowerless = self.flower.is_never() && !self.transitions.iter().any(|passage| passage.relayed);
        one_unit && flowerless && !self.zone_ranks.are_drawn()
    }

    /// The state in which a bud is after a step at which no relays follow a passage; `leads` tells whether its axis
    /// leads its set of relays.
    pub fn state_after(&self, words: &[u32], at: &At, leads: bool) -> u8 {
        let passes = |passage: &&Passage| passage.concerns(at.state, leads) && passage.chance.happens_at(words, at);
        self.transitions.iter().find(passes).map_or(at.state, |passage| passage.to)
    }

    /// The tests of a plain step of a bud, which lacks light where `shaded`.
    pub fn tests(&self, shaded: bool) -> StepTests<'_> {
        let [death, pause, short] = [&self.death, &self.pause, &self.short].map(|chance| chance.looked_up(shaded));
        StepTests { death, pause, short }
    }

    /// The steps in full light, where they are simple: neither passages between states nor short units, and numbers and
    /// tests that ask for little.
    pub fn simple(&self) -> Option<SimpleSteps> {
        let nodes = self.long_nodes.unchanging().filter(|_| self.short.is_never() && self.transitions.is_empty())?;
        let [death, pause] = [&self.death, &self.pause].map(Chance::along);
        Some(SimpleSteps { death: death?, pause: pause?, nodes }).filter(|_| self.is_plain)
    }

    /// Lets hazards join the mortality of a bud.
    pub fn endanger(&mut self, hazard: ByAge) {
        self.death.respond(Change::Joins(hazard), (PLACE_OF_DEATH, 1), &mut self.spare);
    }

    /// Lets hazards join the probability of a pause.
    pub fn delay(&mut self, hazard: ByAge) {
        self.pause.respond(Change::Joins(hazard), (PLACE_OF_PAUSE, 1), &mut self.spare);
    }

    /// Multiplies the probability of a terminal flower.
    pub fn flower_times(&mut self, factor: ByAge) {
        self.flower.respond(Change::Times(factor), (PLACE_OF_FLOWER, 1), &mut self.spare);
    }

    /// Multiplies the numbers of nodes of growth units.
    pub fn nodes_times(&mut self, factor: &ByAge) {
        let units = self.per_step.table.max_in_any_run().min(MOST_UNITS);
        // A unit is long or short, so both numbers use one word.
        for (nodes, place) in [(&mut self.long_nodes, 0), (&mut self.short_nodes, 0), (&mut self.neoformed, 1)] {
            if nodes.table.max_in_any_run() > 0 {
                nodes.respond(factor.clone(), (PLACE_OF_NODES + place * MOST_UNITS, units), &mut self.spare);
            }
        }
    }

    /// The most nodes that a growth unit can have.
    pub fn most_nodes(&self) -> Ranks {
        let tables = [&self.long_nodes, &self.neoformed, &self.short_nodes].map(|number| &number.table);
        let most = |of: fn(&CountTable) -> u32| (of(tables[0]) + of(tables[1])).max(of(tables[2]));
        Ranks {
            now: most(CountTable::max),
            ever: most(CountTable::max_in_any_run),
            go_on: tables.iter().any(|table| table.goes_on()),
        }
    }
}

fn transitions(order: &Order, compiler: &mut Compiler, layout: &mut Layout) -> Vec<Passage> {
    let mut compiled = Vec::new();
    for (index, transition) in order.transition.iter().enumerate() {
        let keys = format!("transition.{index}");
        let from = compiler.state(&transition.from, &format!("{keys}.from"));
        let to = compiler.state(&transition.to, &format!("{keys}.to"));
        let table = compiler.probability(&transition.probability, &format!("{keys}.probability"));
        let Transition { sibling, relayed, .. } = *transition;
        compiled.push(Passage { from, to, chance: layout.chance(table, 1), sibling, relayed });
    }
    compiled
}
