//! Geometry at rest (de Reffye 1988 §4): internodes, phyllotaxis and trends, in the units in which people state them.
//!
//! People type centimetres, millimetres and degrees; compilation makes metres and radians of them. Absent: the pose,
//! which is the same for every model (`phytomer_sim::pose`).

use super::colour::BarkChoice;
use super::looks::{ByState, FormChoice, KindName};
use super::near;
use crate::law::{Constant, Count, Law, Quantity, Variate};
use phytomer_looks::NearStem;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The internodes of an order.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Internode {
    /// The length of an internode, cm.
    pub length_cm: Variate,
    /// The diameter of an internode at its birth, mm.
    pub diameter_mm: Variate,
    /// What an internode has added to its diameter, mm: a law in which `age` is the plant's age, `dimension` and
    /// `cycle` the internode's own, in ticks, and the state that in which its axis started.
    pub thickening_mm: Law,
    /// A cylinder has one diameter; a cone narrows to the diameter of the next internode of its axis; a blade is plane,
    /// as wide as its diameter and of its own thickness, and its tip is as wide as the next internode. One for all
    /// axes, or one for each state in which an axis can start.
    pub shape: ByState<ShapeName>,
    /// The thickness of internodes that are blades, mm, in [0.001, 1000], for their stiffness, volume and mass; left
    /// out: 0.3, assumed, as petals and leaf blades have 0.1 to 0.5. Other shapes have none.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0.001, "maximum" = 1000))]
    pub thickness_mm: Option<Constant>,
    /// What its internodes are: `internode` where they are those of a stem, else a kind whose name ends in `internode`.
    /// One for all axes, or one for each state in which an axis can start.
    #[serde(skip_serializing_if = "ByState::is_plain_kind")]
    pub kind: ByState<KindName>,
    /// The sides of the tubes that they are drawn as, from 3 to 64: 6 for the hexagonal cones of 1988; left out: as
    /// many as the mesh has.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sides: Option<Quantity>,
    /// A form that they are drawn with instead of tubes, as long as the internode and as wide as its diameter.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub form: Option<ByState<FormChoice>>,
    /// Their colour: `"#rrggbb"`, or colours by the age of the wood. One for all axes, or one for each state in which
    /// an axis can start. Left out: by kind.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colour: Option<ByState<BarkChoice>>,
    /// How they are drawn from near, at detail 1 to 3 of a mesh or a picture: swollen nodes, leaf bases, an urn, lobes
    /// of a sepal. One for all axes, or one for each state in which an axis can start. Left out: as tubes and plain
    /// blades.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "near::shortest")]
    pub near: Option<ByState<NearStem>>,
}

impl Default for Internode {
    fn default() -> Self {
        Self {
            length_cm: Variate::from(1.0),
            diameter_mm: Variate::from(1.0),
            thickening_mm: Law::default(),
            shape: ByState::All(ShapeName::Cone),
            thickness_mm: None,
            kind: ByState::All(KindName::Internode),
            sides: None,
            form: None,
            colour: None,
            near: None,
        }
    }
}

/// The shape of internodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ShapeName {
    /// One diameter.
    Cylinder,
    /// A truncated cone.
    Cone,
    /// A plane blade: a stretch of a petal, a sepal or a leaf that is grown as an axis.
    Blade,
}

/// Phyllotaxis: the divergence from one node to the next. The positions of one node are spread evenly around it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Phyllotaxis {
    /// `"distichous"` (180°), `"opposite-decussate"` (90°), `"whorled"` (half the angle between two positions of a
    /// node), `"spiral"` (the golden angle), or a Fibonacci fraction of a turn such as `"2/5"` or `"3/8"`.
    Named(String),
    /// The divergence from one node to the next, degrees, a number or a random variable.
    Degrees(Variate),
    /// Divergence as a random variable, and the azimuth of an axis's first leaf.
    Divergence(Divergence),
    /// A name as above, and where it comes from.
    Sourced(NamedPhyllotaxis),
}

impl Default for Phyllotaxis {
    fn default() -> Self {
        Self::Named("spiral".to_owned())
    }
}

/// Divergence in full.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Divergence {
    /// The divergence from one node to the next, degrees.
    pub divergence_deg: Variate,
    /// The azimuth of an axis's first leaf from the upper side of the axis, degrees; drawn once an axis, at its birth.
    /// Left out: 90, to the side.
    #[serde(default = "to_the_side")]
    #[schemars(extend("minimum" = -360, "maximum" = 360))]
    pub first_deg: Variate,
}

/// A named phyllotaxis, and where it comes from.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct NamedPhyllotaxis {
    /// `"distichous"`, `"opposite-decussate"`, `"whorled"`, `"spiral"`, or a Fibonacci fraction of a turn such as
    /// `"2/5"`: the same as the name alone.
    pub named: String,
    /// Where the name comes from: a reference, a data set, an observation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String")]
    pub source: Option<String>,
    /// True where the name is a guess and not an observation.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub assumed: bool,
}

fn to_the_side() -> Variate {
    Variate::from(90.0)
}

/// The development trend of an axis (de Reffye 1988 §4, Fig. 15).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Trend {
    /// One trend for the whole axis.
    Simple(Orientation),
    /// A trend in full.
    Tended(Tended),
    /// A composite trend: phases along the axis, each from a rank on.
    Composite(Vec<Phase>),
    /// A trend for each state.
    ByState(StateTrends),
}

impl Default for Trend {
    fn default() -> Self {
        Self::Simple(Orientation::Straight)
    }
}

/// A trend by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Orientation {
    /// Towards the vertical, a tenth of the way an internode.
    Orthotropic,
    /// Towards the horizontal, a tenth of the way an internode.
    Plagiotropic,
    /// The direction of insertion is kept.
    Straight,
}

/// A trend in full.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Tended {
    /// The angle to the upward vertical that the axis tends to, degrees: 0 orthotropic, 90 plagiotropic, 180 hanging.
    /// Drawn once an axis, at its birth.
    #[schemars(extend("minimum" = 0, "maximum" = 180))]
    pub inclination_deg: Variate,
    /// The share of the angle that is left which each internode turns, in [0, 1]: after n internodes (1 − share)ⁿ of
    /// the first angle is left. Drawn once an axis, at its birth.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub share: Variate,
}

/// A trend for each state in which the axis may be: what it makes after a passage follows that of its new state.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StateTrends {
    /// The trend of each of the species's states, by its name.
    #[schemars(extend("minProperties" = 1))]
    pub by_state: BTreeMap<String, Tended>,
}

/// One phase of a composite trend.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Phase {
    /// The node rank along the axis from which the phase holds, drawn once an axis, at its birth; the first phase
    /// starts at 1. Of the phases that have begun the one stated last holds, so a phase that begins no earlier than the
    /// next one is passed over.
    pub from_rank: Count,
    /// The angle to the upward vertical that the axis tends to, degrees; drawn once an axis, at its birth.
    #[schemars(extend("minimum" = 0, "maximum" = 180))]
    pub inclination_deg: Variate,
    /// The share of the angle that is left which each internode turns, in [0, 1]: after n internodes (1 − share)ⁿ of
    /// the first angle is left. Drawn once an axis, at its birth.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub share: Variate,
}
