//! The morph targets of a body, material by material: counted, entered into a file, and written.
//!
//! A target has the moves of the vertices that it moves, by their numbers (sparse accessors). Each patch is in the mesh
//! as it stands at one of two keys, that from which its targets move it least often. Normals are those of the last
//! key at which a part stands. Absent: the animation (`growth`).

use super::body::{Drawn, Patch, Scratch};
use super::document::{Accessor, Document, INDICES, Number, VERTICES, pad, too_large};
use super::paint::{WHITE, enter_material, linear};
use super::still::{unit, y_up};
use super::tangents::Tangents;
use phytomer_meshes::{Tag, Vertex};
use serde_json::{Map, Value, json};
use std::io::{self, Write};

/// The bytes of a vertex, what texture coordinates add, and the bytes of a tangent.
const STRIDE: u64 = 32;
const OF_TEXTURE: u64 = 8;
const OF_TANGENT: u64 = 16;
/// The most vertices of a mesh, as in other formats.
const MOST_VERTICES: u64 = i32::MAX as u64;

/// What is counted of the patches of one material of a body.
pub struct Plan {
    slot: usize,
    /// Whether pictures of colours and of relief lie on them.
    is_covered: bool,
    has_relief: bool,
    pub vertices: u64,
    pub faces: u64,
    /// The key at which each patch is in the mesh as it stands there.
    at: Vec<u16>,
    bounds: [[i16; 3]; 2],
    targets: Vec<Target>,
}

/// What a target moves.
#[derive(Debug, Clone, Copy)]
struct Target {
    count: u64,
    bounds: [[i16; 3]; 2],
}

/// The bounds of nothing.
const EMPTY: [[i16; 3]; 2] = [[i16::MAX; 3], [i16::MIN; 3]];

impl Target {
    const NONE: Self = Self { count: 0, bounds: EMPTY };
}

impl Plan {
    fn bytes_of_place(&self) -> u64 {
        if self.vertices <= 1 << 16 { 2 } else { 4 }
    }

    /// The bytes of its views.
    pub fn bytes(&self) -> u64 {
        let moved: u64 = self.targets.iter().map(|target| target.count).sum();
        let tangents = if self.has_relief { self.vertices * OF_TANGENT } else { 0 };
        self.vertices * self.stride() + tangents + self.faces * 12 + moved * (6 + self.bytes_of_place())
    }

    fn stride(&self) -> u64 {
        STRIDE + if self.is_covered { OF_TEXTURE } else { 0 }
    }
}

impl Drawn<'_> {
    /// Counts the materials that the body has.
    ///
    /// # Errors
    /// Where there are more vertices than a mesh may have.
    pub fn plan(&self) -> io::Result<Vec<Plan>> {
        let plans = (0..self.slots().len()).map(|slot| self.plan_slot(slot)).filter(|plan| plan.faces > 0);
        let plans: Vec<Plan> = plans.collect();
        let most = plans.iter().map(|plan| plan.vertices).max().unwrap_or(0);
        if most > MOST_VERTICES { Err(too_large(most * STRIDE)) } else { Ok(plans) }
    }

    fn plan_slot(&self, slot: usize) -> Plan {
        let keys = self.body.keyed.keys();
        let none = vec![Target::NONE; keys];
        let texture = self.slots()[slot].texture.as_ref();
        let (is_covered, has_relief) = (texture.is_some(), texture.is_some_and(|texture| texture.normals.is_some()));
        let (at, bounds, targets) = (Vec::new(), EMPTY, none.clone());
        let mut plan = Plan { slot, is_covered, has_relief, vertices: 0, faces: 0, at, bounds, targets };
        let (mut scratch, mut moved) = (Scratch::default(), none);
        for patch in self.patches(slot) {
            let candidates = [patch.near(0, keys), patch.near(keys - 1, keys)];
            let costs = candidates.map(|at| self.moved(patch, at, &mut scratch, &mut moved));
            let at = candidates[usize::from(costs[1] < costs[0])];
            if costs[1] >= costs[0] {
                self.moved(patch, at, &mut scratch, &mut moved);
            }
            plan.at.push(at as u16);
            for (all, own) in plan.targets.iter_mut().zip(&moved) {
                all.count += own.count;
                all.bounds = spanned(all.bounds, own.bounds);
            }
            for place in &scratch.base {
                plan.bounds = spanned(plan.bounds, [*place; 2]);
            }
            plan.vertices += scratch.base.len() as u64;
            self.faces(patch, &mut scratch);
            plan.faces += scratch.faces.len() as u64;
        }
        plan
    }

    /// Counts what each target moves of a patch that is in the mesh as it stands at a key; the sum.
    fn moved(&self, patch: Patch, at: usize, scratch: &mut Scratch, moved: &mut [Target]) -> u64 {
        self.state(patch, at, scratch);
        std::mem::swap(&mut scratch.base, &mut scratch.state);
        let keys = moved.len();
        for key in 0..keys {
            if key > 0 && patch.near(key, keys) == patch.near(key - 1, keys) {
                moved[key] = moved[key - 1];
                continue;
            }
            self.state(patch, key, scratch);
            let target = &mut moved[key];
            *target = Target::NONE;
            for (state, base) in scratch.state.iter().zip(&scratch.base).filter(|(state, base)| state != base) {
                target.count += 1;
                target.bounds = spanned(target.bounds, [[0, 1, 2].map(|k| state[k] - base[k]); 2]);
            }
        }
        moved.iter().map(|target| target.count).sum()
    }

    /// Writes all views of a material.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, plan: &Plan, out: &mut (dyn Write + Send)) -> io::Result<()> {
        let mut scratch = Scratch::default();
        let mut bytes = Vec::new();
        for (patch, at) in self.patches(plan.slot).zip(&plan.at) {
            bytes.clear();
            self.state(patch, usize::from(*at), &mut scratch);
            self.put(patch, plan.is_covered, &mut scratch, &mut bytes);
            out.write_all(&bytes)?;
        }
        if plan.has_relief {
            out.write_all(&self.tangents(plan, &mut scratch))?;
        }
        let mut first = 0;
        for patch in self.patches(plan.slot) {
            bytes.clear();
            self.faces(patch, &mut scratch);
            let corners = scratch.faces.iter().flatten().map(|corner| (first + corner).to_le_bytes());
            corners.for_each(|corner| bytes.extend_from_slice(&corner));
            out.write_all(&bytes)?;
            first += self.vertices(patch) as u32;
        }
        (0..plan.targets.len()).try_for_each(|key| self.write_target(plan, key, &mut scratch, out))
    }

    /// Appends the vertices of a patch as it is in the mesh; white, with texture coordinates, where a picture covers
    /// it.
    fn put(&self, patch: Patch, is_covered: bool, scratch: &mut Scratch, bytes: &mut Vec<u8>) {
        let keyed = &self.body.keyed;
        let textures = if is_covered { self.textures(patch, scratch) } else { Vec::new() };
        let mut put = |vertex: usize, normal: [f32; 3], tag: &Tag| {
            put_vertex(scratch.state[vertex], normal, tag, textures.get(vertex), bytes);
        };
        match patch {
            Patch::Alone(alone) => {
                let tag = Tag { death: keyed.death(alone.keys().end - 1), ..alone.tag };
                let each = keyed.normals(alone).iter().zip(&keyed.colours[alone.colours.clone()]);
                for (vertex, (normal, colour)) in each.enumerate() {
                    put(vertex, *normal, &Tag { colour: *colour, ..tag });
                }
            }
            Patch::Tube(tube) => {
                let mut normals = Vec::new();
                let last = tube.keys.end - 1;
                tube.skin(keyed, last, &mut scratch.rings, &mut |_, normal| normals.push(normal.to_array()));
                for (vertex, normal) in normals.into_iter().enumerate() {
                    put(vertex, normal, &tube.tag(keyed, vertex));
                }
            }
        }
    }

    /// The texture coordinates of a patch.
    fn textures(&self, patch: Patch, scratch: &mut Scratch) -> Vec<[f32; 2]> {
        match patch {
            Patch::Alone(alone) => self.body.keyed.textures[alone.colours.clone()].to_vec(),
            Patch::Tube(tube) => tube.textures(&self.body.keyed, &mut scratch.rings),
        }
    }

    /// The tangents of a material, of its patches as they stand at their last keys, as normals are.
    fn tangents(&self, plan: &Plan, scratch: &mut Scratch) -> Vec<u8> {
        let (keyed, mut tangents, mut first) = (&self.body.keyed, Tangents::default(), 0);
        let tag = Tag { colour: [0; 4], birth: 0.0, death: 0.0, component: 0, kind: 0 };
        for patch in self.patches(plan.slot) {
            let textures = self.textures(patch, scratch);
            let mut add = |vertex: usize, at: [f32; 3], normal: [f32; 3]| {
                let texture = textures.get(vertex).copied().unwrap_or_default();
                tangents.add(&Vertex::new(at, normal, texture, &tag));
            };
            match patch {
                Patch::Alone(alone) => {
                    keyed.corners(alone, alone.keys().end - 1, &mut scratch.corners);
                    let each = scratch.corners.iter().zip(keyed.normals(alone)).enumerate();
                    each.for_each(|(vertex, (at, normal))| add(vertex, *at, *normal));
                }
                Patch::Tube(tube) => {
                    let mut vertex = 0;
                    tube.skin(keyed, tube.keys.end - 1, &mut scratch.rings, &mut |at, normal| {
                        add(vertex, at.to_array(), normal.to_array());
                        vertex += 1;
                    });
                }
            }
            self.faces(patch, scratch);
            scratch.faces.iter().for_each(|face| tangents.join(face.map(|corner| first + corner)));
            first += self.vertices(patch) as u32;
        }
        tangents.bytes()
    }

    /// Writes the places and the moves of a target.
    fn write_target(
        &self,
        plan: &Plan,
        key: usize,
        scratch: &mut Scratch,
        out: &mut (dyn Write + Send),
    ) -> io::Result<()> {
        let (mut places, mut moves, mut first) = (Vec::new(), Vec::new(), 0_u32);
        let short = plan.bytes_of_place() == 2;
        for (patch, at) in self.patches(plan.slot).zip(&plan.at) {
            if patch.near(key, plan.targets.len()) == usize::from(*at) {
                first += self.vertices(patch) as u32;
                continue;
            }
            self.state(patch, usize::from(*at), scratch);
            std::mem::swap(&mut scratch.base, &mut scratch.state);
            self.state(patch, key, scratch);
            for (nth, (state, base)) in scratch.state.iter().zip(&scratch.base).enumerate() {
                if state != base {
                    let place = (first + nth as u32).to_le_bytes();
                    places.extend_from_slice(if short { &place[..2] } else { &place });
                    let by = turned([0, 1, 2].map(|k| state[k] - base[k]));
                    by.iter().for_each(|x| moves.extend_from_slice(&x.to_le_bytes()));
                }
            }
            first += scratch.state.len() as u32;
        }
        for bytes in [places, moves] {
            out.write_all(&bytes)?;
            pad(bytes.len() as u64, out)?;
        }
        Ok(())
    }
}

/// Enters a material of a body, by its place in the file, with what has it and its targets.
pub fn enter_slot(file: &mut Document, plan: &Plan, material: usize) -> Value {
    let (vertices, stride) = (plan.vertices, plan.stride());
    let view = file.view(vertices * stride, Some(stride), Some(VERTICES));
    let of = |number, shape, offset| Accessor::of(view, number, shape, vertices).at(offset);
    let mut attributes = vec![
        ("POSITION", of(Number::I16, "VEC3", 0).within(bounds_of(plan.bounds))),
        ("NORMAL", of(Number::I8, "VEC3", 8).normalized()),
        ("COLOR_0", of(Number::U16, "VEC4", 12).normalized()),
        ("_BIRTH_AGE", of(Number::F32, "SCALAR", 20)),
        ("_DEATH_AGE", of(Number::F32, "SCALAR", 24)),
        ("_COMPONENT_ID", of(Number::F32, "SCALAR", 28)),
    ];
    if plan.is_covered {
        attributes.push(("TEXCOORD_0", of(Number::F32, "VEC2", STRIDE)));
    }
    if plan.has_relief {
        let tangents = file.view(vertices * OF_TANGENT, None, Some(VERTICES));
        attributes.push(("TANGENT", Accessor::of(tangents, Number::F32, "VEC4", vertices)));
    }
    let entered = attributes.into_iter().map(|(name, accessor)| (name.to_owned(), file.accessor(accessor).into()));
    let attributes: Map<String, Value> = entered.collect();
    let of_faces = file.view(plan.faces * 12, None, Some(INDICES));
    let indices = file.accessor(Accessor::of(of_faces, Number::U32, "SCALAR", 3 * plan.faces));
    let targets: Vec<Value> =
        plan.targets.iter().map(|target| json!({ "POSITION": target.enter(file, plan) })).collect();
    json!({ "attributes": attributes, "indices": indices, "material": material, "targets": targets })
}

impl Drawn<'_> {
    /// Enters the material of what is counted; the bytes of its pictures are added to those of the views.
    pub fn enter_material(&self, file: &mut Document, plan: &Plan, bytes: &mut Vec<u8>) -> usize {
        enter_material(&self.slots()[plan.slot], file, bytes)
    }
}

impl Target {
    fn enter(&self, file: &mut Document, plan: &Plan) -> usize {
        let sparse = (self.count > 0).then(|| {
            let places = file.view(self.count * plan.bytes_of_place(), None, None);
            let number = if plan.bytes_of_place() == 2 { Number::U16 } else { Number::U32 };
            (self.count, places, number, file.view(self.count * 6, None, None))
        });
        // Vertices that are not named are not moved.
        let bounds = if self.count < plan.vertices { spanned(self.bounds, [[0; 3]; 2]) } else { self.bounds };
        let moves = Accessor::of(0, Number::I16, "VEC3", plan.vertices).within(bounds_of(bounds));
        file.accessor(Accessor { view: None, sparse, ..moves })
    }
}

fn put_vertex(at: [i16; 3], normal: [f32; 3], tag: &Tag, texture: Option<&[f32; 2]>, bytes: &mut Vec<u8>) {
    turned(at).iter().for_each(|x| bytes.extend_from_slice(&x.to_le_bytes()));
    bytes.extend_from_slice(&[0; 2]);
    let normal = y_up(unit(normal)).map(|x| (x * 127.0).round() as i8);
    bytes.extend_from_slice(&normal.map(|x| x as u8));
    bytes.push(0);
    let colour = if texture.is_some() { WHITE } else { linear(tag.colour) };
    colour.iter().for_each(|channel| bytes.extend_from_slice(&channel.to_le_bytes()));
    let floats = [tag.birth, tag.death.min(f32::MAX), tag.component as f32];
    let texture = texture.map(|[s, t]| [*s, 1.0 - t]);
    floats.iter().chain(texture.iter().flatten()).for_each(|x| bytes.extend_from_slice(&x.to_le_bytes()));
}

/// A place or a move in the axes of glTF, whose Y is up.
fn turned([x, y, z]: [i16; 3]) -> [i16; 3] {
    [x, z, -y]
}

/// Bounds in the axes of glTF.
fn bounds_of([low, high]: [[i16; 3]; 2]) -> [[f32; 3]; 2] {
    [[low[0], low[2], -high[1]], [high[0], high[2], -low[1]]].map(|bound| bound.map(f32::from))
}

fn spanned([low, high]: [[i16; 3]; 2], [least, most]: [[i16; 3]; 2]) -> [[i16; 3]; 2] {
    [[0, 1, 2].map(|k| low[k].min(least[k])), [0, 1, 2].map(|k| high[k].max(most[k]))]
}
