//! A law as it is written: a bare number, or a table with exactly one kind (de Reffye et al. 1988 §4: "experimental
//! measures, or calculated from mathematical laws taken as hypotheses, or completely arbitrary").
//!
//! The formulas are in `curves` and `expression`; the compilation in `formula` and `table`. That exactly one kind is
//! given is checked there and reported as a fault; the schema lists all the kinds in one object, so that an editor
//! can complete them and a misspelt one can be told from its neighbours.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};

use super::bare::{self, BareOr};
use super::curves::{ExponentialLaw, GompertzLaw, LinearLaw, LogisticLaw, RobustaLaw, StepLaw, TableLaw, WeibullLaw};
use super::responses::{LinearPlateauLaw, MitscherlichLaw, QuadraticPlateauLaw};
use crate::fault::{Fault, Path};

/// A law: a number as a function of age, dimension, cycle, rank, bud_birth, bud_dimension, unit, height_m, light and
/// state, and of nitrogen, degree_days, degree_days_per_day, day_length_h and date where the scenario tells them.
/// Written as a bare number, or as a table with exactly one kind, for example `{ value = 0.1 }` or `{ expression =
/// "min(1, 0.01 * dimension)" }`.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Law {
    /// The same number at every point.
    Number(f64),
    /// A table with exactly one kind.
    Form(Box<LawForm>),
}

/// A law with exactly one kind, and where it comes from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(inline, extend("minProperties" = 1))]
pub struct LawForm {
    /// The same number at every point, in the unit of the key that the law stands under.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64")]
    pub value: Option<f64>,
    /// One number for each value of a variable, as measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "TableLaw")]
    pub table: Option<TableLaw>,
    /// One number before a point and another from it on.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "StepLaw")]
    pub step: Option<StepLaw>,
    /// A straight line: start + slope x, kept within min and max where given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "LinearLaw")]
    pub linear: Option<LinearLaw>,
    /// An exponential approach: end + (start − end) exp(−rate x).
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "ExponentialLaw")]
    pub exponential: Option<ExponentialLaw>,
    /// An S-shaped curve: low + (high − low) / (1 + exp(−steepness (x − midpoint))).
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "LogisticLaw")]
    pub logistic: Option<LogisticLaw>,
    /// The hazard of one tick of a Weibull life length: 1 − exp(−((x/scale)^shape − ((x−1)/scale)^shape)).
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "WeibullLaw")]
    pub weibull: Option<WeibullLaw>,
    /// The hazard of one cycle whose dead fraction by cycle i is 1 − exp(−alpha i^beta), as measured on robusta coffee.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "RobustaLaw")]
    pub robusta: Option<RobustaLaw>,
    /// The hazard of one tick whose dead fraction by x is 1 − exp(−c (e^(g x) − 1)).
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "GompertzLaw")]
    pub gompertz: Option<GompertzLaw>,
    /// Several hazards at once, each a law: 1 − Π (1 − h), what any of several independent causes does in a tick.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Vec<Law>")]
    pub hazards: Option<Vec<Law>>,
    /// The law of diminishing returns: max (1 − exp(−rate (x + offset))), which starts at 0 where x is −offset
    /// (Mitscherlich 1909).
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "MitscherlichLaw")]
    pub mitscherlich: Option<MitscherlichLaw>,
    /// A straight line up to a plateau: start + slope min(x, plateau_from) (Cerrato & Blackmer 1990).
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "LinearPlateauLaw")]
    pub linear_plateau: Option<LinearPlateauLaw>,
    /// A parabola up to the plateau at its vertex: start + slope (x − x² / (2 plateau_from)), and start + slope
    /// plateau_from / 2 from there on (Cerrato & Blackmer 1990).
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "QuadraticPlateauLaw")]
    pub quadratic_plateau: Option<QuadraticPlateauLaw>,
    /// A formula of order, age, dimension, cycle, rank, bud_birth, bud_dimension, unit, height_m, light, nitrogen,
    /// degree_days, degree_days_per_day, day_length_h and date: + - * / ^, comparisons (0 or 1), and, or, not, min,
    /// max, exp, log (natural), pow, sqrt, abs, floor, if(condition, then, else).
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String")]
    pub expression: Option<String>,
    /// One law for each physiological state of the species, every state named once.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "BTreeMap<String, Law>")]
    pub by_state: Option<BTreeMap<String, Law>>,
    /// Where the numbers come from: a reference, a data set, an observation.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String")]
    pub source: Option<String>,
    /// The interval of 95 % of each number that was estimated, by the number's name: `interval = { alpha = [1e-8, 2e-8]
    /// }`. It documents the law; growth does not read it.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub interval: BTreeMap<String, [f64; 2]>,
    /// How many observations the numbers were estimated from. It documents the law; growth does not read it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "u32")]
    pub n: Option<u32>,
    /// The range in which `phytomer fit --law abc` looks for each number, by the number's name:
    /// `prior = { value = [0.1, 0.5] }`. Growth does not read it.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub prior: BTreeMap<String, [f64; 2]>,
    /// True where the numbers are a guess and not a measure.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub assumed: bool,
}

impl<'de> Deserialize<'de> for Law {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ok(match bare::read(deserializer)? {
            BareOr::Bare(number) => Self::Number(number),
            BareOr::Table(form) => Self::Form(Box::new(form)),
        })
    }
}

impl Default for Law {
    /// Zero everywhere.
    fn default() -> Self {
        Self::Number(0.0)
    }
}

impl From<f64> for Law {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<LawForm> for Law {
    fn from(form: LawForm) -> Self {
        Self::Form(Box::new(form))
    }
}

/// A fault unless exactly one of the kinds is given. `kinds` lists each kind with whether it is given.
pub(super) fn one_kind(kinds: &[(&'static str, bool)], path: &Path) -> Result<(), Fault> {
    let given: Vec<&str> = kinds.iter().filter(|kind| kind.1).map(|kind| kind.0).collect();
    let problem = match given.len() {
        1 => return Ok(()),
        0 => "no kind is given".to_owned(),
        _ => format!("{} kinds are given: {}", given.len(), given.join(", ")),
    };
    let all: Vec<&str> = kinds.iter().map(|kind| kind.0).collect();
    Err(Fault::new(path, problem, format!("exactly one of {}", all.join(", "))))
}

impl LawForm {
    /// A fault unless exactly one kind is given.
    pub(super) fn check_kind(&self, path: &Path) -> Result<(), Fault> {
        let kinds = [
            ("value", self.value.is_some()),
            ("table", self.table.is_some()),
            ("step", self.step.is_some()),
            ("linear", self.linear.is_some()),
            ("exponential", self.exponential.is_some()),
            ("logistic", self.logistic.is_some()),
            ("weibull", self.weibull.is_some()),
            ("robusta", self.robusta.is_some()),
            ("gompertz", self.gompertz.is_some()),
            ("hazards", self.hazards.is_some()),
            ("mitscherlich", self.mitscherlich.is_some()),
            ("linear_plateau", self.linear_plateau.is_some()),
            ("quadratic_plateau", self.quadratic_plateau.is_some()),
            ("expression", self.expression.is_some()),
            ("by_state", self.by_state.is_some()),
        ];
        one_kind(&kinds, path)?;
        check_intervals(&self.interval, path)
    }
}

/// A fault where the limits of an interval are no numbers in order.
pub(super) fn check_intervals(intervals: &BTreeMap<String, [f64; 2]>, path: &Path) -> Result<(), Fault> {
    let wrong = intervals.iter().find(|(_, [low, high])| !(low.is_finite() && high.is_finite() && low <= high));
    let Some((name, [low, high])) = wrong else { return Ok(()) };
    let problem = format!("the interval of `{}` is [{low}, {high}]", super::spelling::clip(name));
    Err(Fault::new(&path.key("interval").key(name), problem, "a lower and an upper limit, in this order"))
}
