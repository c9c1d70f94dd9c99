//! The string of one plant, in which each cell and each branch keeps its number, and its rewriting.
//!
//! Rules are applied to all symbols at once (Aono & Kunii 1984, "L-system model"). A rewritten cell is the first cell
//! of its production: it differentiates and keeps its number, and the other cells are new. So in `F → F F` the first
//! internode keeps the number, and in `g → d(g)g` the apical cell becomes the internode below the new apex. New cells
//! and branches are numbered in the order of the string. A cell whose production is empty vanishes with its number; it
//! bears no branch and does not end an axis, which is checked beforehand (`d0l`). A branch is a fork, or lateral, from
//! its birth on. Absent: the positions of cells in space (`draw`).

use super::text::{Branching, Symbol};
use phytomer_sim::clock::Tick;

/// The most kinds of cells.
pub(super) const MOST_CELLS: usize = 64;

/// The compiled system.
#[derive(Debug, Clone)]
pub(super) struct Rules {
    /// The string at age 0.
    pub axiom: Vec<Symbol>,
    /// The production of each cell, which is empty or begins with a cell; `None`: the cell stays as it is.
    pub productions: Vec<Option<Vec<Symbol>>>,
}

/// What a rewriting may not go beyond, and what it tells of the cells of the string.
pub(super) struct Rewriting<'a, N> {
    /// The tick.
    pub at: Tick,
    /// The most modules of the new string.
    pub most: usize,
    /// Gives component numbers.
    pub number: N,
    /// Gets the cells that vanish, each as its place among the cells of the old string.
    pub vanished: &'a mut Vec<u32>,
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

    /// Whether any cell vanishes.
    pub fn has_deaths(&self) -> bool {
        self.productions.iter().flatten().any(Vec::is_empty)
    }

    /// Rewrites the string. Returns `false` where it would have more modules than allowed; the string is then
    /// incomplete. Linear in the modules of the new string.
    pub fn rewrite(&self, living: &mut Living, mut how: Rewriting<'_, impl FnMut() -> u32>) -> bool {
        let Living { modules } = living;
        let last = std::mem::take(modules);
        let ends = ends_of_axes(&last);
        let mut cells = 0..;
        for (old, end) in last.into_iter().zip(ends) {
            let Module::Cell(letter, born) = old else {
                modules.push(old);
                continue;
            };
            let cell = cells.next().unwrap_or(u32::MAX);
            match self.productions[usize::from(letter)].as_deref() {
                None => modules.push(old),
                Some([]) => how.vanished.push(cell),
                Some([first, others @ ..]) => {
                    // The first symbol is a cell, which keeps the number.
                    let kept = if let Symbol::Cell(letter) = first { *letter } else { letter };
                    modules.push(Module::Cell(kept, born));
                    modules.extend(others.iter().map(|symbol| module(*symbol, end, how.at, &mut how.number)));
                }
            }
            if modules.len() > how.most {
                return false;
            }
        }
        true
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
