//! One tree of GMT1: its branches, each from its mother's vector and diameter (Aono & Kunii 1984, rules 1–4).
//!
//! The paper has no axes and no orders. Here the child with the smaller |h| continues its mother's axis, the left child
//! where both are equal; the other child begins an axis of the next order. That is the paper's own reading of a
//! monopodial tree (h1 ≈ 0), extended to all other trees; in a pure dichotomy it is a convention that cannot be seen.
//! Absent on purpose: levels and ages (`model`), and the draws of the numbers of a tree (`laws`).

use super::branching::{child, length};
use phytomer_sim::clock::{NEVER, Tick};
use phytomer_sim::math;
use phytomer_sim::plant::key::Place;
use phytomer_sim::plant::{AxisId, EventKind, NewAxis, NewNode, NodeId, Origin, Plant, Rest};
use std::f64::consts::PI;

/// The numbers of one tree.
#[derive(Debug, Clone)]
pub(super) struct Tree {
    children: [Child; 2],
    diameter_ratio: f64,
    divergence_deg: f64,
    /// Length and diameter of the first branch, metres.
    first_m: [f64; 2],
}

/// The way in which a child leaves its mother.
#[derive(Debug, Clone, Copy)]
struct Child {
    /// The child's length over the mother's.
    ratio: f64,
    /// The angle between the child and the mother, signed: left is above 0.
    angle_deg: f64,
    angle: f64,
    /// Whether the child continues the mother's axis.
    continues: bool,
}

/// A branch of the last level, on which the next one stands.
#[derive(Debug, Clone, Copy)]
pub(super) struct Branch {
    node: NodeId,
    axis: AxisId,
    /// Its rank along the axis, from 1.
    rank: u32,
    /// From root to tip, metres: (u, v, w).
    vector: [f64; 3],
    diameter: f64,
}

impl Tree {
    /// The tree with these angles between mother and children and these lengths of children over the mother's, left
    /// then right; and with the length and the diameter of its first branch.
    pub fn new(
        [h1, h2]: [f64; 2],
        [r1, r2]: [f64; 2],
        diameter_ratio: f64,
        divergence_deg: f64,
        first_m: [f64; 2],
    ) -> Self {
        let left_continues = h1.abs() <= h2.abs();
        let child = |ratio, angle_deg: f64, continues| Child { ratio, angle_deg, angle: radians(angle_deg), continues };
        let children = [child(r1, h1, left_continues), child(r2, h2, !left_continues)];
        Self { children, diameter_ratio, divergence_deg, first_m }
    }

    /// The base section: "the first two child branches lie on the plane parallel to the direction of gravity", so it
    /// stands upright.
    pub fn first_branch(&self, plant: &mut Plant) -> Branch {
        let [first_length_m, first_diameter_m] = self.first_m;
        let seed = Branch {
            node: NodeId::NONE,
            axis: AxisId::TRUNK,
            rank: 0,
            vector: [0.0, 0.0, first_length_m],
            diameter: first_diameter_m,
        };
        self.add(&seed, AxisId::TRUNK, seed.vector, seed.diameter, 0, plant)
    }

    /// Two children at the tip of `mother`, the left one first (rules 1–3).
    pub fn bifurcate(&self, mother: &Branch, level: u32, plant: &mut Plant) -> [Branch; 2] {
        let turn_deg = self.turn_deg(mother.rank);
        let diameter = mother.diameter * self.diameter_ratio;
        self.children.map(|way| {
            let vector = child(mother.vector, way.ratio, way.angle, radians(turn_deg));
            let axis = if way.continues { mother.axis } else { new_axis(mother, &way, turn_deg, level, plant) };
            self.add(mother, axis, vector, diameter, level, plant)
        })
    }

    /// By how much the branching above the branch of `rank` is turned out of the maximal gradient plane, degrees in
    /// (−360, 360). Each branching along an axis adds the divergence angle; the first of an axis is not turned (Figs. 4
    /// and 10).
    fn turn_deg(&self, rank: u32) -> f64 {
        math::fmod(f64::from(rank - 1) * self.divergence_deg, 360.0)
    }

    fn add(
        &self,
        mother: &Branch,
        axis: AxisId,
        vector: [f64; 3],
        diameter: f64,
        level: u32,
        plant: &mut Plant,
    ) -> Branch {
        let rank = if axis == mother.axis { mother.rank + 1 } else { 1 };
        let long = length(vector);
        let node = plant.add_node(NewNode {
            parent: mother.node,
            axis,
            birth: birth(level),
            rank,
            unit_rank: 1,
            short: false,
            neoformed: false,
            trend: 0,
            length: long as f32,
            diameter: diameter as f32,
            azimuth: radians(around(self.turn_deg(rank))) as f32,
        });
        plant.state_rest(node, Rest::Heading(vector.map(|x| (x / long) as f32)));
        plant.note(birth(level), axis, EventKind::Grew, 1);
        Branch { node, axis, rank, vector, diameter }
    }
}

/// The tick at which the branches of a growth level appear.
pub(super) fn birth(level: u32) -> Tick {
    level + 1
}

/// The axis that a child begins. Its azimuth counts from the horizontal on the right of its mother, counter-clockwise
/// seen from her tip backwards: on an upright trunk from +x, where the pose's azimuths begin too.
fn new_axis(mother: &Branch, way: &Child, turn_deg: f64, level: u32, plant: &mut Plant) -> AxisId {
    let bearing = mother.axis.index();
    let opposite = if way.angle_deg < 0.0 { 0.0 } else { 180.0 };
    let axis = plant.add_axis(NewAxis {
        bearer: Some(mother.node),
        key: plant.axes.key[bearing].child(Place::Axillary(0).on(mother.rank)),
        order: plant.axes.order[bearing] + 1,
        origin: Origin::Axillary,
        position: 0,
        follows: false,
        state: 0,
        appearance: birth(level),
        birth: birth(level),
        azimuth: radians(around(turn_deg + opposite)) as f32,
        insertion: way.angle.abs() as f32,
        shed_after: NEVER,
    });
    plant.note(birth(level), axis, EventKind::Branched, 1);
    axis
}

fn radians(degrees: f64) -> f64 {
    degrees * (PI / 180.0)
}

/// An angle above −720 degrees, reduced to [0, 360).
fn around(degrees: f64) -> f64 {
    math::fmod(degrees + 720.0, 360.0)
}
