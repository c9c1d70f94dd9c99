//! What people do to the plants of a plot: pruning, training, thinning and harvest, as a calendar of operations.
//!
//! An operation is done between two ticks ([`timing`]), on the plants for which its condition holds, one operation
//! after another in the order of the file and plant by plant in the order of the plot. What it takes is chosen by
//! conditions over columns ([`mod@column`], [`choice`]). After the last operation of a tick the model of each plant
//! answers the cuts, so that their order does not matter. Absent: the days at which operations are done, which become
//! ticks above this crate; the language of conditions; and growth.

pub mod choice;
pub mod column;
mod dates;
mod fruits;
mod plants;
pub mod region;
pub mod timing;
mod training;
mod wood;

pub use choice::{Choice, Formula, SharedFormula};
pub use column::{Column, Thing, Values};
pub use region::Region;
pub use timing::{Due, Start, When};
pub use training::{Support, Training};
pub use wood::Kept;

use crate::clock::Tick;
use crate::plant::{AxisId, Cause, Cut, Plant, Taking};
use crate::site::calendar::Calendar;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefMutIterator, ParallelIterator};
use std::sync::Arc;
use wood::Branches;

#[cfg(test)]
mod tests;

/// What an operation does.
#[derive(Debug, Clone, PartialEq)]
pub enum Act {
    /// Shortens axes.
    Head(Kept),
    /// Takes branches off where they arise.
    Thin,
    /// Takes what stands in a region, of axes up to an order.
    Clear(Region, u8),
    /// Cuts the trunk above a rank, and takes the young trunks that it bears below.
    Stump(u32),
    /// Takes whole plants. The choice is among the plants of the plot.
    Remove,
    /// Picks fruits, so that the others have more.
    ThinFruits,
    /// Picks fruits that have a share of their life on the plant behind them: the harvest.
    Harvest(f64),
    /// Cuts and takes what stands above a height, as forage and cane are harvested.
    Mow(f64),
    /// Bends branches, or the trunk, to a support that holds them.
    Train(Training),
    /// Plants successors where plants of the plot are dead or were taken; the work of the plot (`sim::managed`).
    Replant,
}

/// An operation: what is done, when, on which plants and to which of their parts.
#[derive(Debug, Clone)]
pub struct Operation {
    /// What is done.
    pub act: Act,
    /// When.
    pub when: When,
    /// The plants to which it is done; all if not stated.
    pub plants: Option<SharedFormula>,
    /// The parts that it takes, where it takes parts that can be chosen.
    pub choice: Choice,
}

impl Operation {
    /// Whether the plants must stand for it: be thickened, bent and posed.
    pub fn looks(&self) -> bool {
        let by_place = matches!(self.act, Act::Clear(..) | Act::Mow(_) | Act::Train(_));
        let formulas = self.choice.formulas().chain(&self.plants).chain(&self.when.condition);
        by_place || formulas.flat_map(|formula| formula.columns()).any(Column::is_of_the_pose)
    }

    /// Whether it cuts wood, so that dormant buds may be released.
    fn cuts(&self) -> bool {
        !matches!(self.act, Act::ThinFruits | Act::Harvest(_) | Act::Remove | Act::Train(_) | Act::Replant)
    }

    /// Does it to one plant, as it stood at the end of the tick before its age `tick`.
    fn apply(&self, plant: &mut Plant, tick: Tick) {
        let (choice, asks_height) = (&self.choice, self.asks_height());
        let height = if asks_height { plants::height(plant, tick) } else { f64::NAN };
        let branches =
            |plant: &Plant, cut: &dyn Fn(Branches<'_>) -> Vec<Cut>| cut(Branches::find(plant, tick).of_height(height));
        let cuts = match &self.act {
            Act::Head(kept) => branches(plant, &|all| all.head(choice, *kept, Taking::Pruning)),
            Act::Thin => branches(plant, &|all| all.thin(choice, Taking::Pruning)),
            Act::Clear(region, order) => branches(plant, &|all| all.clear(choice, region, *order, Taking::Pruning)),
            Act::Mow(height) => {
                branches(plant, &|all| all.clear(choice, &Region::Above(*height), u8::MAX, Taking::Harvest))
            }
            Act::Stump(rank) => branches(plant, &|all| all.stump(choice, *rank, Taking::Pruning)),
            Act::Replant => Vec::new(),
            Act::Remove => vec![Cut { axis: AxisId::TRUNK, rank: 0, tick, by: Taking::Pruning }],
            Act::Train(training) => {
                let chosen = Branches::find(plant, tick).of_height(height).trained(choice);
                return training.apply(plant, &chosen, tick);
            }
            Act::ThinFruits => return fruits::pick(plant, choice, 0.0, Cause::Pruned, tick, height),
            Act::Harvest(ripe) => return fruits::pick(plant, choice, *ripe, Cause::Harvested, tick, height),
        };
        plant.cut_all(&cuts);
    }

    fn asks_height(&self) -> bool {
        self.choice.formulas().flat_map(|formula| formula.columns()).any(|column| column == Column::PlantHeight)
    }
}

/// The operations on the plants of one plot, and how far they have come.
#[derive(Debug, Clone, Default)]
pub struct Management {
    operations: Arc<[Operation]>,
    /// For each operation with a condition and each plant, plant by plant, the tick at which it first held.
    begun: Vec<Option<Tick>>,
    /// The ticks with their dates, where a condition may ask them.
    calendar: Option<Arc<Calendar>>,
    /// The members of the plot that are planted by an operation alone.
    successors: Arc<[Successor]>,
}

/// A member of a plot that is planted where another one is dead or was taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Successor {
    /// Its place among the members.
    pub member: usize,
    /// The place of the member that it follows.
    pub follows: usize,
}

/// A plant of a plot, as an operation meets it.
#[derive(Debug, Clone, Copy)]
pub struct Worked {
    /// The tick of the plot at which it was sown.
    pub sown: Tick,
    /// Whether it is worked on at all: its model keeps the past of its plants.
    pub can_be_cut: bool,
}

impl Management {
    /// A calendar of operations, in the order in which they are done within a tick.
    pub fn of(operations: Arc<[Operation]>) -> Self {
        Self { operations, begun: Vec::new(), calendar: None, successors: Arc::new([]) }
    }

    /// Tells which members are planted by an operation alone. They are sown at no tick before it.
    pub fn with_successors(self, successors: Arc<[Successor]>) -> Self {
        Self { successors, ..self }
    }

    /// The members that are planted by an operation alone.
    pub fn successors(&self) -> &Arc<[Successor]> {
        &self.successors
    }

    /// Whether successors are planted at `tick`.
    pub(crate) fn replants(&self, tick: Tick, members: &[Worked]) -> bool {
        let due = |operation: &Operation| operation.when.due(tick, 0, None) == Due::Yes;
        let of_replanting = self.operations.iter().filter(|operation| operation.act == Act::Replant);
        members.iter().any(|member| member.can_be_cut) && of_replanting.into_iter().any(due)
    }

    /// Tells the dates of the ticks, for conditions that ask them.
    pub fn dated(self, calendar: Option<Arc<Calendar>>) -> Self {
        Self { calendar, ..self }
    }

    /// Whether nothing is ever done.
    pub fn is_empty(&self) -> bool {
        self.operations.is_empty()
    }

    /// The operations.
    pub fn operations(&self) -> &Arc<[Operation]> {
        &self.operations
    }

    /// Whether dormant buds must be remembered.
    pub fn cuts(&self) -> bool {
        self.operations.iter().any(Operation::cuts)
    }

    /// Whether the plants must stand for any of the operations.
    pub fn looks(&self) -> bool {
        self.operations.iter().any(Operation::looks)
    }

    /// Goes back to the first tick.
    pub fn restart(&mut self) {
        self.begun.clear();
    }

    fn begun(&self, operation: usize, plant: usize) -> Option<Tick> {
        self.begun.get(plant * self.operations.len() + operation).copied().flatten()
    }

    fn begin(&mut self, operation: usize, plant: usize, tick: Tick) {
        let place = plant * self.operations.len() + operation;
        if self.begun.len() <= place {
            self.begun.resize(place + 1, None);
        }
        self.begun[place].get_or_insert(tick);
    }

    /// The first tick after `after` at which something is done, or a condition asked.
    pub fn next(&self, after: Tick, members: &[Worked]) -> Option<Tick> {
        let next = |(number, operation): (usize, &Operation)| {
            let mut worked = members.iter().enumerate().filter(|(_, member)| member.can_be_cut);
            // Replanting is work on the plot: no plant need be sown for it.
            if operation.act == Act::Replant {
                return worked.next().and_then(|_| operation.when.next(after, 0, None));
            }
            worked
                .filter_map(|(plant, member)| operation.when.next(after, member.sown, self.begun(number, plant)))
                .min()
        };
        self.operations.iter().enumerate().filter_map(next).min()
    }

    /// Whether the plants must stand at the end of the tick before `tick`, for what is due then.
    pub fn looks_at(&self, tick: Tick, members: &[Worked]) -> bool {
        let looks = |(number, operation): (usize, &Operation)| {
            let mut worked = members.iter().enumerate().filter(|(_, member)| member.can_be_cut);
            let due = worked
                .any(|(plant, member)| operation.when.due(tick, member.sown, self.begun(number, plant)) != Due::No);
            due && operation.looks()
        };
        self.operations.iter().enumerate().any(looks)
    }

    /// Does what is due at `tick`, one operation after another, each on all plants that it concerns.
    pub fn work(&mut self, tick: Tick, members: &[Worked], plants: &mut [Plant]) {
        let operations = Arc::clone(&self.operations);
        let of_plants = operations.iter().enumerate().filter(|(_, operation)| operation.act != Act::Replant);
        for (number, operation) in of_plants {
            let concerned = self.concerned(number, operation, tick, members, plants);
            if concerned.is_empty() {
                continue;
            }
            let one = |(place, plant): (usize, &mut Plant)| {
                if concerned.binary_search(&place).is_ok() {
                    operation.apply(plant, tick - members[place].sown);
                }
            };
            match &mut *plants {
                [plant] => one((0, plant)),
                plants => plants.par_iter_mut().enumerate().for_each(one),
            }
        }
    }

    /// The plants that an operation concerns at `tick`, by their places in the plot, rising.
    fn concerned(
        &mut self,
        number: usize,
        operation: &Operation,
        tick: Tick,
        members: &[Worked],
        all: &[Plant],
    ) -> Vec<usize> {
        let calendar = self.calendar.clone();
        let of = |plant: usize, column: Column| match column.is_of_the_date() {
            true => dates::value(calendar.as_deref(), column, tick, members[plant].sown),
            false => plants::value(&all[plant], plant, tick - members[plant].sown, column),
        };
        let mut concerned = Vec::new();
        for (plant, member) in members.iter().enumerate().filter(|(_, member)| member.can_be_cut) {
            let due = operation.when.due(tick, member.sown, self.begun(number, plant));
            // A plant that was taken is not worked on again.
            let stands = |age: Tick| all[plant].axes.shed.first().is_some_and(|shed| *shed > age);
            let meets = due != Due::No && stands(tick - member.sown);
            let holds = |condition| choice::holds(condition, &mut |column| of(plant, column));
            if !meets || (due == Due::Asked && !holds(operation.when.condition.as_ref())) {
                continue;
            }
            self.begin(number, plant, tick);
            if holds(operation.plants.as_ref()) {
                concerned.push(plant);
            }
        }
        if operation.act != Act::Remove {
            return concerned;
        }
        // Of whole plants the choice is among those of the plot.
        let protected = |place: usize| operation.choice.protects(&mut |column| of(concerned[place], column));
        let chosen = operation.choice.of(
            concerned.len(),
            |place| !protected(place),
            |place, column| of(concerned[place], column),
        );
        chosen.into_iter().map(|place| concerned[place]).collect()
    }
}
