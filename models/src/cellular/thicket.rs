//! Growth by trials in voxels (Greene 1989; ABOP ch. 2): at each tick every tip tries some headings about its own, and
//! the best of the segments that can grow does.
//!
//! A trial fails where its segment leaves no new voxel, passes through a voxel that is taken, that touches an obstacle
//! of the site or that reaches below the ground, or ends farther from a surface than the plant can hold. Of the others
//! the best grows, by a sum of preferences: near a surface, in the light, upward, straight on. A tip without a trial
//! that passes rests for ever. Absent: parameters (`greene`), diffusion of light, and leaves.

use super::around::Around;
use super::body::{Growing, Segment, branch, keep_diameters, lengthen};
use super::sky::Sky;
use super::voxels::{Lattice, Voxel};
use phytomer_sim::clock::Tick;
use phytomer_sim::math::{cos, sincos};
use phytomer_sim::model::{Grow, Growth, Overgrown};
use phytomer_sim::plant::{Habit, LineageKey, NewAxis, NodeId, Plant};
use phytomer_sim::random::{Purpose, Stream};
use phytomer_sim::rotation::Rotation;
use phytomer_sim::site::View;
use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Greene's model, checked and compiled. Lengths in metres, angles in radians.
#[derive(Debug, Clone)]
pub struct GreeneModel {
    pub(super) lattice: Lattice,
    pub(super) segment: f64,
    pub(super) diameter: f64,
    pub(super) trials: u32,
    pub(super) spread: f64,
    pub(super) branching: f64,
    pub(super) branch_spread: f64,
    pub(super) hold: f64,
    pub(super) cling: f64,
    pub(super) sight: f64,
    pub(super) surface: f64,
    pub(super) light: f64,
    pub(super) upward: f64,
    pub(super) straight: f64,
    pub(super) sky: Sky,
    pub(super) habit: Arc<Habit>,
}

/// The voxels and the growing tips of one plant.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Thicket {
    taken: BTreeSet<Voxel>,
    tips: Vec<Growing>,
}

/// A segment that may grow.
struct Trial {
    heading: [f64; 3],
    end: [f64; 3],
    /// The voxels behind that of its start.
    voxels: Vec<Voxel>,
}

impl GreeneModel {
    /// Whether a voxel reaches below the seed or touches what nothing can grow in: by its middle and its corners.
    fn is_shut(&self, voxel: Voxel, around: &Around<'_>) -> bool {
        let middle = self.lattice.middle_of(voxel);
        let half = 0.5 * self.lattice.edge;
        let corner = |k: u32| {
            let side = |bit: u32| if k >> bit & 1 == 0 { -half } else { half };
            [middle[0] + side(0), middle[1] + side(1), middle[2] + side(2)]
        };
        voxel[2] < 0 || around.is_shut(middle) || (0..8).any(|k| around.is_shut(corner(k)))
    }

    /// The segment from a place along a heading; `None` where it cannot grow.
    fn tried(&self, at: [f64; 3], heading: [f64; 3], thicket: &Thicket, around: &Around<'_>) -> Option<Trial> {
        let end = [0, 1, 2].map(|k| at[k] + self.segment * heading[k]);
        let voxels: Vec<Voxel> = self.lattice.passed(at, end).into_iter().skip(1).collect();
        let free = |voxel: &Voxel| !thicket.taken.contains(voxel) && !self.is_shut(*voxel, around);
        let grows = !voxels.is_empty() && voxels.iter().all(free);
        // In the open there is nothing to hold to.
        let holds = || self.hold == f64::INFINITY || !around.has_bodies() || around.distance(end) <= self.hold;
        (grows && holds()).then_some(Trial { heading, end, voxels })
    }

    /// What a trial of a tip is worth.
    fn worth(&self, trial: &Trial, heading: [f64; 3], thicket: &Thicket, around: &Around<'_>) -> f64 {
        let mut worth = self.upward * trial.heading[2];
        worth += self.straight * (0..3).map(|k| heading[k] * trial.heading[k]).sum::<f64>();
        let distance = if self.surface > 0.0 { around.distance(trial.end) } else { f64::INFINITY };
        if distance.is_finite() {
            worth -= self.surface * (distance - self.cling).abs() / self.segment;
        }
        if self.light > 0.0 {
            let own = trial.voxels.last();
            let shut = |at: [f64; 3]| {
                let voxel = self.lattice.voxel_of(at);
                around.is_solid(at) || (thicket.taken.contains(&voxel) && own != Some(&voxel))
            };
            worth += self.light * self.sky.share(trial.end, self.lattice.edge, self.sight, shut);
        }
        worth
    }

    /// The best of the trials about a heading that can grow; of equals the first.
    fn best(
        &self,
        from: &Growing,
        spread: f64,
        words: &mut Stream,
        thicket: &Thicket,
        around: &Around<'_>,
    ) -> Option<Trial> {
        let mut best: Option<(f64, Trial)> = None;
        for _ in 0..self.trials {
            let (turn, side) = (unit(words), unit(words));
            let heading = about(from.heading, spread, turn, side);
            let Some(trial) = self.tried(from.at, heading, thicket, around) else { continue };
            let worth = self.worth(&trial, from.heading, thicket, around);
            if best.as_ref().is_none_or(|(most, _)| worth > *most) {
                best = Some((worth, trial));
            }
        }
        best.map(|(_, trial)| trial)
    }

    /// Grows a tip by a segment and, by chance, a branch beside it.
    fn advance(
        &self,
        plant: &mut Plant,
        thicket: &mut Thicket,
        from: &Growing,
        birth: Tick,
        around: &Around<'_>,
    ) -> Result<Vec<Growing>, Overgrown> {
        let key: LineageKey = plant.axes.key[from.tip.axis.index()];
        let mut words = plant.random.stream(key, Purpose::Node);
        // A word for the branch, and two for each trial of the tip and of the branch.
        words.seek(u64::from(from.tip.rank) * (1 + 4 * u64::from(self.trials)));
        let branches = unit(&mut words) < self.branching && from.tip.node != NodeId::NONE;
        let mut new = Vec::new();
        let spreads = [(false, self.spread), (true, self.branch_spread)];
        for (aside, spread) in spreads.into_iter().filter(|(aside, _)| !aside || branches) {
            let Some(trial) = self.best(from, spread, &mut words, thicket, around) else { continue };
            let Trial { heading, end, voxels } = trial;
            let segment = Segment { heading, length: self.segment, diameter: self.diameter, birth };
            let tip =
                if aside { branch(plant, &from.tip, 0, &segment)? } else { lengthen(plant, &from.tip, &segment)? };
            thicket.taken.extend(voxels);
            new.push(Growing { tip, at: end, heading });
        }
        Ok(new)
    }
}

/// A word as a number in (0, 1).
fn unit(words: &mut Stream) -> f64 {
    (f64::from(words.word()) + 0.5) / 4_294_967_296.0
}

/// A direction within an angle of a heading, evenly over the cap: by two numbers in (0, 1).
fn about(heading: [f64; 3], spread: f64, turn: f64, side: f64) -> [f64; 3] {
    let along = 1.0 - turn * (1.0 - cos(spread));
    let across = (1.0 - along * along).max(0.0).sqrt();
    let (sin, cos) = sincos(TAU * side);
    Rotation::to(heading, [0.0, 0.0, 1.0]).turned([along, across * cos, across * sin])
}

impl Grow for GreeneModel {
    type Life = Thicket;

    fn growth(&self) -> Growth {
        Growth::Rebuilds
    }

    fn habit(&self) -> Arc<Habit> {
        Arc::clone(&self.habit)
    }

    fn sow(&self, plant: &mut Plant) -> Thicket {
        plant.add_axis(NewAxis::OF_THE_SEED);
        Thicket { taken: BTreeSet::from([[0; 3]]), tips: vec![Growing::SEED] }
    }

    fn grow_to(&self, age: Tick, plant: &mut Plant, life: &mut Thicket, view: &View<'_>) -> Result<(), Overgrown> {
        if age < plant.age {
            plant.clear();
            *life = self.sow(plant);
        }
        let around = Around { site: view.site, place: plant.place };
        for birth in plant.age + 1..=age {
            let mut tips = Vec::with_capacity(life.tips.len());
            for from in std::mem::take(&mut life.tips) {
                tips.extend(self.advance(plant, life, &from, birth, &around)?);
            }
            life.tips = tips;
        }
        plant.age = age;
        Ok(())
    }

    fn thicken(&self, _age: Tick, plant: &mut Plant) {
        keep_diameters(plant);
    }
}
