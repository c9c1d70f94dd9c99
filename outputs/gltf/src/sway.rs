//! A plant that sways in a gusty wind as GLB: a skinned mesh, and the loop of its joints as an animation.
//!
//! The full solution, the plant as the wind moves it, is shown moment by moment: [`KEYS`] times a second a key, which
//! keeps where the joints are, and between two keys a moment at which it is only compared. One key is just before the
//! end of the loop, since a gust knocks at its beginning. Told is the largest distance from the tip of an internode to
//! where the joints bring it, with the shares of the file and as a player goes from key to key. Memory holds the joints
//! of all keys and the tips of one moment. Absent: leaves that flutter by themselves.

use super::document::{Accessor, Document, Number};
use super::rig::{Rig, Turned};
use super::still::{Bound, Still, y_up};
use glam::Vec3;
use phytomer_meshes::Drawing;
use phytomer_sim::Tick;
use phytomer_sim::mechanics::sway::GUSTS_S;
use phytomer_sim::plant::{NodeId, Plant};
use serde_json::json;
use std::io::{self, Write};

/// Keys a second.
const KEYS: u32 = 12;
/// How long before the end of the loop its last key is, seconds.
const BEFORE: f64 = 1e-3;

/// A swaying plant.
pub struct Sway {
    rig: Rig,
    /// The joints in calm air.
    rest: Vec<Turned>,
    /// The tips of the internodes that stand, in calm air, with their joints.
    tips: Vec<(NodeId, Vec3, Bound)>,
    /// Each joint as its parent carries it, key by key.
    keys: Vec<Vec<Turned>>,
    /// The true tips at a moment between two keys.
    between: Option<Vec<Vec3>>,
    farthest: f32,
}

impl Sway {
    /// A skeleton of at most so many joints for a plant that stands in calm air; `None` where no internode stands.
    pub fn of(plant: &Plant, age: Tick, joints: u32) -> Option<Self> {
        let rig = Rig::of(plant, age, joints)?;
        let rest = rig.turned(plant);
        let nodes = (0..plant.nodes.len() as u32).map(NodeId).filter(|node| plant.stands(*node, age));
        let tips = nodes.map(|node| (node, tip(plant, node), rig.bind_tip(node))).collect();
        Some(Self { rig, rest, tips, keys: Vec::new(), between: None, farthest: 0.0 })
    }

    /// The moments at which the plant must be shown, seconds: a key and a moment between two keys in turn.
    pub fn moments() -> Vec<f64> {
        let keys = (GUSTS_S * f64::from(KEYS)).round() as u32;
        let key = |k: u32| if k == keys { GUSTS_S - BEFORE } else { f64::from(k) / f64::from(KEYS) };
        (0..=2 * keys).map(|k| 0.5 * (key(k / 2) + key(k.div_ceil(2)))).collect()
    }

    /// Shows the plant at the next moment.
    pub fn show(&mut self, plant: &Plant) {
        let true_tips = self.tips.iter().map(|(node, ..)| tip(plant, *node)).collect::<Vec<_>>();
        if self.between.is_none() && !self.keys.is_empty() {
            self.between = Some(true_tips);
            return;
        }
        let turned = self.rig.turned(plant);
        let carried = |(joint, own): (&super::rig::Joint, &Turned)| {
            joint.parent.map_or(*own, |parent| turned[usize::from(parent)].inwards(own))
        };
        let mut locals: Vec<Turned> = self.rig.joints.iter().zip(&turned).map(carried).collect();
        if let Some(before) = self.keys.last() {
            // The shorter way from key to key.
            for (local, before) in locals.iter_mut().zip(before) {
                local.turn = if local.turn.dot(before.turn) < 0.0 { -local.turn } else { local.turn };
            }
            if let Some(tips) = self.between.take() {
                let half: Vec<Turned> = before.iter().zip(&locals).map(|(from, to)| halfway(from, to)).collect();
                self.compare(&half, &tips);
            }
        }
        self.compare(&locals, &true_tips);
        self.keys.push(locals);
    }

    fn compare(&mut self, locals: &[Turned], tips: &[Vec3]) {
        let mut turned: Vec<Turned> = Vec::with_capacity(locals.len());
        for (joint, local) in self.rig.joints.iter().zip(locals) {
            turned.push(joint.parent.map_or(*local, |parent| turned[usize::from(parent)].on(local)));
        }
        for ((_, at, (joints, shares)), tip) in self.tips.iter().zip(tips) {
            let moved = joints.iter().zip(shares).filter(|(_, share)| **share > 0).map(|(joint, share)| {
                let joint = usize::from(*joint);
                let own = self.rest[joint].turn.inverse() * (*at - self.rest[joint].at);
                turned[joint].outwards(own) * (f32::from(*share) / 255.0)
            });
            self.farthest = self.farthest.max(moved.sum::<Vec3>().distance(*tip));
        }
    }

    /// The number of joints, with that of the ground.
    pub fn joints(&self) -> usize {
        self.rig.joints.len()
    }

    /// The largest distance from the full solution, metres.
    pub fn farthest(&self) -> f32 {
        self.farthest
    }

    /// Writes the GLB file; `mesh` is the plant in calm air.
    ///
    /// # Errors
    /// Those of `out`; a mesh that is larger than the format can hold, before anything is written.
    pub fn write(&self, mesh: &dyn Drawing, wind: &str, out: &mut (dyn Write + Send)) -> io::Result<()> {
        let bind = |vertex: &phytomer_meshes::Vertex| self.rig.bind(vertex);
        let still = Still::of(mesh, Some(&bind))?;
        let mut file = Document::default();
        file.extras.insert("wind".to_owned(), json!(wind));
        file.extras.insert("farthest_m".to_owned(), json!(self.farthest));
        let mut bytes = Vec::new();
        self.enter_skin(&mut file, &mut bytes);
        self.enter_animation(&mut file, &mut bytes);
        still.write(file, bytes, out)
    }

    fn enter_skin(&self, file: &mut Document, bytes: &mut Vec<u8>) {
        let joints = &self.rig.joints;
        for (number, joint) in joints.iter().enumerate() {
            let parent = joint.parent.map(|parent| &self.rest[usize::from(parent)]);
            let local = parent.map_or(self.rest[number], |parent| parent.inwards(&self.rest[number]));
            let carries: Vec<usize> =
                (0..joints.len()).filter(|other| joints[*other].parent.map(usize::from) == Some(number)).collect();
            let mut node = json!({ "name": format!("joint {number}") });
            if joint.parent.is_some() {
                node["translation"] = json!(local.at.to_array());
                node["rotation"] = json!(local.turn.to_array());
            }
            if !carries.is_empty() {
                node["children"] = json!(carries);
            }
            file.node(node);
        }
        file.roots.push(0);
        for rest in &self.rest {
            let back = rest.turn.inverse();
            let columns = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| (back * axis).extend(0.0));
            let matrix = columns.into_iter().chain([(back * -rest.at).extend(1.0)]);
            matrix.flat_map(|column| column.to_array()).for_each(|x| bytes.extend_from_slice(&x.to_le_bytes()));
        }
        let view = file.view(64 * joints.len() as u64, None, None);
        let matrices = file.accessor(Accessor::of(view, Number::F32, "MAT4", joints.len() as u64));
        let all: Vec<usize> = (0..joints.len()).collect();
        file.skins.push(json!({ "inverseBindMatrices": matrices, "joints": all, "skeleton": 0 }));
    }

    /// Enters the animation; its last key is the first once more.
    fn enter_animation(&self, file: &mut Document, bytes: &mut Vec<u8>) {
        let moments = Self::moments();
        let times = moments.iter().step_by(2).copied().chain([GUSTS_S]).map(|time| time as f32);
        let times: Vec<f32> = times.collect();
        let mut put = |file: &mut Document, numbers: Vec<f32>| {
            numbers.iter().for_each(|x| bytes.extend_from_slice(&x.to_le_bytes()));
            file.view(4 * numbers.len() as u64, None, None)
        };
        let count = times.len() as u64;
        let bounds = [[0.0], [GUSTS_S as f32]];
        let view = put(file, times);
        let input = file.accessor(Accessor::of(view, Number::F32, "SCALAR", count).within(bounds));
        let (mut samplers, mut channels) = (Vec::new(), Vec::new());
        for joint in (0..self.rig.joints.len()).filter(|joint| self.rig.joints[*joint].parent.is_some()) {
            let of_keys = || self.keys.iter().chain(self.keys.first()).map(|key| key[joint]);
            let view = put(file, of_keys().flat_map(|key| key.at.to_array()).collect());
            let translations = file.accessor(Accessor::of(view, Number::F32, "VEC3", count));
            let view = put(file, of_keys().flat_map(|key| key.turn.to_array()).collect());
            let rotations = file.accessor(Accessor::of(view, Number::F32, "VEC4", count));
            for (path, output) in [("translation", translations), ("rotation", rotations)] {
                channels.push(json!({ "sampler": samplers.len(), "target": { "node": joint, "path": path } }));
                samplers.push(json!({ "input": input, "output": output, "interpolation": "LINEAR" }));
            }
        }
        if !channels.is_empty() {
            file.animations.push(json!({ "name": "wind", "channels": channels, "samplers": samplers }));
        }
    }
}

/// The tip of an internode, in the axes of glTF.
fn tip(plant: &Plant, node: NodeId) -> Vec3 {
    Vec3::from_array(y_up(plant.frames.at(node).advanced(plant.posed_length(node)).base))
}

/// Halfway from one frame to another, as players go.
fn halfway(from: &Turned, to: &Turned) -> Turned {
    Turned { at: 0.5 * (from.at + to.at), turn: (from.turn + to.turn).normalize() }
}
