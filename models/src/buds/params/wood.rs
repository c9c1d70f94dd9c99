//! The wood of a species: how internodes thicken beyond their law of age, what they weigh, and how they bend (de Reffye
//! 1988 §5; the mechanics is `phytomer_sim::mechanics`).
//!
//! A species without a `[wood]` table keeps the pose at rest and the law `thickening_mm` of each order. The keys are in
//! GPa, millimetres and degrees; compilation makes SI units of them. Absent: the measured table of woods; the reader of
//! species files looks up the wood that `like` names.

use crate::law::{Constant, Law, Quantity};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The wood of a species.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Wood {
    /// A wood of the shipped table (`phytomer list woods`), whose stiffness, green density and drag hold where this
    /// table states none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub like: Option<String>,
    /// Whether axes bend under what they bear.
    pub bends: bool,
    /// Young's modulus of green wood, GPa: a law in which `dimension` and `cycle` are the internode's own age in ticks.
    /// Orders may state their own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modulus_gpa: Option<Law>,
    /// Green density, kg/m³; a law of the same variables.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density_kg_m3: Option<Law>,
    /// The drag of leaves and wood in the wind; left out: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drag: Option<DragLaw>,
    /// How internodes gain diameter; left out: by the law `internode.thickening_mm` of their order.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thickening: Option<ThickeningRule>,
    /// The fresh mass of a square metre of leaf, one side, kg/m², in [0, 100].
    pub leaf_kg_m2: Constant,
    /// The density of a flower as the ellipsoid of its length and width, kg/m³, in [0, 5000].
    pub flower_kg_m3: Constant,
    /// The density of a fruit, likewise, kg/m³, in [0, 5000].
    pub fruit_kg_m3: Constant,
}

impl Default for Wood {
    fn default() -> Self {
        Self {
            like: None,
            bends: true,
            modulus_gpa: None,
            density_kg_m3: None,
            drag: None,
            thickening: None,
            leaf_kg_m2: Constant::from(0.2),
            flower_kg_m3: Constant::from(200.0),
            fruit_kg_m3: Constant::from(1000.0),
        }
    }
}

/// Drag that falls with the speed of the wind, as crowns give way: C_d = c U⁻ⁿ, U in m/s.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DragLaw {
    /// c, in [0, 100].
    pub c: Constant,
    /// n, in [0, 2]; at 2 the force no longer rises with the wind.
    pub n: Constant,
    /// Where the numbers come from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<String>,
    /// True where the numbers are a guess and not a measure.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub assumed: bool,
}

/// A rule of secondary growth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "rule", rename_all = "lowercase", deny_unknown_fields)]
pub enum ThickeningRule {
    /// The pipe model (Shinozaki et al. 1964): the section at birth, and a pipe for each leaf above.
    Pipe {
        /// The section of the pipe of one leaf, mm², in [0, 1000000].
        mm2_per_leaf: Constant,
        /// Whether every leaf that ever was has its pipe, or the living ones alone.
        #[serde(default)]
        leaves: CountedLeaves,
        /// Where the numbers come from.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        source: Option<String>,
    },
    /// Da Vinci's rule: at a fork, d^Δ below is the sum of d^Δ above.
    Vinci {
        /// Δ, in [1, 5]: 2 keeps the sum of the sections; about 2.5 and more in twigs.
        exponent: Constant,
        /// Where the numbers come from.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        source: Option<String>,
    },
    /// A ring a tick, as long as the axis lives.
    Rings {
        /// Its width, mm, in [0, 1000].
        #[serde(default)]
        width_mm: Constant,
        /// The section that a square metre of living leaves above adds in a tick, mm²/m², in [0, 1000000].
        #[serde(default)]
        mm2_per_leaf_m2: Constant,
        /// Where the numbers come from.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        source: Option<String>,
    },
}

/// Which leaves above an internode have their pipes in it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum CountedLeaves {
    /// Every one that ever was.
    #[default]
    Ever,
    /// Those that live; the wood of the others stays.
    Living,
}

/// The wood of one order, where it differs from that of the species.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct OrderWood {
    /// Young's modulus of green wood, GPa.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modulus_gpa: Option<Law>,
    /// Green density, kg/m³.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density_kg_m3: Option<Law>,
    /// How axes of the order right themselves; left out: not at all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub uprighting: Option<UprightingLaw>,
}

impl OrderWood {
    /// Whether the order states no wood of its own.
    pub fn is_as_the_species(&self) -> bool {
        *self == Self::default()
    }
}

/// Gravitropic righting: reaction wood in what thickens, and the turning of young internodes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct UprightingLaw {
    /// The angle to the upward vertical that the axis keeps to, degrees in [0, 180]: 0 orthotropic, 90 plagiotropic.
    pub inclination_deg: Constant,
    /// The difference of maturation strain between the two sides of new wood, Δε, in [-0.1, 0.1].
    pub strain: Constant,
    /// The curvature that a young internode square to that direction gains in a tick, degrees a metre, in
    /// [0, 36000].
    pub rate_deg_per_m: Constant,
    /// For how many ticks an internode is young.
    pub young: Quantity,
    /// Where the numbers come from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub source: Option<String>,
    /// True where the numbers are a guess and not a measure.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub assumed: bool,
}

impl Default for UprightingLaw {
    fn default() -> Self {
        Self {
            inclination_deg: Constant::from(0.0),
            strain: Constant::from(0.0),
            rate_deg_per_m: Constant::from(0.0),
            young: Quantity::from(1),
            source: None,
            assumed: false,
        }
    }
}
