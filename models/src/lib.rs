//! Growth models, peers of one another: each its documented parameter struct, then its formulas.

pub mod buds;
pub mod contract;
pub mod fault;
pub mod geometric;
