//! A D0L-system as a growth model: its string rewritten tick by tick, and the plant written anew from it.
//!
//! Age n has the string of n rewritings; the paper counts growth levels from 1, so that level n is the age n − 1.
//! Absent: rewriting (`string`) and drawing (`draw`).

use super::count::expectation;
use super::draw::{Size, draw, note_new};
use super::string::{Born, Living, Rewriting, Rules};
use phytomer_sim::clock::Tick;
use phytomer_sim::expectation::Expectation;
use phytomer_sim::model::{Grow, Growth, Overgrown};
use phytomer_sim::plant::{Cause, Habit, Looks, NodeId, Plant, Shape, Trend};
use phytomer_sim::site::View;
use std::sync::Arc;

/// A D0L-system with its parameters checked and compiled.
#[derive(Debug, Clone)]
pub struct D0lModel {
    rules: Rules,
    sizes: Vec<Size>,
    angle: f32,
    habit: Arc<Habit>,
}

/// The axis of the seed: the first component.
const TRUNK: Born = Born { number: 0, at: 0 };

impl D0lModel {
    pub(super) fn new(rules: Rules, sizes: &[[f64; 2]], angle: f64) -> Self {
        let size = |[length, diameter]: &[f64; 2]| Size { length: *length as f32, diameter: (diameter * 0.001) as f32 };
        let looks = Looks::of_shape(Shape::Cylinder);
        let habit = Habit { trends: vec![Trend::STRAIGHT], looks, ..Habit::default() };
        Self { rules, sizes: sizes.iter().map(size).collect(), angle: angle as f32, habit: Arc::new(habit) }
    }
}

impl D0lModel {
    /// Rewrites the string up to the age `age`, and draws the plant.
    fn rewrite(&self, age: Tick, plant: &mut Plant, living: &mut Living) -> Result<(), Overgrown> {
        let limit = Overgrown::of(plant);
        // Each component is at least one module of the string, and a branch two.
        let most = 2 * limit.limit as usize;
        let mut vanished = Vec::new();
        for at in plant.age + 1..=age {
            let how = Rewriting { at, most, number: || plant.next_number(), vanished: &mut vanished };
            if !self.rules.rewrite(living, how) || plant.is_overgrown() {
                return Err(limit);
            }
        }
        // The internodes of the columns are the cells of the string, in their order.
        vanished.into_iter().for_each(|cell| plant.depart(NodeId(cell), age, Cause::Rewritten));
        let last = plant.age;
        plant.begin_rewriting();
        draw(living, TRUNK, &self.sizes, self.angle, plant);
        plant.age = age;
        note_new(plant, last);
        Ok(())
    }
}

impl Grow for D0lModel {
    type Life = Living;

    fn growth(&self) -> Growth {
        Growth::Rewrites
    }

    fn habit(&self) -> Arc<Habit> {
        Arc::clone(&self.habit)
    }

    fn sow(&self, plant: &mut Plant) -> Living {
        plant.name_by_number();
        plant.next_number();
        let living = self.rules.sow(|| plant.next_number());
        draw(&living, TRUNK, &self.sizes, self.angle, plant);
        living
    }

    fn grow_to(&self, age: Tick, plant: &mut Plant, living: &mut Living, _: &View<'_>) -> Result<(), Overgrown> {
        // Where cells vanish the plant is drawn at each tick, so that each stands in the columns before it goes.
        let legs = if self.rules.has_deaths() { 1 } else { age.saturating_sub(plant.age) };
        while plant.age < age {
            self.rewrite(plant.age + legs, plant, living)?;
        }
        Ok(())
    }

    /// Nothing is random here: these are the numbers themselves.
    fn expectation(&self, until: Tick) -> Option<Expectation> {
        Some(expectation(&self.rules, until))
    }

    /// A cell has the diameter of its kind along its length.
    fn thicken(&self, _age: Tick, plant: &mut Plant) {
        let nodes = &mut plant.nodes;
        nodes.diameter.copy_from_slice(&nodes.primary_diameter);
        nodes.diameter_tip.copy_from_slice(&nodes.primary_diameter);
    }
}
