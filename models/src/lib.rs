//! Growth models, peers of one another: each its documented parameter struct, then its formulas.
//!
//! A model reads no file and draws no triangle; it grows plants of `phytomer_sim` and returns faults with the paths of
//! the parameters. A new model is a folder here, a line here, and a variant in `config`. The numbers that a file may
//! hold (bare, with a source, or drawn) are the same for all models and have a crate of their own, `phytomer_law`,
//! which is [`law`] here. Shapes as people state them are the same for all models too ([`shapes`]).

pub mod buds;
pub mod cellular;
pub mod contract;
pub mod geometric;
pub mod lsystem;
pub mod parameters;
pub mod parametric;
pub mod shapes;
mod turns;

pub use phytomer_law as law;
pub use phytomer_law::fault;
