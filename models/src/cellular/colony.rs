//! Growth through a field of density (Cohen 1967; ABOP ch. 2), around the obstacles of the site.
//!
//! All tips see the field as it was at the end of the last tick. A tip grows along inertia · its heading − avoidance ·
//! R ∇ρ + tropism, R being the reach of the field. Its room is 1 at the density of its own straight trail and 0 where
//! others add `crowding` to it; the length of the segment and the probability to branch are proportional to the room,
//! and a tip without room rests for ever, since the density never falls. A tip that branches divides: one arm continues
//! its axis, the other begins an axis of the next order, at equal angles to either side. An arm that would enter an
//! obstacle turns along its surface (`surface`); one that cannot grows no more. Absent: parameters (`cohen`), and the
//! tips of other plants.

use super::around::{Around, unit};
use super::body::{Growing, Segment, branch, keep_diameters, lengthen};
use super::density::Density;
use super::foretold;
use super::surface::heeded;
use phytomer_sim::clock::Tick;
use phytomer_sim::expectation::Expectation;
use phytomer_sim::math::sincos;
use phytomer_sim::model::{Grow, Growth, Overgrown};
use phytomer_sim::plant::{Habit, NewAxis, NodeId, Plant};
use phytomer_sim::random::Purpose;
use phytomer_sim::rotation::Rotation;
use phytomer_sim::site::View;
use std::f64::consts::TAU;
use std::sync::Arc;

/// A segment shorter than this share of a full one does not grow.
const SHORTEST: f64 = 0.01;

/// Cohen's model, checked and compiled. Lengths in metres, angles in radians.
#[derive(Debug, Clone)]
pub struct CohenModel {
    pub(super) segment: f64,
    pub(super) reach: f64,
    pub(super) diameter: f64,
    pub(super) inertia: f64,
    pub(super) avoidance: f64,
    pub(super) tropism: [f64; 3],
    pub(super) crowding: f64,
    pub(super) branching: f64,
    pub(super) angle: f64,
    /// The density of a tip's own straight trail.
    pub(super) own: f64,
    pub(super) habit: Arc<Habit>,
}

/// The field and the tips of one plant.
#[derive(Debug, Clone, PartialEq)]
pub struct Colony {
    density: Density,
    tips: Vec<Growing>,
}

/// What a tip does at a tick.
struct Step {
    length: f64,
    /// The headings of the arms that can grow: the first continues the axis.
    headings: Vec<[f64; 3]>,
}

impl CohenModel {
    /// What a tip does; `None` where it has no room.
    fn step(&self, plant: &Plant, colony: &Colony, from: &Growing, at: (Tick, &Around<'_>)) -> Option<Step> {
        let (birth, around) = at;
        let (density, gradient) = colony.density.at(from.at, self.own + self.crowding)?;
        let room = (1.0 - (density - self.own) / self.crowding).clamp(0.0, 1.0);
        if room < SHORTEST {
            return None;
        }
        let way = [0, 1, 2]
            .map(|k| self.inertia * from.heading[k] - self.avoidance * self.reach * gradient[k] + self.tropism[k]);
        let heading = unit(way).unwrap_or(from.heading);
        let key = plant.axes.key[from.tip.axis.index()];
        let mut words = plant.random.stream(key, Purpose::Node);
        words.seek(2 * u64::from(birth));
        let divides = words.share() < self.branching * room && from.tip.node != NodeId::NONE;
        let arms = if divides { arms(heading, self.angle, words.share()).to_vec() } else { vec![heading] };
        let length = self.segment * room;
        let turn = |arm: u64| {
            // What becomes of a tip at a surface has words of its own.
            let mut words = plant.random.stream(key, Purpose::Bud);
            words.seek(2 * u64::from(birth) + arm);
            words.share()
        };
        let heeded = |(arm, heading)| heeded(around, from.at, heading, length, || turn(arm));
        Some(Step { length, headings: (0..).zip(arms).filter_map(heeded).collect() })
    }

    fn tick(&self, plant: &mut Plant, colony: &mut Colony, birth: Tick, around: &Around<'_>) -> Result<(), Overgrown> {
        let step = |from: &Growing| self.step(plant, colony, from, (birth, around));
        let steps: Vec<Option<Step>> = colony.tips.iter().map(step).collect();
        let mut tips = Vec::with_capacity(colony.tips.len());
        for (from, step) in std::mem::take(&mut colony.tips).into_iter().zip(steps) {
            let Some(Step { length, headings }) = step else { continue };
            for (arm, heading) in headings.into_iter().enumerate() {
                let segment = Segment { heading, length, diameter: self.diameter, birth };
                let tip = if arm == 0 {
                    lengthen(plant, &from.tip, &segment)?
                } else {
                    branch(plant, &from.tip, 0, &segment)?
                };
                let at = [0, 1, 2].map(|k| from.at[k] + length * heading[k]);
                colony.density.add(at);
                tips.push(Growing { tip, at, heading });
            }
        }
        colony.tips = tips;
        Ok(())
    }
}

/// Two headings at an angle to either side of a heading, in a plane that is turned about it by a share of a full turn.
fn arms(heading: [f64; 3], angle: f64, turn: f64) -> [[f64; 3]; 2] {
    let frame = Rotation::to(heading, [0.0, 0.0, 1.0]);
    let ((sin, cos), (y, z)) = (sincos(angle), sincos(TAU * turn));
    [1.0, -1.0].map(|side| frame.turned([cos, side * sin * y, side * sin * z]))
}

impl Grow for CohenModel {
    type Life = Colony;

    fn growth(&self) -> Growth {
        Growth::Rebuilds
    }

    fn habit(&self) -> Arc<Habit> {
        Arc::clone(&self.habit)
    }

    fn sow(&self, plant: &mut Plant) -> Colony {
        plant.add_axis(NewAxis::OF_THE_SEED);
        let mut density = Density::of(self.reach);
        density.add([0.0; 3]);
        Colony { density, tips: vec![Growing::SEED] }
    }

    fn grow_to(&self, age: Tick, plant: &mut Plant, life: &mut Colony, view: &View<'_>) -> Result<(), Overgrown> {
        if age < plant.age {
            plant.clear();
            *life = self.sow(plant);
        }
        let around = Around { site: view.site, place: plant.place };
        for birth in plant.age + 1..=age {
            self.tick(plant, life, birth, &around)?;
        }
        plant.age = age;
        Ok(())
    }

    fn thicken(&self, _age: Tick, plant: &mut Plant) {
        keep_diameters(plant);
    }

    fn expectation(&self, until: Tick) -> Option<Expectation> {
        Some(foretold::at_most(until, self.branching))
    }
}
