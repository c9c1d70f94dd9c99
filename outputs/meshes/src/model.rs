//! A form as a mesh of its own, for files in which one mesh stands for many components.
//!
//! x runs along the component from its base, y to its left, z to its upper side. An organ is its model scaled along
//! these axes ([`Model::scale`]), turned and moved; an internode narrows from its base to its tip ([`Model::at`]). So
//! placed, a model has the vertices of the scene. Absent: instances and files, which are the writers'.

use super::chunk::{Face, Tag, Vertex};
use super::forms::{Depth, FormMesh, Placement};
use super::outline;
use super::section::{Prism, Ring};
use super::stem::{Drawn, Stems};
use super::tube::{Frustum, Strip, Tube};
use super::{Mesh, MeshOptions};
use bytemuck::Zeroable;
use phytomer_looks::{Surface, polygon};
use phytomer_sim::plant::{Form, NodeId};
use phytomer_sim::pose::Frame;

/// A form in a box of its own.
#[derive(Debug, Clone, Default)]
pub struct Model {
    /// Its vertices and triangles.
    pub mesh: Mesh,
    sized: Sized,
    /// Whether its fullness is in its mesh; else in its width.
    in_parts: bool,
}

/// What scales the three axes of a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Sized {
    /// Its length, its width and its width.
    Wide,
    /// Its length, its width and its length.
    Long,
    /// One share.
    #[default]
    Share,
    /// Three factors.
    Factors,
    /// Its length, and a diameter that goes from base to tip.
    Narrowing,
}

const FRAME: Frame = Frame { base: [0.0; 3], heading: [1.0, 0.0, 0.0], up: [0.0, 0.0, 1.0] };

impl Model {
    /// A form of an organ; colours are those of the organ and of its stalk.
    pub fn of_form(options: &MeshOptions, form: Form, fullness: f32, colours: [[u8; 3]; 2]) -> Self {
        Self::of_shape(options.shape(form), fullness, colours)
    }

    /// A form of an organ that is seen from near, with the tints of its parts over its colours.
    pub fn of_near(form: &FormMesh, fullness: f32, colours: [[u8; 3]; 2]) -> Self {
        let mut model = Self::of_shape(form, fullness, colours);
        form.tint(&mut model.mesh.vertices);
        model
    }

    fn of_shape(shape: &FormMesh, fullness: f32, colours: [[u8; 3]; 2]) -> Self {
        let in_parts = shape.is_in_parts();
        let fullness = if in_parts { fullness } else { 1.0 };
        let Frame { base, heading, up } = FRAME;
        let place = Placement { base, heading, up, size: [1.0; 2], fullness };
        let sized = if shape.depth() == Depth::Width { Sized::Wide } else { Sized::Long };
        let write = |out: &mut [Vertex]| shape.write(&place, &colours.map(tag), out);
        Self { mesh: made(shape.points.len(), &shape.faces, write), sized, in_parts }
    }

    /// A polygon, by its corners.
    pub fn of_outline(corners: &[[f32; 3]], colour: [u8; 3]) -> Self {
        let faces = polygon::triangles(corners);
        let faces: Vec<[u32; 3]> = faces.iter().map(|face| face.map(|corner| corner as u32)).collect();
        let write = |out: &mut [Vertex]| outline::write((corners, &faces), &FRAME, 1.0, &tag(colour), out);
        Self { mesh: made(corners.len(), &faces, write), sized: Sized::Share, in_parts: false }
    }

    /// A curved surface.
    pub fn of_surface(surface: &Surface, colour: [u8; 3]) -> Self {
        let write = |out: &mut [Vertex]| outline::write_surface(surface, [1.0; 3], &FRAME, &tag(colour), out);
        let mesh = made(surface.points().len(), surface.faces(), write);
        Self { mesh, sized: Sized::Factors, in_parts: false }
    }

    /// An internode that is drawn by itself.
    fn of_stem(stem: &Drawn, colour: [u8; 3]) -> Self {
        let Frame { base, heading, up } = FRAME;
        let unit = Frustum { base, heading, up, length: 1.0, radii: [0.5; 2] };
        let narrowing = Self::narrowing;
        let tag = tag(colour);
        match stem {
            Drawn::Tube(tube, _) => narrowing(of_tube(tube, &unit, &tag)),
            // Instances know no neighbours: a piece of a blade is a strip to them.
            Drawn::Strip | Drawn::Lamina(_) => {
                narrowing(made(Strip::VERTICES, &Strip::FACES, |out| Strip::write(&unit, &tag, out)))
            }
            Drawn::Prism(prism) => narrowing(of_prism(prism, &unit, &tag)),
            Drawn::Form(shape) => Self::of_shape(shape, 1.0, [colour; 2]),
            // Instances have no detail.
            Drawn::Turned(_) => narrowing(of_tube(&Tube::new(8), &unit, &tag)),
            Drawn::Near(each, _) => Self::of_stem(&each[0], colour),
        }
    }

    /// A body whose width goes from base to tip.
    pub(super) fn narrowing(mesh: Mesh) -> Self {
        Self { mesh, sized: Sized::Narrowing, in_parts: false }
    }

    /// The factors along its axes for the sizes of a component, as a life has them, and its fullness.
    pub fn scale(&self, size: [f32; 3], fullness: f32) -> [f32; 3] {
        let [length, width, _] = size;
        let width = if self.in_parts { width } else { width * fullness };
        match self.sized {
            Sized::Wide => [length, width, width],
            Sized::Long => [length, width, length],
            Sized::Share => [length; 3],
            Sized::Factors => size,
            Sized::Narrowing => [length, size[1], size[1]],
        }
    }

    /// A place of its box in a component of these sizes.
    pub fn at(&self, [x, y, z]: [f32; 3], size: [f32; 3], fullness: f32) -> [f32; 3] {
        if self.sized == Sized::Narrowing {
            let width = size[1] + x * (size[2] - size[1]);
            return [x * size[0], y * width, z * width];
        }
        let [along, left, up] = self.scale(size, fullness);
        [x * along, y * left, z * up]
    }

    /// Whether the fullness of a component is in the mesh of its model.
    pub fn is_in_parts(&self) -> bool {
        self.in_parts
    }
}

impl Stems<'_> {
    /// The form of an internode that is drawn by itself, in the colour that it has.
    pub fn model(&self, node: NodeId) -> Model {
        Model::of_stem(self.form(node), self.colour(node))
    }
}

fn tag([red, green, blue]: [u8; 3]) -> Tag {
    Tag { colour: [red, green, blue, 255], birth: 0.0, death: f32::INFINITY, component: 0, kind: 0 }
}

fn of_tube(tube: &Tube, unit: &Frustum, tag: &Tag) -> Mesh {
    made(tube.vertices(), tube.faces(), |out| tube.write(unit, tag, out))
}

fn of_prism(prism: &Prism, unit: &Frustum, tag: &Tag) -> Mesh {
    made(prism.vertices(), prism.faces(), |out| prism.write([Ring::base(unit), Ring::tip(unit)], tag, out))
}

fn made(vertices: usize, faces: &[[u32; 3]], write: impl Fn(&mut [Vertex])) -> Mesh {
    let mut mesh = Mesh { vertices: vec![Vertex::zeroed(); vertices], faces: Vec::new() };
    write(&mut mesh.vertices);
    mesh.faces = faces.iter().map(|face| Face::new(*face)).collect();
    mesh
}
