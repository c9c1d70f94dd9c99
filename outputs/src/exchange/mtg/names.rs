//! What features and classes mean, by their names; and the names that are written.
//!
//! The reserved names of the format come first and in its order. The others are those of digitised plants, in English
//! and in French, and of Xplo.

use crate::exchange::description::Role;

/// A quantity for which a description has a field.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Meaning {
    Length,
    BaseDiameter,
    TipDiameter,
    Area,
    /// A coordinate of its place.
    Place(usize),
    /// A component of its direction.
    Direction(usize),
    /// A component of the direction of its upper side.
    Up(usize),
    Birth,
    Death,
    /// Whether it lives.
    State,
    /// The age of the plant.
    Age,
    Date,
    /// A name by which codes call the entity.
    Alias,
    /// Nothing that a description has a field for.
    Other,
}

/// The features that are written, in order, with their types.
pub const WRITTEN: [(&str, &str, Meaning); 17] = [
    ("Length", "REAL", Meaning::Length),
    ("BottomDiameter", "REAL", Meaning::BaseDiameter),
    ("TopDiameter", "REAL", Meaning::TipDiameter),
    ("State", "ALPHA", Meaning::State),
    ("XX", "REAL", Meaning::Place(0)),
    ("YY", "REAL", Meaning::Place(1)),
    ("ZZ", "REAL", Meaning::Place(2)),
    ("birth", "INT", Meaning::Birth),
    ("death", "INT", Meaning::Death),
    ("area", "REAL", Meaning::Area),
    ("DirX", "REAL", Meaning::Direction(0)),
    ("DirY", "REAL", Meaning::Direction(1)),
    ("DirZ", "REAL", Meaning::Direction(2)),
    ("UpX", "REAL", Meaning::Up(0)),
    ("UpY", "REAL", Meaning::Up(1)),
    ("UpZ", "REAL", Meaning::Up(2)),
    ("age", "INT", Meaning::Age),
];

/// Names that openalea.mtg gives its own functions as arguments: a feature of such a name destroys its graph.
pub const TAKEN: [&str; 10] =
    ["component_id", "parent", "parent_id", "child", "complex", "complex_id", "label", "index", "edge_type", "vid"];

/// The first words of the first line of a file of this program.
pub const MARK: &str = "# phytomer: lengths in metres, XX YY ZZ the base of a component, ages in ticks";

/// What a feature means. Directions, births and the like are ours: other files have their own meanings of such names,
/// so they are taken for it where the file is marked alone.
pub fn meaning(name: &str, marked: bool) -> Meaning {
    let lower = name.to_ascii_lowercase();
    if marked && let Some((_, _, meaning)) = WRITTEN.iter().find(|(known, ..)| known.eq_ignore_ascii_case(name)) {
        return *meaning;
    }
    match lower.as_str() {
        "length" | "long" | "longueur" => Meaning::Length,
        "bottomdiameter" | "bottomdia" | "botdia" | "basdia" | "diabase" | "width" => Meaning::BaseDiameter,
        "topdiameter" | "topdia" | "diasom" => Meaning::TipDiameter,
        "area" => Meaning::Area,
        "xx" => Meaning::Place(0),
        "yy" => Meaning::Place(1),
        "zz" => Meaning::Place(2),
        "alias" => Meaning::Alias,
        _ => Meaning::Other,
    }
}

/// What entities of a class are: by a word in full, else by the letters that this program writes. The coarsest scale is
/// that of plants; letters mean axes and internodes only in their scale.
pub fn role(symbol: &str, scale: u32, scales: (u32, u32), marked: bool) -> Role {
    match symbol.to_ascii_lowercase().as_str() {
        "scene" => return Role::Scene,
        "plant" | "individual" | "tree" => return Role::Plant,
        "axis" | "axe" => return Role::Axis,
        "growthunit" | "growth_unit" | "gu" => return Role::GrowthUnit,
        "internode" | "metamer" | "phytomer" | "segment" | "cylinder" => return Role::Internode,
        "leaf" | "leaflet" => return Role::Leaf,
        "flower" | "inflorescence" => return Role::Flower,
        "fruit" => return Role::Fruit,
        _ => {}
    }
    let (coarsest, finest) = scales;
    match symbol {
        "P" if scale == coarsest => Role::Plant,
        "A" if scale > coarsest && scale < finest => Role::Axis,
        "U" if scale > coarsest && scale < finest => Role::GrowthUnit,
        "I" if scale == finest => Role::Internode,
        "L" if marked => Role::Leaf,
        "F" if marked => Role::Flower,
        "R" if marked => Role::Fruit,
        _ if scale == coarsest && coarsest < finest => Role::Plant,
        _ => Role::Other,
    }
}
