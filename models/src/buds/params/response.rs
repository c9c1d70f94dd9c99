//! Responses of the buds to what the site and its seasons bring, such as nitrogen (de Reffye 1988 §7: "use of
//! fertilizers").
//!
//! A response is a law of one variable and acts on laws of the buds; it says at which value of the variable these laws
//! were measured. Several responses act in the order in which they are stated. Absent: how they join the laws
//! (`compile::change`), and pests, which a scenario states for its plants.

use crate::law::Law;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// How buds respond to a variable.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Response {
    /// What responds.
    #[schemars(length(min = 1))]
    pub acts_on: BTreeSet<Target>,
    /// The response as a law of one variable, for example `{ mitscherlich = { over = "nitrogen", rate = 0.02 } }`. On
    /// `death` and `pause` it is a hazard, a probability of its own at each clock step; on all else only its ratio to
    /// its value at `reference` counts.
    pub law: Law,
    /// The value of the variable for which the laws of the species hold, at which the response changes nothing.
    pub reference: f64,
    /// The orders whose axes respond, from 1. All if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "BTreeSet<u8>", length(min = 1))]
    pub orders: Option<BTreeSet<u8>>,
}

/// What responds to a variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Target {
    /// The death of apical buds: d = q − q(reference) joins their probability p as p + d − p d.
    Death,
    /// The pauses of apical buds, which a hazard joins in the same way.
    Pause,
    /// The probability that an axillary bud ramifies, times m.
    Ramification,
    /// The probabilities that an apex becomes a flower and that a lateral flower opens, times m.
    Flowering,
    /// The probability that a flower sets fruit, times m.
    FruitSet,
    /// The nodes of a growth unit: ⌊n m + u⌋ with u uniform over [0, 1).
    Nodes,
    /// The lengths of internodes, times m.
    InternodeLength,
    /// The areas of leaves, times m: their lengths and widths times its square root.
    LeafArea,
}

impl Target {
    /// Everything that responds, in the order in which responses are compiled.
    pub const ALL: [Self; 8] = [
        Self::Death,
        Self::Pause,
        Self::Ramification,
        Self::Flowering,
        Self::FruitSet,
        Self::Nodes,
        Self::InternodeLength,
        Self::LeafArea,
    ];

    /// Whether the law of a response to it is a hazard, and not a ratio.
    pub const fn is_hazard(self) -> bool {
        matches!(self, Self::Death | Self::Pause)
    }
}
