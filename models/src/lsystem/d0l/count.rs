//! How many cells and branches a system makes by each age: sums over kinds of cells, without a string.
//!
//! A kind is a letter on an axis of an order, and whether the cell is the last of its axis, since the branches behind a
//! last cell are forks (`text`). A system without interaction rewrites all cells of a kind alike, so the numbers are
//! exact. Absent: components of a plant (`draw`).

use super::string::Rules;
use super::text::{Branching, Symbol};
use phytomer_sim::clock::Tick;
use phytomer_sim::expectation::{Certainty, Expectation, OrderExpectation};

/// The most orders: those of the columns of a plant.
const MOST_ORDERS: usize = u8::MAX as usize;
/// No plant of the system grows beyond so many cells; for later ages the numbers are reported as too many to count.
const COUNTLESS: f64 = 1e15;

/// A kind of cells: the letter, the order above that of the string's own axis, and whether the axis ends with the cell.
struct Kind {
    letter: usize,
    above: usize,
    last: bool,
}

/// The contents of a string: its cells, and its branches by their order above that of its own axis.
struct Made {
    cells: Vec<Kind>,
    branches: Vec<usize>,
}

/// The numbers of components that a plant of the system has made by each age up to `until`, as means without variance.
pub(super) fn expectation(rules: &Rules, until: Tick) -> Expectation {
    let letters = rules.productions.len();
    let becomes: Vec<[Option<Made>; 2]> = rules
        .productions
        .iter()
        .map(|rule| [false, true].map(|last| rule.as_ref().map(|symbols| made_of(symbols, last))))
        .collect();
    let axiom = made_of(&rules.axiom, true);
    let mut living = Counts::default();
    let mut new = Counts::default();
    axiom.cells.iter().for_each(|cell| living.add(cell.above, slot(cell, letters), letters, 1.0));
    let mut orders: Vec<OrderExpectation> = Vec::new();
    let mut tell = |order: usize, age: Tick, axes: f64, nodes: f64| {
        while orders.len() <= order {
            orders.push(OrderExpectation::zero(until));
        }
        let at = &mut orders[order];
        at.axes[age as usize] += axes;
        at.nodes[age as usize] += nodes;
        at.units[age as usize] += nodes;
    };
    tell(0, 0, 1.0, 0.0);
    axiom.cells.iter().for_each(|cell| tell(cell.above, 0, 0.0, 1.0));
    axiom.branches.iter().for_each(|above| tell(*above, 0, 1.0, 0.0));
    for age in 1..=until {
        new.0.clear();
        for (order, kinds) in living.0.iter().enumerate() {
            for (kind, &count) in kinds.iter().enumerate().filter(|(_, count)| **count > 0.0) {
                let Some(made) = &becomes[kind % letters][kind / letters] else {
                    new.add(order, kind, letters, count);
                    continue;
                };
                let above = |above: usize| (order + above).min(MOST_ORDERS - 1);
                for (nth, cell) in made.cells.iter().enumerate() {
                    new.add(above(cell.above), slot(cell, letters), letters, count);
                    // The first cell is the one that was rewritten.
                    tell(above(cell.above), age, 0.0, if nth > 0 { count } else { 0.0 });
                }
                made.branches.iter().for_each(|branch| tell(above(*branch), age, count, 0.0));
            }
        }
        std::mem::swap(&mut living, &mut new);
        if living.0.iter().flatten().sum::<f64>() > COUNTLESS {
            (age + 1..=until).for_each(|age| tell(0, age, f64::INFINITY, f64::INFINITY));
            break;
        }
    }
    orders.iter_mut().for_each(OrderExpectation::accumulate);
    Expectation { orders, axes: Certainty::Exact, organs: Certainty::Exact }
}

/// Cells by order, and within an order by kind: first, by letter, the cells behind which their axis continues, then the
/// last cells of axes.
#[derive(Default)]
struct Counts(Vec<Vec<f64>>);

impl Counts {
    fn add(&mut self, order: usize, kind: usize, letters: usize, count: f64) {
        while self.0.len() <= order {
            self.0.push(vec![0.0; 2 * letters]);
        }
        self.0[order][kind] += count;
    }
}

fn slot(cell: &Kind, letters: usize) -> usize {
    cell.letter + if cell.last { letters } else { 0 }
}

/// The contents of a string; `end` tells whether no cell follows behind it on its axis.
fn made_of(symbols: &[Symbol], end: bool) -> Made {
    let mut made = Made { cells: Vec::new(), branches: Vec::new() };
    // For each open axis: its order above that of the string, and the place of its last cell so far.
    let mut axes: Vec<(usize, Option<usize>)> = vec![(0, None)];
    for symbol in symbols {
        let above = axes.last().map_or(0, |(above, _)| *above);
        match symbol {
            Symbol::Cell(letter) => {
                axes.iter_mut().last().into_iter().for_each(|(_, last)| *last = Some(made.cells.len()));
                made.cells.push(Kind { letter: usize::from(*letter), above, last: false });
            }
            Symbol::Open(branching) => {
                let forks = *branching == Branching::Fork || (*branching == Branching::ForkAtEnd && end);
                let order = if forks { above } else { above + 1 };
                made.branches.push(order);
                axes.push((order, None));
            }
            Symbol::Close => {
                let last = axes.pop().and_then(|(_, last)| last);
                last.into_iter().for_each(|place| made.cells[place].last = true);
            }
        }
    }
    let last = axes.pop().and_then(|(_, last)| last).filter(|_| end);
    last.into_iter().for_each(|place| made.cells[place].last = true);
    made
}
