//! Many small parts that one organ stands for: the needles of a piece of shoot, and the flowers or fruits of a node.
//!
//! A needle of a fir, and a berry among those of a coffee's node, would each cost a component; a species file states
//! one organ for all of them, of needles with the area of all (`area_m2`). From near they are drawn in nature's
//! numbers: needles as broad as that area lets them be; flowers and fruits fill the length and the width that are
//! stated. Absent: triangles (`phytomer_meshes`).

use super::head::Flower;
use crate::FormName;

/// The needles of a piece of shoot.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "files", serde(deny_unknown_fields, default))]
pub struct Brush {
    /// Needles, in [2, 300].
    pub needles: u16,
    /// How many stand in one bundle, in [1, 8]: two in many pines.
    pub bundle: u8,
    /// The share of the length along which they stand, in [0, 1]; 0: a rosette on a short shoot.
    pub shoot: f32,
    /// The angle between the shoot and its first needles, degrees, in [5, 120].
    pub first_deg: f32,
    /// The same of its last needles.
    pub last_deg: f32,
    /// How far needles are turned into one plane to the left and the right, in [0, 1]: a fir's in the shade.
    pub combed: f32,
    /// The angle through which a needle bends towards the tip of the shoot, degrees, in [−90, 90].
    pub bend_deg: f32,
}

impl Default for Brush {
    fn default() -> Self {
        Self { needles: 40, bundle: 1, shoot: 0.0, first_deg: 85.0, last_deg: 12.0, combed: 0.0, bend_deg: 10.0 }
    }
}

/// Flowers or fruits that stand together at a node.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "files", serde(deny_unknown_fields, default))]
pub struct Cluster {
    /// How many, in [2, 240].
    pub count: u8,
    /// What each of them is: a form of the library.
    pub form: FormName,
    /// What each of them is, where it is a flower of its own settings, in place of `form`.
    #[cfg_attr(feature = "files", serde(skip_serializing_if = "Option::is_none"))]
    pub flower: Option<Flower>,
    /// The share of the length that is a stalk below each of them, in [0, 0.9].
    pub stalk: f32,
    /// The width of one over its length without the stalk, in [0.05, 4].
    pub width: f32,
    /// The angle between the axis and the outermost, degrees, in [5, 170].
    pub spread_deg: f32,
    /// The share of the length at which the middle is around which they stand, in [0, 0.8]: 0, a node that bears them;
    /// above it they fill an ellipsoid, as the fruits of a bunch.
    #[cfg_attr(feature = "files", serde(skip_serializing_if = "is_at_the_node"))]
    pub middle: f32,
}

/// Whether the parts of a cluster stand at its node; left out of files then.
#[cfg(feature = "files")]
fn is_at_the_node(middle: &f32) -> bool {
    *middle == 0.0
}

impl Default for Cluster {
    fn default() -> Self {
        let form = FormName::Berry;
        Self { count: 8, form, flower: None, stalk: 0.4, width: 1.0, spread_deg: 75.0, middle: 0.0 }
    }
}
