//! Scenario and species files: reading them, inheritance, and every fault at once with its place in the file.
//!
//! A file becomes a tree with spans (`document`), the tree is held against the schema of its types (`schema`), species
//! inherit (`inherit`), and what the models find wrong is shown where it was typed (`report`).
//! Absent: growth formulas, and anything that runs.

pub mod document;
pub mod inherit;
pub mod library;
pub mod report;
pub mod schema;
pub mod source;
mod spelling;
