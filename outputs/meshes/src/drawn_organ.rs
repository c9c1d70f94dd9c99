//! An organ as a scene draws it. Absent: how it is found (`scene`), and the triangles of its form (`forms`).

use super::outline::OwnForm;

/// An organ as it is drawn: where, how large and in what colours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrawnOrgan {
    /// Its base, metres.
    pub base: [f32; 3],
    /// The unit vector along it.
    pub heading: [f32; 3],
    /// The unit vector of its upper side.
    pub up: [f32; 3],
    /// Its length and width at its age, metres, and 0; of an organ with an outline of its own the share of it, twice,
    /// and 0; of a curved surface the factors along the organ, to its left and to its upper side.
    pub size: [f32; 3],
    /// How much fuller it is than its form, so that it has its area.
    pub fullness: f32,
    /// The colours of the organ and of its stalk.
    pub colours: [[u8; 4]; 2],
    /// The form that it has instead of that of its column.
    pub own: OwnForm,
}
