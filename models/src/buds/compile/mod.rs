//! From parameters to tables: every law compiled and checked over its whole range, every fault reported, before the
//! first tick.
//!
//! Each random quantity has a fixed slot in the words of its stream (see [`words`]); a quantity that is constant takes
//! no word at all.

mod compiler;
mod geometry;
mod node;
mod relay;
mod step;
mod wood;
pub(super) mod words;

pub(super) use geometry::Trends;
pub(super) use node::NodeLaws;
pub(super) use relay::{Branching, EndLaws};
pub(super) use step::StepLaws;

use super::law::{Domain, ValueTable};
use super::params::{Buds, Order, Season};
use crate::fault::{Fault, Path};
use compiler::Compiler;
use phytomer_sim::clock::{LAST_TICK, NEVER, Speed};
use phytomer_sim::plant::{Habit, Shape};
use std::sync::Arc;

/// The most orders that a species may have.
const MOST_ORDERS: usize = 16;

/// A species of the bud model, compiled for all ages up to `until`.
#[derive(Debug, Clone)]
pub struct BudModel {
    pub(super) orders: Vec<OrderLaws>,
    pub(super) season: Option<Season>,
    pub(super) states: usize,
    pub(super) until: u32,
    pub(super) habit: Arc<Habit>,
}

/// The compiled laws of one order.
#[derive(Debug, Clone)]
pub(super) struct OrderLaws {
    pub number: u8,
    pub speed: Speed,
    pub step: StepLaws,
    pub node: NodeLaws,
    pub end: EndLaws,
    pub trends: Trends,
    pub first_azimuth: f32,
    /// Metres added to a diameter; asked at the plant's age and the internode's own.
    pub thickening: ValueTable,
}

impl Buds {
    /// Compiles the species for all ages up to `until`, and checks every law over its whole range.
    ///
    /// # Errors
    /// Every fault that there is, each with its path below `path`.
    pub fn compile(&self, until: u32, path: &Path) -> Result<BudModel, Vec<Fault>> {
        let mut faults = self.check(until, path);
        let mut orders = Vec::new();
        let mut trends = Vec::new();
        for (index, order) in self.order.iter().enumerate().take(MOST_ORDERS) {
            let mut compiler = Compiler::new(self, index, until.min(LAST_TICK), &path.key("order"));
            orders.push(compile_order(order, &mut compiler, &mut trends));
            faults.append(&mut compiler.faults);
        }
        let wood = wood::compile(self, until.min(LAST_TICK), path, &mut faults);
        if !faults.is_empty() {
            faults.sort_by(|a, b| a.path.cmp(&b.path));
            faults.dedup();
            return Err(faults);
        }
        let habit = Habit {
            trends,
            shed_after: self.order.iter().map(|order| order.shed_after.unwrap_or(NEVER)).collect(),
            shapes: self.order.iter().map(|order| Shape::from(order.internode.shape)).collect(),
            wood,
        };
        let states = self.states.len().max(1);
        Ok(BudModel { orders, season: self.season, states, until, habit: Arc::new(habit) })
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
        if let Some(season) = self.season
            && season.leaf_fall >= season.ticks_per_year
        {
            let found = format!("the tick {} is not in a year of {} ticks", season.leaf_fall, season.ticks_per_year);
            let expected = format!("a tick of the year from 0 to {}", season.ticks_per_year.saturating_sub(1));
            fault(&path.key("season").key("leaf_fall"), found, expected);
        }
        faults
    }
}

fn compile_order(order: &Order, compiler: &mut Compiler, trends: &mut Vec<phytomer_sim::plant::Trend>) -> OrderLaws {
    let step = StepLaws::compile(order, compiler);
    let end = EndLaws::compile(order, compiler);
    compiler.set_max_rank(step.most_nodes().max(1));
    let (phyllotaxis, first_azimuth) = geometry::phyllotaxis(order, compiler);
    OrderLaws {
        number: compiler.order_number(),
        speed: compiler.speed,
        node: NodeLaws::compile(order, phyllotaxis, compiler),
        end,
        trends: Trends::compile(&order.trend, compiler, trends),
        first_azimuth,
        thickening: compiler.thickening(&order.internode.thickening_mm),
        step,
    }
}

/// The domain of the laws of an order, before the nodes of its growth units are known.
fn domain(buds: &Buds, index: usize, until: u32, speed: Speed) -> Domain {
    Domain {
        order: u8::try_from(index + 1).unwrap_or(u8::MAX),
        until,
        max_cycle: speed.steps_by(until),
        max_rank: 0,
        states: buds.states.clone(),
    }
}
