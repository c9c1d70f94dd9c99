//! Which of the 23 architectural models of Hallé, Oldeman & Tomlinson 1978 (*Tropical Trees and Forests*) a recorded
//! plant qualifies for, by topology, fates and trends.
//!
//! Rows of `components` become axes (`axes`), axes give [`Characters`], and each model is a list of required characters
//! (`models`). How far chance may carry a plant from the drawing of its model is in [`tolerance`]. Absent: how plants
//! grow, and the models that species files state, which the qualifiers do not read.

mod axes;
mod characters;
mod lie;
mod models;
mod of_run;
mod relays;
mod share;
pub mod tolerance;

pub use characters::{Characters, Untold};
pub use lie::Lie;
pub use models::{ARCHITECTURES, Architecture, Lacks};
pub use of_run::{LOOKED_AT, Qualified, qualified};
pub use relays::Relays;
pub use share::Share;

/// The names of all models for which a plant of these characters qualifies, in the order of [`ARCHITECTURES`]; empty
/// where it qualifies for none.
pub fn architectures(characters: &Characters) -> Vec<&'static str> {
    ARCHITECTURES.iter().filter(|model| model.qualify(characters).is_ok()).map(|model| model.name).collect()
}

/// The model with the name `name`, as species files write it; `None` where no model has this name.
pub fn architecture(name: &str) -> Option<&'static Architecture> {
    ARCHITECTURES.iter().find(|model| model.name == name)
}
