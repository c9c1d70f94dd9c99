//! Growth models, peers of one another: each its documented parameter struct, then its formulas.
//!
//! A model reads no file and draws no triangle; it grows plants of `phytomer_sim` and tells its faults by paths. A new
//! one is a folder here, a line here, and a variant in `config`. What a number of a file may be, bare, with its source
//! or drawn, is the same for all models and has a crate of its own, `phytomer_law`, which is [`law`] here.

pub mod buds;
pub mod contract;
pub mod geometric;
pub mod lsystem;
pub mod parameters;
pub mod parametric;

pub use phytomer_law as law;
pub use phytomer_law::fault;
