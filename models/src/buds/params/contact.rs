//! What buds do where they meet an obstacle or the ground, as a species states it.
//!
//! A scenario says what is solid, and whether shoots meet the stems of plants; the species says how far a bud feels and
//! how it answers. Absent: the shapes (`crate::shapes`), and how a shoot finds its way past them
//! (`phytomer_sim::site::way`).

use crate::law::Constant;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a bud does where it meets something solid: an obstacle that blocks, the ground, or the stem of a plant.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Contact {
    /// What it does. It turns along the surface if not given.
    pub answer: Answer,
    /// How far ahead it feels, metres: the length of a cone along its heading. 0 if not given: a bud then answers what
    /// its next internode would enter.
    pub reach_m: Constant,
    /// The angle between the axis of the cone and its side, degrees; 30 if not given.
    pub half_angle_deg: Constant,
    /// For `answer = "fasten"`: the distance from the surface at which shoots lie, metres. 5 mm if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cling_m: Option<Constant>,
    /// For `answer = "fasten"`: the greatest distance from the surface at which a shoot holds to it, metres. 5 cm if
    /// not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hold_m: Option<Constant>,
    /// For `answer = "fasten"`: the least diameter of the wood of other plants to which a shoot holds, centimetres. 1
    /// if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub support_cm: Option<Constant>,
}

/// What a bud does where it meets something solid.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    /// It pauses as long as it feels it.
    Pause,
    /// It dies; the cause is `obstructed`.
    Die,
    /// Its internodes turn along the surface.
    #[default]
    Deflect,
    /// A climber: it turns along the surface too, and once it is near enough it holds to it.
    Fasten,
}

impl Default for Contact {
    fn default() -> Self {
        Self {
            answer: Answer::default(),
            reach_m: Constant::Number(0.0),
            half_angle_deg: Constant::Number(30.0),
            cling_m: None,
            hold_m: None,
            support_cm: None,
        }
    }
}
