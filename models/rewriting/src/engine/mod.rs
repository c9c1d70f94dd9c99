//! Derivation: which production applies where, what it makes, and how the string is rewritten.

mod choose;
mod context;
mod cut;
mod expand;
mod pieces;
mod step;

pub(crate) use context::Anchor;
pub(crate) use expand::{Expansion, Root};
pub(crate) use pieces::Pieces;
pub(crate) use step::{Bounds, sow, step};
