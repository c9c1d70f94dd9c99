//! A whole life as GLB: meshes with a morph target for each key age, and an animation of their weights.
//!
//! At a key the weight of its target is 1 and all others are 0, so the plant is there as it has grown; between two keys
//! every vertex goes evenly from one to the other. Without an animation the last key is shown. What does not stand is
//! a point ([`Keyed`]). Positions are whole numbers of 16 bits (KHR_mesh_quantization): multiples of a step that is a
//! 32,766th of the largest extent, the same at all keys, so that a target has the difference of two whole numbers
//! exactly. A target names only the vertices that it moves (sparse accessors). Each patch has, as its own place in the
//! mesh, that at one of two keys which its targets move least often. Colours do not change; normals are those of the
//! last key at which a part stands. Absent: what happens between keys, where a plant bends or sheds.

use super::document::{Accessor, Document, INDICES, MOST_BYTES, Number, VERTICES, pad, too_large};
use super::keys::{Alone, Keyed};
use super::paint::{CLASSES, class_of, linear, material};
use super::still::{unit, y_up};
use super::wood::{Ring, Tube};
use phytomer_meshes::Tag;
use serde_json::{Map, Value, json};
use std::io::{self, Write};

/// The bytes of a vertex.
const STRIDE: u64 = 32;
/// The most vertices of a mesh, as in other formats.
const MOST_VERTICES: u64 = i32::MAX as u64;
/// The largest place on the grid, half of the largest number of 16 bits: the difference of two places must fit too.
const REACH: f64 = 16_383.0;

/// A plant, or what stands among plants, at all keys.
pub struct Body {
    /// What it is called.
    pub name: String,
    /// The place of its seed, metres from the place of the file.
    pub place: [f64; 3],
    /// How it is shown at each key.
    pub keyed: Keyed,
}

/// A life to be written.
pub struct Growth {
    /// Plants and obstacles.
    pub bodies: Vec<Body>,
    /// The keys: ages of a plant, or ticks of a plot; at least two, in their order.
    pub ages: Vec<f32>,
    /// How long the animation is, seconds.
    pub seconds: f64,
    /// How near the wood is drawn, metres.
    pub tolerance: f32,
    /// What the file says of itself: its name.
    pub note: String,
    /// The place of its origin, metres.
    pub origin: [f64; 3],
}

/// What was written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Written {
    /// The number of vertices.
    pub vertices: u64,
    /// The number of triangles.
    pub faces: u64,
    /// The coarsest step of positions, metres.
    pub step: f64,
}

/// Writes a whole GLB file.
///
/// # Errors
/// Those of `out`; a file that would be larger than the format can hold, before anything is written.
pub fn write_growth(growth: &Growth, out: &mut (dyn Write + Send)) -> io::Result<Written> {
    let drawn: Vec<Drawn> = growth.bodies.iter().map(|body| Drawn::of(body, growth.tolerance)).collect();
    let mut file = Document::default();
    let mut plans = Vec::new();
    for drawn in &drawn {
        plans.push(drawn.plan()?);
    }
    let bytes: u64 = plans.iter().flatten().map(Plan::bytes).sum();
    if bytes > MOST_BYTES {
        return Err(too_large(bytes));
    }
    let mut written = Written { vertices: 0, faces: 0, step: 0.0 };
    let mut animated = Vec::new();
    for (drawn, plans) in drawn.iter().zip(&plans) {
        let node = drawn.enter(&mut file, plans, growth);
        animated.extend((!plans.is_empty() && drawn.moves).then_some(node));
        written.vertices += plans.iter().map(|plan| plan.vertices).sum::<u64>();
        written.faces += plans.iter().map(|plan| plan.faces).sum::<u64>();
        written.step = written.step.max(drawn.grid.step);
    }
    if !plans.iter().all(Vec::is_empty) {
        file.uses.push("KHR_mesh_quantization");
        file.requires.push("KHR_mesh_quantization");
    }
    let weights = growth.enter_animation(&mut file, &animated);
    growth.extras(&mut file.extras, written.step);
    file.write_head(out)?;
    for (drawn, plans) in drawn.iter().zip(&plans) {
        plans.iter().try_for_each(|plan| drawn.write(plan, out))?;
    }
    weights.iter().try_for_each(|x| out.write_all(&x.to_le_bytes()))?;
    Ok(written)
}

impl Growth {
    /// Enters the animation, and returns its numbers: the times, then the weights at each.
    fn enter_animation(&self, file: &mut Document, nodes: &[usize]) -> Vec<f32> {
        if nodes.is_empty() {
            return Vec::new();
        }
        let keys = self.ages.len();
        let (first, last) = (self.ages.first().copied().unwrap_or(0.0), self.ages.last().copied().unwrap_or(1.0));
        let time = |age: &f32| (self.seconds * f64::from(age - first) / f64::from(last - first)) as f32;
        let times: Vec<f32> = self.ages.iter().map(time).collect();
        let of_times = file.view(4 * keys as u64, None, None);
        let bounds = [[times[0]], [times[keys - 1]]];
        let input = file.accessor(Accessor::of(of_times, Number::F32, "SCALAR", keys as u64).within(bounds));
        let of_weights = file.view(4 * (keys * keys) as u64, None, None);
        let output = file.accessor(Accessor::of(of_weights, Number::F32, "SCALAR", (keys * keys) as u64));
        let channel = |node: &usize| json!({ "sampler": 0, "target": { "node": node, "path": "weights" } });
        let channels: Vec<Value> = nodes.iter().map(channel).collect();
        file.animations.push(json!({
            "name": "life",
            "channels": channels,
            "samplers": [{ "input": input, "output": output, "interpolation": "LINEAR" }],
        }));
        let weights = (0..keys * keys).map(|k| if k / keys == k % keys { 1.0 } else { 0.0 });
        times.into_iter().chain(weights).collect()
    }

    fn extras(&self, extras: &mut Map<String, Value>, step: f64) {
        extras.insert("notes".to_owned(), json!([self.note]));
        extras.insert("place_m".to_owned(), json!(self.origin));
        extras.insert("tolerance_m".to_owned(), json!(self.tolerance));
        extras.insert("step_m".to_owned(), json!(step));
        extras.insert("ages".to_owned(), json!(self.ages));
        extras.insert("seconds".to_owned(), json!(self.seconds));
    }
}

/// The grid of positions of a body.
#[derive(Debug, Clone, Copy)]
struct Grid {
    middle: [f64; 3],
    step: f64,
}

impl Grid {
    fn of([low, high]: [[f32; 3]; 2]) -> Self {
        let half = |k: usize| 0.5 * (f64::from(high[k]) - f64::from(low[k]));
        let middle = [0, 1, 2].map(|k| f64::from(low[k]) + half(k));
        let largest = [0, 1, 2].map(half).into_iter().fold(0.0, f64::max);
        Self { middle, step: if largest > 0.0 { largest / REACH } else { 1.0 } }
    }

    #[inline]
    fn place(&self, at: [f32; 3]) -> [i16; 3] {
        [0, 1, 2].map(|k| ((f64::from(at[k]) - self.middle[k]) / self.step).round().clamp(-REACH, REACH) as i16)
    }
}

/// A part of a body whose vertices and triangles are the same at all keys.
#[derive(Clone, Copy)]
enum Patch<'a> {
    Tube(&'a Tube),
    Alone(&'a Alone),
}

/// A body ready to be written.
struct Drawn<'a> {
    body: &'a Body,
    tubes: Vec<Tube>,
    grid: Grid,
    /// Whether anything of it is not the same at all keys.
    moves: bool,
}

/// What is counted of the patches of one class of a body.
struct Plan {
    class: usize,
    vertices: u64,
    faces: u64,
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

    fn bytes(&self) -> u64 {
        let moved: u64 = self.targets.iter().map(|target| target.count).sum();
        self.vertices * STRIDE + self.faces * 12 + moved * (6 + self.bytes_of_place())
    }
}

/// Working memory.
#[derive(Default)]
struct Scratch {
    rings: Vec<Ring>,
    corners: Vec<[f32; 3]>,
    faces: Vec<[u32; 3]>,
    base: Vec<[i16; 3]>,
    state: Vec<[i16; 3]>,
}

impl<'a> Drawn<'a> {
    fn of(body: &'a Body, tolerance: f32) -> Self {
        let tubes = Tube::all(&body.keyed, tolerance);
        let mut drawn = Self { body, tubes, grid: Grid { middle: [0.0; 3], step: 1.0 }, moves: false };
        let mut bounds: Option<[[f32; 3]; 2]> = None;
        let (mut scratch, keys) = (Scratch::default(), body.keyed.keys());
        for patch in (0..CLASSES.len()).flat_map(|class| drawn.patches(class)) {
            for key in 0..keys {
                drawn.corners(patch, key, &mut scratch);
                for at in &scratch.corners {
                    let [low, high] = bounds.get_or_insert([*at, *at]);
                    (0..3).for_each(|k| (low[k], high[k]) = (low[k].min(at[k]), high[k].max(at[k])));
                }
            }
        }
        drawn.grid = Grid::of(bounds.unwrap_or_default());
        drawn.moves = (0..keys).any(|key| body.keyed.age(key).is_some());
        drawn
    }

    fn patches(&self, class: usize) -> impl Iterator<Item = Patch<'_>> {
        let tubes = self.tubes.iter().filter(move |_| class == 0).map(Patch::Tube);
        let alone = self.body.keyed.alone.iter().filter(move |alone| class_of(&alone.tag) == class);
        tubes.chain(alone.map(Patch::Alone))
    }

    fn corners(&self, patch: Patch, key: usize, scratch: &mut Scratch) {
        let Scratch { rings, corners, .. } = scratch;
        match patch {
            Patch::Alone(alone) => self.body.keyed.corners(alone, key, corners),
            Patch::Tube(tube) => {
                corners.clear();
                tube.skin(&self.body.keyed, key, rings, &mut |at, _| corners.push(at.to_array()));
            }
        }
    }

    /// The places of a patch on the grid at a key.
    fn state(&self, patch: Patch, key: usize, scratch: &mut Scratch) {
        self.corners(patch, key, scratch);
        let Scratch { corners, state, .. } = scratch;
        state.clear();
        state.extend(corners.iter().map(|at| self.grid.place(*at)));
    }

    /// Counts the classes that the body has.
    fn plan(&self) -> io::Result<Vec<Plan>> {
        let plans = (0..CLASSES.len()).map(|class| self.plan_class(class)).filter(|plan| plan.faces > 0);
        let plans: Vec<Plan> = plans.collect();
        let most = plans.iter().map(|plan| plan.vertices).max().unwrap_or(0);
        if most > MOST_VERTICES { Err(too_large(most * STRIDE)) } else { Ok(plans) }
    }

    fn plan_class(&self, class: usize) -> Plan {
        let keys = self.body.keyed.keys();
        let none = vec![Target::NONE; keys];
        let mut plan = Plan { class, vertices: 0, faces: 0, at: Vec::new(), bounds: EMPTY, targets: none.clone() };
        let (mut scratch, mut moved) = (Scratch::default(), none);
        for patch in self.patches(class) {
            let stands = match patch {
                Patch::Tube(tube) => tube.keys.clone(),
                Patch::Alone(alone) => alone.keys(),
            };
            let candidates = [stands.start.saturating_sub(1), keys - 1];
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
        for (key, target) in moved.iter_mut().enumerate() {
            *target = Target::NONE;
            self.state(patch, key, scratch);
            for (state, base) in scratch.state.iter().zip(&scratch.base).filter(|(state, base)| state != base) {
                target.count += 1;
                target.bounds = spanned(target.bounds, [[0, 1, 2].map(|k| state[k] - base[k]); 2]);
            }
        }
        moved.iter().map(|target| target.count).sum()
    }

    fn faces(&self, patch: Patch, scratch: &mut Scratch) {
        match patch {
            Patch::Tube(tube) => tube.faces(&self.body.keyed, &mut scratch.faces),
            Patch::Alone(alone) => {
                scratch.faces.clear();
                scratch.faces.extend_from_slice(&self.body.keyed.faces[alone.faces.clone()]);
            }
        }
    }

    /// Enters the node of the body with its mesh; its index.
    fn enter(&self, file: &mut Document, plans: &[Plan], growth: &Growth) -> usize {
        let mut node = json!({ "name": self.body.name });
        if !plans.is_empty() {
            let primitives: Vec<Value> = plans.iter().map(|plan| enter_class(file, plan)).collect();
            let mut weights = vec![0; growth.ages.len()];
            weights.iter_mut().last().into_iter().for_each(|last| *last = 1);
            let names: Vec<String> = growth.ages.iter().map(|age| format!("age {age}")).collect();
            file.meshes.push(json!({
                "name": self.body.name,
                "primitives": primitives,
                "weights": weights,
                "extras": { "targetNames": names },
            }));
            let [x, y, z] = [0, 1, 2].map(|k| self.grid.middle[k] + self.body.place[k]);
            node["mesh"] = (file.meshes.len() - 1).into();
            node["translation"] = json!([x, z, -y]);
            node["scale"] = vec![self.grid.step; 3].into();
        }
        let node = file.node(node);
        file.roots.push(node);
        node
    }

    /// Writes all views of a class.
    fn write(&self, plan: &Plan, out: &mut (dyn Write + Send)) -> io::Result<()> {
        let mut scratch = Scratch::default();
        let mut bytes = Vec::new();
        for (patch, at) in self.patches(plan.class).zip(&plan.at) {
            bytes.clear();
            self.state(patch, usize::from(*at), &mut scratch);
            self.put(patch, &mut scratch, &mut bytes);
            out.write_all(&bytes)?;
        }
        let mut first = 0;
        for patch in self.patches(plan.class) {
            bytes.clear();
            self.faces(patch, &mut scratch);
            let corners = scratch.faces.iter().flatten().map(|corner| (first + corner).to_le_bytes());
            corners.for_each(|corner| bytes.extend_from_slice(&corner));
            out.write_all(&bytes)?;
            first += self.vertices(patch) as u32;
        }
        (0..plan.targets.len()).try_for_each(|key| self.write_target(plan, key, &mut scratch, out))
    }

    fn vertices(&self, patch: Patch) -> usize {
        match patch {
            Patch::Tube(tube) => tube.vertices(&self.body.keyed),
            Patch::Alone(alone) => alone.vertices(),
        }
    }

    /// Appends the vertices of a patch as it is in the mesh.
    fn put(&self, patch: Patch, scratch: &mut Scratch, bytes: &mut Vec<u8>) {
        let keyed = &self.body.keyed;
        match patch {
            Patch::Alone(alone) => {
                let tag = Tag { death: keyed.death(alone.keys().end - 1), ..alone.tag };
                let each = scratch.state.iter().zip(keyed.normals(alone)).zip(&keyed.colours[alone.colours.clone()]);
                for ((at, normal), colour) in each {
                    put_vertex(*at, *normal, &Tag { colour: *colour, ..tag }, bytes);
                }
            }
            Patch::Tube(tube) => {
                let mut normals = Vec::new();
                let last = tube.keys.end - 1;
                tube.skin(keyed, last, &mut scratch.rings, &mut |_, normal| normals.push(normal.to_array()));
                for (vertex, (at, normal)) in scratch.state.iter().zip(normals).enumerate() {
                    put_vertex(*at, normal, &tube.tag(keyed, vertex), bytes);
                }
            }
        }
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
        for (patch, at) in self.patches(plan.class).zip(&plan.at) {
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

/// Enters a class of a body, and its targets.
fn enter_class(file: &mut Document, plan: &Plan) -> Value {
    let vertices = plan.vertices;
    let view = file.view(vertices * STRIDE, Some(STRIDE), Some(VERTICES));
    let of = |number, shape, offset| Accessor::of(view, number, shape, vertices).at(offset);
    let attributes = [
        ("POSITION", of(Number::I16, "VEC3", 0).within(bounds_of(plan.bounds))),
        ("NORMAL", of(Number::I8, "VEC3", 8).normalized()),
        ("COLOR_0", of(Number::U16, "VEC4", 12).normalized()),
        ("_BIRTH_AGE", of(Number::F32, "SCALAR", 20)),
        ("_DEATH_AGE", of(Number::F32, "SCALAR", 24)),
        ("_COMPONENT_ID", of(Number::F32, "SCALAR", 28)),
    ];
    let entered = attributes.into_iter().map(|(name, accessor)| (name.to_owned(), file.accessor(accessor).into()));
    let attributes: Map<String, Value> = entered.collect();
    let of_faces = file.view(plan.faces * 12, None, Some(INDICES));
    let indices = file.accessor(Accessor::of(of_faces, Number::U32, "SCALAR", 3 * plan.faces));
    let targets: Vec<Value> =
        plan.targets.iter().map(|target| json!({ "POSITION": target.enter(file, plan) })).collect();
    json!({
        "attributes": attributes,
        "indices": indices,
        "material": file.material(material(plan.class)),
        "targets": targets,
    })
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

fn put_vertex(at: [i16; 3], normal: [f32; 3], tag: &Tag, bytes: &mut Vec<u8>) {
    turned(at).iter().for_each(|x| bytes.extend_from_slice(&x.to_le_bytes()));
    bytes.extend_from_slice(&[0; 2]);
    let normal = y_up(unit(normal)).map(|x| (x * 127.0).round() as i8);
    bytes.extend_from_slice(&normal.map(|x| x as u8));
    bytes.push(0);
    linear(tag.colour).iter().for_each(|channel| bytes.extend_from_slice(&channel.to_le_bytes()));
    let floats = [tag.birth, tag.death.min(f32::MAX), tag.component as f32];
    floats.iter().for_each(|x| bytes.extend_from_slice(&x.to_le_bytes()));
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
