//! A count as it is written: nodes per growth unit, buds per node, growth units a tick, relays (de Reffye et al. 1988
//! §4: "the number of nodes per growth unit … as random variables which depend on various other parameters").
//!
//! The parameters of a distribution are laws, so that they may change with age, rank or state. Parametrisations are
//! those of stat_tool (Guédon), with its lower bound as `shift`; the probabilities are in `mass`, the tables in
//! `count_table`. That exactly one distribution is given is checked at the compilation.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};

use super::bare::{self, BareOr};
use super::form::{Law, one_kind};
use crate::fault::{Fault, Path};

/// A count: a whole number or a discrete random variable. Written as a bare whole number, or as a table with exactly
/// one distribution, for example `{ binomial = { n = 7, p = 0.63 }, shift = 1 }`.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Count {
    /// Always the same whole number, at most 65535.
    Number(#[schemars(range(max = 65535))] u32),
    /// A table with exactly one distribution.
    Form(Box<CountForm>),
}

/// A count with exactly one distribution, and where it comes from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(inline, extend("minProperties" = 1))]
pub struct CountForm {
    /// No chance: a whole number, or a law whose values are whole numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Law")]
    pub constant: Option<Law>,
    /// Binomial: successes in n trials of probability p.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Binomial")]
    pub binomial: Option<Binomial>,
    /// Poisson.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Poisson")]
    pub poisson: Option<Poisson>,
    /// Negative binomial: failures before the r-th success; mean r (1 − p) / p, variance r (1 − p) / p².
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "NegativeBinomial")]
    pub negative_binomial: Option<NegativeBinomial>,
    /// Weights of 0, 1, 2 …, as observed; they need not sum to 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Vec<f64>")]
    pub empirical: Option<Vec<f64>>,
    /// Several distributions, each with its weight; the weights need not sum to 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Vec<CountComponent>")]
    pub mixture: Option<Vec<CountComponent>>,
    /// A whole number added to what is drawn. 0 if not given.
    #[serde(skip_serializing_if = "is_zero")]
    #[schemars(range(max = 65535))]
    pub shift: u32,
    /// Where the numbers come from: a reference, a data set, an observation.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String")]
    pub source: Option<String>,
    /// The interval of 95 % of each number that was estimated, by the number's name: `interval = { p = [0.5, 0.6] }`.
    /// It documents the law; growth does not read it.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub interval: BTreeMap<String, [f64; 2]>,
    /// How many observations the numbers were estimated from. It documents the law; growth does not read it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "u32")]
    pub n: Option<u32>,
    /// The range in which `phytomer fit --law abc` looks for each number, by the number's name:
    /// `prior = { p = [0.1, 0.9] }`. Growth does not read it.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub prior: BTreeMap<String, [f64; 2]>,
    /// True where the numbers are a guess and not a measure.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub assumed: bool,
}

/// One distribution of a mixture.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct CountComponent {
    /// Its weight among the others of the mixture, 0 or more.
    #[schemars(range(min = 0.0))]
    pub weight: f64,
    /// No chance: a whole number, or a law whose values are whole numbers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Law")]
    pub constant: Option<Law>,
    /// Binomial: successes in n trials of probability p.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Binomial")]
    pub binomial: Option<Binomial>,
    /// Poisson.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Poisson")]
    pub poisson: Option<Poisson>,
    /// Negative binomial: failures before the r-th success; mean r (1 − p) / p, variance r (1 − p) / p².
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "NegativeBinomial")]
    pub negative_binomial: Option<NegativeBinomial>,
    /// Weights of 0, 1, 2 …, as observed; they need not sum to 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Vec<f64>")]
    pub empirical: Option<Vec<f64>>,
    /// A whole number added to what is drawn. 0 if not given.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[schemars(range(max = 65535))]
    pub shift: u32,
    /// Where the numbers come from: a reference, a data set, an observation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String")]
    pub source: Option<String>,
    /// True where the numbers are a guess and not a measure.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub assumed: bool,
}

fn is_zero(number: &u32) -> bool {
    *number == 0
}

/// Successes in n trials of probability p: mean n p, variance n p (1 − p).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct Binomial {
    /// Number of trials, a whole number.
    pub n: Law,
    /// Probability of a success, in [0, 1].
    pub p: Law,
}

/// Poisson distribution.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct Poisson {
    /// Mean and variance, 0 or more.
    pub mean: Law,
}

/// Failures before the r-th success of probability p: mean r (1 − p) / p, variance r (1 − p) / p².
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct NegativeBinomial {
    /// Number of successes, above 0; need not be whole.
    pub r: Law,
    /// Probability of a success, above 0 and at most 1.
    pub p: Law,
}

impl<'de> Deserialize<'de> for Count {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ok(match bare::read(deserializer)? {
            BareOr::Bare(number) => Self::Number(number),
            BareOr::Table(form) => Self::Form(Box::new(form)),
        })
    }
}

impl Default for Count {
    /// Always 0.
    fn default() -> Self {
        Self::Number(0)
    }
}

impl From<u32> for Count {
    fn from(number: u32) -> Self {
        Self::Number(number)
    }
}

impl From<CountForm> for Count {
    fn from(form: CountForm) -> Self {
        Self::Form(Box::new(form))
    }
}

/// The distributions that a form or a component of a mixture can hold, borrowed from either.
pub(super) struct Simple<'a> {
    pub constant: Option<&'a Law>,
    pub binomial: Option<&'a Binomial>,
    pub poisson: Option<&'a Poisson>,
    pub negative_binomial: Option<&'a NegativeBinomial>,
    pub empirical: Option<&'a [f64]>,
    pub shift: u32,
}

impl Simple<'_> {
    /// A fault unless exactly one kind is given; `mixture` is `None` where there can be none.
    pub fn check_kind(&self, mixture: Option<bool>, path: &Path) -> Result<(), Fault> {
        let mut kinds = vec![
            ("constant", self.constant.is_some()),
            ("binomial", self.binomial.is_some()),
            ("poisson", self.poisson.is_some()),
            ("negative_binomial", self.negative_binomial.is_some()),
            ("empirical", self.empirical.is_some()),
        ];
        kinds.extend(mixture.map(|given| ("mixture", given)));
        one_kind(&kinds, path)
    }
}

impl CountForm {
    pub(super) fn simple(&self) -> Simple<'_> {
        Simple {
            constant: self.constant.as_ref(),
            binomial: self.binomial.as_ref(),
            poisson: self.poisson.as_ref(),
            negative_binomial: self.negative_binomial.as_ref(),
            empirical: self.empirical.as_deref(),
            shift: self.shift,
        }
    }
}

impl CountComponent {
    pub(super) fn simple(&self) -> Simple<'_> {
        Simple {
            constant: self.constant.as_ref(),
            binomial: self.binomial.as_ref(),
            poisson: self.poisson.as_ref(),
            negative_binomial: self.negative_binomial.as_ref(),
            empirical: self.empirical.as_deref(),
            shift: self.shift,
        }
    }
}
