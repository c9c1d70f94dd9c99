//! The string of one plant, in which each cell and each branch keeps its number, and its rewriting.
//!
//! Rules are applied to all symbols at once (Aono & Kunii 1984, "L-system model"). A rewritten cell is the first cell
//! of its production: it differentiates and keeps its number, and the other cells are new. So in `F → F F` the first
//! internode keeps the number, and in `g → d(g)g` the apical cell becomes the internode below the new apex. New cells
//! and branches are numbered in the order of the string. A branch is a fork, or lateral, from its birth on. Absent: the
//! positions of cells in space (`draw`).

use super::text::{Branching, Symbol};
use phytomer_sim::clock::Tick;

/// The most kinds of cells.
pub(super) const MOST_CELLS: usize = 64;

/// The compiled system.
#[derive(Debug, Clone)]
pub(super) struct Rules {
    /// The string at age 0.
    pub axiom: Vec<Symbol>,
    /// The production of each cell, which begins with a cell; `None`: the cell stays as it is.
    pub productions: Vec<Option<Vec<Symbol>>>,
}

/// A cell or a branch of a plant: its component number, and the tick at which it appeared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Born {
    pub number: u32,
    pub at: Tick,
}

/// A symbol of a plant's string.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Module {
    /// A cell, by the place of its letter.
    Cell(u8, Born),
    /// The beginning of a branch, and whether its axis divides into it.
    Open(Born, bool),
    /// The end of a branch.
    Close,
}

/// The string of one plant.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Living {
    /// Its modules.
    pub(super) modules: Vec<Module>,
}

impl Rules {
    /// The string of a new plant; `number` gives component numbers.
    pub fn sow(&self, mut number: impl FnMut() -> u32) -> Living {
        let modules = self.axiom.iter().map(|symbol| module(*symbol, true, 0, &mut number)).collect();
        Living { modules }
    }

    /// Rewrites the string for the tick `at`. Returns `false` where it would have more than `most` modules; the string
    /// is then incomplete. Linear in the modules of the new string.
    pub fn rewrite(&self, living: &mut Living, at: Tick, most: usize, mut number: impl FnMut() -> u32) -> bool {
        let Living { modules } = living;
        let last = std::mem::take(modules);
        let ends = ends_of_axes(&last);
        for (old, end) in last.into_iter().zip(ends) {
            match self.production(old) {
                Some((Symbol::Cell(letter), others, born)) => {
                    modules.push(Module::Cell(*letter, born));
                    modules.extend(others.iter().map(|symbol| module(*symbol, end, at, &mut number)));
                }
                _ => modules.push(old),
            }
            if modules.len() > most {
                return false;
            }
        }
        true
    }

    /// The production of a module, if it is a cell that is rewritten: the first symbol and the others, and the cell's
    /// number and birth.
    fn production(&self, old: Module) -> Option<(&Symbol, &[Symbol], Born)> {
        let Module::Cell(letter, born) = old else { return None };
        let (first, others) = self.productions[usize::from(letter)].as_ref()?.split_first()?;
        Some((first, others, born))
    }
}

/// For each module whether it is the last cell of its axis.
fn ends_of_axes(modules: &[Module]) -> Vec<bool> {
    let mut ends = vec![false; modules.len()];
    // From the end: for each open axis whether a cell of it was met.
    let mut axes = vec![false];
    for (module, end) in modules.iter().zip(&mut ends).rev() {
        match module {
            Module::Close => axes.push(false),
            Module::Open(..) => _ = axes.pop(),
            Module::Cell(..) => *end = axes.last_mut().is_some_and(|met| !std::mem::replace(met, true)),
        }
    }
    ends
}

/// A new module; `end` tells whether the rewritten cell is the last of its axis.
fn module(symbol: Symbol, end: bool, at: Tick, number: &mut impl FnMut() -> u32) -> Module {
    match symbol {
        Symbol::Cell(letter) => Module::Cell(letter, Born { number: number(), at }),
        Symbol::Open(branching) => {
            let forks = branching == Branching::Fork || (branching == Branching::ForkAtEnd && end);
            Module::Open(Born { number: number(), at }, forks)
        }
        Symbol::Close => Module::Close,
    }
}
