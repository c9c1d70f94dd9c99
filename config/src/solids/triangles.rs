//! The triangles of a mesh file, whatever its format, and what is wrong with one.
//!
//! Absent: the formats (`ply`, `obj`, `glb`), and whether triangles enclose space.

use phytomer_looks::polygon;

/// The most triangles of a mesh.
pub(super) const MOST_TRIANGLES: usize = 50_000;
/// The most corners of a polygon, since cutting it takes the square of their number.
pub(super) const MOST_CORNERS: usize = 1000;
/// The most elements of any other kind: of triangles that share no corners three each.
pub(super) const MOST_ELEMENTS: usize = 3 * MOST_TRIANGLES;

/// The triangles of a file, metres.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Triangles {
    pub points: Vec<[f64; 3]>,
    pub faces: Vec<[u32; 3]>,
}

/// What is wrong with a file: the place in it, the problem, and what was expected.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Refused {
    pub place: String,
    pub problem: String,
    pub expected: String,
}

impl Refused {
    pub fn new(place: impl Into<String>, problem: impl Into<String>, expected: impl Into<String>) -> Self {
        Self { place: place.into(), problem: problem.into(), expected: expected.into() }
    }
}

impl Triangles {
    /// A mesh that nothing is wrong with.
    pub fn tetrahedron() -> Self {
        let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        Self { points, faces: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]] }
    }

    /// Adds the triangles of a polygon, which may be concave.
    pub fn add(&mut self, place: impl Fn() -> String, corners: &[u32]) -> Result<(), Refused> {
        let points = self.points.len();
        if let Some(outside) = corners.iter().find(|corner| **corner as usize >= points) {
            let problem = format!("it names the vertex {outside}, counted from 0");
            return Err(Refused::new(place(), problem, format!("one of the {points} vertices")));
        }
        if !(3..=MOST_CORNERS).contains(&corners.len()) {
            let problem = format!("it has {} corners", corners.len());
            return Err(Refused::new(place(), problem, format!("3 to {MOST_CORNERS}")));
        }
        let at = |corner: &u32| self.points[*corner as usize];
        let first = at(&corners[0]);
        // From the first corner, so that single precision is enough to cut it.
        let beside: Vec<[f32; 3]> =
            corners.iter().map(|corner| [0, 1, 2].map(|k| (at(corner)[k] - first[k]) as f32)).collect();
        self.faces.extend(polygon::triangles(&beside).into_iter().map(|face| face.map(|corner| corners[corner])));
        if self.faces.len() > MOST_TRIANGLES {
            let problem = format!("up to here there are more than {MOST_TRIANGLES} triangles");
            return Err(Refused::new(place(), problem, format!("a mesh of at most {MOST_TRIANGLES}")));
        }
        Ok(())
    }
}
