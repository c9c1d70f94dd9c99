//! Which of the 23 architectural models of Hallé, Oldeman & Tomlinson 1978 (*Tropical Trees and Forests*) a recorded
//! plant qualifies for: a classifier over what tables say, never over looks.
//!
//! Rows of `components` become axes (`axes`), axes give [`Characters`], and each model is a readable qualifier over the
//! characters (`models`). How far chance may carry a plant from the drawing of its model is in [`tolerance`]. Absent:
//! how plants grow; the qualifiers know nothing of species files.

mod axes;
mod characters;
mod lie;
mod models;
mod of_run;
mod relays;
mod share;
pub mod tolerance;

pub use characters::Characters;
pub use lie::Lie;
pub use models::{ARCHITECTURES, Architecture, Lacks};
pub use of_run::{LOOKED_AT, Qualified, qualified};
pub use relays::Relays;
pub use share::Share;

/// The names of the models for which a plant of these characters qualifies.
pub fn architectures(characters: &Characters) -> Vec<&'static str> {
    ARCHITECTURES.iter().filter(|model| model.qualify(characters).is_ok()).map(|model| model.name).collect()
}

/// The model of that name.
pub fn architecture(name: &str) -> Option<&'static Architecture> {
    ARCHITECTURES.iter().find(|model| model.name == name)
}
