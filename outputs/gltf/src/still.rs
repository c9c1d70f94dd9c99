//! A mesh at one age as GLB: a plant or a plot, as PLY has it, with the properties of its vertices.
//!
//! Metres, Y up: our (x, y, z) is (x, z, −y) there. Each material slot, of a class of components (wood, leaves,
//! flowers, fruits, obstacles) or of an order of it, is a primitive with its own material. A vertex has position,
//! normal, texture coordinates, colour in linear light, `_BIRTH_AGE`, `_DEATH_AGE` and `_COMPONENT_ID`, as floats,
//! which hold whole numbers below 2²⁴; what lives has the largest float as `_DEATH_AGE`, because glTF knows no
//! infinity. Columns of a mesh follow, as `_UNTIL_M`. Texture coordinates run from the top, as glTF counts them. The
//! mesh is drawn once to be counted and once more a slot to be written, so that none of it is kept but a few bytes for
//! each run of vertices of one slot. Positions of a skinned mesh stand as they do in calm air.

use super::document::{Accessor, Document, INDICES, MOST_BYTES, Number, VERTICES, pad, too_large};
use super::paint::{WHITE, enter_material, linear};
use super::tangents::Tangents;
use phytomer_meshes::{Columns, Drawing, Slots, Vertex};
use serde_json::{Map, Value, json};
use std::io::{self, Write};

/// The bytes of a vertex without what it belongs to.
pub const SHAPE: u64 = 40;
/// The bytes of a vertex, and what a skin adds.
const STRIDE: u64 = SHAPE + 12;
const OF_SKIN: u64 = 8;

/// The bytes of a vertex of a mesh, with its columns.
fn stride(mesh: &dyn Drawing, skinned: bool) -> u64 {
    let columns = mesh.columns().map_or(0, |columns| columns.names().len() as u64);
    STRIDE + if skinned { OF_SKIN } else { 0 } + 4 * columns
}

/// The joints that move a vertex, and their shares of 255, which are the whole together.
pub type Bound = ([u8; 4], [u8; 4]);

/// The joints of a vertex.
pub type Binding<'b> = dyn Fn(&Vertex) -> Bound + 'b;

/// A vector in the axes of glTF, whose Y is up.
#[inline]
pub fn y_up([x, y, z]: [f32; 3]) -> [f32; 3] {
    [x, z, -y]
}

/// Neighbouring vertices of one slot.
#[derive(Debug, Clone, Copy)]
struct Run {
    /// The first vertex in the mesh, and in its slot.
    first: u32,
    own: u32,
    slot: u16,
}

/// What is counted before a file is written.
#[derive(Debug, Default)]
struct Plan {
    runs: Vec<Run>,
    /// All vertices, and for each slot its own.
    all: u64,
    vertices: Vec<u64>,
    faces: Vec<u64>,
    bounds: Vec<Option<[[f32; 3]; 2]>>,
}

/// Writes a whole GLB file.
///
/// # Errors
/// Those of `out`; a mesh that is larger than the format can hold, before anything is written.
pub fn write_still(mesh: &dyn Drawing, out: &mut (dyn Write + Send)) -> io::Result<()> {
    Still::of(mesh, None)?.write(Document::default(), Vec::new(), out)
}

/// A mesh that is counted and ready to be written.
pub struct Still<'a> {
    mesh: &'a dyn Drawing,
    skin: Option<&'a Binding<'a>>,
    slots: Slots,
    plan: Plan,
}

impl<'a> Still<'a> {
    /// Counts a mesh; `skin` binds its vertices to the joints of a skin.
    ///
    /// # Errors
    /// Where the file would be larger than its format allows: told before anything is drawn.
    pub fn of(mesh: &'a dyn Drawing, skin: Option<&'a Binding<'a>>) -> io::Result<Self> {
        let (counts, stride) = (mesh.counts(), stride(mesh, skin.is_some()));
        let bytes = counts.vertices * stride + counts.faces * 12;
        if bytes > MOST_BYTES {
            return Err(too_large(bytes));
        }
        let slots = mesh.slots();
        let (mut plan, mut in_turn) = (Plan::of(slots.list().len()), slots.in_turn());
        mesh.vertices(&mut |vertices| {
            vertices.iter().for_each(|vertex| plan.count(vertex, in_turn.next(vertex)));
            Ok(())
        })?;
        let (mut faces, mut at) = (vec![0; slots.list().len()], 0);
        mesh.faces(&mut |drawn| {
            drawn.iter().for_each(|face| faces[usize::from(plan.run(face.indices()[0], &mut at).slot)] += 1);
            Ok(())
        })?;
        plan.faces = faces;
        Ok(Self { mesh, skin, slots, plan })
    }

    fn stride(&self) -> u64 {
        stride(self.mesh, self.skin.is_some())
    }

    /// The names of the columns of the mesh, as glTF has names of its users.
    fn columns(&self) -> Vec<String> {
        let names = self.mesh.columns().map(Columns::names).unwrap_or_default();
        names.iter().map(|name| format!("_{}", name.to_uppercase())).collect()
    }

    /// Writes the file; `file` has what else is in it, and `bytes` are those of its views. A mesh that is bound to
    /// joints gets the first skin of the file.
    ///
    /// # Errors As [`write_still`].
    pub fn write(&self, mut file: Document, mut bytes: Vec<u8>, out: &mut (dyn Write + Send)) -> io::Result<()> {
        file.extras.extend(extras_of(self.mesh));
        let node = self.enter_node(&mut file, "", &mut bytes);
        let node = file.node(node);
        file.roots.push(node);
        file.write_head(out)?;
        out.write_all(&bytes)?;
        self.write_bytes(out)
    }

    /// Enters the materials of the mesh, and adds the bytes of their pictures to those of the views.
    pub fn enter_materials(&self, file: &mut Document, bytes: &mut Vec<u8>) {
        self.filled().for_each(|slot| _ = enter_material(&self.slots.list()[slot], file, bytes));
    }

    /// Enters the mesh; its node, whose name ends in `ending`. The bytes of pictures that are not in the file yet are
    /// added to those of the views.
    pub fn enter_node(&self, file: &mut Document, ending: &str, bytes: &mut Vec<u8>) -> Value {
        let name = self.mesh.notes().into_iter().next().unwrap_or_default() + ending;
        let Some(mesh) = self.enter(file, &name, bytes) else { return json!({ "name": name }) };
        let mut node = json!({ "name": name, "mesh": mesh });
        self.skin.iter().for_each(|_| node["skin"] = json!(0));
        node
    }

    /// Writes the bytes of the views of the mesh, in the order in which they are entered.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write_bytes(&self, out: &mut (dyn Write + Send)) -> io::Result<()> {
        for slot in self.filled() {
            self.write_vertices(slot, out)?;
            if self.has_relief(slot) {
                out.write_all(&self.tangents(slot)?.bytes())?;
            }
            self.write_faces(slot, out)?;
        }
        Ok(())
    }

    /// The number of these bytes, about.
    pub fn bytes(&self) -> u64 {
        let counts = self.mesh.counts();
        counts.vertices * self.stride() + counts.faces * 12
    }

    /// Whether a picture of relief lies on a slot.
    fn has_relief(&self, slot: usize) -> bool {
        self.slots.list()[slot].texture.as_ref().is_some_and(|texture| texture.normals.is_some())
    }

    fn tangents(&self, slot: usize) -> io::Result<Tangents> {
        let (mut tangents, mut in_turn, mut at) = (Tangents::default(), self.slots.in_turn(), 0);
        self.mesh.vertices(&mut |vertices| {
            let own = vertices.iter().filter(|vertex| in_turn.next(vertex) == slot);
            own.for_each(|vertex| tangents.add(vertex));
            Ok(())
        })?;
        self.mesh.faces(&mut |faces| {
            for face in faces {
                let run = self.plan.run(face.indices()[0], &mut at);
                if usize::from(run.slot) == slot {
                    tangents.join(face.indices().map(|corner| self.plan.own(corner, run)));
                }
            }
            Ok(())
        })?;
        Ok(tangents)
    }

    /// The slots that have a triangle.
    fn filled(&self) -> impl Iterator<Item = usize> {
        (0..self.plan.faces.len()).filter(|slot| self.plan.faces[*slot] > 0)
    }

    /// Enters the mesh; `None` where it has no triangle.
    fn enter(&self, file: &mut Document, name: &str, bytes: &mut Vec<u8>) -> Option<usize> {
        // The pictures are before the vertices, which are written as they come.
        let materials: Vec<(usize, usize)> =
            self.filled().map(|slot| (slot, enter_material(&self.slots.list()[slot], file, bytes))).collect();
        let enter = |(slot, material): (usize, usize)| self.enter_slot(file, slot, material);
        let primitives: Vec<Value> = materials.into_iter().map(enter).collect();
        if primitives.is_empty() {
            return None;
        }
        file.meshes.push(json!({ "name": name, "primitives": primitives }));
        Some(file.meshes.len() - 1)
    }

    fn enter_slot(&self, file: &mut Document, slot: usize, material: usize) -> Value {
        let (vertices, faces, stride) = (self.plan.vertices[slot], self.plan.faces[slot], self.stride());
        let view = file.view(vertices * stride, Some(stride), Some(VERTICES));
        let of = |number, shape, offset| Accessor::of(view, number, shape, vertices).at(offset);
        let bounds = self.plan.bounds[slot].unwrap_or_default();
        let mut attributes: Vec<(&str, Accessor)> = vec![
            ("POSITION", of(Number::F32, "VEC3", 0).within(bounds)),
            ("NORMAL", of(Number::F32, "VEC3", 12)),
            ("TEXCOORD_0", of(Number::F32, "VEC2", 24)),
            ("COLOR_0", of(Number::U16, "VEC4", 32).normalized()),
            ("_BIRTH_AGE", of(Number::F32, "SCALAR", 40)),
            ("_DEATH_AGE", of(Number::F32, "SCALAR", 44)),
            ("_COMPONENT_ID", of(Number::F32, "SCALAR", 48)),
        ];
        if self.skin.is_some() {
            attributes.push(("JOINTS_0", of(Number::U8, "VEC4", 52)));
            attributes.push(("WEIGHTS_0", of(Number::U8, "VEC4", 56).normalized()));
        }
        let columns = self.columns();
        let first = stride - 4 * columns.len() as u64;
        let more = (0..).zip(&columns).map(|(k, name)| (name.as_str(), of(Number::F32, "SCALAR", first + 4 * k)));
        attributes.extend(more);
        if self.has_relief(slot) {
            let tangents = file.view(16 * vertices, None, Some(VERTICES));
            attributes.push(("TANGENT", Accessor::of(tangents, Number::F32, "VEC4", vertices)));
        }
        let entered = attributes.into_iter().map(|(name, accessor)| (name.to_owned(), file.accessor(accessor).into()));
        let attributes: Map<String, Value> = entered.collect();
        let of_faces = file.view(faces * 12, None, Some(INDICES));
        let indices = file.accessor(Accessor::of(of_faces, Number::U32, "SCALAR", 3 * faces));
        json!({ "attributes": attributes, "indices": indices, "material": material })
    }

    fn write_vertices(&self, slot: usize, out: &mut (dyn Write + Send)) -> io::Result<()> {
        let (mut bytes, mut row, columns) = (Vec::new(), Vec::new(), self.mesh.columns());
        let (mut in_turn, is_white) = (self.slots.in_turn(), self.slots.list()[slot].texture.is_some());
        self.mesh.vertices(&mut |vertices| {
            bytes.clear();
            for vertex in vertices.iter().filter(|vertex| in_turn.next(vertex) == slot) {
                put(vertex, is_white, &mut bytes);
                if let Some((joints, shares)) = self.skin.map(|bind| bind(vertex)) {
                    bytes.extend_from_slice(&joints);
                    bytes.extend_from_slice(&shares);
                }
                row.clear();
                columns.iter().for_each(|columns| columns.put(vertex, &mut row));
                row.iter().for_each(|number| bytes.extend_from_slice(&number.min(f32::MAX).to_le_bytes()));
            }
            out.write_all(&bytes)
        })?;
        pad(self.plan.vertices[slot] * self.stride(), out)
    }

    fn write_faces(&self, slot: usize, out: &mut (dyn Write + Send)) -> io::Result<()> {
        let (mut bytes, mut at) = (Vec::new(), 0);
        self.mesh.faces(&mut |faces| {
            bytes.clear();
            for face in faces {
                let run = self.plan.run(face.indices()[0], &mut at);
                if usize::from(run.slot) == slot {
                    let own = face.indices().map(|corner| self.plan.own(corner, run).to_le_bytes());
                    own.iter().for_each(|corner| bytes.extend_from_slice(corner));
                }
            }
            out.write_all(&bytes)
        })
    }
}

impl Plan {
    fn of(slots: usize) -> Self {
        Self { vertices: vec![0; slots], bounds: vec![None; slots], ..Self::default() }
    }

    fn count(&mut self, vertex: &Vertex, slot: usize) {
        let first = self.all as u32;
        if self.runs.last().is_none_or(|run| usize::from(run.slot) != slot) {
            self.runs.push(Run { first, own: self.vertices[slot] as u32, slot: slot as u16 });
        }
        self.vertices[slot] += 1;
        self.all += 1;
        let at = y_up(vertex.position());
        let [low, high] = self.bounds[slot].get_or_insert([at, at]);
        (0..3).for_each(|k| (low[k], high[k]) = (low[k].min(at[k]), high[k].max(at[k])));
    }

    /// The run of a vertex; `at` remembers the run of the last, near which the next mostly is.
    fn run(&self, vertex: u32, at: &mut usize) -> Run {
        let holds = |place: usize| {
            self.runs.get(place).is_some_and(|run| run.first <= vertex)
                && self.runs.get(place + 1).is_none_or(|next| vertex < next.first)
        };
        if !holds(*at) {
            *at = if holds(*at + 1) {
                *at + 1
            } else {
                self.runs.partition_point(|run| run.first <= vertex).saturating_sub(1)
            };
        }
        self.runs.get(*at).copied().unwrap_or(Run { first: 0, own: 0, slot: 0 })
    }

    /// The place of a vertex in its slot; `near` is the run of a vertex of the same triangle.
    fn own(&self, vertex: u32, near: Run) -> u32 {
        // All corners of a triangle are of one component, whose vertices follow one another.
        near.own + vertex.wrapping_sub(near.first)
    }
}

/// Appends a vertex in the order of the attributes.
fn put(vertex: &Vertex, is_white: bool, bytes: &mut Vec<u8>) {
    let tag = vertex.tag();
    put_shape(vertex, is_white, bytes);
    floats(bytes, &[tag.birth, tag.death.min(f32::MAX), tag.component as f32]);
}

/// Appends place, normal, texture coordinates and colour of a vertex, which is white where a picture lies on it.
pub fn put_shape(vertex: &Vertex, is_white: bool, bytes: &mut Vec<u8>) {
    let [s, t] = vertex.texture();
    floats(bytes, &y_up(vertex.position()));
    floats(bytes, &y_up(unit(vertex.normal())));
    floats(bytes, &[s, 1.0 - t]);
    let colour = if is_white { WHITE } else { linear(vertex.tag().colour) };
    colour.iter().for_each(|channel| bytes.extend_from_slice(&channel.to_le_bytes()));
}

fn floats(bytes: &mut Vec<u8>, of: &[f32]) {
    of.iter().for_each(|x| bytes.extend_from_slice(&x.to_le_bytes()));
}

/// A vector of length 1 of the same direction; straight up where it has none.
pub fn unit(of: [f32; 3]) -> [f32; 3] {
    let length = of.iter().map(|x| x * x).sum::<f32>().sqrt();
    if length > f32::MIN_POSITIVE && length.is_finite() { of.map(|x| x / length) } else { [0.0, 0.0, 1.0] }
}

/// What a file says of a mesh.
pub fn extras_of(mesh: &dyn Drawing) -> Map<String, Value> {
    let mut extras = Map::new();
    extras.insert("notes".to_owned(), mesh.notes().into());
    extras.insert("place_m".to_owned(), json!(mesh.place()));
    if let Some(tolerance) = mesh.tolerance() {
        extras.insert("tolerance_m".to_owned(), json!(tolerance.distance));
    }
    extras
}
