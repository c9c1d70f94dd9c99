//! A skeleton for a plant that sways: joints along its thick axes, and what of the plant hangs on them.
//!
//! One joint is the ground. The others go to axes by the length of an axis times the diameter at its base, divided
//! among them as seats are by d'Hondt; an axis gets none before the axis that bears it has one. Of m joints of an axis
//! the i-th is at i / (m + ½) of its length: for a cantilever, whose deflection grows with the square of the length, a
//! single joint at two thirds leaves the same error, a ninth of the deflection, at the tip and at one third. Between
//! two joints a place is moved by both, in shares that change evenly along the axis; above the last joint by that one,
//! and what has no joint of its own as the place that bears it. A vertex has at most four joints, in shares of 255.
//! Absent: the motion (`sway`).

use super::still::{Bound, y_up};
use glam::{Mat3, Quat, Vec3};
use phytomer_meshes::Vertex;
use phytomer_sim::Tick;
use phytomer_sim::plant::{NodeId, OrganId, Plant};

/// The most joints: their numbers are bytes.
pub const MOST_JOINTS: u32 = 255;
const NONE: u32 = u32::MAX;
/// The joints of a vertex.
const FOUR: usize = 4;

/// Joints with their shares.
type Shares = Vec<(u8, f32)>;

/// Where a joint is and how it is turned, in the axes of glTF.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turned {
    pub at: Vec3,
    pub turn: Quat,
}

impl Turned {
    /// The ground.
    pub const GROUND: Self = Self { at: Vec3::ZERO, turn: Quat::IDENTITY };

    /// A place of this frame in the axes around it.
    pub fn outwards(&self, of: Vec3) -> Vec3 {
        self.at + self.turn * of
    }

    /// A frame as it is seen from this.
    pub fn inwards(&self, of: &Self) -> Self {
        let back = self.turn.inverse();
        Self { at: back * (of.at - self.at), turn: (back * of.turn).normalize() }
    }

    /// A frame that is told in this, in the axes around it.
    pub fn on(&self, of: &Self) -> Self {
        Self { at: self.outwards(of.at), turn: (self.turn * of.turn).normalize() }
    }
}

/// A joint.
#[derive(Debug, Clone, Copy)]
pub struct Joint {
    /// The internode at whose tip it is; none, of the ground.
    pub node: Option<NodeId>,
    /// The joint that carries it.
    pub parent: Option<u8>,
}

/// An axis of the skeleton.
#[derive(Debug, Clone, Default)]
struct Limb {
    /// The joints of the place that bears the axis.
    base: Shares,
    /// The joints on it, with their distance along it.
    joints: Vec<(f32, u8)>,
}

/// The skeleton of a plant at an age.
pub struct Rig {
    pub joints: Vec<Joint>,
    limbs: Vec<Limb>,
    /// The axis of each internode, and the distances of its base and its tip along it.
    along: Vec<(u32, [f32; 2])>,
    /// The internode of each component that stands by its number, and whether it is an organ at its tip.
    of_component: Vec<(u32, bool)>,
    /// The base and the direction of each internode in calm air.
    rest: Vec<[Vec3; 2]>,
}

impl Rig {
    /// The skeleton of at most so many joints of a plant that stands in calm air; `None` where no internode stands.
    pub fn of(plant: &Plant, age: Tick, most: u32) -> Option<Self> {
        let mut rig = Self::measured(plant, age);
        let weights = rig.weights(plant, age);
        if weights.iter().all(|weight| *weight <= 0.0) {
            return None;
        }
        let seats = rig.seats(plant, &weights, most.min(MOST_JOINTS).saturating_sub(1));
        rig.set_joints(plant, age, &seats);
        Some(rig)
    }

    fn measured(plant: &Plant, age: Tick) -> Self {
        let count = plant.nodes.len();
        let (mut along, mut rest) = (vec![(NONE, [0.0; 2]); count], vec![[Vec3::ZERO; 2]; count]);
        let mut of_component = Vec::new();
        let mut tag = |component: u32, node: usize, organ: bool| {
            let place = component as usize;
            if of_component.len() <= place {
                of_component.resize(place + 1, (NONE, false));
            }
            of_component[place] = (node as u32, organ);
        };
        let mut lengths = vec![0.0_f32; plant.axes.len()];
        for node in (0..count).filter(|node| plant.stands(NodeId(*node as u32), age)) {
            let axis = plant.nodes.axis[node].index();
            let (from, length) = (lengths[axis], plant.posed_length(NodeId(node as u32)));
            lengths[axis] += length;
            along[node] = (axis as u32, [from, from + length]);
            let frame = plant.frames.at(NodeId(node as u32));
            rest[node] = [frame.base, frame.heading].map(|of| Vec3::from_array(y_up(of)));
            tag(plant.nodes.component[node], node, false);
        }
        for organ in (0..plant.organs.len()).filter(|organ| plant.organ_stands(OrganId(*organ as u32), age)) {
            tag(plant.organs.component[organ], plant.organs.node[organ].index(), true);
        }
        Self { joints: vec![Joint { node: None, parent: None }], limbs: Vec::new(), along, of_component, rest }
    }

    /// What each axis weighs when joints are given: its length times the diameter at its base.
    fn weights(&self, plant: &Plant, age: Tick) -> Vec<f64> {
        let mut sizes = vec![(0.0_f32, 0.0_f32); plant.axes.len()];
        for (node, (axis, [from, to])) in self.along.iter().enumerate() {
            let Some((length, diameter)) = sizes.get_mut(*axis as usize) else { continue };
            if plant.stands(NodeId(node as u32), age) {
                *diameter = if *from == 0.0 { plant.nodes.diameter[node] } else { *diameter };
                *length = length.max(*to);
            }
        }
        sizes.into_iter().map(|(length, diameter)| f64::from(length) * f64::from(diameter)).collect()
    }

    /// How many joints each axis gets: at most one an internode.
    fn seats(&self, plant: &Plant, weights: &[f64], joints: u32) -> Vec<u32> {
        let (mut seats, mut most) = (vec![0_u32; weights.len()], vec![0_u32; weights.len()]);
        self.along.iter().for_each(|(axis, _)| most.get_mut(*axis as usize).into_iter().for_each(|most| *most += 1));
        let bearer = |axis: usize| plant.axes.bearer[axis].some().map(|node| plant.nodes.axis[node.index()].index());
        for _ in 0..joints {
            let may = |axis: &usize| {
                weights[*axis] > 0.0
                    && seats[*axis] < most[*axis]
                    && bearer(*axis).is_none_or(|bearer| seats[bearer] > 0)
            };
            let asks = |axis: usize| weights[axis] / f64::from(seats[axis] + 1);
            let next = (0..weights.len()).filter(may).max_by(|a, b| asks(*a).total_cmp(&asks(*b)).then(b.cmp(a)));
            let Some(next) = next else { break };
            seats[next] += 1;
        }
        seats
    }

    /// Sets so many joints on each axis, bearing axes first.
    fn set_joints(&mut self, plant: &Plant, age: Tick, seats: &[u32]) {
        let mut nodes_of: Vec<Vec<u32>> = vec![Vec::new(); plant.axes.len()];
        for (node, (axis, _)) in self.along.iter().enumerate().filter(|(_, (axis, _))| *axis != NONE) {
            nodes_of[*axis as usize].push(node as u32);
        }
        self.limbs = vec![Limb::default(); plant.axes.len()];
        for axis in 0..plant.axes.len() {
            let bearer = plant.axes.bearer[axis].some().filter(|bearer| plant.stands(*bearer, age));
            let base = bearer.map_or(vec![(0, 1.0)], |bearer| self.shares_at(bearer.index(), 1.0));
            let mut parent = base.iter().map(|(joint, _)| *joint).max().unwrap_or(0);
            let mut limb = Limb { base, joints: Vec::new() };
            let nodes = &nodes_of[axis];
            let length = nodes.last().map_or(0.0, |node| self.along[*node as usize].1[1]);
            let (count, mut next) = (seats[axis] as usize, 0);
            for seat in 1..=count {
                let wanted = length * seat as f32 / (count as f32 + 0.5);
                let reached = nodes.iter().position(|node| self.along[*node as usize].1[1] >= wanted * 0.999_99);
                // Each joint is at an internode of its own, and leaves one to each that follows.
                let place =
                    reached.unwrap_or(nodes.len()).max(next).min((nodes.len() + seat).saturating_sub(count + 1));
                let Some(node) = nodes.get(place) else { break };
                let joint = self.joints.len() as u8;
                self.joints.push(Joint { node: Some(NodeId(*node)), parent: Some(parent) });
                limb.joints.push((self.along[*node as usize].1[1], joint));
                (parent, next) = (joint, place + 1);
            }
            self.limbs[axis] = limb;
        }
    }

    /// The joints of a place at a share of the length of an internode.
    fn shares_at(&self, node: usize, share: f32) -> Shares {
        let Some((axis, [from, to])) = self.along.get(node) else { return vec![(0, 1.0)] };
        let Some(limb) = self.limbs.get(*axis as usize) else { return vec![(0, 1.0)] };
        limb.shares_at(from + share * (to - from))
    }

    /// The joints that move a vertex of the mesh in calm air.
    pub fn bind(&self, vertex: &Vertex) -> Bound {
        let component = usize::try_from(vertex.tag().component).unwrap_or(usize::MAX);
        let Some((node, organ)) = self.of_component.get(component).filter(|(node, _)| *node != NONE) else {
            return GROUNDED;
        };
        let node = *node as usize;
        let [from, to] = self.along[node].1;
        let (length, [base, heading]) = (to - from, self.rest[node]);
        let share = if *organ || length <= 0.0 {
            1.0
        } else {
            ((Vec3::from_array(y_up(vertex.position())) - base).dot(heading) / length).clamp(0.0, 1.0)
        };
        bound(&self.shares_at(node, share))
    }

    /// The joints that move the tip of an internode.
    pub fn bind_tip(&self, node: NodeId) -> Bound {
        bound(&self.shares_at(node.index(), 1.0))
    }

    /// Where the joints are in a plant as it stands.
    pub fn turned(&self, plant: &Plant) -> Vec<Turned> {
        let turned = |joint: &Joint| {
            let Some(node) = joint.node else { return Turned::GROUND };
            let frame = plant.frames.at(node).advanced(plant.posed_length(node));
            let [along, up] = [frame.heading, frame.up].map(|of| Vec3::from_array(y_up(of)));
            let left = up.cross(along).try_normalize().unwrap_or_else(|| along.any_orthonormal_vector());
            let up = along.cross(left);
            let turn = Quat::from_mat3(&Mat3::from_cols(along, left, up)).normalize();
            Turned { at: Vec3::from_array(y_up(frame.base)), turn }
        };
        self.joints.iter().map(turned).collect()
    }
}

/// What stands still.
const GROUNDED: Bound = ([0; FOUR], [255, 0, 0, 0]);

impl Limb {
    fn shares_at(&self, distance: f32) -> Shares {
        let above = self.joints.iter().position(|(at, _)| distance < *at);
        let (low, high) = match (above, self.joints.last()) {
            (None, None) => return self.base.clone(),
            (None, Some((_, last))) => return vec![(*last, 1.0)],
            (Some(0), _) => ((0.0, self.base.clone()), self.joints[0]),
            (Some(k), _) => ((self.joints[k - 1].0, vec![(self.joints[k - 1].1, 1.0)]), self.joints[k]),
        };
        let share = ((distance - low.0) / (high.0 - low.0)).clamp(0.0, 1.0);
        let mut shares: Shares = low.1.into_iter().map(|(joint, part)| (joint, part * (1.0 - share))).collect();
        shares.push((high.1, share));
        shares
    }
}

/// Joints with their shares in 255, the four that move most.
fn bound(shares: &[(u8, f32)]) -> Bound {
    let mut most: Shares = shares.to_vec();
    most.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    most.truncate(FOUR);
    let all: f32 = most.iter().map(|(_, share)| share).sum();
    let (mut joints, mut parts) = ([0; FOUR], [0_u8; FOUR]);
    let mut left = 255_i32;
    for (k, (joint, share)) in most.iter().enumerate().skip(1) {
        let part = (255.0 * share / all.max(f32::MIN_POSITIVE)).round().clamp(0.0, 255.0) as i32;
        if part > 0 && part <= left {
            (joints[k], parts[k]) = (*joint, part as u8);
            left -= part;
        }
    }
    (joints[0], parts[0]) = (most.first().map_or(0, |(joint, _)| *joint), left.clamp(0, 255) as u8);
    (joints, parts)
}
