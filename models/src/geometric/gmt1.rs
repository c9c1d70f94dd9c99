//! The parameters of GMT1 (Aono & Kunii 1984, "3-D geometric model GMT1" and Table 1), with what is checked of them.
//!
//! Names and units follow Table 1: h1, h2, R1, R2, R_diam, div, g_level. The paper gives no size; the length and the
//! diameter of the first branch are assumed where a file does not give them.
//! Absent on purpose: the equations (`branching`), the tree (`model`) and the name and source of a tree, which every
//! species file has whatever its model.

use phytomer_sim::clock::{LAST_TICK, Tick};
use phytomer_sim::plant::MOST_COMPONENTS;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::model::Gmt1Model;
use crate::fault::{Fault, Path};

/// The most growth levels: at level n a tree has 2ⁿ⁺¹ − 1 branches and 2ⁿ apical buds, and they must stay under
/// [`MOST_COMPONENTS`]. Orders stay under 31.
pub const MOST_LEVELS: u32 = 28;
const _: () = assert!((3 << MOST_LEVELS) - 1 <= MOST_COMPONENTS as u64);

/// The shortest and the thinnest branch that a tree may have, metres: less than any cell, and single precision still
/// holds all its digits.
const SMALLEST_M: f64 = 1e-9;

/// The longest and the thickest first branch, metres.
const LARGEST_M: f64 = 1000.0;

/// The bifurcating tree GMT1: at each growth level every branch that has none bears two children at its tip.
///
/// The first branch is growth level 0: the paper's Eqs. 2 and 3 give a tree of growth level n a base section and n
/// branches above it. Age 1 shows the first branch, and age a the growth level a − 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Gmt1 {
    /// Left branching angle h1 between mother and child, degrees; above 0 is to the left.
    #[schemars(range(min = -180.0, max = 180.0))]
    pub h1_deg: f64,
    /// Right branching angle h2, degrees; below 0 is to the right. h1 and h2 must not both be 0.
    #[schemars(range(min = -180.0, max = 180.0))]
    pub h2_deg: f64,
    /// Contraction ratio R1: the length of the left child over that of its mother.
    #[schemars(range(max = 1.0), extend("exclusiveMinimum" = 0.0))]
    pub r1: f64,
    /// Contraction ratio R2: the length of the right child over that of its mother.
    #[schemars(range(max = 1.0), extend("exclusiveMinimum" = 0.0))]
    pub r2: f64,
    /// Contraction ratio of the diameter, R_diam: a child's over its mother's.
    #[schemars(range(max = 1.0), extend("exclusiveMinimum" = 0.0))]
    pub diameter_ratio: f64,
    /// Divergence angle, degrees: how far each branching along an axis is turned about the axis against the one
    /// below. 0, if not given: all branchings in the maximal gradient plane.
    #[serde(default)]
    #[schemars(range(min = -360.0, max = 360.0))]
    pub divergence_deg: f64,
    /// The largest growth level (g_level): the branchings between the first branch and a tip of the full-grown tree.
    #[schemars(range(max = 28))]
    pub levels: u32,
    /// Length of the first branch, metres; 1 (assumed) if not given.
    #[serde(default = "assumed_length")]
    #[schemars(range(max = 1000.0), extend("exclusiveMinimum" = 0.0))]
    pub first_length_m: f64,
    /// Diameter of the first branch, metres; 0.1 (assumed) if not given.
    #[serde(default = "assumed_diameter")]
    #[schemars(range(max = 1000.0), extend("exclusiveMinimum" = 0.0))]
    pub first_diameter_m: f64,
}

fn assumed_length() -> f64 {
    1.0
}

fn assumed_diameter() -> f64 {
    0.1
}

impl Gmt1 {
    /// Every fault of meaning in the parameters, which stand at `path` in their file.
    pub fn check(&self, path: &Path) -> Vec<Fault> {
        let mut faults = Vec::new();
        self.check_numbers(path, &mut faults);
        if self.h1_deg == 0.0 && self.h2_deg == 0.0 {
            let expected = "h1² + h2² ≠ 0: at least one branching angle that is not 0";
            faults.push(Fault::new(&path.key("h2_deg"), "h1_deg and h2_deg are both 0", expected));
        }
        if self.levels > MOST_LEVELS {
            let problem = format!("levels is {}: a tree of 2^{} branches", self.levels, u64::from(self.levels) + 1);
            faults.push(Fault::new(&path.key("levels"), problem, format!("at most {MOST_LEVELS} growth levels")));
        }
        if faults.is_empty() {
            self.check_smallest(path, &mut faults);
        }
        faults
    }

    /// The model, grown at most to the age `until`; the parameters stand at `path` in their file.
    ///
    /// # Errors
    /// All the faults that [`Gmt1::check`] finds, and an age past the last tick.
    pub fn compile(&self, until: Tick, path: &Path) -> Result<Gmt1Model, Vec<Fault>> {
        let mut faults = self.check(path);
        if until > LAST_TICK {
            faults.push(Fault::new(path, format!("the last age is {until}"), format!("at most {LAST_TICK}")));
        }
        if faults.is_empty() { Ok(Gmt1Model::new(self)) } else { Err(faults) }
    }

    /// The growth level of the tree at `age`, `None` for the seed.
    pub fn level_at(&self, age: Tick) -> Option<u32> {
        age.checked_sub(1).map(|level| level.min(self.levels))
    }

    /// The components of the tree at `age`: at growth level n its 2ⁿ⁺¹ − 1 branches and 2ⁿ apical buds.
    pub fn components_at(&self, age: Tick) -> u64 {
        self.level_at(age).map_or(1, |level| (3_u64 << level.min(MOST_LEVELS)) - 1)
    }

    fn check_numbers(&self, path: &Path, faults: &mut Vec<Fault>) {
        let mut check = |key: &str, value: f64, fits: bool, expected: String| {
            if !value.is_finite() || !fits {
                faults.push(Fault::new(&path.key(key), format!("{key} is {value}"), expected));
            }
        };
        for (key, value, most) in
            [("h1_deg", self.h1_deg, 180), ("h2_deg", self.h2_deg, 180), ("divergence_deg", self.divergence_deg, 360)]
        {
            check(key, value, value.abs() <= f64::from(most), format!("an angle in [-{most}, {most}] degrees"));
        }
        for (key, value) in [("r1", self.r1), ("r2", self.r2), ("diameter_ratio", self.diameter_ratio)] {
            check(key, value, value > 0.0 && value <= 1.0, "a ratio above 0, at most 1".to_owned());
        }
        for (key, value) in [("first_length_m", self.first_length_m), ("first_diameter_m", self.first_diameter_m)] {
            check(key, value, value > 0.0 && value <= LARGEST_M, format!("metres above 0, at most {LARGEST_M}"));
        }
    }

    /// The branches of the last level: as short as the smaller ratio makes them, as thin as the ratio of diameters.
    fn check_smallest(&self, path: &Path, faults: &mut Vec<Fault>) {
        let last = |first: f64, ratio: f64| (0..self.levels).fold(first, |size, _| size * ratio);
        let (key, ratio) = if self.r1 <= self.r2 { ("r1", self.r1) } else { ("r2", self.r2) };
        for (key, size, word) in [
            (key, last(self.first_length_m, ratio), "long"),
            ("diameter_ratio", last(self.first_diameter_m, self.diameter_ratio), "thick"),
        ] {
            if size < SMALLEST_M {
                let problem = format!("after {} levels a branch is {size:.1e} m {word}", self.levels);
                faults.push(Fault::new(&path.key(key), problem, format!("branches of at least {SMALLEST_M:e} m")));
            }
        }
    }
}
