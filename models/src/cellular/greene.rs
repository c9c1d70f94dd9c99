//! The parameters of growth by trials in voxels (Greene 1989, "Voxel space automata: modeling with stochastic growth
//! processes in voxel space"; ABOP ch. 2, Fig. 2.1): a vine over a house, a shoot that leaves through a window.
//!
//! Greene's rules are of the kinds that these parameters weigh: nearness of surfaces, light, directions, and trials of
//! which the best grows. He prints no formula, so the sum of preferences is ours. Absent: growth (`thicket`).

use super::sky::Sky;
use super::stated::{ANGLE, DIAMETER, SHARE, SIZE, WEIGHT, assumed_diameter};
use super::thicket::GreeneModel;
use crate::fault::{Fault, Path};
use crate::law::{Constant, ValueRange};
use phytomer_sim::clock::{LAST_TICK, Tick};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

const DISTANCE: ValueRange = ValueRange { min: 0.0, max: 1000.0, what: "a distance in m" };

/// The most steps of a ray of light, and the most voxels of a segment.
const MOST_STEPS: f64 = 200.0;

/// A plant that grows by trials in voxels, around the obstacles of its site.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Greene {
    /// The edge of a voxel, metres. Two segments never pass through one voxel, but for the voxel of their joint.
    /// The plants of a plot share its voxels, so that their species must state the same edge.
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
    /// The greatest distance of a tip from a surface, metres: beyond it a vine has no hold. Any if not given, and where
    /// the site has no obstacle.
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
            voxel: read(&self.voxel_m, &key("voxel_m"), SIZE),
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
            habit: Arc::new(super::body::habit()),
        };
        if !faults.is_empty() {
            return Err(faults);
        }
        let GreeneModel { voxel, segment, sight, .. } = model;
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
