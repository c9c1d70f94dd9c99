//! L-systems: strings of modules that are rewritten in parallel at each tick, and the plants that the strings describe.
//!
//! [`d0l`] holds the deterministic systems of Aono & Kunii 1984, whose strings stand in the species file or in a file
//! of their own (`cells`). [`view`] reads the files
//! that lie beside an L-system of a text of its own: how the turtle draws, surfaces, functions, colours; [`turtle`]
//! draws by them what the modules of a string tell, and [`text`] makes plants of that. [`Lsystem`] holds the keys of a
//! species. Absent on purpose: the language of such texts and the rewriting of their strings (`phytomer_rewriting`),
//! and reading files (`config`).

mod cells;
pub mod d0l;
mod parameters;
pub mod text;
pub mod turtle;
mod vector;
pub mod view;

pub use d0l::{Cell, D0l, D0lModel};
pub use parameters::{CONSTANT, Continues, Lsystem, StatedEnvironment, Syntax, digits_of, is_map};
