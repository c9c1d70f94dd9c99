//! Parametric trees: stems described by few numbers, level by level (Weber & Penn, *Creation and Rendering of Realistic
//! Trees*, 1995).
//!
//! Implemented are the first two levels of stems: the trunk with the splits at its base, and the branches on them.
//! [`Tree`] is the parameter struct with the paper's parameters, `compile` checks it, `equations` has the formulas of
//! §4.1 to §4.4, `stems` the draws and the stems of a plant, `model` writes the plant. The plant is rebuilt at any age.
//! The paper's trees have no age: a plant is a seed at age 0, and the whole tree from age 1 on. Absent on purpose:
//! splits along a stem, levels above 1, helices, spherical ends, flare, lobes, leaves, pruning, sway, vertical
//! attraction and degradation.

mod card;
mod checks;
mod compile;
mod equations;
mod keys;
mod looks;
mod model;
pub mod numbers;
pub mod params;
mod stems;
mod sway;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_plant;
mod tree;

pub use model::TreeModel;
pub use tree::{Branches, Crown, Tree, Trunk};
