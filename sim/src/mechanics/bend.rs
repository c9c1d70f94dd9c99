//! One tick of bending: loads and shape iterated to equilibrium, on the curvature that is frozen in the wood.
//!
//! New wood is laid on the bent shape and is free of stress there, so a tick adds dκ = dM / (E I) with the stiffness of
//! the tick, never the whole moment over the last stiffness (Ancelin, Fourcaud & Lac 2004). With κ₀ = κ − M / (E I),
//! taken at the curvature and the moment of the last tick and the stiffness of this one, the equilibrium is M = E I (κ
//! − κ₀). It is found by Newton steps: moments and turns from the tips down (`loads`), curvatures and pose from the
//! base up (`turn`).

use super::loads::{Response, Scan};
use super::scratch::Scratch;
use super::section::Section;
use super::turn::{Kept, Turned};
use super::uprighting::straighten;

use crate::clock::Tick;
use crate::plant::standing::Standing;
use crate::plant::{AxisId, EventKind, Plant, Wood};
use crate::pose::bent::follow_bends;
use crate::pose::pose;
use crate::site::Fields;
use crate::site::Site;

/// A plant is in equilibrium when no internode turns by more in a step, rad. The steps converge quadratically, so the
/// remaining error is far smaller.
pub const SETTLED: f64 = 1e-4;

/// The most steps of a tick; a plant that still moves after them is reported.
pub const MOST_STEPS: u32 = 60;

/// The result of a tick of bending.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Outcome {
    /// The number of steps taken.
    pub steps: u32,
    /// Whether the last step turned no internode by more than [`SETTLED`].
    pub settled: bool,
    /// The axis nearest to the seed that did not hold its load, in the first step that found any.
    pub yields: Option<AxisId>,
}

/// Bends `plant` under its weight and the wind of `site`, as it stands at `age`, and poses it. Buckling and a bending
/// without equilibrium are added to its events. Cost: at most [`MOST_STEPS`] times two scans of the internodes.
pub fn bend(plant: &mut Plant, age: Tick, site: &Site, scratch: &mut Scratch) -> Outcome {
    let habit = std::sync::Arc::clone(&plant.habit);
    let Some(wood) = habit.wood.as_ref().filter(|wood| wood.feels(&site.fields(&wood.drag))) else {
        pose(plant, age);
        return Outcome { steps: 0, settled: true, yields: None };
    };
    scratch.prepare(plant, age);
    scratch.pose(plant, age);
    scratch.freeze(plant, wood, age);
    straighten(plant, wood, age, &scratch.standing, &scratch.before, &mut scratch.natural);
    let outcome = scratch.settle(plant, wood, age, &site.fields(&wood.drag));
    report(plant, age, outcome);
    outcome
}

/// Poses a plant with the curvatures that it has, whatever its loads.
pub(crate) fn pose_bent(plant: &mut Plant, age: Tick, scratch: &mut Scratch) {
    scratch.prepare(plant, age);
    scratch.pose(plant, age);
}

impl Scratch {
    /// Keeps the diameters of the last tick, before the plant thickens, where the righting of axes needs them.
    pub fn remember(&mut self, plant: &Plant) {
        self.before.clear();
        if plant.habit.wood.as_ref().is_some_and(Wood::makes_reaction_wood) {
            self.before.extend_from_slice(&plant.nodes.diameter);
        }
    }

    fn prepare(&mut self, plant: &mut Plant, age: Tick) {
        plant.strain.resize(plant.nodes.len());
        plant.measure(age);
        self.standing.find(plant, age);
        self.laterals.arrange(&plant.axes.bearer);
        self.organs.arrange(&plant.organs.node);
        self.responses.resize(plant.nodes.len(), Response::default());
    }

    /// Bends a plant that stands bent at `age` into the forces of another site, without growth, and returns the
    /// curvatures that it had before.
    pub(super) fn lean(&mut self, plant: &mut Plant, wood: &Wood, age: Tick, site: &Site) -> Vec<[f32; 2]> {
        self.prepare(plant, age);
        let stood = plant.strain.curvature.clone();
        self.pose(plant, age);
        self.freeze(plant, wood, age);
        self.settle(plant, wood, age, &site.fields(&wood.drag));
        stood
    }

    fn settle(&mut self, plant: &mut Plant, wood: &Wood, age: Tick, fields: &Fields) -> Outcome {
        let mut outcome = Outcome { steps: 0, settled: false, yields: None };
        while !outcome.settled && outcome.steps < MOST_STEPS {
            let yields = self.weigh(plant, wood, age, fields);
            outcome.yields = outcome.yields.or(yields);
            outcome.steps += 1;
            outcome.settled = self.turn(plant, age) <= SETTLED;
        }
        self.load(plant, wood, age);
        outcome
    }

    /// Poses the plant with its present curvatures.
    pub(super) fn pose(&mut self, plant: &mut Plant, age: Tick) {
        let curvature = std::mem::take(&mut plant.strain.curvature);
        let along = (&self.standing, &self.laterals);
        follow_bends(plant, age, along, &mut self.stances, &mut Kept(&curvature));
        plant.strain.curvature = curvature;
    }

    /// Turns each internode by its response and poses it there. Returns the largest turn, rad.
    fn turn(&mut self, plant: &mut Plant, age: Tick) -> f64 {
        let mut curvature = std::mem::take(&mut plant.strain.curvature);
        let mut turned = Turned::new(&mut curvature, &self.responses, &mut self.turns, plant.axes.len());
        follow_bends(plant, age, (&self.standing, &self.laterals), &mut self.stances, &mut turned);
        let largest = turned.largest();
        plant.strain.curvature = curvature;
        largest
    }

    fn weigh(&mut self, plant: &Plant, wood: &Wood, age: Tick, fields: &Fields) -> Option<AxisId> {
        let Self { natural, loads, responses, .. } = self;
        let lengths = plant.posed_lengths();
        let scan = Scan { plant, wood, age, fields: *fields, lengths, natural, loads, responses };
        scan.weigh(&self.standing, &self.laterals, &self.organs)
    }

    /// Replaces the moments of the last tick by the curvature without load: κ₀ = κ − M / (E I). The same memory holds
    /// both; [`Self::load`] puts moments there again.
    fn freeze(&mut self, plant: &mut Plant, wood: &Wood, age: Tick) {
        self.natural = std::mem::take(&mut plant.strain.moment);
        each_flexural(plant, wood, age, &self.standing, |node, flexural| {
            let (curvature, moment) = (plant.strain.curvature[node], self.natural[node]);
            let pliancy = flexural.map(|flexural| 1.0 / flexural);
            let natural = |k: usize| (f64::from(curvature[k]) - f64::from(moment[k]) * pliancy[k]) as f32;
            self.natural[node] = [natural(0), natural(1)];
        });
    }

    /// Replaces the curvature without load by the moments of this tick: M = E I (κ − κ₀).
    fn load(&mut self, plant: &mut Plant, wood: &Wood, age: Tick) {
        each_flexural(plant, wood, age, &self.standing, |node, flexural| {
            let (curvature, natural) = (plant.strain.curvature[node], self.natural[node]);
            let moment = |k: usize| ((f64::from(curvature[k]) - f64::from(natural[k])) * flexural[k]) as f32;
            self.natural[node] = [moment(0), moment(1)];
        });
        plant.strain.moment = std::mem::take(&mut self.natural);
    }
}

/// Calls `show` for each internode that bends, with its flexural stiffness E I about `up` and about `heading × up`,
/// N·m².
#[inline]
fn each_flexural(plant: &Plant, wood: &Wood, age: Tick, standing: &Standing, mut show: impl FnMut(usize, [f64; 2])) {
    for run in &standing.runs {
        let tissue = wood.tissue(plant.axes.order[run.axis.index()]);
        let of_axis = Section::of(plant.look_of(run.axis));
        for node in run.nodes() {
            let section = of_axis.at(plant, node);
            let middle = f64::from(plant.nodes.diameter[node] + plant.nodes.diameter_tip[node]) * 0.5;
            let modulus = tissue.modulus(age - plant.nodes.birth[node]);
            let flexural = section.second_moments(middle).map(|moment| modulus * moment);
            if flexural[0] > 0.0 && flexural[1] > 0.0 {
                show(node, flexural);
            }
        }
    }
}

fn report(plant: &mut Plant, age: Tick, outcome: Outcome) {
    if let Some(axis) = outcome.yields.filter(|_| outcome.yields != plant.strain.yields) {
        plant.note(age, axis, EventKind::Buckled, 1);
    }
    plant.strain.yields = outcome.yields;
    if !outcome.settled {
        plant.note(age, AxisId::TRUNK, EventKind::Unsettled, outcome.steps);
    }
}
