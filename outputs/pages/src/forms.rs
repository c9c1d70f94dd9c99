//! The list of forms of a page: the mesh of each form of organ that the plants have, once.
//!
//! A form is a mesh of the library or of a file, an outline, a curved surface, or an internode that is drawn by
//! itself. With the kind of the organ and the colour of its stalk it is one entry of the list, which the page draws
//! as often as there are parts of it. Absent: where parts are and how large.

use super::streams::linear;
use phytomer_life::{Life, Model, Part, What};
use phytomer_meshes::{Depth, Face, FormMesh, Mesh, MeshOptions};
use phytomer_sim::plant::Class;
use serde_json::{Value, json};

/// What tells forms apart: the plant's options, what it is, kind and stalk. Outlines and surfaces are told apart by
/// their places in the life of a plant.
type Key = (usize, Shape, u8, [u8; 3]);

/// A form without its mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Shape {
    /// By the number of the form.
    Library(u8),
    /// By the number of the form from near.
    Near(u32),
    Outline(usize, u32),
    Surface(usize, u32),
    Internode(usize, u32),
}

/// The forms of a page.
#[derive(Debug, Default)]
pub struct Forms {
    known: std::collections::BTreeMap<Key, u32>,
    list: Vec<Value>,
    subject: usize,
    species: usize,
    options: MeshOptions,
}

impl Forms {
    /// The parts that come next are those of this plant, of this species, which has these options.
    pub fn begin(&mut self, subject: usize, species: usize, options: &MeshOptions) {
        (self.subject, self.species, self.options) = (subject, species, options.clone());
    }

    /// The number of the form of a part, which is added to the list where it is new.
    pub fn of(&mut self, part: &Part, life: &Life) -> u32 {
        let shape = match part.what {
            What::Organ(form) => Shape::Library(form.0),
            What::Near(form) => Shape::Near(form.number()),
            What::Outlined(place) => Shape::Outline(self.subject, place),
            What::Surface(place) => Shape::Surface(self.subject, place),
            What::Internode => Shape::Internode(self.subject, part.stem),
        };
        // The stalk of an internode is none: all of it has its own colour.
        let stalk = if part.what == What::Internode { [0; 3] } else { part.stalk };
        let key = (self.species, shape, part.kind as u8, stalk);
        if let Some(known) = self.known.get(&key) {
            return *known;
        }
        let number = self.list.len() as u32;
        self.list.push(self.described(part, life, stalk));
        self.known.insert(key, number);
        number
    }

    /// The list.
    pub fn list(self) -> Vec<Value> {
        self.list
    }

    fn described(&self, part: &Part, life: &Life, stalk: [u8; 3]) -> Value {
        let mut form = match part.what {
            What::Organ(form) => of_mesh(self.options.shape(form)),
            What::Near(form) => match life.nears.as_ref().and_then(|nears| nears.mesh(form)) {
                Some(mesh) => of_near(mesh),
                None => of_model(&Model::default().mesh, "width"),
            },
            What::Outlined(place) => {
                let corners = life.outlines.get(place as usize).map_or(&[][..], Vec::as_slice);
                of_model(&Model::of_outline(corners, NO_COLOUR).mesh, "share")
            }
            What::Surface(place) => {
                let model = life.surfaces.get(place as usize).map(|surface| Model::of_surface(surface, NO_COLOUR));
                of_model(&model.unwrap_or_default().mesh, "each")
            }
            What::Internode => of_stem(life.stems.get(part.stem as usize)),
        };
        let leafy = matches!(part.kind.class(), Class::Leaf | Class::Flower);
        let plane = part.what == What::Internode && form["faces"].as_array().is_some_and(|faces| faces.len() == 2);
        form["thin"] = json!(leafy || plane);
        form["kind"] = json!(part.kind as u8);
        form["stalk"] = json!(stalk);
        form
    }
}

/// The colour of a form, which the page takes from each part.
const NO_COLOUR: [u8; 3] = [0; 3];

/// The step of the numbers of a corner.
const UNIT: f64 = 1e-4;

/// Place, offset from the middle line, normal, each in steps, and whether it is of the stalk.
fn corner(at: [f32; 3], across: [f32; 3], normal: [f32; 3], stalk: bool) -> [i64; 10] {
    let [x, y, z] = at.map(|x| linear(f64::from(x), UNIT));
    let ([a, b, c], [l, m, n]) = (across, normal);
    let [a, b, c, l, m, n] = [a, b, c, l, m, n].map(|x| linear(f64::from(x), UNIT));
    [x, y, z, a, b, c, l, m, n, i64::from(stalk)]
}

fn of_mesh(mesh: &FormMesh) -> Value {
    let corners = mesh.points.iter().flat_map(|point| corner(point.at, point.across, point.normal, point.stalk));
    let corners: Vec<i64> = corners.collect();
    let scale = if mesh.depth() == Depth::Width { "width" } else { "length" };
    json!({"scale": scale, "in_parts": mesh.is_in_parts(), "corners": corners, "faces": mesh.faces})
}

/// A form from near: as one of the library, and for each corner the colour that lies over its own with its share, in
/// 255ths; none where no corner has one.
fn of_near(mesh: &FormMesh) -> Value {
    let mut form = of_mesh(mesh);
    if mesh.points.iter().any(|point| point.tint[3] > 0) {
        form["tints"] = json!(mesh.points.iter().flat_map(|point| point.tint).collect::<Vec<u8>>());
    }
    form
}

/// An internode that is drawn by itself. Its model tells by a corner of its box what scales it.
fn of_stem(model: Option<&Model>) -> Value {
    let Some(model) = model else { return json!({"scale": "tube", "corners": [], "faces": []}) };
    let [_, wide, deep] = model.at([1.0; 3], [1.0, 2.0, 3.0], 1.0);
    let scale = match (wide > 2.5, deep > 1.5) {
        (true, _) => "tube",
        (false, true) => "width",
        (false, false) => "length",
    };
    let mut form = of_model(&model.mesh, scale);
    form["of_internode"] = json!(true);
    form
}

/// A mesh that stands as it is, with what scales it.
fn of_model(mesh: &Mesh, scale: &str) -> Value {
    let vertices = mesh.vertices.iter();
    let corners = vertices.flat_map(|vertex| corner(vertex.position(), [0.0; 3], vertex.normal(), false));
    let corners: Vec<i64> = corners.collect();
    let faces: Vec<[u32; 3]> = mesh.faces.iter().map(Face::indices).collect();
    json!({"scale": scale, "corners": corners, "faces": faces})
}

/// An obstacle, as a form that stands once, and its colour.
pub fn of_solid(mesh: &Mesh) -> Value {
    let [red, green, blue, _] = mesh.vertices.first().map_or([128; 4], |vertex| vertex.tag().colour);
    let mut form = of_model(mesh, "share");
    form["of_internode"] = json!(true);
    form["thin"] = json!(false);
    form["colour"] = json!([red, green, blue]);
    form
}
