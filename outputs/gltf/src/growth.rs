//! A whole life as GLB: meshes with a morph target for each key age, and an animation of their weights.
//!
//! At a key the weight of its target is 1 and all others are 0, so the plant is there as it has grown; between two keys
//! every vertex goes evenly from one to the other. Without an animation the last key is shown. What does not stand is a
//! point ([`super::keys`]). Positions are whole numbers of 16 bits (KHR_mesh_quantization, `body`), and targets name
//! only what they move (`morph`). Colours do not change. Absent: what happens between keys, where a plant bends or
//! sheds.

use super::body::{Body, Drawn};
use super::document::{Accessor, Document, MOST_BYTES, Number, too_large};
use super::morph::{Plan, enter_slot};
use serde_json::{Map, Value, json};
use std::io::{self, Write};

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
    let (mut animated, mut pictures) = (Vec::new(), Vec::new());
    // The bytes of pictures stand before those of all meshes.
    let each = drawn.iter().zip(&plans).flat_map(|(drawn, plans)| plans.iter().map(move |plan| (drawn, plan)));
    let materials = each.map(|(drawn, plan)| drawn.enter_material(&mut file, plan, &mut pictures));
    let mut materials = materials.collect::<Vec<usize>>().into_iter();
    for (drawn, plans) in drawn.iter().zip(&plans) {
        let node = drawn.enter(&mut file, (plans, &mut materials), growth);
        animated.extend((!plans.is_empty() && drawn.moves).then_some(node));
        written.vertices += plans.iter().map(|plan| plan.vertices).sum::<u64>();
        written.faces += plans.iter().map(|plan| plan.faces).sum::<u64>();
        // What has no extent has no grid.
        written.step = if plans.is_empty() { written.step } else { written.step.max(drawn.grid.step) };
    }
    if !plans.iter().all(Vec::is_empty) {
        file.uses.push("KHR_mesh_quantization");
        file.requires.push("KHR_mesh_quantization");
    }
    let weights = growth.enter_animation(&mut file, &animated);
    growth.extras(&mut file.extras, written.step);
    file.write_head(out)?;
    out.write_all(&pictures)?;
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

impl Drawn<'_> {
    /// Enters the node of the body with its mesh, whose materials come in the order of the plans; its index.
    fn enter(
        &self,
        file: &mut Document,
        (plans, materials): (&[Plan], &mut dyn Iterator<Item = usize>),
        growth: &Growth,
    ) -> usize {
        let mut node = json!({ "name": self.body.name });
        if !plans.is_empty() {
            let primitives: Vec<Value> =
                plans.iter().zip(materials).map(|(plan, of)| enter_slot(file, plan, of)).collect();
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
}
