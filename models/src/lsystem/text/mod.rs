//! L-systems of a text of its own: the plants that their strings describe, with components that last.
//!
//! `role` is what each module is to a plant, `draft` the plant of a string in the coordinates of the turtle, `numbers`
//! what lasts from age to age, `columns` the columns of a plant, `events` its events, `model` goes from tick to tick;
//! `system` reads and compiles the texts to a `script`; `world` is what they call and do not state: functions of the
//! view file (`curves`) and shapes (`shapes`); `environment` answers `?E`. Absent: the language (`phytomer_rewriting`),
//! the turtle and its view files (beside), and the keys of a species.

mod columns;
mod curves;
mod draft;
mod environment;
mod events;
mod form;
mod model;
mod numbers;
mod role;
mod script;
mod shapes;
mod system;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_environment;
#[cfg(test)]
mod tests_shapes;
mod world;

pub use environment::Environment;
pub use model::{Life, TextModel};
pub use system::{TextSystem, Wrong};
