//! L-systems: strings of modules that are rewritten in parallel at each tick, and the plants that the strings describe.
//!
//! [`d0l`] holds the deterministic systems of Aono & Kunii 1984, stated in the species file. Absent on purpose: context,
//! parameters of modules, the environment.

pub mod d0l;

pub use d0l::{Cell, D0l, D0lModel};
