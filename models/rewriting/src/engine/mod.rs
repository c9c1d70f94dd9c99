//! Derivation: which production applies where, what it makes, and how the string is rewritten.
//!
//! `step` is the entry; `rewriting` goes through the string, `choose` finds the production, `placing` changes the
//! string. Absent: the reading of texts (`text`, `syntax`, `compile`), and expressions (`evaluate`).

mod bounds;
mod choose;
mod context;
mod cut;
mod expand;
mod pieces;
mod placing;
mod predecessor;
mod rewriting;
mod rows;
mod step;
mod visits;

pub(crate) use bounds::Bounds;
pub(crate) use context::Anchor;
pub(crate) use expand::{Expansion, Root};
pub(crate) use pieces::Pieces;
pub(crate) use rows::lay_rows;
pub(crate) use step::{sow, step};
