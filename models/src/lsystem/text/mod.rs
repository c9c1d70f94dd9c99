//! L-systems of a text of its own: the plants that their strings describe, with components that last.
//!
//! `role` is what each module is to a plant, `draft` the plant of a string in the coordinates of the turtle, `numbers`
//! what lasts from age to age, `columns` the columns of a plant, `events` its events, `model` goes from tick to tick;
//! `system` reads and compiles the texts to a `script`.
//! Absent: the language (`phytomer_rewriting`), the turtle and its view files (beside), and the keys of a species.

mod columns;
mod curves;
mod draft;
mod events;
mod form;
mod model;
mod numbers;
mod role;
mod script;
mod system;
#[cfg(test)]
mod tests;

pub use model::{Life, TextModel};
pub use system::{TextSystem, Wrong};
