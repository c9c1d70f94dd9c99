//! The parameters of GMT1 (Aono & Kunii 1984, "3-D geometric model GMT1" and Table 1), and the numbers of components
//! that follow from the growth level alone.
//!
//! Names and units follow Table 1: h1, h2, R1, R2, R_diam, div, g_level. The paper gives no size; the length and the
//! diameter of the first branch are assumed where a file does not give them. The paper's trees have fixed numbers; here
//! each real number may also be a random variable, of which a plant draws one value for its whole life. Absent on
//! purpose: the equations (`branching`), the tree (`tree`, `model`), the draws (`laws`), the checks (`compile`) and the
//! name and source of a tree, which every species file has whatever its model.

use phytomer_sim::clock::Tick;
use phytomer_sim::plant::MOST_COMPONENTS;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::law::{Quantity, Variate, VariateForm};

/// The most growth levels: at level n a tree has 2ⁿ⁺¹ − 1 branches and 2ⁿ apical buds, and they must stay under
/// [`MOST_COMPONENTS`]. Orders stay under 31.
pub const MOST_LEVELS: u32 = 28;
const _: () = assert!((3 << MOST_LEVELS) - 1 <= MOST_COMPONENTS as u64);

/// The bifurcating tree GMT1: at each growth level every branch that has none bears two children at its tip.
///
/// The first branch is growth level 0: the paper's Eqs. 2 and 3 give a tree of growth level n a base section and n
/// branches above it. Age 1 shows the first branch, and age a the growth level a − 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Gmt1 {
    /// Left branching angle h1 between mother and child, degrees; above 0 is to the left.
    #[schemars(extend("minimum" = -180, "maximum" = 180))]
    pub h1_deg: Variate,
    /// Right branching angle h2, degrees; below 0 is to the right. h1 and h2 must not both be 0.
    #[schemars(extend("minimum" = -180, "maximum" = 180))]
    pub h2_deg: Variate,
    /// Contraction ratio R1: the length of the left child over that of its mother.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 1))]
    pub r1: Variate,
    /// Contraction ratio R2: the length of the right child over that of its mother.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 1))]
    pub r2: Variate,
    /// Contraction ratio of the diameter, R_diam: a child's over its mother's.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 1))]
    pub diameter_ratio: Variate,
    /// Divergence angle, degrees: how far each branching along an axis is turned about the axis against the one
    /// below. 0, if not given: all branchings in the maximal gradient plane.
    #[serde(default)]
    #[schemars(extend("minimum" = -360, "maximum" = 360))]
    pub divergence_deg: Variate,
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

impl Gmt1 {
    /// The growth level of the tree at `age`, `None` for the seed.
    pub fn level_at(&self, age: Tick) -> Option<u32> {
        age.checked_sub(1).map(|level| level.min(self.levels.value()))
    }

    /// The components of the tree at `age`: at growth level n its 2ⁿ⁺¹ − 1 branches and 2ⁿ apical buds.
    pub fn components_at(&self, age: Tick) -> u64 {
        self.level_at(age).map_or(1, |level| (3_u64 << level.min(MOST_LEVELS)) - 1)
    }
}
