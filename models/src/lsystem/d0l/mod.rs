//! The deterministic L-systems without interaction of Aono & Kunii 1984 ("L-system model"), with the paper's drawing
//! rules.
//!
//! [`D0l`] is the parameter struct, `text` reads its strings, `string` rewrites them and keeps the number of each cell,
//! `draw` makes the plant of a string, `count` computes its size without a string, `model` goes from tick to tick.
//! Nothing in them is random. Absent on purpose: context, parameters of modules, a turtle, the environment, which the
//! systems of a text have.

mod count;
mod draw;
mod model;
mod parameters;
mod string;
#[cfg(test)]
mod tests;
mod text;

pub use model::D0lModel;
pub use parameters::{Cell, D0l};
