//! glTF 2.0 in one binary file (GLB): what viewers, engines and Blender open without an importer of ours.
//!
//! [`write_still`] writes a mesh at one age. Metres, Y up, colours of vertices in linear light. JSON by serde_json; the
//! bytes are ours, since no crate writes accessors as a stream. Absent: meshopt and Draco, which few programs read, and
//! textures.

mod document;
mod paint;
mod still;

pub use still::{Binding, Bound, Still, write_still};
