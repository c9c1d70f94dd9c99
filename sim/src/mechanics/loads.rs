//! The reverse scan: what each internode carries, the moment that this makes in its middle, and how the internode
//! answers.
//!
//! With F the sum of all forces beyond the middle of an internode and N their torque about the origin, the moment there
//! is M = N − x × F. Turning all that lies beyond by small angles Φ about horizontal axes changes M by the sum of G Φ over the
//! internodes beyond, with G = −ℓ·F for a chord ℓ that carries F: positive where the load stands on top of it. So the
//! equations of a Newton step,
//!
//! ```text
//! E I / L (Φᵢ − Φₚ) = M − E I (κ − κ₀) + Σ G Φ   over the internodes beyond,
//! ```
//!
//! are solved by elimination from the tips: the sum of each branch is an affine function of the turn at its base. The
//! solution is exact in a vertical plane and nearly so in space, where a second term ℓ (Φ·F) is left out, as is torsion.
//! The pivot of the elimination is the stiffness that is left under load: where it is not positive the plant buckles.

use super::wood::{Tissue, Wood, frustum};
use crate::clock::Tick;
use crate::plant::borne::{Borne, Down};
use crate::plant::standing::{Run, Standing};
use crate::plant::{AxisId, Plant};
use crate::site::Fields;
use crate::vector::Vector;

/// An internode holds while more than this share of its own stiffness is left under load. Where it does not, the step is
/// taken on that stiffness alone, so that a plant that buckles still moves, away from the shape that it cannot hold.
const LEFT: f64 = 1e-3;

/// The most that an internode answers with, rad; far beyond what a step may turn.
const MOST_TURN: f64 = 1e3;

/// What lies beyond a point of an axis, as that point feels it.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Load {
    /// The sum of the forces, N.
    force: Vector,
    /// The sum of their torques about the origin, N·m.
    torque: Vector,
    /// By how much the moments of all that lies beyond change for a turn here, N·m/rad.
    follows: f64,
    /// By how much they change for the turns beyond that do not depend on the one here, N·m.
    moves: Vector,
}

/// How an internode answers in this step: its turn is `gain` times that of its base, and `turn` about `up` and
/// `heading × up`.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Response {
    pub gain: f32,
    pub turn: [f32; 2],
}

/// What the reverse scan walks over and writes.
pub(super) struct Scan<'a> {
    pub plant: &'a Plant,
    pub wood: &'a Wood,
    pub age: Tick,
    pub fields: Fields,
    /// The curvature that each internode would have without load, rad/m.
    pub natural: &'a [[f32; 2]],
    /// Scratch, one entry an axis.
    pub loads: &'a mut Vec<Load>,
    pub responses: &'a mut [Response],
}

impl Load {
    #[inline]
    fn add(&mut self, other: &Self) {
        self.force = self.force + other.force;
        self.torque = self.torque + other.torque;
        self.follows += other.follows;
        self.moves = self.moves + other.moves;
    }

    #[inline]
    fn put(&mut self, at: Vector, force: Vector) {
        self.force = self.force + force;
        self.torque = self.torque + at.cross(force);
    }
}

impl Scan<'_> {
    /// Goes over every internode that stands, from the tips down; the last axis met, nearest to the seed, that does not
    /// hold what it carries.
    pub fn weigh(mut self, standing: &Standing, laterals: &Borne, organs: &Borne) -> Option<AxisId> {
        self.loads.clear();
        self.loads.resize(self.plant.axes.len(), Load::default());
        let mut laterals = Down::new(laterals, &self.plant.axes.bearer);
        let mut organs = Down::new(organs, &self.plant.organs.node);
        let mut yields = None;
        for run in standing.runs.iter().rev() {
            if !self.weigh_run(run, &mut laterals, &mut organs) {
                yields = Some(run.axis);
            }
        }
        yields
    }

    #[inline]
    fn weigh_run(&mut self, run: &Run, laterals: &mut Down<'_>, organs: &mut Down<'_>) -> bool {
        let tissue = self.wood.tissue(self.plant.axes.order[run.axis.index()]);
        let mut load = self.loads[run.axis.index()];
        let mut holds = true;
        for node in run.nodes().rev() {
            while let Some(axis) = laterals.on(node) {
                load.add(&self.loads[axis]);
            }
            while let Some(organ) = organs.on(node) {
                self.hang(&mut load, node, organ);
            }
            holds &= self.pass(&mut load, tissue, node);
        }
        self.loads[run.axis.index()] = load;
        holds
    }

    /// An organ pulls at its node.
    #[inline]
    fn hang(&self, load: &mut Load, node: usize, organ: usize) {
        let organs = &self.plant.organs;
        if organs.birth[organ] > self.age || organs.death[organ] <= self.age {
            return;
        }
        let mass = self.wood.organs.of(self.plant, organ);
        let force = self.fields.gravity * mass + self.fields.drag * f64::from(organs.area[organ]);
        let frames = &self.plant.frames;
        let along = Vector::from(frames.heading[node]) * f64::from(self.plant.nodes.length[node]);
        load.put(Vector::from(frames.base[node]) + along, force);
    }

    /// From the tip of an internode to its base, with its answer; whether it holds.
    #[inline]
    fn pass(&mut self, load: &mut Load, tissue: &Tissue, node: usize) -> bool {
        let Plant { nodes, frames, strain, .. } = self.plant;
        let (length, own_age) = (f64::from(nodes.length[node]), self.age - nodes.birth[node]);
        let (base, tip) = (f64::from(nodes.diameter[node]), f64::from(nodes.diameter_tip[node]));
        let middle = (base + tip) * 0.5;
        let heading = Vector::from(frames.heading[node]);
        let foot = Vector::from(frames.base[node]);
        let weight = self.fields.gravity * tissue.density(own_age);
        let half = length * 0.5;
        let outer = weight * frustum(half, middle, tip) + self.fields.drag * (half * (middle + tip) * 0.5);
        let inner = weight * frustum(half, base, middle) + self.fields.drag * (half * (middle + base) * 0.5);

        let beyond = load.force;
        load.put(foot + heading * (0.75 * length), outer);
        let moment = load.torque - (foot + heading * half).cross(load.force);
        load.put(foot + heading * (0.25 * length), inner);
        let near = -heading.dot(beyond * half + outer * (0.25 * length));
        let whole = -heading.dot(beyond * length + outer * (0.75 * length) + inner * (0.25 * length));

        let flexural = tissue.modulus(own_age) * second_moment(middle);
        let stiffness = flexural / length;
        if !(stiffness.is_finite() && stiffness > 0.0) {
            // No length, or nothing that bends: it goes with its base.
            load.follows += whole;
            self.responses[node] = Response { gain: 1.0, turn: [0.0; 2] };
            return true;
        }
        let left = stiffness - 0.5 * near - load.follows;
        let holds = left > LEFT * stiffness;
        let (pivot, near, past) = if holds { (left, near, 0.5 * whole + load.follows) } else { (stiffness, 0.0, 0.0) };
        let up = Vector::from(frames.up[node]);
        let axes = [up, heading.cross(up)];
        let turn = [0, 1].map(|k| {
            let excess = f64::from(strain.curvature[node][k]) - f64::from(self.natural[node][k]);
            let turn = ((moment + load.moves).dot(axes[k]) - flexural * excess) / pivot;
            turn.clamp(-MOST_TURN, MOST_TURN)
        });
        let gain = (stiffness + 0.5 * near) / pivot;
        load.moves = load.moves + (axes[0] * turn[0] + axes[1] * turn[1]) * past;
        load.follows = if holds { past * gain + 0.5 * whole } else { 0.0 };
        self.responses[node] = Response { gain: gain as f32, turn: turn.map(|turn| turn as f32) };
        holds
    }
}

/// π d⁴ / 64, m⁴.
#[inline]
pub(super) fn second_moment(diameter: f64) -> f64 {
    let square = diameter * diameter;
    std::f64::consts::PI / 64.0 * square * square
}
