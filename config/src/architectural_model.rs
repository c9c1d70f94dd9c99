//! The names of the 23 architectural models of tropical trees, as species files state them.
//!
//! Absent: how a plant is classified as one of them (`phytomer_analysis::architecture`), and species that show each of
//! them (`presets/halle`).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The 23 architectural models of tropical trees (Hallé, Oldeman & Tomlinson 1978).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(inline)]
#[allow(missing_docs)]
pub enum ArchitecturalModel {
    Holttum,
    Corner,
    Tomlinson,
    Schoute,
    Chamberlain,
    McClure,
    Leeuwenberg,
    Koriba,
    Prevost,
    Fagerlind,
    Petit,
    Nozeran,
    Aubreville,
    Massart,
    Roux,
    Cook,
    Scarrone,
    Stone,
    Rauh,
    Attims,
    Mangenot,
    Champagnat,
    Troll,
}

impl ArchitecturalModel {
    /// Every model, in the order of Hallé, Oldeman & Tomlinson.
    pub const ALL: [Self; 23] = [
        Self::Holttum,
        Self::Corner,
        Self::Tomlinson,
        Self::Schoute,
        Self::Chamberlain,
        Self::McClure,
        Self::Leeuwenberg,
        Self::Koriba,
        Self::Prevost,
        Self::Fagerlind,
        Self::Petit,
        Self::Nozeran,
        Self::Aubreville,
        Self::Massart,
        Self::Roux,
        Self::Cook,
        Self::Scarrone,
        Self::Stone,
        Self::Rauh,
        Self::Attims,
        Self::Mangenot,
        Self::Champagnat,
        Self::Troll,
    ];

    /// The name of the model as the key `architectural_model` takes it, and as the shipped species in `halle/` are
    /// named.
    pub fn word(self) -> &'static str {
        match self {
            Self::Holttum => "holttum",
            Self::Corner => "corner",
            Self::Tomlinson => "tomlinson",
            Self::Schoute => "schoute",
            Self::Chamberlain => "chamberlain",
            Self::McClure => "mcclure",
            Self::Leeuwenberg => "leeuwenberg",
            Self::Koriba => "koriba",
            Self::Prevost => "prevost",
            Self::Fagerlind => "fagerlind",
            Self::Petit => "petit",
            Self::Nozeran => "nozeran",
            Self::Aubreville => "aubreville",
            Self::Massart => "massart",
            Self::Roux => "roux",
            Self::Cook => "cook",
            Self::Scarrone => "scarrone",
            Self::Stone => "stone",
            Self::Rauh => "rauh",
            Self::Attims => "attims",
            Self::Mangenot => "mangenot",
            Self::Champagnat => "champagnat",
            Self::Troll => "troll",
        }
    }
}
