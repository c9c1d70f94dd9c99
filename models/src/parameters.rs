//! What a growth model offers to everything above it: a word, a sentence, the shape of its keys in a species file, and
//! what can be asked of its parameters.
//!
//! A model implements [`Parameters`] for its parameter struct, in its own folder. Reading files, inheritance, faults
//! with their places, lists and descriptions ask the [`Card`] and never which model it is. Absent: files and schemas
//! (`config`).

use crate::fault::{Fault, Path};
use phytomer_sim::Tick;
use phytomer_sim::model::GrowthModel;
use std::sync::Arc;

/// What a model is called, and how its keys stand in a species file.
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
    /// Keys to which others refer: where one is refused, what is left would look wrong and is not judged.
    pub referred_to: &'static [&'static str],
    /// The table of the species' wood, which may also stand in each table by place; `like` in it takes from the shipped
    /// woods.
    pub wood: Option<Together>,
    /// The parts of each table by place that may have a form of the user's.
    pub formed: &'static [&'static str],
}

/// A list of tables that merge by their place, and the table of what holds for each of them.
#[derive(Debug)]
pub struct ByPlace {
    /// The key of the list.
    pub list: &'static str,
    /// The key of the table whose values hold where a table of the list states none.
    pub every: &'static str,
}

/// A table whose values are judged together: where one is refused the rest is not judged without it.
#[derive(Debug)]
pub struct Together {
    /// Its key.
    pub table: &'static str,
    /// The keys in it that can be left out by themselves.
    pub apart: &'static [&'static str],
}

impl Keys {
    /// Keys of which none has a role.
    pub const PLAIN: Self = Self { by_place: None, referred_to: &[], wood: None, formed: &[] };
}

/// The parameters of a growth model, as people state them.
pub trait Parameters {
    /// What the model is called, and how its keys stand.
    fn card(&self) -> &'static Card;

    /// The model compiled for all ages up to `until`, every law checked over its whole range.
    ///
    /// # Errors
    /// Every fault that there is, each with its path below `top`.
    fn model(&self, until: Tick, top: &Path) -> Result<Arc<dyn GrowthModel>, Vec<Fault>>;

    /// The files of the meshes that the species names as forms, each once, in the order of their numbers, with the
    /// place of the first mention.
    fn own_forms(&self) -> Vec<(Path, &str)> {
        Vec::new()
    }

    /// States the area share of leaves that are drawn with a mesh of the user's and state none, as `share` tells it by
    /// the mesh's number. Whether there is any such leaf; the model is then to be compiled again.
    fn state_area_shares(&mut self, share: &dyn Fn(usize) -> Option<f64>) -> bool {
        let _ = share;
        false
    }

    /// The ticks of a year that the parameters state, with the place.
    fn year(&self) -> Option<(Path, u32)> {
        None
    }

    /// The age from which nothing more grows, where the parameters say it.
    fn full_grown_at(&self) -> Option<Tick> {
        None
    }
}
