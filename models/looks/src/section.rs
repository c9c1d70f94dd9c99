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

impl Section {
    /// The volume of an internode of a closed section over that of the frustum of circles as wide at its ends: by the
    /// area within the corners, and by frusta from ring to ring. `radii` are half the widths at base and tip, in the
    /// unit of `length`. 1 for an open section, which encloses nothing.
    pub fn bulk(&self, radii: [f64; 2], length: f64) -> f64 {
        let frustum = |a: f64, b: f64| a * a + a * b + b * b;
        let round = frustum(radii[0], radii[1]);
        if !self.closed || round <= 0.0 {
            return 1.0;
        }
        let even = |share: f64| radii[0] + share * (radii[1] - radii[0]);
        let (mut below, mut sum) = ([0.0, radii[0]], 0.0);
        let inner = self.rings.iter().map(|ring| ring.map(f64::from));
        let rings = inner.map(|[share, bulge]| [share, (even(share) + bulge * length).max(0.0)]);
        for [share, radius] in rings.chain([[1.0, radii[1]]]) {
            sum += (share - below[0]) * frustum(below[1], radius);
            below = [share, radius];
        }
        area(&self.corners) / std::f64::consts::PI * sum / round
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of half the width has 2/π of the circle; of two cones that meet at a waist half as wide each frustum
    /// has 7/12 of the cylinder around it.
    #[test]
    fn bulk_is_that_of_the_area_and_of_the_rings() {
        let square = Section::of(vec![[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]], true);
        let of_area = 2.0 / std::f64::consts::PI;
        assert!((square.bulk([0.4, 0.1], 3.0) - of_area).abs() < 1e-12);
        let waist = square.with_rings(vec![[0.5, -0.25]]);
        assert!((waist.bulk([1.0, 1.0], 2.0) - of_area * 7.0 / 12.0).abs() < 1e-12);
        let strip = Section::of(vec![[0.0, 1.0], [0.0, 0.0], [1.0, 0.0]], false);
        assert_eq!((strip.bulk([1.0, 1.0], 2.0), waist.bulk([0.0, 0.0], 2.0)), (1.0, 1.0));
    }
}
