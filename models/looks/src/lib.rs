//! What the components of a species look like (de Reffye 1988 §6), where models state it and meshes draw it: the table
//! of forms, and colours.
//!
//! The plant itself carries numbers alone: that of a form ([`phytomer_sim::plant::Form`]) and that of a paint among the
//! [`Paints`] of its species. A model that states colours puts them into the habit, and a mesh takes them out again.
//! Absent: triangles and the colours of what states none (`phytomer_meshes`), and how a file states all this
//! (`phytomer_models`).

mod form;
mod paint;

pub use form::{FormName, own_form, place_of_own};
pub use paint::{Bark, Colour, InternodePaint, OrganPaint, Paints};
