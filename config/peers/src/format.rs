//! The formats that are read, by their words, endings and keys.
//!
//! Absent: reading (`reading`).

use crate::value::Entry;

/// Whose file it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Arbaro's XML.
    Arbaro,
    /// tree-gen's Python dictionaries.
    TreeGen,
    /// Sapling's Python dictionaries, the presets of Blender's tree generator.
    Sapling,
    /// The XML of Helios' library of Weber–Penn trees.
    Helios,
    /// A JSON object with the paper's names, or with the keys of tree-gen or Sapling.
    Json,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Arbaro, Self::TreeGen, Self::Sapling, Self::Helios, Self::Json];

    /// The word that people say.
    pub fn word(self) -> &'static str {
        match self {
            Self::Arbaro => "arbaro",
            Self::TreeGen => "tree-gen",
            Self::Sapling => "sapling",
            Self::Helios => "helios",
            Self::Json => "json",
        }
    }

    /// The name of the program.
    pub fn program(self) -> &'static str {
        match self {
            Self::Arbaro => "Arbaro",
            Self::TreeGen => "tree-gen",
            Self::Sapling => "Sapling",
            Self::Helios => "Helios",
            Self::Json => "JSON",
        }
    }

    /// The format of a word.
    pub fn of_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.word() == word)
    }
}

/// What the ending of a file tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Syntax {
    Xml,
    Python,
    Json,
}

impl Syntax {
    /// That of the ending of a name; `None` where it tells nothing.
    pub fn of_name(name: &str) -> Option<Self> {
        let ending = name.rsplit_once('.').map(|(_, ending)| ending.to_ascii_lowercase())?;
        match ending.as_str() {
            "xml" => Some(Self::Xml),
            "py" => Some(Self::Python),
            "json" => Some(Self::Json),
            _ => None,
        }
    }
}

impl From<Format> for Syntax {
    fn from(format: Format) -> Self {
        match format {
            Format::Arbaro | Format::Helios => Self::Xml,
            Format::TreeGen | Format::Sapling => Self::Python,
            Format::Json => Self::Json,
        }
    }
}

/// Whose keys these are; `None` where neither tree-gen nor Sapling has any of them.
pub(crate) fn of_keys(entries: &[Entry]) -> Option<Format> {
    let has = |keys: &[&str]| entries.iter().any(|entry| keys.contains(&entry.key.as_str()));
    let tree_gen = ["g_scale", "ratio_power", "leaf_blos_num", "base_size", "down_angle", "curve_res"];
    let sapling = ["ratioPower", "baseSize", "downAngle", "curveRes", "scaleV", "leafScale"];
    if has(&tree_gen) { Some(Format::TreeGen) } else { has(&sapling).then_some(Format::Sapling) }
}
