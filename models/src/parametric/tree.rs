//! The parameters of a parametric tree, by the names of Weber & Penn 1995 (appendix), with their variations.
//!
//! A key is the paper's name in small letters, with its unit: `nCurveBack` is `curve_back_deg`. The number before a
//! name tells the table: 0 is `trunk`, 1 the first table of `branches`. A parameter with its variation, NAME ± NAMEV in
//! the paper, is drawn uniformly between NAME − NAMEV and NAME + NAMEV; the paper does not say by which distribution.
//! Absent: the use of the parameters (`equations`), and parameters of the paper that are not implemented.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::law::{Constant, Quantity};

/// A tree of stems: a trunk, which may split at its base, and branches on it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Tree {
    /// Shape: the form of the crown, which makes branches longer or shorter by their height.
    pub shape: Crown,
    /// BaseSize: the share of the tree's size below which no branch stands.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub base_size: Constant,
    /// Scale: the size of the tree, metres.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 1000))]
    pub scale_m: Constant,
    /// ScaleV: the variation of the size, metres; at most `scale_m`.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 1000))]
    pub scale_v_m: Constant,
    /// Ratio: the radius at the base of the trunk over its length.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 1))]
    pub ratio: Constant,
    /// RatioPower: the power of the ratio of lengths by which a branch is thinner than its parent.
    #[serde(default = "one")]
    #[schemars(extend("minimum" = 0, "maximum" = 10))]
    pub ratio_power: Constant,
    /// The stems of level 0: the trunk and its clones.
    pub trunk: Trunk,
    /// The stems of level 1, in one table; none leaves the trunk bare.
    #[serde(default)]
    #[schemars(length(max = 1))]
    pub branches: Vec<Branches>,
}

/// The forms of a crown, by the numbers of Shape (§4.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Crown {
    /// Shape 0.
    Conical,
    /// Shape 1.
    Spherical,
    /// Shape 2.
    Hemispherical,
    /// Shape 3.
    Cylindrical,
    /// Shape 4.
    TaperedCylindrical,
    /// Shape 5.
    Flame,
    /// Shape 6.
    InverseConical,
    /// Shape 7.
    TendFlame,
}

/// The stems of level 0: the trunk, and the clones into which it splits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Trunk {
    /// 0Length: the length of the trunk over the size of the tree.
    #[serde(default = "one")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 10))]
    pub length: Constant,
    /// 0LengthV: its variation; at most `length`.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 10))]
    pub length_v: Constant,
    /// 0Taper: from 0, a cylinder, to 1, a cone that ends in a point.
    #[serde(default = "one")]
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub taper: Constant,
    /// 0BaseSplits: how many clones leave the trunk at the end of its first segment.
    #[serde(default = "none")]
    #[schemars(extend("maximum" = 20))]
    pub base_splits: Quantity,
    /// 0SplitAngle: how far the trunk and its clones turn away from the first segment, degrees.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 180))]
    pub split_angle_deg: Constant,
    /// 0SplitAngleV: its variation, degrees.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 180))]
    pub split_angle_v_deg: Constant,
    /// 0CurveRes: how many segments the trunk has.
    #[schemars(extend("minimum" = 1, "maximum" = 100))]
    pub curve_res: Quantity,
    /// 0Curve: the angle by which the trunk curves over its length, or over its first half where `curve_back_deg` is
    /// not 0, degrees. Above 0 it curves away from its upper side.
    #[serde(default)]
    #[schemars(extend("minimum" = -3600, "maximum" = 3600))]
    pub curve_deg: Constant,
    /// 0CurveBack: the angle over its second half, degrees.
    #[serde(default)]
    #[schemars(extend("minimum" = -3600, "maximum" = 3600))]
    pub curve_back_deg: Constant,
    /// 0CurveV: the variation of the angle over its length, degrees; each segment draws its share.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 3600))]
    pub curve_v_deg: Constant,
}

/// The stems of one level above 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Branches {
    /// nBranches: how many a parent bears over the whole of its length.
    #[schemars(extend("maximum" = 10_000))]
    pub number: Quantity,
    /// nDownAngle: between a branch and its parent, degrees.
    #[schemars(extend("minimum" = 0, "maximum" = 180))]
    pub down_angle_deg: Constant,
    /// nDownAngleV: its variation, degrees. Below 0 nothing is drawn: the angle is greater by its amount at the base of
    /// the crown and smaller by 0.6 of it at the top.
    #[serde(default)]
    #[schemars(extend("minimum" = -180, "maximum" = 180))]
    pub down_angle_v_deg: Constant,
    /// nRotate: from one branch to the next around their parent, degrees. Below 0 they stand on two sides of the parent
    /// by turns, each at 180 + nRotate from its y-axis.
    #[schemars(extend("minimum" = -360, "maximum" = 360))]
    pub rotate_deg: Constant,
    /// nRotateV: its variation, degrees.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 360))]
    pub rotate_v_deg: Constant,
    /// nLength: the greatest length of a branch over that of its parent.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 10))]
    pub length: Constant,
    /// nLengthV: its variation; at most `length`.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 10))]
    pub length_v: Constant,
    /// nTaper: from 0, a cylinder, to 1, a cone that ends in a point.
    #[serde(default = "one")]
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub taper: Constant,
    /// nCurveRes: how many segments a branch has.
    #[schemars(extend("minimum" = 1, "maximum" = 100))]
    pub curve_res: Quantity,
    /// nCurve: the angle by which a branch curves over its length, or over its first half where `curve_back_deg` is not
    /// 0, degrees. Above 0 it curves away from its upper side, downwards.
    #[serde(default)]
    #[schemars(extend("minimum" = -3600, "maximum" = 3600))]
    pub curve_deg: Constant,
    /// nCurveBack: the angle over its second half, degrees.
    #[serde(default)]
    #[schemars(extend("minimum" = -3600, "maximum" = 3600))]
    pub curve_back_deg: Constant,
    /// nCurveV: the variation of the angle over its length, degrees; each segment draws its share.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 3600))]
    pub curve_v_deg: Constant,
}

fn none() -> Quantity {
    Quantity::Number(0)
}

fn one() -> Constant {
    Constant::Number(1.0)
}
