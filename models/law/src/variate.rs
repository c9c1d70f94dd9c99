//! A real random variable as it is written: an insertion angle, a divergence, a leaf size (de Reffye et al. 1988 §4:
//! "to define the insertion angle and the phyllotaxy as random variables, functions of various parameters").
//!
//! The parameters are laws. The draws are in `variate_table`; that exactly one kind is given is checked there.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};

use super::bare::{self, BareOr};
use super::form::{Law, check_intervals, one_kind};
use crate::fault::{Fault, Path};

/// A number or a continuous random variable. Written as a bare number, or as a table with exactly one distribution,
/// for example `{ normal = { mean = 55, sd = 5 }, min = 30, max = 90 }`.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Variate {
    /// Always the same number.
    Number(f64),
    /// A table with exactly one distribution.
    Form(Box<VariateForm>),
}

/// A random variable with exactly one distribution, and where it comes from. All in the unit of its key.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(inline, extend("minProperties" = 1))]
pub struct VariateForm {
    /// No chance: a number or a law.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Law")]
    pub value: Option<Law>,
    /// Normal.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Normal")]
    pub normal: Option<Normal>,
    /// Uniform.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Uniform")]
    pub uniform: Option<Uniform>,
    /// Log-normal, by the mean and the standard deviation of the variable itself, not of its logarithm.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Lognormal")]
    pub lognormal: Option<Lognormal>,
    /// Observed values, each drawn equally often.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Vec<f64>")]
    pub empirical: Option<Vec<f64>>,
    /// A draw below this becomes this.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64")]
    pub min: Option<f64>,
    /// A draw above this becomes this.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64")]
    pub max: Option<f64>,
    /// Where the numbers come from: a reference, a data set, an observation.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String")]
    pub source: Option<String>,
    /// The interval of 95 % of each number that was estimated, by the number's name. It documents the variable;
    /// growth does not read it.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub interval: BTreeMap<String, [f64; 2]>,
    /// How many observations the numbers were estimated from. It documents the variable; growth does not read it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "u32")]
    pub n: Option<u32>,
    /// The range in which `phytomer fit --law abc` looks for each number, by the number's name:
    /// `prior = { mean = [40, 60] }`. Growth does not read it.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub prior: BTreeMap<String, [f64; 2]>,
    /// True where the numbers are a guess and not a measure.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub assumed: bool,
}

/// Normal distribution.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct Normal {
    /// Mean.
    pub mean: Law,
    /// Standard deviation, 0 or more.
    pub sd: Law,
}

/// Uniform distribution.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct Uniform {
    /// Smallest value.
    pub min: Law,
    /// Largest value.
    pub max: Law,
}

/// Log-normal distribution: σ² = ln(1 + sd²/mean²) and μ = ln mean − σ²/2 are those of the logarithm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct Lognormal {
    /// Mean of the variable itself, above 0.
    pub mean: Law,
    /// Standard deviation of the variable itself, 0 or more.
    pub sd: Law,
}

impl<'de> Deserialize<'de> for Variate {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ok(match bare::read(deserializer)? {
            BareOr::Bare(number) => Self::Number(number),
            BareOr::Table(form) => Self::Form(Box::new(form)),
        })
    }
}

impl Default for Variate {
    /// Always 0.
    fn default() -> Self {
        Self::Number(0.0)
    }
}

impl From<f64> for Variate {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<VariateForm> for Variate {
    fn from(form: VariateForm) -> Self {
        Self::Form(Box::new(form))
    }
}

impl VariateForm {
    /// A fault unless exactly one distribution is given.
    pub(super) fn check_kind(&self, path: &Path) -> Result<(), Fault> {
        let kinds = [
            ("value", self.value.is_some()),
            ("normal", self.normal.is_some()),
            ("uniform", self.uniform.is_some()),
            ("lognormal", self.lognormal.is_some()),
            ("empirical", self.empirical.is_some()),
        ];
        one_kind(&kinds, path)?;
        check_intervals(&self.interval, path)
    }
}
