//! What acts on the plants of a run from outside: gravity and a steady wind.
//!
//! Both act only on species whose wood bends. Absent: light, soil and obstacles.

use phytomer_sim::site::{STANDARD_GRAVITY, Wind as SimWind};
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
}

/// A steady, level wind, the same at every height.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Wind {
    /// Its speed, m/s.
    #[schemars(range(min = 0, max = 100))]
    pub speed_m_s: f64,
    /// The direction towards which it blows, degrees from the X axis (east) to the Y axis (north).
    #[serde(default)]
    #[schemars(range(min = -360, max = 360))]
    pub towards_deg: f64,
}

impl Default for Site {
    fn default() -> Self {
        Self { gravity_m_s2: STANDARD_GRAVITY, wind: None }
    }
}

impl Site {
    /// Whether it is the open ground that a scenario without a site stands on.
    pub(super) fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// The site as plants feel it.
    pub fn felt(&self) -> phytomer_sim::site::Site {
        let wind = self.wind.as_ref().map_or_else(SimWind::default, Wind::felt);
        phytomer_sim::site::Site { gravity: self.gravity_m_s2, wind, ..phytomer_sim::site::Site::default() }
    }
}

impl Wind {
    /// The wind as plants feel it.
    pub fn felt(&self) -> SimWind {
        SimWind { speed: self.speed_m_s, towards: self.towards_deg.to_radians() }
    }
}
