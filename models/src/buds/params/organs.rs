//! Leaves, flowers and fruits (de Reffye 1988 §5): how many, how long they live, how large they are.
//!
//! Lateral organs stand in the axils of their node, terminal flowers at the end of their axis. Absent: how organs are
//! drawn; a species names the form alone.

use super::colour::{FlowerChoice, FruitChoice, LeafChoice};
use super::looks::{FormChoice, KindName};
use super::near;
use crate::law::{Constant, Count, Law, Quantity, Variate};
use phytomer_looks::{FormName, Near};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The season of leaf fall.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Season {
    /// The ticks of a year. They are not drawn: the year is the calendar's, and the same for every leaf of a plant.
    pub ticks_per_year: Quantity,
    /// The tick of the year, from 0, at whose beginning a leaf falls that appeared before it; drawn once a leaf, with
    /// its laws evaluated at the node, so that leaves may fall one after another. Either this or `leaf_fall_when` is
    /// given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Count")]
    pub leaf_fall: Option<Count>,
    /// By the date: leaves fall at the first tick after their birth at which this law is not 0, such as `{ expression
    /// = "date >= 305 and degree_days > 1500" }`. It depends on the age of the plant and on its date alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Law")]
    pub leaf_fall_when: Option<Law>,
}

/// How organs turn in the vertical plane in which they stand: leaves that sink as they age, fruits that hang,
/// inflorescences that stand upright.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OrganTrend {
    /// The angle to the upward vertical that the organ turns to, degrees in [0, 180]: 0 upright, 180 hanging.
    #[schemars(extend("minimum" = 0, "maximum" = 180))]
    pub inclination_deg: Constant,
    /// The share of the angle from its insertion to that direction that an organ has turned, in [0, 1]: a law of its
    /// own age, which is `dimension` and `cycle` here, in ticks; 1 leaves nothing of the insertion but its azimuth.
    pub share: Law,
}

/// Where the upper side of a leaf faces.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Facing {
    /// Towards the tip of its axis, as it was laid down.
    #[default]
    Axis,
    /// Towards the sky: stalks twist, as on plagiotropic axes.
    Sky,
}

impl Facing {
    fn is_axis(&self) -> bool {
        *self == Self::Axis
    }
}

/// The leaves of a node.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Leaf {
    /// Leaves a node.
    pub per_node: Count,
    /// The life length of a leaf, ticks; left out: as long as its branch.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub life: Option<Count>,
    /// Length of the leaf with its stalk, cm.
    pub length_cm: Variate,
    /// Width of the blade, cm.
    pub width_cm: Variate,
    /// Area of one side with the stalk, as a share of length × width, in [0, 20]; above 1 where many parts lie one over
    /// another. Left out: that of its form. Meshes have the area that is stated: simple blades are drawn as much wider
    /// or narrower, compound ones in their leaflets.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0, "maximum" = 20))]
    pub area_share: Option<Variate>,
    /// The angle between the axis and the leaf, degrees.
    pub insertion_deg: Variate,
    /// How a leaf turns as it ages; left out: it keeps its insertion.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trend: Option<OrganTrend>,
    /// Where its upper side faces: `axis`, or `sky` where stalks twist.
    #[serde(skip_serializing_if = "Facing::is_axis")]
    pub facing: Facing,
    /// The form that it is drawn with: one of the library (`phytomer list forms`), or `{ mesh = "file.ply" }`.
    pub form: FormChoice,
    /// How it is drawn from near, at detail 1 to 3 of a mesh or a picture: a `blade`, a `flower`, a `capitulum`, a
    /// `brush` of needles or a `cluster`. Left out: as the library has its form.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "near::shortest")]
    pub near: Option<Near>,
    /// What it is: `leaf`, or another kind that stands as a leaf does: a leaflet, a bract, a scale, a part of a flower.
    #[serde(skip_serializing_if = "KindName::is_leaf")]
    pub kind: KindName,
    /// The share of its full length and width, in [0, 1]: a law in which `dimension` and `cycle` are its own age in
    /// ticks. Left out: full-grown at its birth.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expansion: Option<Law>,
    /// Its colour: `"#rrggbb"`, or colours by its age and season. Left out: by kind and form.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colour: Option<LeafChoice>,
}

impl Default for Leaf {
    fn default() -> Self {
        Self {
            per_node: Count::from(1),
            life: None,
            length_cm: Variate::from(5.0),
            width_cm: Variate::from(2.5),
            area_share: None,
            insertion_deg: Variate::from(60.0),
            trend: None,
            facing: Facing::Axis,
            form: FormName::Elliptic.into(),
            near: None,
            kind: KindName::Leaf,
            expansion: None,
            colour: None,
        }
    }
}

/// Flowers, or inflorescences.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Flower {
    /// The probability that the apical bud becomes a flower at a clock step, which ends the axis. Tested after the
    /// pause. The flower stands on the last node of the axis; a bud without a node of its own ends without one.
    pub terminal: Law,
    /// The probability that a lateral flower opens, tested for each of the flowers of a node.
    pub lateral: Law,
    /// The lateral flowers that a node can bear.
    pub per_node: Count,
    /// The ticks from the appearance of a node to its lateral flowers.
    pub delay: Count,
    /// The life length of a flower, ticks.
    pub life: Count,
    /// The probability that a flower sets fruit at the end of its life.
    pub fruit_set: Law,
    /// Length, cm.
    pub length_cm: Variate,
    /// Width, cm.
    pub width_cm: Variate,
    /// The angle between the axis and a lateral flower, degrees.
    pub insertion_deg: Variate,
    /// How a flower turns as it ages; left out: it keeps its insertion.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trend: Option<OrganTrend>,
    /// The form that it is drawn with: one of the library (`phytomer list forms`), or `{ mesh = "file.ply" }`.
    pub form: FormChoice,
    /// How it is drawn from near, at detail 1 to 3 of a mesh or a picture: a `blade`, a `flower`, a `capitulum`, a
    /// `brush` of needles or a `cluster`. Left out: as the library has its form.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "near::shortest")]
    pub near: Option<Near>,
    /// What it is: `flower`, or an inflorescence or a spikelet.
    #[serde(skip_serializing_if = "KindName::is_flower")]
    pub kind: KindName,
    /// The share of its full length and width, in [0, 1]: a law in which `dimension` and `cycle` are its own age in
    /// ticks. Left out: full-grown at its birth.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expansion: Option<Law>,
    /// Its colour: `"#rrggbb"`, or colours by its age. Left out: by kind and form.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colour: Option<FlowerChoice>,
}

impl Default for Flower {
    fn default() -> Self {
        Self {
            terminal: Law::default(),
            lateral: Law::default(),
            per_node: Count::from(1),
            delay: Count::from(0),
            life: Count::from(1),
            fruit_set: Law::default(),
            length_cm: Variate::from(1.0),
            width_cm: Variate::from(1.0),
            insertion_deg: Variate::from(45.0),
            trend: None,
            form: FormName::Corolla.into(),
            near: None,
            kind: KindName::Flower,
            expansion: None,
            colour: None,
        }
    }
}

/// Fruits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Fruit {
    /// The life length of a fruit, ticks.
    pub life: Count,
    /// Length, cm.
    pub length_cm: Variate,
    /// Width, cm.
    pub width_cm: Variate,
    /// How a fruit turns as it ages, from the insertion of its flower; left out: it keeps it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trend: Option<OrganTrend>,
    /// The form that it is drawn with: one of the library (`phytomer list forms`), or `{ mesh = "file.ply" }`.
    pub form: FormChoice,
    /// How it is drawn from near, at detail 1 to 3 of a mesh or a picture: a `blade`, a `flower`, a `capitulum`, a
    /// `brush` of needles or a `cluster`. Left out: as the library has its form.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "near::shortest")]
    pub near: Option<Near>,
    /// What it is: `fruit`, or an infructescence or a strobilus.
    #[serde(skip_serializing_if = "KindName::is_fruit")]
    pub kind: KindName,
    /// The share of its full length and width, in [0, 1]: a law in which `dimension` and `cycle` are its own age in
    /// ticks. Left out: full-grown at its birth.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expansion: Option<Law>,
    /// Its colour: `"#rrggbb"`, or colours by its age. Left out: by kind and form.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colour: Option<FruitChoice>,
}

impl Default for Fruit {
    fn default() -> Self {
        Self {
            life: Count::from(1),
            length_cm: Variate::from(1.0),
            width_cm: Variate::from(1.0),
            trend: None,
            form: FormName::Berry.into(),
            near: None,
            kind: KindName::Fruit,
            expansion: None,
            colour: None,
        }
    }
}
