//! The form in which an organ is drawn, as a number.
//!
//! Growth, pose and mechanics do not ask what a form looks like: the plant carries its number for those that draw it.
//! Absent: names and areas of forms (`phytomer_looks`), and their triangles (`phytomer_meshes`).

/// The number of the form in which an organ is drawn: those of the library come first, then the meshes of the user's
/// that its species names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Form(pub u8);
