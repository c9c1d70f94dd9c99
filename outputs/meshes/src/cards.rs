//! Crossed cards that stand for a whole plant: upright quads with pictures of it in one atlas.
//!
//! Absent: how the pictures are made (`phytomer_pictures::cards`), and files.

/// A card: an upright rectangle, seen from both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Card {
    /// Its corners, metres: lower left, lower right, upper right and upper left, as its front is seen.
    pub corners: [[f32; 3]; 4],
    /// The unit vector towards who sees its front.
    pub normal: [f32; 3],
    /// The texture coordinates of the corners, from the lower left of the atlas.
    pub texture: [[f32; 2]; 4],
}

/// Cards and their atlas.
#[derive(Debug, Clone, PartialEq)]
pub struct Cards {
    /// The cards.
    pub cards: Vec<Card>,
    /// Colour and opacity as PNG with four channels; what is more than half opaque is shown. Colours go on beyond what
    /// is shown, so that smaller copies have no fringe.
    pub colours: Vec<u8>,
    /// Normals as PNG: red to the right, green up, blue towards the viewer.
    pub normals: Vec<u8>,
}

impl Cards {
    /// The triangles of a card, by its corners.
    pub const FACES: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

    /// The number of triangles.
    pub fn faces(&self) -> u64 {
        (self.cards.len() * Self::FACES.len()) as u64
    }
}
