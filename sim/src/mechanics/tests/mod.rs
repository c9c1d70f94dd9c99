//! Bending against closed forms and published numbers: rods of many internodes, alone and on forks.
//!
//! A rod is one axis of equal internodes with chosen length, diameters, stiffness and weight, clamped at its base.

mod blade;
mod columns;
mod elastica;
mod freezing;
mod habit;
mod held;
mod secondary;
mod small;

use super::*;
use crate::math::pow;
use crate::plant::*;
use crate::site::Site;
use std::sync::Arc;

/// A diameter as a share of that at the base, by the height in [0, 1].
pub type Taper = fn(f64) -> f64;

/// A rod of length 1 m under a gravity of 1 m/s², so that masses are weights.
pub struct Rod {
    /// How many internodes.
    pub internodes: u32,
    /// The angle of its base to the upward vertical, radians.
    pub insertion: f64,
    /// Diameter at the base, m.
    pub diameter: f64,
    /// The diameter at the height s is `diameter` × taper(s).
    pub taper: Taper,
    /// E I at the base, N·m².
    pub flexural: f64,
    /// Weight of a metre of wood at the base, N/m.
    pub weight: f64,
    /// A weight at the tip, N.
    pub tip: f64,
}

impl Rod {
    pub fn level(internodes: u32) -> Self {
        let insertion = std::f64::consts::FRAC_PI_2;
        Self { internodes, insertion, diameter: 0.02, taper: |_| 1.0, flexural: 1.0, weight: 0.0, tip: 0.0 }
    }

    pub fn wood(&self) -> Wood {
        let section = std::f64::consts::PI / 4.0 * self.diameter * self.diameter;
        let second_moment = section * self.diameter * self.diameter / 16.0;
        let tissue = Tissue {
            modulus: vec![(self.flexural / second_moment) as f32],
            density: vec![(self.weight / section) as f32],
            uprighting: Uprighting::default(),
        };
        Wood {
            tissues: vec![tissue],
            bends: true,
            organs: OrganMass { leaf: 1.0, ..OrganMass::default() },
            ..Wood::default()
        }
    }

    pub fn plant(&self) -> Plant {
        let habit =
            Habit { trends: vec![], looks: Looks::of_shape(Shape::Cone), wood: Some(self.wood()), ..Habit::default() };
        let seed = Seed { plant: 0, draws: 0, run_seed: 1, component_limit: u32::MAX, keep_events: true };
        let mut plant = Plant::new(&seed, Arc::new(habit));
        let axis = add_axis(&mut plant, None, self.insertion);
        for rank in 0..self.internodes {
            let at = |rank: u32| (self.diameter * (self.taper)(f64::from(rank) / f64::from(self.internodes))) as f32;
            let node = add_node(&mut plant, axis, 1.0 / self.internodes as f32, at(rank));
            plant.nodes.diameter_tip[node.index()] = at(rank + 1);
        }
        if self.tip != 0.0 {
            add_leaf(&mut plant, NodeId(self.internodes - 1), self.tip as f32);
        }
        plant
    }

    /// The rod bent at once from rest.
    pub fn bent(&self) -> (Plant, Outcome) {
        let mut plant = self.plant();
        let outcome = bend(&mut plant, 1, &unit_gravity(), &mut Scratch::default());
        (plant, outcome)
    }
}

pub fn unit_gravity() -> Site {
    Site { gravity: 1.0, ..Site::default() }
}

pub fn add_axis(plant: &mut Plant, bearer: Option<NodeId>, insertion: f64) -> AxisId {
    plant.add_axis(NewAxis {
        bearer,
        key: LineageKey(plant.axes.len() as u64),
        origin: Origin::Axillary,
        insertion: insertion as f32,
        ..NewAxis::OF_THE_SEED
    })
}

pub fn add_node(plant: &mut Plant, axis: AxisId, length: f32, diameter: f32) -> NodeId {
    let last = plant.axes.last_node[axis.index()];
    let parent = if last == NodeId::NONE { plant.axes.bearer[axis.index()] } else { last };
    plant.add_node(NewNode { parent, axis, length, diameter, ..NewNode::OF_THE_TRUNK })
}

/// A leaf of `area` m², which weighs as many kilograms.
pub fn add_leaf(plant: &mut Plant, node: NodeId, area: f32) {
    plant.add_organ(NewOrgan { node, length: 0.1, width: 0.1, area, ..NewOrgan::LEAF });
}

/// The tip of the plant's first axis: distance along the ground and height, m.
pub fn tip(plant: &Plant) -> (f64, f64) {
    let frame = crate::pose::bud_frame(plant, AxisId::TRUNK);
    (f64::from(frame.base[0]), f64::from(frame.base[2]))
}
