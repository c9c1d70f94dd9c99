//! Growth through a field of density (Cohen 1967, "Computer simulation of biological pattern generation processes";
//! ABOP ch. 2): tips that keep their way, turn from what already stands there, and follow a tropism.
//!
//! All tips see the field as it was at the end of the last tick. A tip grows along inertia · its heading − avoidance ·
//! R ∇ρ + tropism, R being the reach of the field. Its room is 1 at the density of its own straight trail and 0 where
//! others add `crowding` to it; the length of the segment and the probability to branch are proportional to the room,
//! and a tip without room waits. A tip that branches divides: one arm continues its axis, the other begins an axis of
//! the next order, at equal angles to either side. Cohen's program had these influences on flat arrays; his numbers are
//! not printed with ABOP, so the formula is ours. Absent: obstacles.

use super::body::{Growing, Segment, branch, habit, keep_diameters, lengthen};
use super::density::Density;
use crate::fault::{Fault, Path};
use crate::law::{Constant, ConstantForm, ValueRange};
use phytomer_sim::clock::{LAST_TICK, Tick};
use phytomer_sim::math::sincos;
use phytomer_sim::model::{Grow, Growth, Overgrown};
use phytomer_sim::plant::{Habit, NewAxis, NodeId, Plant};
use phytomer_sim::random::{Purpose, Stream};
use phytomer_sim::rotation::Rotation;
use phytomer_sim::site::View;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use std::sync::Arc;

const SIZE: ValueRange = ValueRange { min: 1e-4, max: 1000.0, what: "a length in m" };
const DIAMETER: ValueRange = ValueRange { min: 0.0, max: 1e6, what: "a diameter in mm" };
const ANGLE: ValueRange = ValueRange { min: 0.0, max: 180.0, what: "an angle in degrees" };
const SHARE: ValueRange = ValueRange { min: 0.0, max: 1.0, what: "a probability" };
const WEIGHT: ValueRange = ValueRange { min: 0.0, max: 1000.0, what: "a weight" };
const CROWD: ValueRange = ValueRange { min: 1e-6, max: 1e6, what: "a density" };

/// A segment shorter than this share of a full one does not grow: the tip waits.
const SHORTEST: f64 = 0.01;
/// The most segments within the reach of the field.
const MOST_IN_REACH: f64 = 100.0;

/// A plant of tips that grow through the density of what has grown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cohen {
    /// The length of a segment with room, metres.
    #[schemars(with = "Constant", extend("minimum" = 0.0001, "maximum" = 1000))]
    pub segment_m: Constant,
    /// The distance up to which the end of a segment is felt, metres.
    #[schemars(with = "Constant", extend("minimum" = 0.0001, "maximum" = 1000))]
    pub reach_m: Constant,
    /// The diameter of an internode, millimetres; 10 (assumed) if not given.
    #[serde(default = "assumed_diameter")]
    #[schemars(with = "Constant", extend("minimum" = 0, "maximum" = 1_000_000))]
    pub diameter_mm: Constant,
    /// The weight of a tip's own heading; 1 if not given.
    #[serde(default = "one_time")]
    #[schemars(with = "Constant", extend("minimum" = 0, "maximum" = 1000))]
    pub inertia: Constant,
    /// The weight of the way from where others stand; 0 if not given.
    #[serde(default)]
    #[schemars(with = "Constant", extend("minimum" = 0, "maximum" = 1000))]
    pub avoidance: Constant,
    /// A direction that tips follow, as long as its weight: [x, y, z], z upward. None if not given.
    #[serde(default)]
    #[schemars(inner(range(min = -1000, max = 1000)))]
    pub tropism: [f64; 3],
    /// The density that others add where nothing grows any more: the end of a segment adds 1 where it is. 2 if not
    /// given.
    #[serde(default = "two")]
    #[schemars(with = "Constant", extend("minimum" = 0.000_001, "maximum" = 1_000_000))]
    pub crowding: Constant,
    /// The probability that a tip with room divides when it grows; 0 if not given.
    #[serde(default)]
    #[schemars(with = "Constant", extend("minimum" = 0, "maximum" = 1))]
    pub branching: Constant,
    /// The angle between each arm of a tip that divides and its heading, degrees; 30 if not given.
    #[serde(default = "thirty")]
    #[schemars(with = "Constant", extend("minimum" = 0, "maximum" = 180))]
    pub branching_deg: Constant,
}

fn assumed_diameter() -> Constant {
    Constant::from(ConstantForm { value: 10.0, source: None, assumed: true })
}

fn one_time() -> Constant {
    Constant::from(1.0)
}

fn two() -> Constant {
    Constant::from(2.0)
}

fn thirty() -> Constant {
    Constant::from(30.0)
}

impl Cohen {
    /// The model, grown at most to the age `until`; the parameters stand at `path` in their file.
    ///
    /// # Errors
    /// Every fault found, each with its path below `path`.
    pub fn compile(&self, until: Tick, path: &Path) -> Result<CohenModel, Vec<Fault>> {
        let mut faults = Vec::new();
        if until > LAST_TICK {
            faults.push(Fault::new(path, format!("the last age is {until}"), format!("at most {LAST_TICK}")));
        }
        let mut read = |number: &Constant, key: &str, range: ValueRange| {
            number.within(&path.key(key), range).map_err(|fault| faults.push(fault)).unwrap_or_default()
        };
        let (segment, reach) = (read(&self.segment_m, "segment_m", SIZE), read(&self.reach_m, "reach_m", SIZE));
        let mut model = CohenModel {
            segment,
            reach,
            diameter: read(&self.diameter_mm, "diameter_mm", DIAMETER) / 1000.0,
            inertia: read(&self.inertia, "inertia", WEIGHT),
            avoidance: read(&self.avoidance, "avoidance", WEIGHT),
            tropism: self.tropism,
            crowding: read(&self.crowding, "crowding", CROWD),
            branching: read(&self.branching, "branching", SHARE),
            angle: read(&self.branching_deg, "branching_deg", ANGLE).to_radians(),
            own: 0.0,
            habit: Arc::new(habit()),
        };
        if faults.is_empty() && reach / segment > MOST_IN_REACH {
            let problem = format!("{reach} m are more than {MOST_IN_REACH} segments");
            let expected = format!("at most {}", MOST_IN_REACH * segment);
            faults.push(Fault::new(&path.key("reach_m"), problem, expected));
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        model.own = Density::of(reach).of_row(segment);
        Ok(model)
    }
}

/// Cohen's model, checked and compiled. Lengths in metres, angles in radians.
#[derive(Debug, Clone)]
pub struct CohenModel {
    segment: f64,
    reach: f64,
    diameter: f64,
    inertia: f64,
    avoidance: f64,
    tropism: [f64; 3],
    crowding: f64,
    branching: f64,
    angle: f64,
    /// The density of a tip's own straight trail.
    own: f64,
    habit: Arc<Habit>,
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
    /// The heading of the tip, and that of a second arm where it divides.
    headings: [Option<[f64; 3]>; 2],
}

impl CohenModel {
    /// What a tip does; `None` where it has no room.
    fn step(&self, plant: &Plant, colony: &Colony, from: &Growing, birth: Tick) -> Option<Step> {
        let (density, gradient) = colony.density.at(from.at);
        let room = (1.0 - (density - self.own) / self.crowding).clamp(0.0, 1.0);
        if room < SHORTEST {
            return None;
        }
        let way = [0, 1, 2]
            .map(|k| self.inertia * from.heading[k] - self.avoidance * self.reach * gradient[k] + self.tropism[k]);
        let heading = unit(way).unwrap_or(from.heading);
        let mut words = plant.random.stream(plant.axes.key[from.tip.axis.index()], Purpose::Node);
        // A tip that waits draws anew at each tick.
        words.seek(2 * u64::from(birth));
        let divides = share(&mut words) < self.branching * room && from.tip.node != NodeId::NONE;
        let headings = if divides {
            let [one, other] = arms(heading, self.angle, share(&mut words));
            [Some(one), Some(other)]
        } else {
            [Some(heading), None]
        };
        Some(Step { length: self.segment * room, headings })
    }

    fn tick(&self, plant: &mut Plant, colony: &mut Colony, birth: Tick) -> Result<(), Overgrown> {
        let steps: Vec<Option<Step>> = colony.tips.iter().map(|from| self.step(plant, colony, from, birth)).collect();
        let mut tips = Vec::with_capacity(colony.tips.len());
        for (from, step) in std::mem::take(&mut colony.tips).into_iter().zip(steps) {
            let Some(Step { length, headings }) = step else {
                tips.push(from);
                continue;
            };
            for (arm, heading) in headings.into_iter().enumerate() {
                let Some(heading) = heading else { continue };
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

/// A vector of length 1; `None` of one without direction.
fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    (length > 1e-12 && length.is_finite()).then(|| vector.map(|x| x / length))
}

/// A word as a number in (0, 1).
fn share(words: &mut Stream) -> f64 {
    (f64::from(words.word()) + 0.5) / 4_294_967_296.0
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

    fn grow_to(&self, age: Tick, plant: &mut Plant, life: &mut Colony, _: &View<'_>) -> Result<(), Overgrown> {
        if age < plant.age {
            plant.clear();
            *life = self.sow(plant);
        }
        for birth in plant.age + 1..=age {
            self.tick(plant, life, birth)?;
        }
        plant.age = age;
        Ok(())
    }

    fn thicken(&self, _age: Tick, plant: &mut Plant) {
        keep_diameters(plant);
    }
}
