//! Geometric models: trees as repeated branchings, each child a fixed ratio and angle of its mother (Aono & Kunii,
//! *Botanical Tree Image Generation*, IEEE CG&A 4(5), 1984).
//!
//! [`Gmt1`] is the parameter struct, `laws` has a plant's draws of the parameters, `branching` the paper's equations,
//! `tree` a tree that they build, `model` its growth, level by level, and `compile` leads from the parameters to the
//! model. The model has no buds, and nothing is random once a plant has its parameters: the plant is rebuilt at each
//! age, and the heading of each internode is stated. Absent on purpose: the deviators, ternary branching and statistics
//! of GMT2 to GMT4.

mod branching;
mod card;
mod compile;
mod gmt1;
mod laws;
mod model;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_drawn;
#[cfg(test)]
mod tests_parameters;
mod tree;

pub use branching::{child, left_of};
pub use gmt1::{Gmt1, MOST_LEVELS};
pub use model::Gmt1Model;
