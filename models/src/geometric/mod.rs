//! Geometric models: trees as repeated branchings, each child a fixed ratio and angle of its mother (Aono & Kunii,
//! *Botanical Tree Image Generation*, IEEE CG&A 4(5), 1984).
//!
//! [`Gmt1`] is the parameter struct, `branching` the paper's equations, `model` the tree that they build, level by
//! level. Such a model knows no buds and draws nothing at random: it rebuilds the plant at each age, and states the
//! heading of each internode itself.
//! Absent on purpose: the deviators, ternary branching and statistics of GMT2 to GMT4.

mod branching;
mod gmt1;
mod model;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_parameters;

pub use branching::{child, left_of};
pub use gmt1::{Gmt1, MOST_LEVELS};
pub use model::Gmt1Model;
