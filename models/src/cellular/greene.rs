//! Growth by trials in voxels (Greene 1989, "Voxel space automata: modeling with stochastic growth processes in voxel
//! space"; ABOP ch. 2, Fig. 2.1): a vine over a house, a shoot that leaves through a window.
//!
//! At each tick every tip tries `trials` headings about its own. A trial fails where its segment leaves no new voxel,
//! passes through a voxel that is taken, that touches an obstacle of the site or that reaches below the ground, or ends
//! farther from a surface than the plant can hold. Of the others the best grows, by a sum of preferences: near a
//! surface, in the light, upward, straight on. Greene's rules are of these kinds; he prints no formula, so the sum is ours.
//! A tip without a trial that passes rests for ever. Distances and obstacles are those of the site's shapes; the light is
//! the share of open sky. Absent: diffusion of light, and leaves.

use super::body::{Segment, Tip, branch, habit, keep_diameters, lengthen};
use super::sky::Sky;
use super::voxels::{Lattice, Voxel};
use crate::fault::{Fault, Path};
use crate::law::{Constant, ConstantForm, ValueRange};
use phytomer_sim::clock::{LAST_TICK, Tick};
use phytomer_sim::math::{cos, sincos};
use phytomer_sim::model::{Grow, Growth, Overgrown};
use phytomer_sim::plant::{Habit, LineageKey, NewAxis, NodeId, Plant};
use phytomer_sim::random::{Purpose, Stream};
use phytomer_sim::rotation::Rotation;
use phytomer_sim::shape::SURFACE;
use phytomer_sim::site::{Side, Site, View};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::sync::Arc;

const SIZE: ValueRange = ValueRange { min: 1e-4, max: 1000.0, what: "a length in m" };
const DISTANCE: ValueRange = ValueRange { min: 0.0, max: 1000.0, what: "a distance in m" };
const DIAMETER: ValueRange = ValueRange { min: 0.0, max: 1e6, what: "a diameter in mm" };
const ANGLE: ValueRange = ValueRange { min: 0.0, max: 180.0, what: "an angle in degrees" };
const SHARE: ValueRange = ValueRange { min: 0.0, max: 1.0, what: "a probability" };
const WEIGHT: ValueRange = ValueRange { min: 0.0, max: 1000.0, what: "a weight" };

/// The most steps of a ray of light, and the most voxels of a segment.
const MOST_STEPS: f64 = 200.0;

/// A plant that grows by trials in voxels, around the obstacles of its site.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Greene {
    /// The edge of a voxel, metres. Two segments never pass through one voxel, but for the voxel of their joint.
    #[schemars(with = "Constant", extend("minimum" = 0.0001, "maximum" = 1000))]
    pub voxel_m: Constant,
    /// The length of a segment, metres; at least the edge of a voxel.
    #[schemars(with = "Constant", extend("minimum" = 0.0001, "maximum" = 1000))]
    pub segment_m: Constant,
    /// The diameter of an internode, millimetres; 10 (assumed) if not given.
    #[serde(default = "assumed_diameter")]
    #[schemars(with = "Constant", extend("minimum" = 0, "maximum" = 1_000_000))]
    pub diameter_mm: Constant,
    /// The number of headings that a tip tries at a tick; 12 if not given.
    #[serde(default = "twelve")]
    #[schemars(range(min = 1, max = 100))]
    pub trials: u32,
    /// The largest angle between a tip's heading and one that it tries, degrees.
    #[schemars(with = "Constant", extend("minimum" = 0, "maximum" = 180))]
    pub spread_deg: Constant,
    /// The probability that a tip branches when it grows; 0 if not given.
    #[serde(default)]
    #[schemars(with = "Constant", extend("minimum" = 0, "maximum" = 1))]
    pub branching: Constant,
    /// The largest angle between the heading of a tip and that of its branch, degrees; 90 if not given.
    #[serde(default = "right_angle")]
    #[schemars(with = "Constant", extend("minimum" = 0, "maximum" = 180))]
    pub branching_deg: Constant,
    /// The greatest distance of a tip from a surface, metres: beyond it a vine has no hold. Any if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Constant", extend("minimum" = 0, "maximum" = 1000))]
    pub hold_m: Option<Constant>,
    /// The distance from a surface at which a tip grows best, metres; 0 if not given.
    #[serde(default)]
    #[schemars(with = "Constant", extend("minimum" = 0, "maximum" = 1000))]
    pub cling_m: Constant,
    /// How far a tip sees for its light, metres; 5 if not given.
    #[serde(default = "five")]
    #[schemars(with = "Constant", extend("minimum" = 0.0001, "maximum" = 1000))]
    pub sight_m: Constant,
    /// What a trial is preferred by.
    #[serde(default)]
    pub prefer: Preferences,
}

/// The weights of the preferences, 0 each if not given. A trial is worth their sum, each times its number.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Preferences {
    /// Of a surface: times the distance from `cling_m`, in segments, taken away.
    #[schemars(with = "Constant", extend("minimum" = 0, "maximum" = 1000))]
    pub surface: Constant,
    /// Of light: times the share of open sky.
    #[schemars(with = "Constant", extend("minimum" = 0, "maximum" = 1000))]
    pub light: Constant,
    /// Of the upward direction: times the upward part of the heading.
    #[schemars(with = "Constant", extend("minimum" = 0, "maximum" = 1000))]
    pub upward: Constant,
    /// Of the tip's own heading: times the cosine of the turn.
    #[schemars(with = "Constant", extend("minimum" = 0, "maximum" = 1000))]
    pub straight: Constant,
}

fn assumed_diameter() -> Constant {
    Constant::from(ConstantForm { value: 10.0, source: None, assumed: true })
}

fn twelve() -> u32 {
    12
}

fn right_angle() -> Constant {
    Constant::from(90.0)
}

fn five() -> Constant {
    Constant::from(5.0)
}

impl Greene {
    /// The model, grown at most to the age `until`; the parameters stand at `path` in their file.
    ///
    /// # Errors
    /// Every fault found, each with its path below `path`.
    pub fn compile(&self, until: Tick, path: &Path) -> Result<GreeneModel, Vec<Fault>> {
        let mut faults = Vec::new();
        if until > LAST_TICK {
            faults.push(Fault::new(path, format!("the last age is {until}"), format!("at most {LAST_TICK}")));
        }
        let mut read = |number: &Constant, path: &Path, range: ValueRange| {
            number.within(path, range).map_err(|fault| faults.push(fault)).unwrap_or_default()
        };
        let key = |key: &str| path.key(key);
        let prefer = key("prefer");
        let model = GreeneModel {
            lattice: Lattice { edge: read(&self.voxel_m, &key("voxel_m"), SIZE) },
            segment: read(&self.segment_m, &key("segment_m"), SIZE),
            diameter: read(&self.diameter_mm, &key("diameter_mm"), DIAMETER) / 1000.0,
            trials: self.trials,
            spread: read(&self.spread_deg, &key("spread_deg"), ANGLE).to_radians(),
            branching: read(&self.branching, &key("branching"), SHARE),
            branch_spread: read(&self.branching_deg, &key("branching_deg"), ANGLE).to_radians(),
            hold: self.hold_m.as_ref().map_or(f64::INFINITY, |hold| read(hold, &key("hold_m"), DISTANCE)),
            cling: read(&self.cling_m, &key("cling_m"), DISTANCE),
            sight: read(&self.sight_m, &key("sight_m"), SIZE),
            surface: read(&self.prefer.surface, &prefer.key("surface"), WEIGHT),
            light: read(&self.prefer.light, &prefer.key("light"), WEIGHT),
            upward: read(&self.prefer.upward, &prefer.key("upward"), WEIGHT),
            straight: read(&self.prefer.straight, &prefer.key("straight"), WEIGHT),
            sky: Sky::new(),
            habit: Arc::new(habit()),
        };
        if !faults.is_empty() {
            return Err(faults);
        }
        let GreeneModel { lattice: Lattice { edge: voxel }, segment, sight, .. } = model;
        if segment < voxel {
            let problem = format!("a segment of {segment} m is shorter than the edge of a voxel, {voxel} m");
            faults.push(Fault::new(&key("segment_m"), problem, format!("at least {voxel}")));
        }
        for (name, length) in [("segment_m", segment), ("sight_m", sight)] {
            if length / voxel > MOST_STEPS {
                let problem = format!("{length} m are more than {MOST_STEPS} voxels");
                faults.push(Fault::new(&key(name), problem, format!("at most {}", MOST_STEPS * voxel)));
            }
        }
        if faults.is_empty() { Ok(model) } else { Err(faults) }
    }
}

/// Greene's model, checked and compiled. Lengths in metres, angles in radians.
#[derive(Debug, Clone)]
pub struct GreeneModel {
    lattice: Lattice,
    segment: f64,
    diameter: f64,
    trials: u32,
    spread: f64,
    branching: f64,
    branch_spread: f64,
    hold: f64,
    cling: f64,
    sight: f64,
    surface: f64,
    light: f64,
    upward: f64,
    straight: f64,
    sky: Sky,
    habit: Arc<Habit>,
}

/// The voxels and the growing tips of one plant.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Thicket {
    taken: BTreeSet<Voxel>,
    tips: Vec<Growing>,
}

/// A tip that grows.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Growing {
    tip: Tip,
    /// Where it is, metres from the seed.
    at: [f64; 3],
    heading: [f64; 3],
}

/// A segment that may grow.
struct Trial {
    heading: [f64; 3],
    end: [f64; 3],
    /// The voxels behind that of its start.
    voxels: Vec<Voxel>,
}

/// The site as a plant meets it that stands at `place`.
struct Around<'a> {
    site: &'a Site,
    place: [f64; 3],
}

impl Around<'_> {
    fn world(&self, at: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| at[k] + self.place[k])
    }

    /// Whether nothing can grow there.
    fn is_shut(&self, at: [f64; 3]) -> bool {
        !self.site.obstacles.is_empty() && self.site.kills_at(self.world(at))
    }

    /// Whether a body stands there, which shades.
    fn is_solid(&self, at: [f64; 3]) -> bool {
        let solid = |obstacle: &phytomer_sim::site::Obstacle| obstacle.kills == Side::Inside;
        self.site.obstacles.iter().any(|obstacle| solid(obstacle) && obstacle.kills_at(self.world(at)))
    }

    /// The distance to the nearest surface of a body; infinite where there is none.
    fn distance(&self, at: [f64; 3]) -> f64 {
        let bodies = self.site.obstacles.iter().filter(|obstacle| obstacle.kills == Side::Inside);
        bodies.map(|body| SURFACE - body.shape.field(self.world(at))).fold(f64::INFINITY, f64::min)
    }
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
        let holds = || self.hold == f64::INFINITY || around.distance(end) <= self.hold;
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
        let seed = Growing { tip: Tip::SEED, at: [0.0; 3], heading: [0.0, 0.0, 1.0] };
        Thicket { taken: BTreeSet::from([[0; 3]]), tips: vec![seed] }
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
