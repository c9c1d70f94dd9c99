//! Corners and triangles of a form as it is seen from near, in the proportions of the organ, and the step from there to
//! the unit box of forms.
//!
//! The organ is one long and `aspect` wide here, so that angles are true. Normals are smooth: at each corner the sum of
//! the area vectors of its triangles. Absent: what is built.

use super::super::{Depth, FormMesh, Point};

/// A vector, lengths of the organ.
pub type Vector = [f32; 3];

/// A colour that lies over that of the organ, and its share of 255.
pub type Tint = [u8; 4];

/// No tint.
pub const PLAIN: Tint = [0; 4];

/// A mesh that is being built.
#[derive(Debug, Default)]
pub struct Build {
    points: Vec<Point>,
    /// Whether each corner has a normal that is kept.
    shaped: Vec<bool>,
    faces: Vec<[u32; 3]>,
    /// Whether what is added has the colour of the stalk.
    pub stalk: bool,
    /// The tint of what is added.
    pub tint: Tint,
}

impl Build {
    /// Adds a corner and returns its number.
    pub fn corner(&mut self, at: Vector, across: Vector, texture: [f32; 2]) -> u32 {
        let (stalk, tint) = (self.stalk, self.tint);
        self.points.push(Point { at, across, normal: [0.0; 3], texture, stalk, tint });
        self.shaped.push(false);
        self.points.len() as u32 - 1
    }

    /// Adds a corner that keeps its normal and its colours, and returns its number.
    pub fn shaped(&mut self, point: Point) -> u32 {
        self.points.push(point);
        self.shaped.push(true);
        self.points.len() as u32 - 1
    }

    /// Adds a corner at the place of another one, for a surface that meets its surface at an edge.
    pub fn again(&mut self, corner: u32) -> u32 {
        self.points.push(self.points[corner as usize]);
        self.shaped.push(self.shaped[corner as usize]);
        self.points.len() as u32 - 1
    }

    /// Adds a triangle, counterclockwise from its upper side; one without an area is left out.
    pub fn face(&mut self, corners: [u32; 3]) {
        let [a, b, c] = corners.map(|corner| self.points[corner as usize].at);
        let area = cross(minus(b, a), minus(c, a));
        if dot(area, area) > 1e-18 {
            self.faces.push(corners);
        }
    }

    /// Adds the two triangles of a quadrangle.
    pub fn quad(&mut self, [a, b, c, d]: [u32; 4]) {
        self.face([a, b, c]);
        self.face([a, c, d]);
    }

    /// Scales what has been built, so that it reaches 1 along and `half` out of its axis.
    pub fn fit(&mut self, half: f32) {
        let far = self.points.iter().fold([1e-6_f32; 2], |[along, out], point| {
            let [x, y, z] = point.at;
            [along.max(x), out.max((y * y + z * z).sqrt())]
        });
        let by = [1.0 / far[0], half / far[1], half / far[1]];
        self.points.iter_mut().for_each(|point| point.at = [0, 1, 2].map(|k| point.at[k] * by[k]));
    }

    /// The form in its unit box, for organs of about this width over their length.
    pub fn into_form(mut self, aspect: f32, depth: Depth, in_parts: bool) -> FormMesh {
        self.smooth();
        let scale = [1.0, aspect, if depth == Depth::Width { aspect } else { 1.0 }];
        let mut used = vec![u32::MAX; self.points.len()];
        let mut form = FormMesh::new(depth);
        form.in_parts = in_parts;
        for face in &self.faces {
            form.faces.push(face.map(|corner| {
                let place = &mut used[corner as usize];
                if *place == u32::MAX {
                    *place = form.points.len() as u32;
                    form.points.push(boxed(&self.points[corner as usize], scale));
                }
                *place
            }));
        }
        form.closed = super::super::side::closed_parts(&form);
        form.measured_at(if depth == Depth::Width { aspect } else { 1.0 / aspect })
    }

    /// Gives each corner the sum of the area vectors of its triangles.
    fn smooth(&mut self) {
        for face in &self.faces {
            let [a, b, c] = face.map(|corner| self.points[corner as usize].at);
            let area = cross(minus(b, a), minus(c, a));
            for corner in face.iter().filter(|corner| !self.shaped[**corner as usize]) {
                let normal = &mut self.points[*corner as usize].normal;
                (0..3).for_each(|k| normal[k] += area[k]);
            }
        }
    }
}

/// A corner in the box; its normal is such that the scales of the box turn it back.
fn boxed(point: &Point, scale: Vector) -> Point {
    let over = |v: Vector| [0, 1, 2].map(|k| v[k] / scale[k]);
    let normal = unit([0, 1, 2].map(|k| point.normal[k] * scale[k]));
    let across = over(point.across);
    Point { at: over(point.at), across, normal, ..*point }
}

/// A unit vector; the upward one of none.
pub fn unit(v: Vector) -> Vector {
    let length = dot(v, v).sqrt();
    if length > 1e-30 { v.map(|x| x / length) } else { [0.0, 0.0, 1.0] }
}

pub fn dot(a: Vector, b: Vector) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: Vector, b: Vector) -> Vector {
    crate::tube::cross(a, b)
}

pub fn minus(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|k| a[k] - b[k])
}

/// The sum of vectors, each by a factor.
pub fn sum(parts: &[(f32, Vector)]) -> Vector {
    [0, 1, 2].map(|k| parts.iter().map(|(factor, vector)| factor * vector[k]).sum())
}
