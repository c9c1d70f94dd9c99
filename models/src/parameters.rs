//! The interface of a growth model's parameters: a name, a sentence, the roles of its keys in a species file, and the
//! operations on its parameters.
//!
//! A model implements [`Parameters`] for its parameter struct, in its own folder. Reading files, inheritance, faults
//! with their places, lists and descriptions use the [`Card`], and have no code for a single model. Absent: files and
//! schemas (`config`).

use crate::fault::{Fault, Path};
use crate::law::Variate;
use crate::shapes::Shapes;
use phytomer_sim::Tick;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::site::calendar::Dates;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The name of a model, a sentence about it, and the roles of its keys in a species file.
#[derive(Debug)]
pub struct Card {
    /// The word of the key `model` of a species file.
    pub word: &'static str,
    /// One line about it, with its source.
    pub about: &'static str,
    /// Its keys.
    pub keys: Keys,
}

/// Which keys of a species file have a role beyond that of their values.
#[derive(Debug)]
pub struct Keys {
    /// The list of tables that merge by their place between a species and the one that it inherits from.
    pub by_place: Option<ByPlace>,
    /// Keys to which other keys refer: where such a key is refused, the keys that refer to it would look wrong and are
    /// not checked.
    pub referred_to: &'static [&'static str],
    /// The table of the species' wood, which may also stand in each table by place; its key `like` names a wood of the
    /// shipped table.
    pub wood: Option<Together>,
    /// The parts of each table by place that may be drawn with a user's mesh.
    pub formed: &'static [&'static str],
    /// The key that names a file whose text, with those of the files beside it, the table `texts` holds.
    pub texts: Option<&'static str>,
}

/// A list of tables that merge by their place, and the table of what holds for each of them.
#[derive(Debug)]
pub struct ByPlace {
    /// The key of the list.
    pub list: &'static str,
    /// The key of the table whose values hold where a table of the list states none.
    pub every: &'static str,
}

/// A table whose values are checked together: where some value is refused, the rest of the table is not checked without
/// it.
#[derive(Debug)]
pub struct Together {
    /// Its key.
    pub table: &'static str,
    /// The keys in the table that can be refused alone.
    pub apart: &'static [&'static str],
}

impl Keys {
    /// No key has a role.
    pub const PLAIN: Self = Self { by_place: None, referred_to: &[], wood: None, formed: &[], texts: None };
}

/// What a scenario states for the models of its species: shapes of its site, and constants.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Surroundings {
    /// The shapes of the site, by their names.
    pub shapes: Shapes,
    /// The constants, by their names.
    pub constants: BTreeMap<String, Variate>,
}

/// A tree whose stems have levels, as it is at an age: what scales the ranges at which its elements are drawn
/// (Weber & Penn 1995 §5).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Levelled {
    /// Its quality, above 0.
    pub quality: f64,
    /// Whether it is in leaf and not in spring, or evergreen: leaves then hide its stems.
    pub in_leaf: bool,
    /// Whether it is in spring, and its leaves are small.
    pub spring: bool,
}

/// The parameters of a growth model, as people state them.
pub trait Parameters {
    /// The name of the model, and the roles of its keys.
    fn card(&self) -> &'static Card;

    /// The model compiled for all ages up to `until`, every law checked over its whole range. `dates` are those of the
    /// ages, for laws that depend on the date; `None` without a calendar.
    ///
    /// # Errors
    /// Every fault found, each with its path below `top`.
    fn model(&self, until: Tick, dates: Option<&Dates>, top: &Path) -> Result<Arc<dyn GrowthModel>, Vec<Fault>>;

    /// The files of the meshes that the species names as forms, each once, in the order of their numbers, with the path
    /// of the first mention. Empty unless the model has own forms.
    fn own_forms(&self) -> Vec<(Path, &str)> {
        Vec::new()
    }

    /// Sets the area share of each leaf that is drawn with a user's mesh and states no area share. `share` takes the
    /// number of a mesh and gives its share, or `None`. Returns whether any leaf was changed; the model is then to be
    /// compiled again.
    fn state_area_shares(&mut self, share: &dyn Fn(usize) -> Option<f64>) -> bool {
        let _ = share;
        false
    }

    /// Whether the model reads what a scenario states for it.
    fn reads_surroundings(&self) -> bool {
        false
    }

    /// States in the parameters what a scenario states, in place of what they state under the same names.
    fn surround(&mut self, surroundings: &Surroundings) {
        let _ = surroundings;
    }

    /// The ticks of a year that the parameters state, with the path; `None` where they state no year.
    fn year(&self) -> Option<(Path, u32)> {
        None
    }

    /// The names of the states that an axis can be in, in the order of their numbers; empty where the model has none.
    fn states(&self) -> &[String] {
        &[]
    }

    /// A tree of stems by levels as it is at `age`; `None` where the plants of the model have no levels.
    fn levelled(&self, age: Tick) -> Option<Levelled> {
        let _ = age;
        None
    }

    /// States the quality of the tree. Returns whether the model has one; it is then to be compiled again.
    fn set_quality(&mut self, quality: f64) -> bool {
        let _ = quality;
        false
    }

    /// The age from which nothing more grows, or at which it is meant to be looked at, where the parameters determine
    /// it.
    fn full_grown_at(&self) -> Option<Tick> {
        None
    }
}
