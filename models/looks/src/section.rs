//! Cross sections of internodes that are no circles: corners around the axis line, in halves of the width; and rings
//! between base and tip, where the width does not change evenly from one to the other.
//!
//! A closed section is the border of a solid, an open one a thin strip that is bent across. Corners run
//! counterclockwise as seen against the heading. Absent: triangles (`phytomer_meshes`), and where sections come from.

/// A cross section.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Section {
    /// Up and to the side of the internode, its heading coming towards the viewer: the side is heading × up.
    corners: Vec<[f32; 2]>,
    closed: bool,
    /// From base to tip, each the share of the length and the bulge.
    rings: Vec<[f32; 2]>,
}

impl Section {
    /// The section of corners in either direction; those of a closed one are turned round where they run clockwise.
    pub fn of(mut corners: Vec<[f32; 2]>, closed: bool) -> Self {
        if closed && area(&corners) < 0.0 {
            corners.reverse();
        }
        Self { corners, closed, rings: Vec::new() }
    }

    /// The section with rings between base and tip: of each the share of the length at which it stands, between 0 and 1
    /// and rising, and its bulge: by how much half its width is above that of the even change from base to tip, in
    /// lengths of the internode.
    pub fn with_rings(self, rings: Vec<[f32; 2]>) -> Self {
        Self { rings, ..self }
    }

    /// The rings between base and tip: of each the share of the length, and the bulge in lengths of the internode.
    pub fn rings(&self) -> &[[f32; 2]] {
        &self.rings
    }

    /// Its corners, each once.
    pub fn corners(&self) -> &[[f32; 2]] {
        &self.corners
    }

    /// Whether the last corner is joined to the first.
    pub fn is_closed(&self) -> bool {
        self.closed
    }
}

/// The area within, in squares of half the width; negative where the corners run clockwise.
fn area(corners: &[[f32; 2]]) -> f64 {
    let next = |k: usize| corners[(k + 1) % corners.len()].map(f64::from);
    let twice = |(k, at): (usize, &[f32; 2])| {
        let ([x, y], [u, v]) = (at.map(f64::from), next(k));
        x * v - u * y
    };
    0.5 * corners.iter().enumerate().map(twice).sum::<f64>()
}
