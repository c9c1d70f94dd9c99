//! A member: one of the plants of each plot, with its species, its place and its sowing.

use phytomer_law::fault::{Fault, Path};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One of the plants of each plot.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Member {
    /// The species of the plant: a shipped species by its name, or a species file by its path. The scenario's species
    /// if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1))]
    pub species: Option<String>,
    /// The place of the plant, metres from the place of its plot: two numbers on level ground, or three. The place of
    /// the plot if not given.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(min = 2, max = 3), inner(range(min = -1e5, max = 1e5)))]
    pub at_m: Vec<f64>,
    /// The tick of the plot at which the plant is sown and has the age 0. Tick 0 if not given.
    #[serde(default, skip_serializing_if = "is_first")]
    #[schemars(range(min = 0, max = 65_534))]
    pub sown: u32,
    /// The number of another member of the list, from 0, of which this one is the successor: an event with the
    /// operation `replanting` plants it where the other one is dead, was taken or did not germinate.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 65_534))]
    pub replaces: Option<u32>,
    /// Whether the plant is a guard: it grows and is recorded, and `summary` leaves it out.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub guard: bool,
}

fn is_first(sown: &u32) -> bool {
    *sown == 0
}

impl Member {
    /// The place of the plant from the place of its plot, [x, y, z] in metres.
    pub fn place(&self) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.at_m.get(axis).copied().unwrap_or(0.0))
    }
}

/// What is sown when the run has ended.
pub(super) fn too_late(path: &Path, who: &str, sown: u32, until: u32) -> Fault {
    let problem = format!("{who} sown at tick {sown}, and the run ends at tick {until}");
    Fault::new(path, problem, format!("a tick in [0, {}]", until.saturating_sub(1)))
}
