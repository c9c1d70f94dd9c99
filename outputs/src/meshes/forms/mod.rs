//! The library of forms (de Reffye 1988 §6): a small mesh for each form of organ, in a unit box, put in place by scaling.
//!
//! In the box x runs from the base (0) to the tip (1) along the organ, y across it to its left (−½ to ½), z to its upper
//! side. Length scales x, width y, and one of the two z. Triangles are single-sided, counterclockwise as seen from the
//! upper or outer side, with one normal a vertex: the ten readers of the profile draw both sides or let the user choose,
//! and doubled faces would flicker and count twice in areas. Leaves are assemblies of at most four plane convex
//! polygons, folded along the midrib. Internodes are tubes ([`super::tube`]); buds are not drawn.

mod blade;
mod flower;
mod palm;
mod round;

use super::chunk::{Tag, Vertex};
use phytomer_sim::plant::Form;
use std::sync::LazyLock;

/// A corner of a shape, in its unit box.
#[derive(Debug, Clone, Copy)]
pub struct Point {
    /// Where.
    pub at: [f32; 3],
    /// The unit normal.
    pub normal: [f32; 3],
    /// The place in the texture.
    pub texture: [f32; 2],
    /// Whether it has the colour of the stalk.
    pub stalk: bool,
}

/// What scales the third direction of a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depth {
    /// The width, as in fruits and folded blades.
    Width,
    /// The length, as in arching leaves.
    Length,
}

/// A mesh in its unit box.
#[derive(Debug, Clone)]
pub struct Shape {
    /// Its corners.
    pub points: Vec<Point>,
    /// Its triangles, by the numbers of its corners.
    pub faces: Vec<[u32; 3]>,
    depth: Depth,
}

/// Where a shape goes, in metres and unit vectors.
#[derive(Debug, Clone, Copy)]
pub struct Placement {
    /// The base.
    pub base: [f32; 3],
    /// Along the organ.
    pub heading: [f32; 3],
    /// Its upper side.
    pub up: [f32; 3],
    /// Its length and width.
    pub size: [f32; 2],
}

/// The shape of a form.
pub fn shape(form: Form) -> &'static Shape {
    static LIBRARY: LazyLock<[Shape; 8]> = LazyLock::new(|| {
        [
            blade::elliptic(),
            blade::lanceolate(),
            blade::deltoid(),
            blade::needle(),
            palm::palm(),
            flower::corolla(),
            round::berry(),
            round::cone(),
        ]
    });
    &LIBRARY[form as usize]
}

impl Shape {
    fn new(depth: Depth) -> Self {
        Self { points: Vec::new(), faces: Vec::new(), depth }
    }

    /// Adds a plane convex polygon, its corners counterclockwise as seen from its upper side.
    fn polygon(&mut self, corners: &[[f32; 3]], texture: impl Fn([f32; 3]) -> [f32; 2], stalk: bool) {
        let first = self.points.len() as u32;
        let normal = plane_normal(corners);
        self.points.extend(corners.iter().map(|&at| Point { at, normal, texture: texture(at), stalk }));
        self.faces.extend((1..corners.len() as u32 - 1).map(|k| [first, first + k, first + k + 1]));
    }

    /// Writes the vertices of the shape in its place; `out` has exactly their number. `tags` are of the organ and of its
    /// stalk.
    #[inline]
    pub fn write(&self, place: &Placement, tags: &[Tag; 2], out: &mut [Vertex]) {
        let Placement { base, heading: h, up, size: [length, width] } = *place;
        let left = super::tube::cross(up, h);
        let depth = if self.depth == Depth::Width { width } else { length };
        // A normal scales by the cofactors of what scales the shape.
        let cofactors = [width * depth, length * depth, length * width];
        let turned = |[x, y, z]: [f32; 3]| [0, 1, 2].map(|k| x * h[k] + y * left[k] + z * up[k]);
        let (mut of, mut normal) = ([f32::NAN; 3], [0.0; 3]);
        for (point, vertex) in self.points.iter().zip(out) {
            let offset = turned([point.at[0] * length, point.at[1] * width, point.at[2] * depth]);
            let at = [0, 1, 2].map(|k| base[k] + offset[k]);
            // The corners of a polygon follow one another and have one normal.
            if point.normal != of {
                (of, normal) = (point.normal, turned(scaled_normal(point.normal, cofactors)));
            }
            *vertex = Vertex::new(at, normal, point.texture, &tags[usize::from(point.stalk)]);
        }
    }
}

#[inline]
fn scaled_normal(normal: [f32; 3], cofactors: [f32; 3]) -> [f32; 3] {
    let n = [0, 1, 2].map(|k| normal[k] * cofactors[k]);
    let square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    // Of an organ without any size nothing is seen; its normals stay as they are.
    if square > f32::MIN_POSITIVE * 1e8 { n.map(|x| x / square.sqrt()) } else { normal }
}

/// The normal of a plane polygon, by Newell's sum over its edges.
fn plane_normal(corners: &[[f32; 3]]) -> [f32; 3] {
    let mut sum = [0.0; 3];
    for (k, a) in corners.iter().enumerate() {
        let b = corners[(k + 1) % corners.len()];
        let across = super::tube::cross(*a, b);
        (0..3).for_each(|i| sum[i] += across[i]);
    }
    unit(sum)
}

fn unit(v: [f32; 3]) -> [f32; 3] {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|x| x / length)
}

/// The texture of a blade: s across, t along.
fn along([x, y, _]: [f32; 3]) -> [f32; 2] {
    [0.5 + y, x]
}

#[cfg(test)]
mod tests {
    use super::super::chunk::Face;
    use super::super::measure::{assert_closed, assert_unit_normals, outward_share, volume};
    use super::*;
    use bytemuck::Zeroable;
    use std::collections::BTreeSet;

    const FORMS: [Form; 8] = [
        Form::Elliptic,
        Form::Lanceolate,
        Form::Deltoid,
        Form::Needle,
        Form::Palm,
        Form::Corolla,
        Form::Berry,
        Form::Cone,
    ];

    fn placed(form: Form, size: [f32; 2]) -> (Vec<Vertex>, Vec<Face>) {
        let tag = Tag { colour: [0; 4], birth: 0.0, death: 1.0, component: 3, kind: 2 };
        let place = Placement { base: [1.0, 2.0, 3.0], heading: [0.0, 0.6, 0.8], up: [0.0, -0.8, 0.6], size };
        let shape = shape(form);
        let mut vertices = vec![Vertex::zeroed(); shape.points.len()];
        shape.write(&place, &[tag, tag], &mut vertices);
        (vertices, shape.faces.iter().map(|&face| Face::new(face)).collect())
    }

    #[test]
    fn every_form_fits_its_box_and_its_normals_agree_with_its_triangles() {
        for form in FORMS {
            let inside = |p: &Point| p.at[0] >= -0.01 && p.at[0] <= 1.01 && p.at[1].abs() <= 0.51;
            assert!(shape(form).points.iter().all(inside), "{form:?}");
            let corners: BTreeSet<u32> = shape(form).faces.iter().flatten().copied().collect();
            assert!(corners.into_iter().eq(0..shape(form).points.len() as u32), "{form:?}: readers drop idle vertices");
            for size in [[0.2, 0.08], [0.1, 0.12], [1.0, 1.0]] {
                let (vertices, faces) = placed(form, size);
                assert_unit_normals(&vertices);
                assert_eq!(outward_share(&vertices, &faces), 1.0, "{form:?} {size:?}");
            }
        }
    }

    #[test]
    fn normals_are_unit_at_any_size() {
        for (form, size) in
            FORMS.iter().flat_map(|&form| [(form, [0.0, 0.0]), (form, [1e-6, 1e-6]), (form, [3.0, 0.0])])
        {
            assert_unit_normals(&placed(form, size).0);
        }
    }

    #[test]
    fn blades_are_assemblies_of_at_most_four_plane_convex_polygons() {
        for form in &FORMS[..4] {
            let points = &shape(*form).points;
            let mut normals: Vec<_> = points.iter().map(|p| (p.stalk, p.normal.map(f32::to_bits))).collect();
            normals.dedup();
            assert!(normals.len() <= 4, "{form:?}");
        }
    }

    #[test]
    fn a_berry_is_closed_and_nearly_a_sphere() {
        let (vertices, faces) = placed(Form::Berry, [0.02, 0.02]);
        assert_closed(&vertices, &faces);
        let ball = std::f64::consts::PI / 6.0 * 8e-6;
        assert!((0.6..1.0).contains(&(volume(&vertices, &faces) / ball)));
        assert!(volume(&placed(Form::Cone, [0.1, 0.05]).0, &faces_of(Form::Cone)) > 0.0);
    }

    fn faces_of(form: Form) -> Vec<Face> {
        placed(form, [1.0, 1.0]).1
    }
}
