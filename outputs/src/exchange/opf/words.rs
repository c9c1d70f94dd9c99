//! The words of OPF files: classes of entities, and the attributes that the description has fields for.

use super::super::description::Role;

/// What entities of a class are, by the words that programs use.
pub(super) fn role(class: &str) -> Role {
    let word = class.trim_end_matches(|c: char| c.is_ascii_digit() || c == '_').to_ascii_lowercase();
    match word.as_str() {
        "scene" => Role::Scene,
        "individual" | "plant" | "tree" | "p" => Role::Plant,
        "axis" | "axe" | "a" => Role::Axis,
        "growthunit" | "growth_unit" | "gu" | "uc" | "u" => Role::GrowthUnit,
        "metamer" | "internode" | "phytomer" | "segment" | "cylinder" | "entrenoeud" | "en" | "i" | "stem" => {
            Role::Internode
        }
        "leaf" | "leaflet" | "feuille" | "lamina" | "l" => Role::Leaf,
        "flower" | "inflorescence" | "fleur" | "f" => Role::Flower,
        "fruit" | "bunch" | "r" => Role::Fruit,
        _ => Role::Other,
    }
}

/// The class of an entity in a file: the word for what this program calls by a letter, else the symbol as it is.
pub(super) fn class(symbol: &str, role: Role) -> &str {
    match (symbol, role) {
        ("P", Role::Plant) => "Individual",
        ("A", Role::Axis) => "Axis",
        ("U", Role::GrowthUnit) => "GrowthUnit",
        ("I", Role::Internode) => "Internode",
        ("L", Role::Leaf) => "Leaf",
        ("F", Role::Flower) => "Flower",
        ("R", Role::Fruit) => "Fruit",
        _ => symbol,
    }
}

/// An attribute that the description has a field for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Known {
    /// Length.
    Length,
    /// Diameter at the base, width of an organ.
    Width,
    /// Diameter at the tip.
    TipWidth,
    /// Area of one side.
    Area,
    /// The index after the symbol.
    Index,
    /// The age of the plant at birth.
    BirthAge,
    /// The age of the plant at death.
    DeathAge,
    /// Whether it is dead.
    Dead,
    /// What the plant is called.
    PlantName,
    /// Its species.
    Species,
    /// Its age.
    PlantAge,
    /// Ticks of a year.
    TicksPerYear,
}

/// All of them: the name in a file, and its class.
pub(super) const KNOWN: [(Known, &str, &str); 12] = [
    (Known::Length, "Length", "Double"),
    (Known::Width, "Width", "Double"),
    (Known::TipWidth, "TipWidth", "Double"),
    (Known::Area, "Area", "Double"),
    (Known::Index, "Index", "Double"),
    (Known::BirthAge, "BirthAge", "Integer"),
    (Known::DeathAge, "DeathAge", "Integer"),
    (Known::Dead, "Dead", "Boolean"),
    (Known::PlantName, "PlantName", "String"),
    (Known::Species, "Species", "String"),
    (Known::PlantAge, "PlantAge", "Integer"),
    (Known::TicksPerYear, "TicksPerYear", "Double"),
];

/// The field of an attribute.
pub(super) fn known(name: &str) -> Option<Known> {
    KNOWN.into_iter().find(|(_, word, _)| *word == name).map(|(known, ..)| known)
}

/// Whether an element of an entity with this name is no attribute.
pub(super) fn is_structure(name: &str) -> bool {
    matches!(name, "topology" | "decomp" | "follow" | "branch" | "geometry")
}
