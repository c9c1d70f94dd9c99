//! Plants at one age whose organs are instances (EXT_mesh_gpu_instancing): a mesh for each kind, form and step of
//! colour, and of each organ its place, its turn and its factors of size.
//!
//! Wood and obstacles are written as in any still. A plant is a node, and under it stands a node for each mesh that it
//! has instances of, with the attributes `TRANSLATION`, `ROTATION`, `SCALE`, `_BIRTH_AGE`, `_DEATH_AGE` and
//! `_COMPONENT_ID`; equal plants of a plot share their numbers. The extension is required: a program without it would
//! show one organ of each mesh at the foot of the plant. Memory holds 52 bytes an organ. Absent: lives and skeletons,
//! which move vertices.

use super::document::{Accessor, Document, INDICES, MOST_BYTES, Number, VERTICES, pad, too_large};
use super::paint::{class_of_kind, enter_material};
use super::still::{SHAPE, Still, put_shape, y_up};
use super::tangents::Tangents;
use glam::Quat;
use phytomer_life::{Life, Member, Model, Models, Part, StillOrgans, between, wood_of, wood_of_plot};
use phytomer_meshes::{Drawing, PlantDrawing, PlotMesh, Scene, Slot, Vertex};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::{self, Write};

const EXTENSION: &str = "EXT_mesh_gpu_instancing";
/// The bytes of an organ.
const ORGAN: u64 = 52;

/// Writes a plant at an age.
///
/// # Errors
/// Those of `out`; a file that is larger than its format can hold, before anything is written.
pub fn write_plant_instanced(scene: &Scene, run_seed: u64, out: &mut (dyn Write + Send)) -> io::Result<()> {
    let wood = Scene::new(scene.plant(), scene.age(), &wood_of(scene.options()));
    let about = scene.about(run_seed);
    write(&PlantDrawing { scene: &wood, about }, &StillOrgans::of_plant(scene), out)
}

/// Writes the plants of a plot, each in its place, with its obstacles.
///
/// # Errors
/// As [`write_plant_instanced`].
pub fn write_plot_instanced(plot: &PlotMesh, out: &mut (dyn Write + Send)) -> io::Result<()> {
    write(&wood_of_plot(plot).drawing()?, &StillOrgans::of_plot(plot), out)
}

fn write(wood: &dyn Drawing, organs: &StillOrgans, out: &mut (dyn Write + Send)) -> io::Result<()> {
    let still = Still::of(wood, None)?;
    let count: usize = organs.lives.iter().map(|life| life.parts.len()).sum();
    let bytes = count as u64 * ORGAN;
    if bytes > MOST_BYTES {
        return Err(too_large(bytes));
    }
    let mut models = Models::of(&organs.lives, &organs.options);
    let slots = wood.slots();
    let grouped = |(number, life)| {
        let member = organs.members.iter().position(|member| member.life == number).unwrap_or_default();
        grouped((number, life), &mut models, &|part| {
            slots.of_component(member, part.component, class_of_kind(part.kind))
        })
    };
    let groups: Vec<Groups> = organs.lives.iter().enumerate().map(grouped).collect();
    let mut filled = Filled::default();
    let mut shapes = Shapes::new();
    for key in groups.iter().flat_map(Groups::keys) {
        if !shapes.contains_key(key) {
            let shape = filled.enter_shape(&slots.list()[key.1], &models.made()[key.0].1);
            shapes.insert(*key, shape);
        }
    }
    let names = models.names();
    let bodies: Vec<Vec<Value>> = groups
        .iter()
        .map(|groups| groups.iter().map(|(key, of)| filled.enter(&names[key.0], &shapes[key], of)).collect())
        .collect();
    for (member, name) in organs.members.iter().zip(&organs.names) {
        filled.stand(member, name, &bodies[member.life]);
    }
    if count > 0 {
        filled.file.uses.push(EXTENSION);
        filled.file.requires.push(EXTENSION);
    }
    still.write(filled.file, filled.bytes, out)
}

/// A model, and the slot of its material.
type Key = (usize, usize);

/// The organs of a life by their models and slots.
type Groups = BTreeMap<Key, Vec<Placed>>;

/// The shapes that were entered.
type Shapes = BTreeMap<Key, Shape>;

/// An organ in the axes of glTF.
struct Placed {
    translation: [f32; 3],
    rotation: [f32; 4],
    scale: [f32; 3],
    birth: f32,
    component: u32,
}

/// The accessors and the material of a model.
struct Shape {
    view: usize,
    vertices: u64,
    bounds: [[f32; 3]; 2],
    /// The other attributes, which are the same wherever the model stands.
    others: Vec<(&'static str, usize)>,
    indices: usize,
    material: usize,
}

fn grouped((number, life): (usize, &Life), models: &mut Models, slot: &dyn Fn(&Part) -> usize) -> Groups {
    let mut groups = Groups::new();
    let age = life.ages.first().copied().unwrap_or_default();
    for part in &life.parts {
        let model = models.meet(number, part, between(life.tints_of_part(part), age));
        let placed = placed(life, part, age, &models.made()[model].1);
        groups.entry((model, slot(part))).or_default().push(placed);
    }
    groups
}

fn placed(life: &Life, part: &Part, age: f32, model: &Model) -> Placed {
    let pose = life.pose_at(part, age);
    let [x, y, z, real] = Quat::from_mat3(&pose.turn()).normalize().to_array();
    let [x, y, z] = y_up([x, y, z]);
    let [along, left, up] = model.scale(pose.size, part.fullness);
    Placed {
        translation: y_up(pose.base),
        rotation: [x, y, z, real],
        // A model has Y up too, so that its factors change their places.
        scale: [along, up, left],
        birth: part.birth,
        component: part.component,
    }
}

/// A file and the bytes of the views that were entered.
#[derive(Default)]
struct Filled {
    file: Document,
    bytes: Vec<u8>,
}

impl Filled {
    /// Enters a view and takes its bytes; its index.
    fn view(&mut self, bytes: &[u8], stride: Option<u64>, target: Option<u32>) -> usize {
        self.bytes.extend_from_slice(bytes);
        let filled = pad(bytes.len() as u64, &mut self.bytes);
        debug_assert!(filled.is_ok(), "memory does not fail");
        self.file.view(bytes.len() as u64, stride, target)
    }

    fn enter_shape(&mut self, slot: &Slot, model: &Model) -> Shape {
        let material = enter_material(slot, &mut self.file, &mut self.bytes);
        let mesh = &model.mesh;
        let mut bytes = Vec::new();
        mesh.vertices.iter().for_each(|vertex| put_shape(vertex, slot.texture.is_some(), &mut bytes));
        let vertices = mesh.vertices.len() as u64;
        let view = self.view(&bytes, Some(SHAPE), Some(VERTICES));
        let of = |number, shape, offset| Accessor::of(view, number, shape, vertices).at(offset);
        let others = [
            ("NORMAL", of(Number::F32, "VEC3", 12)),
            ("TEXCOORD_0", of(Number::F32, "VEC2", 24)),
            ("COLOR_0", of(Number::U16, "VEC4", 32).normalized()),
        ];
        let mut others: Vec<(&str, usize)> =
            others.into_iter().map(|(name, accessor)| (name, self.file.accessor(accessor))).collect();
        if slot.texture.as_ref().is_some_and(|texture| texture.normals.is_some()) {
            let mut tangents = Tangents::default();
            mesh.vertices.iter().for_each(|vertex| tangents.add(vertex));
            mesh.faces.iter().for_each(|face| tangents.join(face.indices()));
            let view = self.view(&tangents.bytes(), None, Some(VERTICES));
            others.push(("TANGENT", self.file.accessor(Accessor::of(view, Number::F32, "VEC4", vertices))));
        }
        let corners = mesh.faces.iter().flat_map(|face| face.indices());
        let faces: Vec<u8> = corners.flat_map(u32::to_le_bytes).collect();
        let of_faces = self.view(&faces, None, Some(INDICES));
        let indices = Accessor::of(of_faces, Number::U32, "SCALAR", 3 * mesh.faces.len() as u64);
        let indices = self.file.accessor(indices);
        Shape { view, vertices, bounds: bounds_of(&mesh.vertices), others, indices, material }
    }

    /// Enters the organs of one model with a mesh of their own; the node without a place.
    fn enter(&mut self, name: &str, shape: &Shape, organs: &[Placed]) -> Value {
        // three.js keeps the attributes of instances with the vertices, which it shares between meshes whose accessors
        // are the same. So each mesh has an accessor of its own.
        let places = Accessor::of(shape.view, Number::F32, "VEC3", shape.vertices).within(shape.bounds);
        let mut attributes = json!({ "POSITION": self.file.accessor(places) });
        for &(name, accessor) in &shape.others {
            attributes[name] = accessor.into();
        }
        let primitive = json!({ "attributes": attributes, "indices": shape.indices, "material": shape.material });
        self.file.meshes.push(json!({ "name": name, "primitives": [primitive] }));
        let mesh = self.file.meshes.len() - 1;
        let instances = json!({
            "TRANSLATION": self.column("VEC3", organs, |organ| organ.translation),
            "ROTATION": self.column("VEC4", organs, |organ| organ.rotation),
            "SCALE": self.column("VEC3", organs, |organ| organ.scale),
            "_BIRTH_AGE": self.column("SCALAR", organs, |organ| [organ.birth]),
            "_DEATH_AGE": self.column("SCALAR", organs, |_| [f32::MAX]),
            "_COMPONENT_ID": self.column("SCALAR", organs, |organ| [organ.component as f32]),
        });
        json!({ "name": name, "mesh": mesh, "extensions": { EXTENSION: { "attributes": instances } } })
    }

    fn column<const N: usize>(
        &mut self,
        shape: &'static str,
        organs: &[Placed],
        read: impl Fn(&Placed) -> [f32; N],
    ) -> usize {
        let bytes: Vec<u8> = organs.iter().flat_map(read).flat_map(f32::to_le_bytes).collect();
        let view = self.view(&bytes, None, None);
        self.file.accessor(Accessor::of(view, Number::F32, shape, organs.len() as u64))
    }

    /// Enters a plant with the nodes of its organs.
    fn stand(&mut self, member: &Member, name: &str, organs: &[Value]) {
        if organs.is_empty() {
            return;
        }
        let children: Vec<usize> = organs.iter().map(|node| self.file.node(node.clone())).collect();
        let mut node = json!({ "name": format!("organs of {name}"), "children": children });
        if member.offset != [0.0; 3] {
            node["translation"] = json!(y_up(member.offset));
        }
        let node = self.file.node(node);
        self.file.roots.push(node);
    }
}

/// The least and the largest coordinates of a model, in the axes of glTF.
fn bounds_of(vertices: &[Vertex]) -> [[f32; 3]; 2] {
    let mut bounds: Option<[[f32; 3]; 2]> = None;
    for at in vertices.iter().map(|vertex| y_up(vertex.position())) {
        let [low, high] = bounds.get_or_insert([at, at]);
        (0..3).for_each(|k| (low[k], high[k]) = (low[k].min(at[k]), high[k].max(at[k])));
    }
    bounds.unwrap_or_default()
}
