//! The tree of GMT1, built level by level (Aono & Kunii 1984, rules 1–4): two children at the tip of every branch of
//! the level before, all at once, each with its share of its mother's length and diameter.
//!
//! The paper has no axes and no orders. Here the child with the smaller |h| carries its mother's axis on, the left one
//! where both are equal; the other begins an axis of the next order. That is the paper's own reading of a monopodial
//! tree (h1 ≈ 0), carried over to all others; in a pure dichotomy it is a convention and nothing to be seen.
//! Components are numbered level by level, the left child first, so that numbers, keys and births hold at every age.

use super::branching::{child, length};
use super::gmt1::Gmt1;
use phytomer_sim::clock::{NEVER, Tick};
use phytomer_sim::expectation::{Expectation, OrderExpectation};
use phytomer_sim::math;
use phytomer_sim::model::{Growth, GrowthModel, Overgrown};
use phytomer_sim::plant::key::Place;
use phytomer_sim::plant::{
    AxisId, EventKind, Habit, LineageKey, Looks, NewAxis, NewNode, NodeId, Origin, Plant, Shape, Trend,
};
use phytomer_sim::site::Site;
use std::f64::consts::PI;
use std::sync::Arc;

/// GMT1 with its parameters checked and its angles in radians.
#[derive(Debug, Clone)]
pub struct Gmt1Model {
    parameters: Gmt1,
    children: [Child; 2],
    habit: Arc<Habit>,
}

/// How a child stands to its mother.
#[derive(Debug, Clone, Copy)]
struct Child {
    /// Its length over hers.
    ratio: f64,
    /// The angle between them, signed: left is above 0.
    angle_deg: f64,
    angle: f64,
    /// Whether it carries her axis on.
    continues: bool,
}

/// A branch of the last level, on which the next one stands.
#[derive(Debug, Clone, Copy)]
struct Branch {
    node: NodeId,
    axis: AxisId,
    /// Its rank along the axis, from 1.
    rank: u32,
    /// From root to tip, metres: (u, v, w).
    vector: [f64; 3],
    diameter: f64,
}

impl Gmt1Model {
    pub(super) fn new(parameters: &Gmt1) -> Self {
        let &Gmt1 { h1_deg, h2_deg, r1, r2, .. } = parameters;
        let left_continues = h1_deg.abs() <= h2_deg.abs();
        let child = |ratio, angle_deg: f64, continues| Child { ratio, angle_deg, angle: radians(angle_deg), continues };
        Self {
            parameters: parameters.clone(),
            children: [child(r1, h1_deg, left_continues), child(r2, h2_deg, !left_continues)],
            habit: Arc::new(Habit {
                trends: vec![Trend::STRAIGHT],
                looks: Looks::of_shape(Shape::Cylinder),
                organ_trends: vec![],
                wood: None,
            }),
        }
    }

    /// The parameters that the model was made from.
    pub fn parameters(&self) -> &Gmt1 {
        &self.parameters
    }

    fn rebuild(&self, age: Tick, plant: &mut Plant) -> Result<(), Overgrown> {
        plant.clear();
        self.sow(plant);
        let limit = plant.component_limit();
        if self.parameters.components_at(age) > u64::from(limit) {
            return Err(Overgrown { plant: plant.id, limit });
        }
        if let Some(last) = self.parameters.level_at(age) {
            let mut tips = vec![self.first_branch(plant)];
            for level in 1..=last {
                tips = tips.iter().flat_map(|mother| self.bifurcate(mother, level, plant)).collect();
            }
        }
        plant.age = age;
        Ok(())
    }

    /// Branches and axes by order and age. Of the 2ᵐ branches of growth level m, C(m, k) have order k + 1: k of the m
    /// branchings that led to them were taken sideways.
    fn counts(&self, until: Tick) -> Expectation {
        let last = self.parameters.level_at(until);
        let mut orders: Vec<_> = (0..=last.unwrap_or(0)).map(|_| OrderExpectation::zero(until)).collect();
        orders[0].axes[0] = 1.0;
        let mut branches = vec![0.0; orders.len()];
        for level in 0..last.map_or(0, |last| last + 1) {
            let age = birth(level) as usize;
            let mothers = branches.clone();
            for (k, order) in orders.iter_mut().enumerate() {
                let sideways = if k > 0 { mothers[k - 1] } else { 0.0 };
                let onward = if level == 0 && k == 0 { 1.0 } else { mothers[k] };
                order.axes[age] = sideways;
                branches[k] = onward + sideways;
                (order.units[age], order.nodes[age]) = (branches[k], branches[k]);
            }
        }
        orders.iter_mut().for_each(OrderExpectation::accumulate);
        Expectation { orders }
    }

    /// The base section: "the first two child branches lie on the plane parallel to the direction of gravity", so it
    /// stands upright.
    fn first_branch(&self, plant: &mut Plant) -> Branch {
        let Gmt1 { first_length_m, first_diameter_m, .. } = self.parameters;
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
    fn bifurcate(&self, mother: &Branch, level: u32, plant: &mut Plant) -> [Branch; 2] {
        let turn_deg = self.turn_deg(mother.rank);
        let diameter = mother.diameter * self.parameters.diameter_ratio;
        self.children.map(|way| {
            let vector = child(mother.vector, way.ratio, way.angle, radians(turn_deg));
            let axis = if way.continues { mother.axis } else { new_axis(mother, &way, turn_deg, level, plant) };
            self.add(mother, axis, vector, diameter, level, plant)
        })
    }

    /// How far the branching above the branch of `rank` is turned out of the maximal gradient plane, degrees in
    /// (−360, 360): by the divergence angle once more with each branching along the axis, the first one of the axis
    /// not at all (Figs. 4 and 10).
    fn turn_deg(&self, rank: u32) -> f64 {
        math::fmod(f64::from(rank - 1) * self.parameters.divergence_deg, 360.0)
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
        plant.stated_headings.push(vector.map(|x| (x / long) as f32));
        plant.note(birth(level), axis, EventKind::Grew, 1);
        Branch { node, axis, rank, vector, diameter }
    }
}

/// The tick at which the branches of a growth level appear.
fn birth(level: u32) -> Tick {
    level + 1
}

/// The axis that a child begins. Its azimuth counts from the horizontal on the right of its mother, counter-clockwise
/// for who looks back from her tip: on an upright trunk from +x, where the pose's azimuths begin too.
fn new_axis(mother: &Branch, way: &Child, turn_deg: f64, level: u32, plant: &mut Plant) -> AxisId {
    let bearing = mother.axis.index();
    let opposite = if way.angle_deg < 0.0 { 0.0 } else { 180.0 };
    let axis = plant.add_axis(NewAxis {
        bearer: Some(mother.node),
        key: plant.axes.key[bearing].child(Place::Axillary(0).on(mother.rank)),
        order: plant.axes.order[bearing] + 1,
        origin: Origin::Axillary,
        position: 0,
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

/// An angle above −720 degrees as one in [0, 360).
fn around(degrees: f64) -> f64 {
    math::fmod(degrees + 720.0, 360.0)
}

impl GrowthModel for Gmt1Model {
    fn growth(&self) -> Growth {
        Growth::Rebuilds
    }

    fn habit(&self) -> Arc<Habit> {
        self.habit.clone()
    }

    fn sow(&self, plant: &mut Plant) {
        plant.add_axis(NewAxis {
            bearer: None,
            key: LineageKey::SEED,
            order: 1,
            origin: Origin::Seed,
            position: 0,
            state: 0,
            appearance: 0,
            birth: 0,
            azimuth: 0.0,
            insertion: 0.0,
            shed_after: NEVER,
        });
    }

    fn grow_to(&self, age: Tick, plants: &mut [Plant], _site: &Site) -> Result<(), Overgrown> {
        plants.iter_mut().try_for_each(|plant| self.rebuild(age, plant))
    }

    /// A branch keeps the diameter that it was made with, and one diameter along its length.
    fn thicken(&self, _age: Tick, plant: &mut Plant) {
        let nodes = &mut plant.nodes;
        nodes.diameter.copy_from_slice(&nodes.primary_diameter);
        nodes.diameter_tip.copy_from_slice(&nodes.primary_diameter);
    }

    /// Nothing is left to chance: the counts themselves.
    fn expectation(&self, until: Tick) -> Option<Expectation> {
        Some(self.counts(until))
    }
}
