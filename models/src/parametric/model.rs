//! A parametric tree as a growth model: written anew at each age, by its own law of growth, or whole from age 1 on.
//!
//! Absent: the tree itself (`grow`), and its numbers in closed form (`expectation`).

use super::expectation;
use super::grow::grow;
use super::numbers::Numbers;
use super::radius::{flare, radius_at};
use super::sections::Sections;
use super::sway;
use phytomer_sim::clock::Tick;
use phytomer_sim::expectation::Expectation;
use phytomer_sim::gusts::{Gusts, Swing};
use phytomer_sim::model::{Grow, Growth, Overgrown};
use phytomer_sim::plant::{Habit, NewAxis, Plant};
use phytomer_sim::site::View;
use std::sync::Arc;

/// A parametric tree with its parameters checked.
#[derive(Debug, Clone)]
pub struct TreeModel {
    tree: Arc<Numbers>,
    sections: Arc<Sections>,
    habit: Arc<Habit>,
}

impl TreeModel {
    pub(super) fn new(tree: Numbers, sections: Sections, habit: Habit) -> Self {
        Self { tree: Arc::new(tree), sections: Arc::new(sections), habit: Arc::new(habit) }
    }

    /// The parameters as plain numbers.
    pub fn numbers(&self) -> &Numbers {
        &self.tree
    }
}

impl Grow for TreeModel {
    type Life = ();

    fn growth(&self) -> Growth {
        Growth::Rebuilds
    }

    fn habit(&self) -> Arc<Habit> {
        Arc::clone(&self.habit)
    }

    fn sow(&self, plant: &mut Plant) {
        plant.add_axis(NewAxis::OF_THE_SEED);
    }

    fn grow_to(&self, age: Tick, plant: &mut Plant, (): &mut (), _view: &View<'_>) -> Result<(), Overgrown> {
        plant.clear();
        self.sow(plant);
        grow(&self.tree, &self.sections, plant, age)?;
        plant.age = age;
        Ok(())
    }

    /// A segment is as thick at its tip as the next segment at its base. The tip of the last of n segments, whose base
    /// is at the share (n − 1)/n of the stem, follows the stem's taper (§4.4): from 1 on it has no width.
    fn thicken(&self, _age: Tick, plant: &mut Plant) {
        let Plant { axes, nodes, .. } = plant;
        nodes.diameter.copy_from_slice(&nodes.primary_diameter);
        for node in 0..nodes.len() {
            let axis = nodes.axis[node].index();
            nodes.diameter_tip[node] = if axes.last_node[axis].index() == node {
                let level = axes.order[axis].saturating_sub(1);
                (f64::from(nodes.diameter[node]) * self.end_over_base(level)) as f32
            } else {
                nodes.diameter[node + 1]
            };
        }
    }

    fn sways(&self) -> bool {
        true
    }

    fn swings(&self, plant: &Plant) -> Vec<Swing> {
        sway::swings(plant, &self.tree)
    }

    fn sway(&self, plant: &mut Plant, gusts: &Gusts) {
        sway::sway(plant, &self.tree, gusts);
    }

    fn expectation(&self, until: Tick) -> Option<Expectation> {
        Some(expectation::of(&self.tree, until))
    }
}

impl TreeModel {
    /// The radius at the end of the last segment of a stem over that at its base.
    fn end_over_base(&self, level: u8) -> f64 {
        let of = self.tree.of(level);
        if of.taper >= 1.0 {
            return 0.0;
        }
        let base = 1.0 - 1.0 / f64::from(of.curve_res);
        let wider = if level == 0 { flare(self.tree.flare, base) } else { 1.0 };
        radius_at(1.0, of.taper, 1.0, 1.0) / (radius_at(base, of.taper, 1.0, 1.0) * wider)
    }
}
