//! The ends of apices and what follows them: relays and reiteration (de Reffye 1988 §2), forks, and passages between
//! states.
//!
//! Forks are the dichotomy of Hallé, Oldeman & Tomlinson 1978 (Schoute's model). Passages between states are those of a
//! reference axis (Barczi et al. 2008, AMAPsim): an oriented automaton along the life of an axis. All of these are
//! optional; a species that states none of them grows as in 1988.

use crate::law::{Count, Law, Quantity, Variate};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How an apex ends other than by death or by flowering.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Apex {
    /// The growth units after which the apex ends; left out: it never ends of itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub units: Option<Count>,
    /// For how many ticks a branch lives on that has made all its growth units: a determinate branch keeps its leaves
    /// until it is shed whole. 0 if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub persists: Option<Count>,
    /// The equal axes, of its own order, into which an apex divides that has made all its growth units: 2 is a
    /// dichotomy. Left out: it does not divide.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fork: Option<Fork>,
}

/// An apex that divides.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fork {
    /// The axes into which it divides; at most 32.
    pub axes: Count,
    /// The angle between each of them and the axis that ended, degrees.
    pub insertion_deg: Variate,
}

/// An end of an apex.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ApexEnd {
    /// The mortality test.
    Death,
    /// A terminal flower.
    Flower,
    /// All its growth units were made.
    Completed,
}

/// Sympodial growth: relay axes of the same order, from the last node of an ended axis or from one below. Relay buds
/// are buds of their own beside the axillary ones; an axis that ends before it has a node of its own is not relayed. An
/// axis that passes into another state may be relayed too (`transition.relayed`), while its apex lives on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Relay {
    /// The ends that are relayed; empty: monopodial growth.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub on: Vec<ApexEnd>,
    /// The relay buds; at most 32.
    pub count: Count,
    /// The probability that a relay bud becomes an axis.
    pub probability: Law,
    /// How many nodes below the last one the relays stand, all on one node; drawn once a set of relays. Where the axis
    /// has no such node of its own there is no relay.
    pub below: Count,
    /// The ticks that a relay waits.
    pub delay: Count,
    /// The insertion angle of a relay, degrees; left out: that of the order.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub insertion_deg: Option<Variate>,
    /// The state in which a relay starts; left out: that in which the ended axis was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub state: Option<String>,
}

impl Default for Relay {
    fn default() -> Self {
        Self {
            on: Vec::new(),
            count: Count::from(1),
            probability: Law::from(1.0),
            below: Count::from(0),
            delay: Count::from(0),
            insertion_deg: None,
            state: None,
        }
    }
}

/// Traumatic reiteration: the dormant axillary buds of the node below a lost apex, released at the order of the bearing
/// axis instead of the next.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Traumatic {
    /// The probability that a dormant bud is released by the death of the apex above it.
    pub probability: Law,
    /// The ticks that it waits.
    pub delay: Count,
    /// The insertion angle of the released axis, degrees.
    pub insertion_deg: Variate,
    /// The state in which it starts; left out: that in which the lost apex was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub state: Option<String>,
}

impl Default for Traumatic {
    fn default() -> Self {
        Self { probability: Law::default(), delay: Count::from(0), insertion_deg: Variate::from(45.0), state: None }
    }
}

/// Adaptive reiteration: buds beside the standard axillary ones that make an axis of order 1, or of a given order.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Reiteration {
    /// The reiteration buds of a node; at most 32.
    pub buds: Count,
    /// The probability that a reiteration bud becomes an axis.
    pub probability: Law,
    /// The order of the new axis. It is not drawn: an order names a table of this file, and to pass from one kind of
    /// axis to another by chance is what `probability` and the states are for.
    pub order: Quantity,
    /// The ticks that it waits.
    pub delay: Count,
    /// The insertion angle of the new axis, degrees.
    pub insertion_deg: Variate,
    /// The state in which it starts; left out: the first, a young tree.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub state: Option<String>,
}

impl Default for Reiteration {
    fn default() -> Self {
        Self {
            buds: Count::from(0),
            probability: Law::default(),
            order: Quantity::from(1),
            delay: Count::from(0),
            insertion_deg: Variate::from(45.0),
            state: None,
        }
    }
}

/// A passage from one state to another.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Transition {
    /// The state before.
    pub from: String,
    /// The state after.
    pub to: String,
    /// The probability of the passage at a step at which the bud grew.
    pub probability: Law,
    /// Which relays of a set pass: the leader or the others. Left out: each.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sibling: Option<Sibling>,
    /// Whether the axis is relayed when it passes, as `relay` says, though its apex lives on: by apposition.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub relayed: bool,
}

/// A place among the relays of one set, which are equal at their birth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Sibling {
    /// The first of its set; an axis that is no relay leads as well.
    Leader,
    /// Each but the first.
    Others,
}
