//! A whole number that is not drawn, as it is written: bare, or as a table that says where it comes from.
//!
//! Such a number holds for a whole species: the ticks of a year, the order of a reiteration. Absent on purpose:
//! distributions and laws, which [`Count`](super::Count) has; and bounds, which the user of the number checks.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};

use super::bare::{self, Bare, BareOr};

/// A whole number that is not drawn. Written bare, or as a table with its source, for example
/// `{ value = 12, source = "one tick is a month" }`.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Quantity {
    /// The whole number, at most 65535.
    Number(#[schemars(range(max = 65535))] u32),
    /// The whole number, and where it comes from.
    Form(Box<QuantityForm>),
}

/// A whole number, and where it comes from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct QuantityForm {
    /// The whole number, at most 65535.
    #[schemars(range(max = 65535))]
    pub value: u32,
    /// Where the number comes from: a reference, a data set, an observation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String")]
    pub source: Option<String>,
    /// The range in which `phytomer fit --law abc` looks for the number: `prior = { value = [10, 14] }`. Growth does
    /// not read it.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub prior: BTreeMap<String, [f64; 2]>,
    /// True where the number is a guess and not a measure.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub assumed: bool,
}

impl Quantity {
    /// The number.
    pub fn value(&self) -> u32 {
        match self {
            Self::Number(number) => *number,
            Self::Form(form) => form.value,
        }
    }
}

impl From<u32> for Quantity {
    fn from(number: u32) -> Self {
        Self::Number(number)
    }
}

impl From<QuantityForm> for Quantity {
    fn from(form: QuantityForm) -> Self {
        Self::Form(Box::new(form))
    }
}

/// A whole number in the place of a table.
struct Whole(u32);

impl Bare for Whole {
    const EXPECTED: &'static str = "a whole number from 0, or a table with its `value`";

    fn whole(number: i64) -> Option<Self> {
        u32::try_from(number).ok().map(Self)
    }

    fn real(_: f64) -> Option<Self> {
        None
    }
}

impl<'de> Deserialize<'de> for Quantity {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ok(match bare::read(deserializer)? {
            BareOr::Bare(Whole(number)) => Self::Number(number),
            BareOr::Table(form) => Self::Form(Box::new(form)),
        })
    }
}
