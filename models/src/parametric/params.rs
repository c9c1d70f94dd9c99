//! The parameters of a parametric tree, by the names of Weber & Penn 1995 (appendix).
//!
//! Keys that begin with a capital or with the number of a level are the paper's own: `Shape`, `0SegSplits`,
//! `1DownAngleV`. Small keys (`children`, `growth`, `season`, `leaf_colour`, `bark`, `quality`, `sway`) are additions
//! of this program. Lengths are in metres and angles in degrees, as in the paper. NAME ± NAMEV is drawn uniformly
//! between NAME − NAMEV and NAME + NAMEV; the paper does not say by which distribution. Absent: how the keys of all
//! levels stand in one table (`keys`), and what the parameters do (`equations` and its neighbours).

use super::looks::LeafShape;
use crate::buds::params::{BarkChoice, LeafChoice};
use crate::law::{Constant, Law, Quantity};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A tree of stems and leaves.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    /// What holds for the whole tree. In a box, as the levels are, so that the parameters of other models, which share
    /// an enum with these, do not take their room.
    pub whole: Box<Whole>,
    /// Level 0: the trunk and its clones; keys that begin with 0.
    pub trunk: Box<Trunk>,
    /// Levels 1 to 3; keys that begin with 1, 2 and 3. Stems of later levels have the parameters of level 3.
    pub branches: Box<[Branches; 3]>,
}

/// The parameters of the whole tree.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "PascalCase", deny_unknown_fields)]
pub struct Whole {
    /// The form of the crown, which makes branches longer or shorter by their height: 0 conical, 1 spherical, 2
    /// hemispherical, 3 cylindrical, 4 tapered cylindrical, 5 flame, 6 inverse conical, 7 tend flame, 8 the pruning
    /// envelope.
    #[schemars(extend("maximum" = 8))]
    pub shape: Quantity,
    /// The share of the tree's size below which no branch stands.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub base_size: Constant,
    /// The size of the tree, metres.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 1000))]
    pub scale: Constant,
    /// The variation of the size, metres. A size under a tenth of `Scale` is drawn again.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 1000))]
    pub scale_v: Constant,
    /// 1 in every species of the paper; no equation of it uses the number, so that another is a fault.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub z_scale: Constant,
    /// 0 in every species of the paper; no equation of it uses the number, so that another is a fault.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub z_scale_v: Constant,
    /// The number of levels of stems, the trunk among them. Leaves stand on the stems of the last.
    #[schemars(extend("minimum" = 1, "maximum" = 8))]
    pub levels: Quantity,
    /// The radius at the base of the trunk over its length.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 1))]
    pub ratio: Constant,
    /// The power of the ratio of lengths by which a branch is thinner than its parent.
    #[serde(default = "one")]
    #[schemars(extend("minimum" = 0, "maximum" = 10))]
    pub ratio_power: Constant,
    /// The number of ridges around the trunk.
    #[serde(default = "none")]
    #[schemars(extend("maximum" = 64))]
    pub lobes: Quantity,
    /// The height of the ridges, as a share of the radius.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub lobe_depth: Constant,
    /// By how much the trunk is wider at its base, as a share of the radius.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 100))]
    pub flare: Constant,
    /// The number of leaves on a stem, at most; below 0 they stand in a fan at its end.
    #[serde(default)]
    #[schemars(extend("minimum" = -10_000, "maximum" = 10_000))]
    pub leaves: Constant,
    /// The form of leaves: 0 oval, 1 triangle, 2 three-lobe oak, 3 three-lobe maple, 4 five-lobe maple, 5 three
    /// leaflets; or a form of the library by its name (`phytomer list forms`).
    #[serde(default)]
    pub leaf_shape: LeafShape,
    /// The length of a leaf, metres.
    #[serde(default = "leaf_scale")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 100))]
    pub leaf_scale: Constant,
    /// The width of a leaf over its length.
    #[serde(default = "one")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 100))]
    pub leaf_scale_x: Constant,
    /// By how much leaves turn their upper side outwards and upwards, from 0 to 1 (§4.9); the paper's appendix lists no
    /// such key.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub leaf_bend: Constant,
    /// The tendency of stems of level 2 and above to turn upwards; below 0 they droop.
    #[serde(default)]
    #[schemars(extend("minimum" = -100, "maximum" = 100))]
    pub attraction_up: Constant,
    /// From 0, no pruning, to 1: every stem ends within the envelope.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub prune_ratio: Constant,
    /// The greatest radius of the envelope over the size of the tree.
    #[serde(default = "half")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 10))]
    pub prune_width: Constant,
    /// The height of the greatest radius above the bottom of the envelope, as a share of the envelope's height; above 0
    /// and below 1.
    #[serde(default = "half")]
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub prune_width_peak: Constant,
    /// The curvature of the envelope below its greatest radius: 1 a cone, 0.5 rounded, 2 hollow.
    #[serde(default = "half")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 10))]
    pub prune_power_low: Constant,
    /// The curvature of the envelope above its greatest radius.
    #[serde(default = "half")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 10))]
    pub prune_power_high: Constant,
    /// Where the branches of the trunk stand: `whole` counts `1Branches` over the whole trunk and leaves out those of
    /// its bare part; `above_base` places them all above it. Not of the paper.
    #[serde(default, rename = "children", skip_serializing_if = "Children::is_whole")]
    pub children: Children,
    /// More or fewer leaves, each as much smaller or larger (§4.5, where the program that draws states it): 1 as
    /// stated.
    #[serde(default = "one", rename = "quality", skip_serializing_if = "is_one")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 100))]
    pub quality: Constant,
    /// The tree by its age; left out: it stands whole from age 1 on. Not of the paper.
    #[serde(default, rename = "growth", skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Growing")]
    pub growth: Option<Growing>,
    /// When leaves come and fall; left out: they stay. Not of the paper.
    #[serde(default, rename = "season", skip_serializing_if = "Option::is_none")]
    #[schemars(with = "LeafSeason")]
    pub season: Option<LeafSeason>,
    /// The rate at which stems sway: by length over radius, or as the paper prints it (§4.7).
    #[serde(default, rename = "sway", skip_serializing_if = "Sway::is_by_length_over_radius")]
    pub sway: Sway,
    /// The colour of leaves: `"#rrggbb"`, or colours by age and season. Left out: by their form.
    #[serde(default, rename = "leaf_colour", skip_serializing_if = "Option::is_none")]
    #[schemars(with = "LeafChoice")]
    pub leaf_colour: Option<LeafChoice>,
    /// The colour of bark: `"#rrggbb"`, or colours by age.
    #[serde(default, rename = "bark", skip_serializing_if = "Option::is_none")]
    #[schemars(with = "BarkChoice")]
    pub bark: Option<BarkChoice>,
}

/// Where the children of the trunk stand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Children {
    /// Counted over the whole trunk, and left out in its bare part.
    #[default]
    Whole,
    /// All of them above the bare part.
    AboveBase,
}

impl Children {
    fn is_whole(&self) -> bool {
        *self == Self::Whole
    }
}

/// The rate of a stem's sway.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Sway {
    /// Length over radius: a slender stem sways fast, and the trunk of the quaking aspen once in 1.4 s.
    #[default]
    LengthOverRadius,
    /// Radius over length, as the paper prints it: that trunk sways once in an hour and three quarters.
    Printed,
}

impl Sway {
    fn is_by_length_over_radius(&self) -> bool {
        *self == Self::LengthOverRadius
    }
}

/// The tree by its age.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Growing {
    /// The size of the tree over its full size, in (0, 1]: a law of `age`, which the lengths and radii of all stems
    /// follow. Leaves keep their size.
    pub scale: Law,
    /// How many levels of stems stand, of `Levels` at most: a law of `age` that never falls, rounded down. Leaves stand
    /// when all levels do. Left out: all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Law")]
    pub levels: Option<Law>,
}

/// When leaves come and fall. Each year has leaves of its own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LeafSeason {
    /// The ticks of a year.
    #[schemars(extend("minimum" = 2))]
    pub ticks_per_year: Quantity,
    /// The tick of the year, from 0, at which leaves appear.
    pub leaf_out: Quantity,
    /// The later tick of the year at which leaves fall.
    pub leaf_fall: Quantity,
}

/// The parameters of level 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "PascalCase", deny_unknown_fields)]
pub struct Trunk {
    /// A factor of the radius of the trunk.
    #[serde(default = "one")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 100))]
    pub scale: Constant,
    /// Its variation, below `0Scale`.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 100))]
    pub scale_v: Constant,
    /// How many clones leave the trunk at the end of its first segment; where it is not 0, in place of `0SegSplits`.
    #[serde(default = "none")]
    #[schemars(extend("maximum" = 20))]
    pub base_splits: Quantity,
    /// The length of the trunk over the size of the tree.
    #[serde(default = "one")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 10))]
    pub length: Constant,
    /// Its variation, at most `0Length`.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 10))]
    pub length_v: Constant,
    /// From 0, a cylinder, to 1, a cone; 2 ends in half a sphere, 3 is a chain of spheres.
    #[serde(default = "one")]
    #[schemars(extend("minimum" = 0, "maximum" = 3))]
    pub taper: Constant,
    /// How many clones leave a stem at the end of each segment but the last, in the mean.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 20))]
    pub seg_splits: Constant,
    /// How far a stem and its clones lean from the vertical after a split, degrees.
    #[serde(default)]
    #[schemars(extend("minimum" = -180, "maximum" = 180))]
    pub split_angle: Constant,
    /// Its variation, degrees.
    #[serde(default)]
    #[schemars(extend("minimum" = -180, "maximum" = 180))]
    pub split_angle_v: Constant,
    /// The number of segments.
    #[schemars(extend("minimum" = 1, "maximum" = 100))]
    pub curve_res: Quantity,
    /// The angle by which a stem curves over its length, or over its first half where `0CurveBack` is not 0, degrees.
    /// Above 0 it curves away from its upper side.
    #[serde(default)]
    #[schemars(extend("minimum" = -3600, "maximum" = 3600))]
    pub curve: Constant,
    /// The angle over its second half, degrees.
    #[serde(default)]
    #[schemars(extend("minimum" = -3600, "maximum" = 3600))]
    pub curve_back: Constant,
    /// The variation of the angle over its length, degrees; each segment draws its share. Below 0 the stem is a helix
    /// of which each segment makes this angle with the axis.
    #[serde(default)]
    #[schemars(extend("exclusiveMinimum" = -90, "maximum" = 3600))]
    pub curve_v: Constant,
}

/// The parameters of a level above 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "PascalCase", deny_unknown_fields, default)]
pub struct Branches {
    /// The angle between a stem and its parent, degrees.
    #[schemars(extend("minimum" = -180, "maximum" = 180))]
    pub down_angle: Constant,
    /// Its variation, degrees. Below 0 nothing is drawn: the angle is greater by its amount at the base of the crown,
    /// and smaller by 0.6 of it at the top.
    #[schemars(extend("minimum" = -180, "maximum" = 180))]
    pub down_angle_v: Constant,
    /// From one stem to the next around their parent, degrees. Below 0 they stand on two sides of the parent by turns,
    /// each at 180 + the angle from its upper side. In a fan: the angle over which it is spread.
    #[schemars(extend("minimum" = -360, "maximum" = 360))]
    pub rotate: Constant,
    /// Its variation, degrees.
    #[schemars(extend("minimum" = -360, "maximum" = 360))]
    pub rotate_v: Constant,
    /// How many stems a parent bears, at most; below 0 they stand in a fan at its end.
    #[schemars(extend("minimum" = -2000, "maximum" = 2000))]
    pub branches: Constant,
    /// The greatest length over that of the parent.
    #[schemars(extend("minimum" = 0, "maximum" = 10))]
    pub length: Constant,
    /// Its variation, at most the length.
    #[schemars(extend("minimum" = 0, "maximum" = 10))]
    pub length_v: Constant,
    /// From 0, a cylinder, to 1, a cone; 2 ends in half a sphere, 3 is a chain of spheres. Left out: 1.
    #[schemars(extend("minimum" = 0, "maximum" = 3))]
    pub taper: Constant,
    /// How many clones leave a stem at the end of each segment but the last, in the mean.
    #[schemars(extend("minimum" = 0, "maximum" = 20))]
    pub seg_splits: Constant,
    /// How far a stem and its clones lean from the vertical after a split, degrees.
    #[schemars(extend("minimum" = -180, "maximum" = 180))]
    pub split_angle: Constant,
    /// Its variation, degrees.
    #[schemars(extend("minimum" = -180, "maximum" = 180))]
    pub split_angle_v: Constant,
    /// The number of segments. Left out: 1.
    #[schemars(extend("minimum" = 1, "maximum" = 100))]
    pub curve_res: Quantity,
    /// The angle by which a stem curves over its length, or over its first half where the `CurveBack` of its level is
    /// not 0, degrees. Above 0 it curves away from its upper side.
    #[schemars(extend("minimum" = -3600, "maximum" = 3600))]
    pub curve: Constant,
    /// The angle over its second half, degrees.
    #[schemars(extend("minimum" = -3600, "maximum" = 3600))]
    pub curve_back: Constant,
    /// The variation of the angle over its length, degrees; each segment draws its share. Below 0 the stem is a helix
    /// of which each segment makes this angle with the axis.
    #[schemars(extend("exclusiveMinimum" = -90, "maximum" = 3600))]
    pub curve_v: Constant,
}

impl Default for Branches {
    /// A level without stems: straight, of one segment, a cone.
    fn default() -> Self {
        let none = Constant::default;
        Self {
            down_angle: none(),
            down_angle_v: none(),
            rotate: none(),
            rotate_v: none(),
            branches: none(),
            length: none(),
            length_v: none(),
            taper: one(),
            seg_splits: none(),
            split_angle: none(),
            split_angle_v: none(),
            curve_res: Quantity::Number(1),
            curve: none(),
            curve_back: none(),
            curve_v: none(),
        }
    }
}

fn none() -> Quantity {
    Quantity::Number(0)
}

fn one() -> Constant {
    Constant::Number(1.0)
}

fn half() -> Constant {
    Constant::Number(0.5)
}

fn leaf_scale() -> Constant {
    Constant::Number(0.2)
}

fn is_one(number: &Constant) -> bool {
    *number == one()
}

fn is_zero(number: &Constant) -> bool {
    *number == Constant::default()
}
