//! Meshes of the user's as forms: triangles moved and scaled into the unit box of the library.
//!
//! Absent: reading them from files.

use super::Shape;

/// The meshes of its own that a species names, in the order of their numbers.
#[derive(Debug, Clone, Default)]
pub struct OwnForms {
    shapes: Vec<Shape>,
}

impl OwnForms {
    /// The shape at a place.
    pub(crate) fn shape(&self, place: u8) -> Option<&Shape> {
        self.shapes.get(usize::from(place))
    }
}
