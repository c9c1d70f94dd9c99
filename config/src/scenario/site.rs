//! External influences on the plants of a run: gravity, a steady wind, and planes that kill the buds that reach them.
//!
//! Gravity and wind act only on species whose wood bends. Absent: light and soil.

use phytomer_law::fault::{Fault, Path};
use phytomer_sim::site::{Plane as SimPlane, STANDARD_GRAVITY, Wind as SimWind};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The site of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Site {
    /// The acceleration of gravity, m/s²; 0 leaves every plant in its pose at rest. 9.80665 if not given.
    #[schemars(range(min = 0, max = 100))]
    pub gravity_m_s2: f64,
    /// A steady wind; calm if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wind: Option<Wind>,
    /// The latitude, degrees, north positive. That of the weather file if not given; without either the length of a day
    /// is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -90, max = 90))]
    pub latitude_deg: Option<f64>,
    /// Planes that kill every bud that reaches them, as `[[site.plane]]`: a roof, a wall, a mown height. None if not
    /// given. Each plot has these planes, placed relative to the plot.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub plane: Vec<Plane>,
}

/// A plane that kills the buds on it and beyond it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plane {
    /// A point on the plane, metres from the place of the plot.
    #[schemars(inner(range(min = -1e6, max = 1e6)))]
    pub point_m: [f64; 3],
    /// The normal of the plane, on the side where no bud lives; any length but 0.
    #[schemars(inner(range(min = -1e6, max = 1e6)))]
    pub normal: [f64; 3],
}

/// A steady, horizontal wind, equal at every height.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Wind {
    /// The speed of the wind, m/s.
    #[schemars(range(min = 0, max = 100))]
    pub speed_m_s: f64,
    /// The direction towards which it blows, degrees from the X axis (east) to the Y axis (north).
    #[serde(default)]
    #[schemars(range(min = -360, max = 360))]
    pub towards_deg: f64,
}

impl Default for Site {
    fn default() -> Self {
        Self { gravity_m_s2: STANDARD_GRAVITY, wind: None, latitude_deg: None, plane: Vec::new() }
    }
}

impl Site {
    /// Whether the site is that of a scenario without `[site]`: open ground without wind, under gravity.
    pub(super) fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// The site of the plants of a plot at `place`, metres: its planes are moved with the plot.
    pub fn felt_at(&self, place: [f64; 3]) -> phytomer_sim::site::Site {
        let wind = self.wind.as_ref().map_or_else(SimWind::default, Wind::felt);
        let planes = self.plane.iter().map(|plane| plane.moved(place)).collect();
        phytomer_sim::site::Site { gravity: self.gravity_m_s2, wind, planes, ..phytomer_sim::site::Site::default() }
    }

    /// Adds the faults of planes that the schema cannot state.
    pub(super) fn check_planes(&self, path: &Path, faults: &mut Vec<Fault>) {
        for (number, plane) in self.plane.iter().enumerate().filter(|(_, plane)| plane.normal == [0.0; 3]) {
            let path = path.key("plane").index(number).key("normal");
            let problem = format!("the normal of the plane through {:?} has the length 0", plane.point_m);
            faults.push(Fault::new(&path, problem, "a direction, such as [0, 0, 1] for a roof"));
        }
    }
}

impl Plane {
    /// The plane as it lies around the seed of a plant.
    pub(super) fn around_seed(&self) -> SimPlane {
        self.moved([0.0; 3])
    }

    /// The plane of a plot at `place`, metres.
    fn moved(&self, place: [f64; 3]) -> SimPlane {
        SimPlane { point: [0, 1, 2].map(|k| self.point_m[k] + place[k]), normal: self.normal }
    }
}

impl Wind {
    /// The wind as `phytomer_sim` takes it.
    pub fn felt(&self) -> SimWind {
        SimWind { speed: self.speed_m_s, towards: self.towards_deg.to_radians() }
    }
}
