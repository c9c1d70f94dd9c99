//! Growth by trials in voxels (Greene 1989; ABOP ch. 2): at each tick every tip tries some headings about its own, and
//! the best of the segments that can grow does.
//!
//! A trial fails where its segment leaves no new voxel, passes through a voxel that is taken, that touches an obstacle
//! of the site or that reaches below the ground, or ends farther from a surface than the plant can hold. Of the others
//! the best grows, by a sum of preferences: near a surface, in the light, upward, straight on. A tip without a trial
//! that passes rests for ever. Where the plants of a plot share voxels, a tip claims those of its segment and of its
//! branch together; a tip that is refused tries again at the next tick, when it knows whose they are. A seed in a
//! voxel that another plant has does not grow. Absent: parameters (`greene`), diffusion of light, and leaves.

use super::body::{Growing, Segment, branch, keep_diameters, lengthen};
use super::foretold;
use super::sky::Sky;
use super::space::Space;
use super::voxels::Voxel;
use phytomer_sim::cells::Claims;
use phytomer_sim::clock::Tick;
use phytomer_sim::expectation::Expectation;
use phytomer_sim::math::{cos, sincos};
use phytomer_sim::model::{Grow, Growth, Overgrown};
use phytomer_sim::plant::{Habit, LineageKey, NewAxis, NodeId, Plant};
use phytomer_sim::random::{Purpose, Stream};
use phytomer_sim::rotation::Rotation;
use phytomer_sim::site::{Site, View};
use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Greene's model, checked and compiled. Lengths in metres, angles in radians.
#[derive(Debug, Clone)]
pub struct GreeneModel {
    pub(super) voxel: f64,
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
    /// What is to grow at the next tick; its voxels are taken.
    planned: Vec<Planned>,
}

/// A segment that may grow.
#[derive(Debug, Clone, PartialEq)]
struct Trial {
    heading: [f64; 3],
    end: [f64; 3],
    /// The voxels behind that of its start.
    voxels: Vec<Voxel>,
}

/// What a tip is to grow: a segment, a branch, or both.
#[derive(Debug, Clone, PartialEq)]
struct Planned {
    from: Growing,
    /// Each segment, and whether it begins a branch.
    segments: Vec<(bool, Trial)>,
}

impl Planned {
    fn voxels(&self) -> impl Iterator<Item = &Voxel> {
        self.segments.iter().flat_map(|(_, trial)| &trial.voxels)
    }

    /// Whether it is the first segment of a plant.
    fn is_first(&self) -> bool {
        self.from.tip.node == NodeId::NONE
    }
}

impl GreeneModel {
    /// The segment from a place along a heading; `None` where it cannot grow.
    fn tried(&self, at: [f64; 3], heading: [f64; 3], thicket: &Thicket, space: &Space<'_>) -> Option<Trial> {
        let end = [0, 1, 2].map(|k| at[k] + self.segment * heading[k]);
        let voxels: Vec<Voxel> = space.lattice.passed(at, end).into_iter().skip(1).collect();
        let free =
            |voxel: &Voxel| !thicket.taken.contains(voxel) && !space.is_anothers(*voxel) && !space.is_shut(*voxel);
        let grows = !voxels.is_empty() && voxels.iter().all(free);
        let around = &space.around;
        // In the open there is nothing to hold to.
        let holds = || self.hold == f64::INFINITY || !around.has_bodies() || around.distance(end) <= self.hold;
        (grows && holds()).then_some(Trial { heading, end, voxels })
    }

    /// What a trial of a tip is worth.
    fn worth(&self, trial: &Trial, heading: [f64; 3], thicket: &Thicket, space: &Space<'_>) -> f64 {
        let mut worth = self.upward * trial.heading[2];
        worth += self.straight * (0..3).map(|k| heading[k] * trial.heading[k]).sum::<f64>();
        let distance = if self.surface > 0.0 { space.around.distance(trial.end) } else { f64::INFINITY };
        if distance.is_finite() {
            worth -= self.surface * (distance - self.cling).abs() / self.segment;
        }
        if self.light > 0.0 {
            let own = trial.voxels.last();
            let grown = |voxel: Voxel| thicket.taken.contains(&voxel) || space.is_anothers(voxel);
            let shut = |at: [f64; 3]| {
                let voxel = space.lattice.voxel_of(at);
                space.around.is_solid(at) || (own != Some(&voxel) && grown(voxel))
            };
            worth += self.light * self.sky.share(trial.end, self.voxel, self.sight, shut);
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
        space: &Space<'_>,
    ) -> Option<Trial> {
        let mut best: Option<(f64, Trial)> = None;
        for _ in 0..self.trials {
            let (turn, side) = (words.share(), words.share());
            let heading = about(from.heading, spread, turn, side);
            let Some(trial) = self.tried(from.at, heading, thicket, space) else { continue };
            let worth = self.worth(&trial, from.heading, thicket, space);
            if best.as_ref().is_none_or(|(most, _)| worth > *most) {
                best = Some((worth, trial));
            }
        }
        best.map(|(_, trial)| trial)
    }

    /// What a tip is to grow: a segment and, by chance, a branch beside it. Takes their voxels. `None` where nothing
    /// can grow, nor will.
    fn planned(&self, plant: &Plant, thicket: &mut Thicket, from: Growing, space: &Space<'_>) -> Option<Planned> {
        let key: LineageKey = plant.axes.key[from.tip.axis.index()];
        let mut words = plant.random.stream(key, Purpose::Node);
        // A word for the branch, and two for each trial of the tip and of the branch. A tip that was refused draws the
        // same, and chooses another trial since the voxels are others' now.
        words.seek(u64::from(from.tip.rank) * (1 + 4 * u64::from(self.trials)));
        let mut planned = Planned { from, segments: Vec::new() };
        if planned.is_first() && space.is_anothers(space.lattice.seed()) {
            return None;
        }
        let branches = words.share() < self.branching && !planned.is_first();
        let spreads = [(false, self.spread), (true, self.branch_spread)];
        for (aside, spread) in spreads.into_iter().filter(|(aside, _)| !aside || branches) {
            let Some(trial) = self.best(&from, spread, &mut words, thicket, space) else { continue };
            thicket.taken.extend(&trial.voxels);
            planned.segments.push((aside, trial));
        }
        (!planned.segments.is_empty()).then_some(planned)
    }

    /// Plans what all tips are to grow.
    fn plan(&self, plant: &Plant, thicket: &mut Thicket, space: &Space<'_>) {
        if thicket.taken.is_empty() {
            thicket.taken.insert(space.lattice.seed());
        }
        for from in std::mem::take(&mut thicket.tips) {
            let planned = self.planned(plant, thicket, from, space);
            thicket.planned.extend(planned);
        }
    }

    /// Grows what was planned, as far as it is granted.
    fn settle(
        &self,
        plant: &mut Plant,
        thicket: &mut Thicket,
        birth: Tick,
        granted: impl Fn(usize) -> bool,
    ) -> Result<(), Overgrown> {
        for (number, planned) in std::mem::take(&mut thicket.planned).into_iter().enumerate() {
            if !granted(number) {
                planned.voxels().for_each(|voxel| _ = thicket.taken.remove(voxel));
                thicket.tips.push(planned.from);
                continue;
            }
            let from = planned.from.tip;
            for (aside, Trial { heading, end, .. }) in planned.segments {
                let segment = Segment { heading, length: self.segment, diameter: self.diameter, birth };
                let tip = if aside { branch(plant, &from, 0, &segment)? } else { lengthen(plant, &from, &segment)? };
                thicket.tips.push(Growing { tip, at: end, heading });
            }
        }
        Ok(())
    }
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
        Thicket { tips: vec![Growing::SEED], ..Thicket::default() }
    }

    fn grow_to(&self, age: Tick, plant: &mut Plant, life: &mut Thicket, view: &View<'_>) -> Result<(), Overgrown> {
        if age < plant.age {
            plant.clear();
            *life = self.sow(plant);
        }
        if view.site.cells.shared {
            // Planned when it was claimed.
            self.settle(plant, life, age, |number| view.granted.get(number) == Some(&true))?;
        } else {
            let space = Space::of(self.voxel, plant, view.site);
            for birth in plant.age + 1..=age {
                self.plan(plant, life, &space);
                self.settle(plant, life, birth, |_| true)?;
            }
        }
        plant.age = age;
        Ok(())
    }

    fn cell_m(&self) -> Option<f64> {
        Some(self.voxel)
    }

    fn claim(&self, plant: &Plant, life: &mut Thicket, site: &Site, claims: &mut Claims) {
        let space = Space::of(self.voxel, plant, site);
        self.plan(plant, life, &space);
        let claimed = life.planned.iter().map(|planned| {
            let seed = planned.is_first().then(|| space.lattice.seed());
            seed.into_iter().chain(planned.voxels().copied()).collect()
        });
        claims.0.extend(claimed);
    }

    fn thicken(&self, _age: Tick, plant: &mut Plant) {
        keep_diameters(plant);
    }

    fn expectation(&self, until: Tick) -> Option<Expectation> {
        Some(foretold::at_most(until, self.branching))
    }
}
