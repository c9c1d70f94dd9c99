//! The form in which an organ is drawn, as a number.
//!
//! Growth, pose and mechanics do not depend on what a form looks like: the plant carries its number, and meshes draw
//! it. Absent: names and areas of forms (`phytomer_looks`), and their triangles (`phytomer_meshes`).

/// The number of the form in which an organ is drawn: forms of the library come first, then the user's meshes that its
/// species names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Form(pub u8);
