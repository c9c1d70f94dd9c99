//! The state of one plant between two steps: its string, the variables of the program, and the source of its draws.
//!
//! A [`Derived`] belongs to the program that sowed it, which alone changes it. Absent: the derivation (`engine`).

use crate::string::{ModuleString, Slot};
use phytomer_sim::key::LineageKey;
use phytomer_sim::random::PlantRandom;

/// What a derivation has come to.
#[derive(Debug, Clone)]
pub struct Derived {
    pub(crate) string: ModuleString,
    /// The modules that a production may rewrite, in the order of the string.
    pub(crate) active: Vec<Slot>,
    /// The modules of which each step changes the parameters and nothing else, by their slots as they came.
    pub(crate) updated: Vec<Slot>,
    /// Room for the active modules of the next step.
    pub(crate) spare: Vec<Slot>,
    pub(crate) variables: Variables,
    /// The modules that the last step has cut off, by their keys.
    pub(crate) cut: Vec<LineageKey>,
    pub(crate) step: u32,
    pub(crate) random: PlantRandom,
}

/// The variables of blocks and the arrays, each by its number.
#[derive(Debug, Clone, Default)]
pub(crate) struct Variables {
    pub values: Vec<f64>,
    pub arrays: Vec<Vec<f64>>,
    /// What `seed:` and `srand` have set; a part of the key of every draw.
    pub seed: u64,
}

impl Derived {
    /// The string, with the answers to its queries.
    pub fn string(&self) -> &ModuleString {
        &self.string
    }

    /// The keys of the modules that `%` has cut off in the last step, in the order of the string.
    pub fn cut(&self) -> &[LineageKey] {
        &self.cut
    }

    /// How many steps have been made; 0 at the axiom.
    pub fn step(&self) -> u32 {
        self.step
    }
}

/// A module as it is drawn: a module of the string, or what the homomorphism makes of one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drawn<'d> {
    /// Its name.
    pub symbol: crate::symbol::Symbol,
    /// Its parameters.
    pub parameters: &'d [f64],
    /// The key of the module, or the key of its module and its path in what that is drawn as.
    pub key: phytomer_sim::key::LineageKey,
    /// The module of the string that it is, or that is drawn as it.
    pub of: Slot,
    /// How many productions of the homomorphism lie between the module and this: 0 for the module itself.
    pub depth: u32,
}
