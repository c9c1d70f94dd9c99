//! The script of plants: a compiled text, and what its modules are.
//!
//! Plants of one species share a script, unless they draw constants of their own. Absent: how a script is made
//! (`system`), and what is grown of it (`model`).

use super::role::Roles;
use phytomer_rewriting::Program;
use phytomer_sim::random::PlantRandom;
use std::fmt;

/// A program, and what its modules are.
#[derive(Debug)]
pub(super) struct Script {
    pub program: Program,
    pub roles: Roles,
}

/// The scripts of a species of which each plant draws constants of its own.
pub(super) trait Scripts: fmt::Debug + Send + Sync {
    /// The script of a plant.
    ///
    /// # Errors
    /// What is wrong with the text where its constants have the values of this plant.
    fn script(&self, random: &PlantRandom) -> Result<Script, String>;
}
