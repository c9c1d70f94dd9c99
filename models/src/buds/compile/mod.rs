//! From parameters to tables: every law compiled and checked over its whole range, every fault reported, before the
//! first tick.
//!
//! Each random quantity has a fixed slot in the words of its stream (see [`words`]); a quantity that is constant takes
//! no word at all.

mod branching;
mod chain;
mod change;
mod compiler;
mod contact;
mod geometry;
mod head;
mod look;
mod node;
mod organs;
mod reach;
mod relay;
mod response;
mod step;
mod trend;
mod wood;
pub(super) mod words;
mod zone;

pub(super) use branching::Branching;
pub(super) use change::{join, nodes_times};
pub(super) use contact::ContactLaws;
pub(super) use head::HeadLaws;
pub(super) use node::{
    LeafFall, NODE_OF_RESPONSES, NodeLaws, OrganLaws, PLACE_OF_EATEN_FLOWERS, PLACE_OF_EATEN_FRUITS,
    PLACE_OF_EATEN_LEAVES,
};
pub(super) use reach::Reach;
pub(super) use relay::EndLaws;
pub(super) use step::{
    PLACE_OF_DEATH, PLACE_OF_WEAKNESS, Passage, STEP_OF_RESPONSES, SimpleSteps, StepLaws, StepTests,
};
pub(super) use words::{Along, Chance, ChanceAt, Draws, Measure, MeasureAt, Number, NumberAt, Piece, Spare};
pub(super) use zone::{Ramification, Ranks};

use super::params::Buds;
use crate::fault::{self, Fault, Path};
use crate::law::{Asked, Domain, ValueTable};
use compiler::Compiler;
use phytomer_sim::clock::LAST_TICK;
use phytomer_sim::expectation::Expectation;
use phytomer_sim::plant::{Habit, OrganTrends, Trend};
use phytomer_sim::site::calendar::Dates;
use std::sync::{Arc, OnceLock};

/// The most orders that a species may have.
const MOST_ORDERS: usize = 16;

/// A species of the bud model, compiled for all ages up to `until`.
#[derive(Debug, Clone)]
pub struct BudModel {
    pub(super) orders: Vec<OrderLaws>,
    pub(super) states: usize,
    pub(super) until: u32,
    pub(super) habit: Arc<Habit>,
    /// What buds do where they meet something.
    pub(super) contact: ContactLaws,
    /// The expectation up to the last age, computed at its first use, since there are several uses before the first
    /// tick.
    pub(super) expected: OnceLock<Option<Expectation>>,
}

/// The compiled laws of one order.
#[derive(Debug, Clone)]
pub(super) struct OrderLaws {
    pub number: u8,
    pub head: HeadLaws,
    pub step: StepLaws,
    pub node: NodeLaws,
    pub end: EndLaws,
    /// How far growth units can reach.
    pub reach: Reach,
    /// Whether some law depends on a variable that moves with growth units alone.
    pub asks_the_bud: bool,
    /// Whether some law depends on the height of the plant.
    pub asks_height: bool,
    /// Whether some law or response depends on the light of the bud.
    pub asks_light: bool,
    /// Whether responses of the order change nothing in full light, so that a bud there reads no words of them.
    pub light_alone: bool,
    /// Whether its axes go through their steps plainly, where they stand in the open and in full light.
    pub is_plain: bool,
    /// The steps of its axes in full light, where they are simple.
    pub simple: Option<SimpleSteps>,
    /// Whether a law itself does, so that sums over the ages of axes cannot have it.
    pub laws_ask_light: bool,
    /// Metres added to a diameter; a law of the plant's age and the internode's own.
    pub thickening: ValueTable,
}

impl Buds {
    /// Compiles the species for all ages up to `until`, and checks every law over its whole range. Laws of the date are
    /// faults: see [`Buds::compile_dated`].
    ///
    /// # Errors
    /// Every fault found, each with its path below `path`.
    pub fn compile(&self, until: u32, path: &Path) -> Result<BudModel, Vec<Fault>> {
        self.compile_dated(until, None, path)
    }

    /// As [`Buds::compile`], for a plant whose ages have these dates. A law of the date becomes one of the age.
    ///
    /// # Errors
    /// Every fault found, each with its path below `path`.
    pub fn compile_dated(&self, until: u32, dates: Option<&Dates>, path: &Path) -> Result<BudModel, Vec<Fault>> {
        let mut faults = self.check(until, path);
        let mut orders = Vec::new();
        let mut trends = Vec::new();
        let mut organ_trends = Vec::new();
        for index in 0..self.order.len().min(MOST_ORDERS) {
            let mut compiler = Compiler::new(self, index, (until.min(LAST_TICK), dates), path);
            orders.push(OrderLaws::compile(self, index, &mut compiler, &mut trends));
            organ_trends.push(organs::trends(&self.order[index], &mut compiler));
            faults.append(&mut compiler.faults);
            fault::tell_once(&mut faults, compiler.asked_again);
        }
        response::compile(self, &mut orders, (until.min(LAST_TICK), dates), path, &mut faults);
        let (looks, paints) = look::compile(self, until.min(LAST_TICK), path, &mut faults);
        let wood = wood::compile(self, until.min(LAST_TICK), path, &mut faults);
        let contact = contact::compile(self, path, &mut faults);
        if !faults.is_empty() {
            faults.sort_by(|a, b| a.path.cmp(&b.path));
            return Err(faults);
        }
        for laws in &mut orders {
            laws.reach = Reach::of(&laws.node);
            laws.simple = laws.simple_steps();
            laws.is_plain = laws.are_plain();
        }
        if organ_trends.iter().all(|of| *of == OrganTrends::default()) {
            organ_trends.clear();
        }
        let habit = Habit { trends, looks, organ_trends, wood, for_drawing: paints.into_habit() };
        let states = self.states.len().max(1);
        Ok(BudModel { orders, states, until, habit: Arc::new(habit), contact, expected: OnceLock::new() })
    }

    fn check(&self, until: u32, path: &Path) -> Vec<Fault> {
        let mut faults = Vec::new();
        let mut fault = |path: &Path, problem: String, expected: String| {
            faults.push(Fault::new(path, problem, expected));
        };
        if self.order.is_empty() || self.order.len() > MOST_ORDERS {
            let found = format!("there are {} orders", self.order.len());
            fault(&path.key("order"), found, format!("from 1 to {MOST_ORDERS} [[order]] tables"));
        }
        if !(1..=LAST_TICK).contains(&until) {
            fault(path, format!("the last age is {until}"), format!("an age from 1 to {LAST_TICK}"));
        }
        if self.states.len() > 64 {
            let found = format!("there are {} states", self.states.len());
            fault(&path.key("states"), found, "at most 64 states".to_owned());
        }
        for (index, state) in self.states.iter().enumerate().take(64) {
            if state.is_empty() || self.states[..index].contains(state) {
                let path = path.key("states").index(index);
                fault(&path, format!("the state \"{state}\" is empty or named twice"), "a name of its own".to_owned());
            }
        }
        if let Some(year) = self.season.as_ref().map(|season| season.ticks_per_year.value())
            && !(1..=LAST_TICK).contains(&year)
        {
            let path = path.key("season").key("ticks_per_year");
            fault(&path, format!("the year has {year} ticks"), format!("from 1 to {LAST_TICK} ticks"));
        }
        faults
    }
}

impl OrderLaws {
    fn compile(buds: &Buds, index: usize, compiler: &mut Compiler, habit: &mut Vec<Trend>) -> Self {
        let order = &buds.order[index];
        compiler.ask(Asked::Birth);
        let head = HeadLaws::compile(order, compiler, habit);
        compiler.ask(Asked::Bud);
        let step = StepLaws::compile(order, head.most_units(), compiler);
        compiler.set_ranks(step.most_nodes());
        let node = NodeLaws::compile(order, buds.season.as_ref(), &step, compiler);
        compiler.unset_ranks();
        let most_buds = node.axillary.count.table.max_in_any_run();
        let end = EndLaws::compile(order, most_buds, &head.insertion.table, compiler);
        Self {
            number: compiler.order_number(),
            head,
            reach: Reach::UNKNOWN,
            node,
            end,
            thickening: compiler.thickening(&order.internode.thickening_mm),
            asks_the_bud: compiler.asks_the_bud,
            asks_height: compiler.asks_height,
            asks_light: compiler.asks_light,
            laws_ask_light: compiler.asks_light,
            light_alone: false,
            is_plain: false,
            simple: None,
            step,
        }
    }
}

/// The order at `index`.
fn order_of(index: usize) -> u8 {
    u8::try_from(index + 1).unwrap_or(u8::MAX)
}

/// The domain of the laws of an order, before the nodes of its growth units are known.
fn domain(buds: &Buds, index: usize, until: u32, max_cycle: u32) -> Domain {
    Domain { order: order_of(index), until, max_cycle, states: buds.states.clone(), ..Domain::default() }
}
