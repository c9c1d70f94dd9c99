//! L-systems as text: the dialect of cpfg, as real files use it, and the notation of the papers (Prusinkiewicz, James &
//! Měch 1994; Prusinkiewicz & Lindenmayer 1990).
//!
//! A text becomes a [`Program`], or faults with line and column; a program derives strings of modules, step by step
//! ([`Derived`]). A module has an identity that lasts as long as nothing rewrites it. Absent: files, turtles, plants,
//! and the meaning of any symbol but brackets, the cut `%`, and queries.

mod cells;
mod code;
mod compile;
mod derived;
mod draws;
mod engine;
mod evaluate;
mod fault;
mod letters;
mod links;
mod origins;
mod outside;
mod parameters;
mod program;
mod string;
mod symbol;
mod syntax;
mod text;

pub use cells::{CellString, Cells};
pub use derived::{Derived, Drawn};
pub use fault::{Fault, MOST_FAULTS, Place, Refused, Stopped};
pub use outside::{Nothing, Outside};
pub use program::{Answers, Interpreter, Limits, Program, Reading, Settings, Unanswered};
pub use string::{Identity, Module, ModuleString, Modules, Slot};
pub use symbol::{MOST_SYMBOLS, Symbol, SymbolTable};

#[cfg(test)]
mod tests_rows;
#[cfg(test)]
mod tests_string;
