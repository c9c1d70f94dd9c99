//! L-systems: strings of modules that are rewritten in parallel at each tick, and the plants that the strings describe.
//!
//! Implemented are the deterministic systems without interaction of Aono & Kunii 1984 ("L-system model") with the
//! paper's drawing rules: [`D0l`] is the parameter struct, `text` reads its strings, `string` rewrites them and keeps
//! the number of each cell, `draw` makes the plant of a string, `count` computes its size without a string, `model`
//! goes from tick to tick. Nothing in them is random. Absent on purpose: context, parameters of modules, the turtle's
//! other commands, death of cells, the environment.

mod card;
mod count;
mod d0l;
mod draw;
mod model;
mod string;
#[cfg(test)]
mod tests;
mod text;

pub use d0l::{Cell, D0l};
pub use model::D0lModel;
