//! The A-system: scripts of its command language run on a stage of trees, and workstations show them (Aono & Kunii,
//! *Botanical Tree Image Generation*, IEEE CG&A 4(5), 1984).
//!
//! [`checked`] reads a script and holds its trees against their model before anything is drawn; [`Stage`] runs it.
//! `trees` are what a script has said of them, `grown` their plants, `drawn` the drawings of these, `foliage` their
//! leaves, `stations` the workstations, `stars` their controllers in a model, `files` what is written. Absent: the
//! language itself (`phytomer_asystem`).

mod cast;
mod checked;
mod drawn;
mod files;
mod foliage;
mod grown;
mod recorded;
mod stage;
mod stars;
mod stations;
#[cfg(test)]
mod tests;
mod trees;

pub use checked::{Checked, checked, checked_typing};
pub use files::StageError;
pub use grown::{MOST_COMPONENTS, full_grown};
pub use recorded::{RecordedError, record};
pub use stage::{Stage, Written};
pub use stations::SIZE;
