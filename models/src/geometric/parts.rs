//! What a tree may have beside its branchings, as a file states it: points that pull at its tips (Aono & Kunii 1984,
//! "Uniform and nonuniform deviation model"), branches that are cut, and leaves (their appendix).
//!
//! The paper's structure `CTRL` has a controller's range of growth levels. Its appendix names `cut_lateral` and `leaf`
//! and describes neither; what they mean here is said at each key. Absent: the branchings (`descriptor`), and what
//! follows from all of it (`deviators`, `tree`).

use crate::buds::params::LeafChoice;
use crate::law::{Constant, Quantity};
use phytomer_looks::FormName;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A point that pulls the tips of branches towards itself, or pushes them away.
///
/// A tip x moves by factor · (q − x)/L, where q is the point and L its distance from the tip before the move. A tip on
/// the point is not moved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Controller {
    /// The strength: how far a tip is moved, metres. Above 0 the point attracts, below 0 it inhibits.
    #[schemars(extend("minimum" = -1000, "maximum" = 1000))]
    pub factor: Constant,
    /// The place of the point from the root of the tree, metres: x, y, z.
    pub at_m: [f64; 3],
    /// The first growth level whose branches it moves; 1 if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Quantity", extend("minimum" = 1, "maximum" = 28))]
    pub from_level: Option<Quantity>,
    /// The last growth level whose branches it moves; the last of the tree if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Quantity", extend("minimum" = 1, "maximum" = 28))]
    pub to_level: Option<Quantity>,
    /// How its strength depends on the distance.
    #[serde(default, skip_serializing_if = "Falloff::is_none")]
    pub falloff: Falloff,
}

/// How the strength of a controller depends on the distance of a tip.
///
/// The paper's text has deviations "in inverse proportion to the distance". Its formula divides q − x by the distance
/// once, which makes a unit vector of it: the strength is the same at every distance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Falloff {
    /// The same at every distance, as the formula has it.
    #[default]
    None,
    /// Divided by the distance once more, as the text has it; at most 1000 m.
    Inverse,
}

impl Falloff {
    fn is_none(&self) -> bool {
        *self == Self::None
    }
}

/// Lateral branches of the main axis that do not grow to the full level of their tree.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CutLateral {
    /// The growth level at which the branch leaves the main axis.
    #[schemars(extend("minimum" = 1, "maximum" = 28))]
    pub level: Quantity,
    /// The last growth level that grows on it; if not given, the branch does not grow at all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Quantity", extend("minimum" = 1, "maximum" = 28))]
    pub to_level: Option<Quantity>,
}

/// The leaves at the tips of branches.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TreeLeaf {
    /// The form that they are drawn with (`phytomer list forms`).
    pub form: FormName,
    /// The leaves at a tip, evenly around it.
    #[schemars(extend("minimum" = 1, "maximum" = 100))]
    pub number: Quantity,
    /// Length of a leaf with its stalk, cm.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 10_000))]
    pub length_cm: Constant,
    /// Width of its blade, cm.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 10_000))]
    pub width_cm: Constant,
    /// The angle between the branch and a leaf, degrees.
    #[schemars(extend("minimum" = 0, "maximum" = 180))]
    pub insertion_deg: Constant,
    /// The first growth level whose branches bear leaves; the last of the tree if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Quantity", extend("minimum" = 0, "maximum" = 28))]
    pub from_level: Option<Quantity>,
    /// The last growth level whose branches bear leaves; the last of the tree if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Quantity", extend("minimum" = 0, "maximum" = 28))]
    pub to_level: Option<Quantity>,
    /// The ticks after which a leaf falls; it stays if not given. 1: only the newest branches are in leaf.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Quantity", extend("minimum" = 1))]
    pub life: Option<Quantity>,
    /// Its colour: `"#rrggbb"`, or colours by its age and season. Left out: by its form.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "LeafChoice")]
    pub colour: Option<LeafChoice>,
}

impl Default for TreeLeaf {
    fn default() -> Self {
        Self {
            form: FormName::Elliptic,
            number: Quantity::Number(1),
            length_cm: Constant::Number(5.0),
            width_cm: Constant::Number(2.5),
            insertion_deg: Constant::Number(0.0),
            from_level: None,
            to_level: None,
            life: None,
            colour: None,
        }
    }
}
