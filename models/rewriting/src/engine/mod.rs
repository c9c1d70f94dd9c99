//! Derivation: which production applies where, what it makes, and how the string is rewritten.

mod bounds;
mod choose;
mod context;
mod cut;
mod expand;
mod pieces;
mod placing;
mod predecessor;
mod rewriting;
mod step;

pub(crate) use bounds::Bounds;
pub(crate) use context::Anchor;
pub(crate) use expand::{Expansion, Root};
pub(crate) use pieces::Pieces;
pub(crate) use step::{sow, step};
