//! Geometric models: trees as repeated branchings, each child a ratio and an angle of its mother (Aono & Kunii,
//! *Botanical Tree Image Generation*, IEEE CG&A 4(5), 1984).
//!
//! [`Descriptor`] is the tree as people state it, with [`Rule`] for a branching and the small tables of `parts`;
//! [`GeometricTree`] joins several on one root, and [`Gmt1`] to [`Gmt4`] are the four models of it. `keys` says which
//! type takes which key, `courses` and `foliage` read keys, `compile` leads to the `plan` of a tree, with its `laws`
//! and `counts`, and `checks` it. `branching`, `course` and `deviators` are the paper's equations, `level` and `tree` a
//! tree that they build, `model` its growth, level by level. The models have no buds, and nothing is random once a
//! plant has its numbers, but the angles of GMT4: the plant is rebuilt at each age, and the heading of each internode
//! is stated.

mod branching;
mod checks;
mod compile;
mod counts;
mod course;
mod courses;
mod descriptor;
mod deviators;
mod foliage;
mod gmt;
mod keys;
mod laws;
mod level;
mod model;
mod parts;
mod plan;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_changing;
#[cfg(test)]
mod tests_composed;
#[cfg(test)]
mod tests_deviated;
#[cfg(test)]
mod tests_drawn;
#[cfg(test)]
mod tests_forecast;
#[cfg(test)]
mod tests_parameters;
mod tree;

pub use branching::{child, left_of};
pub use course::{Category, Curve};
pub use descriptor::{CombinedLevels, Descriptor, GeometricTree, GluedTree, MOST_LEVELS, Rule, TreeType};
pub use gmt::{Gmt1, Gmt2, Gmt3, Gmt4};
pub use model::GeometricModel;
pub use parts::{Controller, CutLateral, Falloff, TreeLeaf};
