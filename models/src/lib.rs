//! Growth models, peers of one another: each its documented parameter struct, then its formulas.

pub mod buds;
pub mod fault;
