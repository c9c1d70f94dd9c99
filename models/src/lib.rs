//! Growth models, peers of one another: each its documented parameter struct, then its formulas.
//!
//! A model reads no file and draws no triangle; it grows plants of `phytomer_sim` and tells its faults by paths. A new
//! one is a folder here, a line here, and a variant in `config`. What a number of a file may be, bare, with its source
//! or drawn, is one for all models: [`law`].

pub mod buds;
pub mod contract;
pub mod fault;
pub mod geometric;
pub mod law;
pub mod lsystem;
pub mod parameters;
