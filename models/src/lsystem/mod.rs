//! L-systems: strings of modules that are rewritten in parallel at each tick, and the plants that they stand for.
//!
//! Today the deterministic systems without interaction of Aono & Kunii 1984 ("L-system model") with the paper's drawing
//! rules: [`D0l`] is the parameter struct, `text` reads its strings, `string` rewrites them and keeps which cell is
//! which, `draw` makes the plant of a string, `count` tells its size without one, `model` goes from tick to tick. Such
//! a system knows no chance. Absent on purpose: context, parameters of modules, the turtle's other commands, death of
//! cells, the environment.

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
