//! glTF 2.0 in one binary file (GLB): what viewers, engines and Blender open without an importer of ours.
//!
//! [`write_still`] writes a mesh at one age, [`write_levels`] its levels of detail, [`write_plant_instanced`] a mesh
//! with its organs as instances, [`write_growth`] a whole life as morph targets, and [`Sway`] a plant on a skeleton
//! that the wind moves. Metres, Y up, colours of vertices in linear light. JSON by serde_json; the bytes are ours,
//! since no crate writes accessors as a stream. Pictures of a species are in the files of one age. Absent: meshopt and
//! Draco, which few programs read.

mod body;
mod document;
mod growth;
mod instanced;
mod keys;
mod levels;
mod morph;
mod paint;
mod rig;
mod still;
mod sway;
mod tangents;
#[cfg(test)]
mod tests;
mod wood;

pub use body::Body;
pub use growth::{Growth, Written, write_growth};
pub use instanced::{write_plant_instanced, write_plot_instanced};
pub use keys::{KeyMaker, Keyed};
pub use levels::{LastCards, Level, write_levels};
pub use rig::MOST_JOINTS;
pub use still::write_still;
pub use sway::Sway;
