//! A real number that is not drawn, as it is written: bare, or as a table that says where it comes from.
//!
//! Such a number holds for a whole species, and its key names its unit: the mass of a leaf, the drag of a crown. Absent
//! on purpose: distributions and laws, which [`Variate`](super::Variate) and [`Law`](super::Law) have.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};

use super::ValueRange;
use super::bare::{self, Bare, BareOr};
use super::form::check_intervals;
use crate::fault::{Fault, Path};

/// A number that is not drawn. Written bare, or as a table with its source, for example
/// `{ value = 0.2, source = "weighed" }`.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Constant {
    /// The number.
    Number(f64),
    /// The number, and where it comes from.
    Form(Box<ConstantForm>),
}

/// A number, and where it comes from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct ConstantForm {
    /// The number.
    pub value: f64,
    /// Where the number comes from: a reference, a data set, an observation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String")]
    pub source: Option<String>,
    /// The interval of 95 % of each number that was estimated, by the number's name. It documents the number;
    /// growth does not read it.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub interval: BTreeMap<String, [f64; 2]>,
    /// How many observations the numbers were estimated from. It documents the number; growth does not read it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "u32")]
    pub n: Option<u32>,
    /// The range in which `phytomer fit --law abc` looks for the number: `prior = { value = [0.1, 0.5] }`. Growth does
    /// not read it.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub prior: BTreeMap<String, [f64; 2]>,
    /// True where the number is a guess and not a measure.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub assumed: bool,
}

impl Constant {
    /// The number.
    pub fn value(&self) -> f64 {
        match self {
            Self::Number(number) => *number,
            Self::Form(form) => form.value,
        }
    }

    /// The number, checked to be within `range`.
    ///
    /// # Errors
    /// A fault at the path of the number itself where it is outside `range`, and one at the limits of its interval
    /// where they are no numbers in order.
    pub fn within(&self, path: &Path, range: ValueRange) -> Result<f64, Fault> {
        if let Self::Form(form) = self {
            check_intervals(&form.interval, path)?;
        }
        let value = self.value();
        if range.holds(value) {
            return Ok(value);
        }
        let path = match self {
            Self::Number(_) => path.clone(),
            Self::Form(_) => path.key("value"),
        };
        Err(Fault::new(&path, format!("the value is {}", range.show(value)), range.expected()))
    }
}

impl Default for Constant {
    fn default() -> Self {
        Self::Number(0.0)
    }
}

impl From<f64> for Constant {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<ConstantForm> for Constant {
    fn from(form: ConstantForm) -> Self {
        Self::Form(Box::new(form))
    }
}

/// A real number in the place of a table.
struct Real(f64);

impl Bare for Real {
    const EXPECTED: &'static str = "a number, or a table with its `value`";

    fn whole(number: i64) -> Option<Self> {
        Some(Self(number as f64))
    }

    fn real(number: f64) -> Option<Self> {
        Some(Self(number))
    }
}

impl<'de> Deserialize<'de> for Constant {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ok(match bare::read(deserializer)? {
            BareOr::Bare(Real(number)) => Self::Number(number),
            BareOr::Table(form) => Self::Form(Box::new(form)),
        })
    }
}
