//! The list of forms of a page: the mesh of each form of organ that the plants have, once.
//!
//! A form is a mesh of the library or of a file, an outline, a curved surface, or an internode that is drawn by
//! itself. With the kind of the organ and the colour of its stalk it is one entry of the list, which the page draws
//! as often as there are parts of it. Absent: where parts are and how large.

use super::streams::linear;
use phytomer_life::{Life, Model, Part, What};
use phytomer_looks::Surface;
use phytomer_looks::polygon::triangles;
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
            What::Outlined(place) => of_outline(life.outlines.get(place as usize).map_or(&[], Vec::as_slice)),
            What::Surface(place) => of_surface(life.surfaces.get(place as usize)),
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

/// An internode that is drawn by itself. Its model tells by a corner of its box what scales it.
fn of_stem(model: Option<&Model>) -> Value {
    let Some(model) = model else { return json!({"scale": "tube", "corners": [], "faces": []}) };
    let [_, wide, deep] = model.at([1.0; 3], [1.0, 2.0, 3.0], 1.0);
    let scale = match (wide > 2.5, deep > 1.5) {
        (true, _) => "tube",
        (false, true) => "width",
        (false, false) => "length",
    };
    let vertices = model.mesh.vertices.iter();
    let corners = vertices.flat_map(|vertex| corner(vertex.position(), [0.0; 3], vertex.normal(), false));
    let corners: Vec<i64> = corners.collect();
    let faces: Vec<[u32; 3]> = model.mesh.faces.iter().map(Face::indices).collect();
    json!({"scale": scale, "of_internode": true, "corners": corners, "faces": faces})
}

/// An obstacle, as a form that stands once, and its colour.
pub fn of_solid(mesh: &Mesh) -> Value {
    let vertices = mesh.vertices.iter();
    let corners = vertices.flat_map(|vertex| corner(vertex.position(), [0.0; 3], vertex.normal(), false));
    let [red, green, blue, _] = mesh.vertices.first().map_or([128; 4], |vertex| vertex.tag().colour);
    let corners: Vec<i64> = corners.collect();
    let faces: Vec<[u32; 3]> = mesh.faces.iter().map(Face::indices).collect();
    json!({"scale": "share", "of_internode": true, "thin": false, "colour": [red, green, blue], "corners": corners,
        "faces": faces})
}

fn of_outline(corners: &[[f32; 3]]) -> Value {
    let faces = triangles(corners);
    let mut normals = vec![[0.0_f32; 3]; corners.len()];
    for face in &faces {
        let [a, b, c] = face.map(|place| corners[place]);
        let [p, q] = [b, c].map(|to| [0, 1, 2].map(|k| to[k] - a[k]));
        let across = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
        face.iter().for_each(|place| (0..3).for_each(|k| normals[*place][k] += across[k]));
    }
    let corners = corners.iter().zip(normals).flat_map(|(at, normal)| {
        let length = normal.iter().map(|x| x * x).sum::<f32>().sqrt();
        let normal = if length > 0.0 { normal.map(|x| x / length) } else { [0.0, 0.0, 1.0] };
        corner(*at, [0.0; 3], normal, false)
    });
    json!({"scale": "share", "corners": corners.collect::<Vec<i64>>(), "faces": faces})
}

fn of_surface(surface: Option<&Surface>) -> Value {
    let points = surface.into_iter().flat_map(Surface::points);
    let corners: Vec<i64> = points.flat_map(|point| corner(point.at, [0.0; 3], point.normal, false)).collect();
    json!({"scale": "each", "corners": corners, "faces": surface.map(Surface::faces).unwrap_or_default()})
}
