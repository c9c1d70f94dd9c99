//! The trees of GMT1 to GMT4, built level by level (Aono & Kunii 1984, rule 4 of GMT1): children at the tip of every
//! branch of the level before, all at once.
//!
//! A plant draws the numbers of its tree once (`plan`); the number of components does not depend on them, unless
//! deviators can move a branch to nothing. Components are numbered level by level, the left child first, so that
//! numbers, keys and births hold at every age. Absent on purpose: branches, axes and their order (`tree`).

use super::plan::Plan;
use super::tree::{Branch, Moment, Tree};
use phytomer_sim::clock::Tick;
use phytomer_sim::expectation::{Certainty, Expectation, OrderExpectation};
use phytomer_sim::model::{Grow, Growth, Overgrown};
use phytomer_sim::plant::{Habit, NewAxis, Plant};
use phytomer_sim::site::View;
use std::sync::Arc;

/// A tree of GMT1 to GMT4 with its parameters checked and compiled.
#[derive(Debug, Clone)]
pub struct GeometricModel {
    plans: Arc<[Plan]>,
    pace: Pace,
    /// What each growth level adds, from level 0: of all trees together.
    added: Vec<AddedByOrder>,
    /// Whether all that is added stays.
    is_certain: bool,
    habit: Arc<Habit>,
}

/// What a growth level adds, by order from 1.
#[derive(Debug, Clone, Default)]
struct AddedByOrder {
    branches: Vec<u64>,
    axes: Vec<u64>,
    leaves: Vec<u64>,
}

/// How many ticks a growth level takes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pace {
    pub ticks_per_level: Tick,
}

impl Pace {
    /// The tick at which the branches of a growth level appear.
    pub fn birth(self, level: u32) -> Tick {
        level * self.ticks_per_level + 1
    }

    /// The newest growth level at `age` of a tree of `last` levels, and how much of it has grown; `None` for the seed.
    fn at(self, age: Tick, last: u32) -> Option<(u32, f64)> {
        let level = (age.checked_sub(1)? / self.ticks_per_level).min(last);
        let grown = (age - level * self.ticks_per_level).min(self.ticks_per_level);
        Some((level, f64::from(grown) / f64::from(self.ticks_per_level)))
    }
}

impl GeometricModel {
    /// Of at least one plan.
    pub(super) fn new(plans: Vec<Plan>, ticks_per_level: Tick, habit: Habit) -> Self {
        let added = added_of(&plans);
        let is_certain = plans.iter().all(Plan::loses_nothing);
        Self { plans: plans.into(), pace: Pace { ticks_per_level }, added, is_certain, habit: Arc::new(habit) }
    }

    /// The components of the tree at `age`, where no branch is moved to nothing: its branches, apical buds and leaves.
    pub fn components_at(&self, age: Tick) -> u64 {
        let reached = (0..).zip(&self.added).take_while(|(level, _)| self.pace.birth(*level) <= age);
        let of = |added: &AddedByOrder| {
            [&added.branches, &added.axes, &added.leaves]
                .into_iter()
                .flatten()
                .fold(0_u64, |sum, n| sum.saturating_add(*n))
        };
        // The bud of the seed.
        reached.fold(1, |sum: u64, (_, added)| sum.saturating_add(of(added)))
    }

    /// The most growth levels of its trees.
    fn last(&self) -> u32 {
        self.plans.iter().map(Plan::last).max().unwrap_or(0)
    }

    fn rebuild(&self, age: Tick, plant: &mut Plant) -> Result<(), Overgrown> {
        plant.clear();
        self.sow(plant);
        if self.is_certain && self.components_at(age) > u64::from(plant.component_limit()) {
            return Err(Overgrown::of(plant));
        }
        if let Some((reached, share)) = self.pace.at(age, self.last()) {
            let trees: Vec<Tree<'_>> =
                self.plans.iter().map(|plan| Tree::new(plan, plan.draw(&plant.random))).collect();
            let mut tips: Vec<Vec<Branch>> = Vec::with_capacity(trees.len());
            for level in 0..=reached {
                let share = if level == reached { share } else { 1.0 };
                let now = Moment { level, share, birth: self.pace.birth(level) };
                self.grow_level(&trees, &now, reached, &mut tips, plant)?;
            }
        }
        plant.age = age;
        Ok(())
    }

    /// Adds one level of all trees, tree by tree; `tips` are the branches of the level before.
    fn grow_level(
        &self,
        trees: &[Tree<'_>],
        now: &Moment,
        reached: u32,
        tips: &mut Vec<Vec<Branch>>,
        plant: &mut Plant,
    ) -> Result<(), Overgrown> {
        for (place, tree) in trees.iter().enumerate() {
            if now.level == 0 {
                let first = tree.first_branch(now, plant);
                tips.push(vec![first]);
                if plant.is_overgrown() {
                    return Err(Overgrown::of(plant));
                }
            } else if now.level <= self.plans[place].last() {
                let told = now.level < reached.min(self.plans[place].last());
                tips[place] = tree.branch(&tips[place], now, told, plant)?;
            }
        }
        Ok(())
    }

    /// Branches, axes and leaves by order and age.
    fn counts(&self, until: Tick) -> Expectation {
        let reached: Vec<_> =
            (0..).zip(&self.added).take_while(|(level, _)| self.pace.birth(*level) <= until.max(1)).collect();
        let deepest = reached.iter().filter_map(|(_, added)| added.branches.iter().rposition(|&n| n > 0)).max();
        let mut orders: Vec<_> = (0..=deepest.unwrap_or(0)).map(|_| OrderExpectation::zero(until)).collect();
        // The bud of the seed.
        orders[0].axes[0] = 1.0;
        for (level, added) in reached.into_iter().filter(|(level, _)| self.pace.birth(*level) <= until) {
            let age = self.pace.birth(level) as usize;
            for (k, order) in orders.iter_mut().enumerate() {
                let of = |numbers: &[u64]| numbers.get(k).copied().unwrap_or(0) as f64;
                order.axes[age] += of(&added.axes);
                (order.units[age], order.nodes[age]) = (of(&added.branches), of(&added.branches));
                order.organs[age] = of(&added.leaves);
            }
        }
        orders.iter_mut().for_each(OrderExpectation::accumulate);
        let certainty = if self.is_certain { Certainty::Exact } else { Certainty::AtMost };
        Expectation { orders, axes: certainty, organs: certainty }
    }
}

/// What all trees add at each level. The first branch of a tree on the root of another begins an axis.
fn added_of(plans: &[Plan]) -> Vec<AddedByOrder> {
    let last = plans.iter().map(Plan::last).max().unwrap_or(0) as usize;
    let none = || vec![0; last + 1];
    let mut all: Vec<AddedByOrder> =
        (0..=last).map(|_| AddedByOrder { branches: none(), axes: none(), leaves: none() }).collect();
    for (place, plan) in plans.iter().enumerate() {
        all[0].axes[0] += u64::from(place > 0);
        for ((level, added), all) in (0..).zip(plan.added()).zip(&mut all) {
            let sum = |all: &mut [u64], added: &[u64], times: u64| {
                all.iter_mut().zip(added).for_each(|(n, more)| *n = n.saturating_add(more.saturating_mul(times)));
            };
            sum(&mut all.branches, &added.branches, 1);
            sum(&mut all.axes, &added.axes, 1);
            sum(&mut all.leaves, &added.branches, plan.leaves_at(level));
        }
    }
    all
}

impl Grow for GeometricModel {
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

    /// How many branches there are is no matter of chance: these are the numbers themselves, or at most the numbers
    /// where deviators can move a branch to nothing.
    fn expectation(&self, until: Tick) -> Option<Expectation> {
        Some(self.counts(until))
    }
}
