//! The descriptor of a tree: everything that the paper's structure `TREE` holds, as a file states it, and what its
//! commands combine and glue (Aono & Kunii 1984, "Internal data structure" and the appendix).
//!
//! Names and units follow Tables 1 and 4: h1, h2, R0, R1, R2, R_diam, div, g_level, dx, dy, dz. One struct holds the
//! keys of all four types of tree; which type takes which key stands in `keys`. The paper's trees have fixed numbers;
//! here each real number may also be a random variable, of which a plant draws one value for its whole life. Absent on
//! purpose: the equations (`branching`, `course`, `deviators`), the checks (`keys`, `compile`), and the place, the
//! size and the colour of a drawn tree, which are the drawing's.

use super::course::Curve;
use super::parts::{Controller, CutLateral, TreeLeaf};
use crate::law::{Constant, Quantity, Variate, VariateForm};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The most growth levels: at level n a bifurcating tree has 2ⁿ⁺¹ − 1 branches and 2ⁿ apical buds, and they must stay
/// under [`MOST_COMPONENTS`](phytomer_sim::plant::MOST_COMPONENTS). Orders stay under 31.
pub const MOST_LEVELS: u32 = 28;

/// The type of a tree: how its branches branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum TreeType {
    /// Two children at constant angles.
    Gmt1,
    /// Two children whose tips deviate.
    Gmt2,
    /// Three children, the centre one in the direction of its mother; tips may deviate.
    Gmt3,
    /// Two children whose angles change with the growth level and scatter; tips may deviate.
    Gmt4,
}

impl TreeType {
    /// All types, in the order of their numbers.
    pub const ALL: [Self; 4] = [Self::Gmt1, Self::Gmt2, Self::Gmt3, Self::Gmt4];

    /// Its name in files.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Gmt1 => "gmt1",
            Self::Gmt2 => "gmt2",
            Self::Gmt3 => "gmt3",
            Self::Gmt4 => "gmt4",
        }
    }

    /// How many children a branch bears.
    pub const fn children(self) -> u32 {
        match self {
            Self::Gmt3 => 3,
            Self::Gmt1 | Self::Gmt2 | Self::Gmt4 => 2,
        }
    }
}

/// How a branch bears its children: the numbers of one branching.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Rule {
    /// Left branching angle h1 between mother and child, degrees; above 0 is to the left. h1 and h2 must not both be 0.
    /// In a `gmt4` it is drawn anew at each branching, and added to the angle of the category where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Variate", extend("minimum" = -180, "maximum" = 180))]
    pub h1_deg: Option<Variate>,
    /// Right branching angle h2, degrees; below 0 is to the right. In a `gmt4` it is drawn anew at each branching, and
    /// added to the angle of the category where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Variate", extend("minimum" = -180, "maximum" = 180))]
    pub h2_deg: Option<Variate>,
    /// Contraction ratio R0: the length of the centre child over that of its mother.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Variate", extend("exclusiveMinimum" = 0, "maximum" = 1))]
    pub r0: Option<Variate>,
    /// Contraction ratio R1: the length of the left child over that of its mother.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Variate", extend("exclusiveMinimum" = 0, "maximum" = 1))]
    pub r1: Option<Variate>,
    /// Contraction ratio R2: the length of the right child over that of its mother.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Variate", extend("exclusiveMinimum" = 0, "maximum" = 1))]
    pub r2: Option<Variate>,
    /// Contraction ratio of the diameter, R_diam: a child's over its mother's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Variate", extend("exclusiveMinimum" = 0, "maximum" = 1))]
    pub diameter_ratio: Option<Variate>,
    /// Divergence angle, degrees: how far each branching along an axis is turned about the axis against the one below.
    /// 0, if neither it nor `divergence` is given: all branchings in the maximal gradient plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Variate", extend("minimum" = -360, "maximum" = 360))]
    pub divergence_deg: Option<Variate>,
    /// The divergence as a Fibonacci fraction of a turn, such as `"2/5"` or `"5/13"`, or `"spiral"` for their limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String")]
    pub divergence: Option<String>,
    /// The angle δ by which every branching is turned about its mother out of the maximal gradient plane, beside the
    /// divergence, degrees (Fig. 10); 0 if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Variate", extend("minimum" = -360, "maximum" = 360))]
    pub delta_deg: Option<Variate>,
    /// By how much the tip of every child is moved, metres: dx, dy, dz; z is up.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "[f64; 3]")]
    pub deviation_m: Option<[f64; 3]>,
    /// The points that pull at tips or push them away.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Vec<Controller>", length(max = 1000))]
    pub controller: Option<Vec<Controller>>,
    /// How the branching angles change from the first growth level to the last (Table 3): 1 steadily, 2 slowly then
    /// fast, 3 fast then slowly, 4 slowly, fast and slowly, 5 up to the middle and down.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Quantity", extend("minimum" = 1, "maximum" = 5))]
    pub category: Option<Quantity>,
    /// The function of the categories 2 and 3; a polynomial if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Curve")]
    pub curve: Option<Curve>,
    /// The angle φ of the exponential function of category 2, degrees: above every angle of the range.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Constant", extend("exclusiveMinimum" = 0, "maximum" = 3600))]
    pub phi_deg: Option<Constant>,
    /// Where category 5 has its greatest angle (n₅), as a share of the way from the first branching to the last, above
    /// 0 and below 1; 0.5 if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Constant", extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1))]
    pub peak: Option<Constant>,
    /// The greatest left angle, h1′, degrees; above 0 is to the left.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Constant", extend("minimum" = -180, "maximum" = 180))]
    pub h1_max_deg: Option<Constant>,
    /// The smallest left angle, h1″, degrees, on the same side.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Constant", extend("minimum" = -180, "maximum" = 180))]
    pub h1_min_deg: Option<Constant>,
    /// The greatest right angle, h2′, degrees; below 0 is to the right.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Constant", extend("minimum" = -180, "maximum" = 180))]
    pub h2_max_deg: Option<Constant>,
    /// The smallest right angle, h2″, degrees, on the same side.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Constant", extend("minimum" = -180, "maximum" = 180))]
    pub h2_min_deg: Option<Constant>,
}

/// A range of growth levels that branch by another type or by other numbers (`combine`). What is not given is as in the
/// rest of the tree.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(extend("additionalProperties" = false))]
pub struct CombinedLevels {
    /// The type of these levels; that of the tree if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "TreeType")]
    pub model: Option<TreeType>,
    /// The first growth level whose branches are borne in this way.
    #[schemars(extend("minimum" = 1, "maximum" = 28))]
    pub from_level: Quantity,
    /// The last one.
    #[schemars(extend("minimum" = 1, "maximum" = 28))]
    pub to_level: Quantity,
    /// How they are borne.
    #[serde(flatten)]
    pub rule: Rule,
}

/// One tree: how it branches, how far, from what first branch, and what is cut of it.
///
/// The first branch is growth level 0: the paper's Eqs. 2 and 3 give a tree of growth level n a base section and n
/// branches above it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Descriptor {
    /// How its branches branch.
    #[serde(flatten)]
    pub rule: Rule,
    /// The largest growth level (g_level): the branchings between the first branch and a tip of the full-grown tree.
    /// Not drawn: a run's limits and its forecast count the components of all plants by it.
    #[schemars(extend("minimum" = 0, "maximum" = 28))]
    pub levels: Quantity,
    /// Length of the first branch, metres; 1 (assumed) if not given.
    #[serde(default = "assumed_length")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 1000))]
    pub first_length_m: Variate,
    /// Diameter of the first branch, metres; 0.1 (assumed) if not given.
    #[serde(default = "assumed_diameter")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 1000))]
    pub first_diameter_m: Variate,
    /// The direction of the first branch, x, y and z of any length; upright if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "[f64; 3]")]
    pub first_direction: Option<[f64; 3]>,
    /// Growth levels that branch by another type or by other numbers.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub combine: Vec<CombinedLevels>,
    /// The growth level from which the main axis does not grow; its lateral branches do.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Quantity", extend("minimum" = 1, "maximum" = 28))]
    pub cut_axis: Option<Quantity>,
    /// The lateral branches of the main axis that grow less than the rest, or not at all.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cut_lateral: Vec<CutLateral>,
    /// The leaves at the tips; none if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "TreeLeaf")]
    pub leaf: Option<TreeLeaf>,
}

impl Descriptor {
    /// A tree of the growth level `levels`, with an assumed first branch and nothing cut.
    pub fn new(rule: Rule, levels: u32) -> Self {
        Self {
            rule,
            levels: levels.into(),
            first_length_m: assumed_length(),
            first_diameter_m: assumed_diameter(),
            first_direction: None,
            combine: Vec::new(),
            cut_axis: None,
            cut_lateral: Vec::new(),
            leaf: None,
        }
    }
}

/// A tree on the root of another (`glue`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(extend("additionalProperties" = false))]
pub struct GluedTree {
    /// Its type.
    pub model: TreeType,
    /// The tree.
    #[serde(flatten)]
    pub tree: Descriptor,
}

/// The tree of a species: a descriptor, the trees on its root, and how a growth level grows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GeometricTree {
    /// The tree.
    #[serde(flatten)]
    pub tree: Descriptor,
    /// Other trees that stand on the same root.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 100))]
    pub glue: Vec<GluedTree>,
    /// The ticks in which a growth level grows (`cont`): at the k-th of n, lengths, diameters, angles, turns and
    /// deviations of the newest branches are k/n of those that they come to have. 1 if not given: at once.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Quantity", extend("minimum" = 1, "maximum" = 1000))]
    pub ticks_per_level: Option<Quantity>,
}

impl From<Descriptor> for GeometricTree {
    fn from(tree: Descriptor) -> Self {
        Self { tree, glue: Vec::new(), ticks_per_level: None }
    }
}

fn assumed_length() -> Variate {
    assumed(1.0)
}

fn assumed_diameter() -> Variate {
    assumed(0.1)
}

fn assumed(number: f64) -> Variate {
    Variate::from(VariateForm { value: Some(number.into()), assumed: true, ..VariateForm::default() })
}
