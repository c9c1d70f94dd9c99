//! The parameters of growth through a field of density (Cohen 1967, "Computer simulation of biological pattern
//! generation processes"; ABOP ch. 2): tips that keep their way, turn from what already stands there, and follow a
//! tropism.
//!
//! Cohen's program had these influences on flat arrays; his numbers are not printed with ABOP, so the formula is ours.
//! Absent: growth (`colony`).

use super::body::habit;
use super::colony::CohenModel;
use super::density::Density;
use super::stated::{ANGLE, DIAMETER, SHARE, SIZE, WEIGHT, assumed_diameter};
use crate::fault::{Fault, Path};
use crate::law::{Constant, ValueRange};
use phytomer_sim::clock::{LAST_TICK, Tick};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A tip asks the ends around it until they add up to `crowding`, so that this bounds the work of a segment.
const CROWD: ValueRange = ValueRange { min: 1e-6, max: 1e4, what: "a density" };

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
    #[schemars(with = "Constant", extend("minimum" = 0.000_001, "maximum" = 10_000))]
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
