//! Estimators of growth laws: functions from counts that people made on plants to parameters with their intervals.
//!
//! One law a module: [`activity`] (whether a bud grows at a tick), [`mortality`], [`nodes`] (nodes per growth unit),
//! [`crown`] (b₁, b₂ and w), [`branching`] (fates of axillary buds along a shoot). Each gives [`Fit`]s, and
//! [`choice`] compares the rivals of one data set by BIC. Absent on purpose: files, species, growth, and measures of
//! recorded runs.

pub mod abc;
pub mod activity;
pub mod branching;
pub mod calibration;
pub mod check;
pub mod choice;
pub mod crown;
pub mod data;
pub mod draws;
pub mod fit;
pub mod gmt;
pub mod json;
mod likelihood;
mod matrix;
pub mod mortality;
pub mod nodes;
mod optimum;
pub mod outcome;
pub mod problem;
pub mod proportions;
pub mod sensitivity;
pub mod special;
pub mod stated;
pub mod wanted;

pub use fit::{Estimate, Fit, Test};
pub use problem::Problem;
