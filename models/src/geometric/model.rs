//! The tree of GMT1, built level by level (Aono & Kunii 1984, rules 1–4): two children at the tip of every branch of
//! the level before, all at once.
//!
//! A plant draws the numbers of its tree once (`laws`); the number of components does not depend on them. Components
//! are numbered level by level, the left child first, so that numbers, keys and births hold at every age. Absent on
//! purpose: branches, axes and their order (`tree`).

use super::gmt1::Gmt1;
use super::laws::Laws;
use super::tree::birth;
use phytomer_sim::clock::Tick;
use phytomer_sim::expectation::{Certainty, Expectation, OrderExpectation};
use phytomer_sim::model::{Grow, Growth, Overgrown};
use phytomer_sim::plant::{Habit, Looks, NewAxis, Plant, Shape, Trend};
use phytomer_sim::site::View;
use std::sync::Arc;

/// GMT1 with its parameters checked and compiled.
#[derive(Debug, Clone)]
pub struct Gmt1Model {
    parameters: Gmt1,
    laws: Laws,
    habit: Arc<Habit>,
}

impl Gmt1Model {
    pub(super) fn new(parameters: &Gmt1, laws: Laws) -> Self {
        Self {
            parameters: parameters.clone(),
            laws,
            habit: Arc::new(Habit {
                trends: vec![Trend::STRAIGHT],
                looks: Looks::of_shape(Shape::Cylinder),
                ..Habit::default()
            }),
        }
    }

    /// The parameters from which the model was made.
    pub fn parameters(&self) -> &Gmt1 {
        &self.parameters
    }

    fn rebuild(&self, age: Tick, plant: &mut Plant) -> Result<(), Overgrown> {
        plant.clear();
        self.sow(plant);
        let limit = plant.component_limit();
        if self.parameters.components_at(age) > u64::from(limit) {
            return Err(Overgrown::of(plant));
        }
        if let Some(last) = self.parameters.level_at(age) {
            let tree = self.laws.draw(&plant.random);
            let mut tips = vec![tree.first_branch(plant)];
            for level in 1..=last {
                tips = tips.iter().flat_map(|mother| tree.bifurcate(mother, level, plant)).collect();
            }
        }
        plant.age = age;
        Ok(())
    }

    /// Branches and axes by order and age. Of the 2ᵐ branches of growth level m, C(m, k) have order k + 1: on the way
    /// to them k of the m branchings were taken sideways.
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
        Expectation { orders, axes: Certainty::Exact, organs: Certainty::Exact }
    }
}

impl Grow for Gmt1Model {
    type Life = ();

    fn growth(&self) -> Growth {
        Growth::Rebuilds
    }

    fn habit(&self) -> Arc<Habit> {
        self.habit.clone()
    }

    fn sow(&self, plant: &mut Plant) {
        plant.add_axis(NewAxis::OF_THE_SEED);
    }

    fn grow_to(&self, age: Tick, plant: &mut Plant, (): &mut (), _view: &View<'_>) -> Result<(), Overgrown> {
        self.rebuild(age, plant)
    }

    /// A branch keeps its first diameter, and has one diameter along its length.
    fn thicken(&self, _age: Tick, plant: &mut Plant) {
        let nodes = &mut plant.nodes;
        nodes.diameter.copy_from_slice(&nodes.primary_diameter);
        nodes.diameter_tip.copy_from_slice(&nodes.primary_diameter);
    }

    /// Nothing is random here: these are the numbers themselves.
    fn expectation(&self, until: Tick) -> Option<Expectation> {
        Some(self.counts(until))
    }
}
