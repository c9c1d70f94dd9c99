//! The curves of one variable: each its documented parameters, then its formula.
//!
//! Sources: de Reffye et al. 1988 §4 ("usually, the laws are uniform or exponential laws"); the robusta mortality is
//! that of the GreenLab course (CIRAD), α = 8.89e-8, β = 4.418 from 600 axes a point. Its measured quantity is the
//! *dead fraction* of the axes by a number of cycles, so 1 − exp(−α iᵝ) is a cumulative fraction, and the probability
//! that a bud alive after cycle i − 1 dies in cycle i is the hazard 1 − exp(−α (iᵝ − (i−1)ᵝ)). Read as a probability
//! of each cycle the same formula would have killed 92 % by cycle 32, where 32 % were found dead.

use phytomer_sim::math;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};

use super::domain::Domain;
use super::variable::Variable;
use crate::fault::{Fault, Path};

/// A curve of one variable.
pub(super) trait Curve {
    /// The variable of which the curve is a function.
    fn over(&self) -> Variable;
    /// The value of the curve where the variable is `x`.
    fn at(&self, x: f64) -> f64;
    /// The least and the largest value where the variable is in `low..=high`; `None` where nothing is known of them.
    /// Those at the ends, for a curve that rises or falls all the way.
    fn extremes(&self, low: f64, high: f64) -> Option<(f64, f64)> {
        let (from, to) = (self.at(low), self.at(high));
        Some((from.min(to), from.max(to)))
    }
    /// Adds a fault for each parameter that is wrong.
    fn check(&self, domain: &Domain, path: &Path, faults: &mut Vec<Fault>);
}

/// One number for each value of a variable, as measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct TableLaw {
    /// The variable.
    pub over: Variable,
    /// The variable's value that the first number is for; smaller ones take the first number too. 1 if not given.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    #[schemars(range(max = 4294967295_u32))]
    pub from: u32,
    /// The numbers, for `from`, `from` + 1, `from` + 2 …; between two of them the first holds.
    pub values: Vec<f64>,
    /// What holds beyond the last number: `error` (the table must reach the end), `last` or `zero`.
    #[serde(default, skip_serializing_if = "Beyond::is_error")]
    pub beyond: Beyond,
}

fn one() -> u32 {
    1
}

fn is_one(number: &u32) -> bool {
    *number == 1
}

/// What holds beyond the last number of a table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Beyond {
    /// The table must reach the end of the variable's range.
    #[default]
    Error,
    /// The last number.
    Last,
    /// Zero.
    Zero,
}

impl Beyond {
    fn is_error(&self) -> bool {
        *self == Self::Error
    }
}

impl JsonSchema for Beyond {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Beyond".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": "string",
            "enum": ["error", "last", "zero"],
            "description": "What holds beyond the last number of a table: `error`, the table must reach the end of \
                the variable's range; `last`, the last number; `zero`, 0.",
        })
    }
}

impl Curve for TableLaw {
    fn over(&self) -> Variable {
        self.over
    }

    fn at(&self, x: f64) -> f64 {
        // The cast rounds down and saturates.
        let place = (x - f64::from(self.from)) as usize;
        match (self.values.get(place), self.beyond) {
            (Some(&value), _) => value,
            (None, Beyond::Zero) => 0.0,
            (None, _) => self.values.last().copied().unwrap_or(f64::NAN),
        }
    }

    fn extremes(&self, _: f64, _: f64) -> Option<(f64, f64)> {
        let beyond = (self.beyond == Beyond::Zero).then_some(0.0);
        let all = self.values.iter().copied().chain(beyond);
        Some(all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value))))
    }

    fn check(&self, domain: &Domain, path: &Path, faults: &mut Vec<Fault>) {
        let path = path.key("values");
        let (has, last) = (self.values.len(), domain.range(self.over).1);
        let needs = u64::from(last.saturating_sub(self.from)) + 1;
        if has == 0 {
            faults.push(Fault::new(&path, "the table is empty", "at least one number"));
        } else if self.beyond == Beyond::Error && (has as u64) < needs {
            let problem = format!("table too short: has {has} values, needs {needs}");
            faults.push(Fault::new(&path, problem, format!("{needs} values, or beyond = \"last\" or \"zero\"")));
        }
        for (i, value) in self.values.iter().enumerate().filter(|(_, value)| !value.is_finite()).take(8) {
            faults.push(Fault::new(&path.index(i), format!("the value is {value}"), "a finite number"));
        }
    }
}

/// A fault for each parameter that is not a finite number, or not above 0 where it must be.
pub(super) fn check_numbers(numbers: &[(&str, f64, bool)], path: &Path, faults: &mut Vec<Fault>) {
    for &(name, value, positive) in numbers {
        let expected = if positive { "a finite number above 0" } else { "a finite number" };
        if !value.is_finite() || (positive && value <= 0.0) {
            faults.push(Fault::new(&path.key(name), format!("{name} is {value}"), expected));
        }
    }
}

/// One number before a point and another from it on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct StepLaw {
    /// The variable.
    pub over: Variable,
    /// The first value of the variable at which `after` holds.
    #[schemars(range(max = 4294967295_u32))]
    pub at: u32,
    /// The number below `at`.
    pub before: f64,
    /// The number from `at` on.
    pub after: f64,
}

impl Curve for StepLaw {
    fn over(&self) -> Variable {
        self.over
    }

    fn at(&self, x: f64) -> f64 {
        if x < f64::from(self.at) { self.before } else { self.after }
    }

    fn check(&self, _: &Domain, path: &Path, faults: &mut Vec<Fault>) {
        check_numbers(&[("before", self.before, false), ("after", self.after, false)], path, faults);
    }
}

/// A straight line: start + slope x, kept within min and max where given.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct LinearLaw {
    /// The variable x.
    pub over: Variable,
    /// The number at x = 0.
    pub start: f64,
    /// What each unit of x adds.
    pub slope: f64,
    /// The line does not go below this.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64")]
    pub min: Option<f64>,
    /// The line does not go above this.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64")]
    pub max: Option<f64>,
}

impl Curve for LinearLaw {
    fn over(&self) -> Variable {
        self.over
    }

    fn at(&self, x: f64) -> f64 {
        let line = self.start + self.slope * x;
        line.max(self.min.unwrap_or(f64::NEG_INFINITY)).min(self.max.unwrap_or(f64::INFINITY))
    }

    fn check(&self, _: &Domain, path: &Path, faults: &mut Vec<Fault>) {
        let (min, max) = (self.min.unwrap_or(0.0), self.max.unwrap_or(0.0));
        let numbers =
            [("start", self.start, false), ("slope", self.slope, false), ("min", min, false), ("max", max, false)];
        check_numbers(&numbers, path, faults);
        if let (Some(min), Some(max)) = (self.min, self.max)
            && min > max
        {
            faults.push(Fault::new(&path.key("min"), format!("min {min} is above max {max}"), "min ≤ max"));
        }
    }
}

/// An exponential approach: end + (start − end) exp(−rate x).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct ExponentialLaw {
    /// The variable x.
    pub over: Variable,
    /// The number at x = 0.
    pub start: f64,
    /// The number that it tends to.
    pub end: f64,
    /// How fast, per unit of x; ln 2 / rate is the half-way time.
    pub rate: f64,
}

impl Curve for ExponentialLaw {
    fn over(&self) -> Variable {
        self.over
    }

    fn at(&self, x: f64) -> f64 {
        self.end + (self.start - self.end) * math::exp(-self.rate * x)
    }

    fn check(&self, _: &Domain, path: &Path, faults: &mut Vec<Fault>) {
        check_numbers(
            &[("start", self.start, false), ("end", self.end, false), ("rate", self.rate, false)],
            path,
            faults,
        );
    }
}

/// An S-shaped curve: low + (high − low) / (1 + exp(−steepness (x − midpoint))).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct LogisticLaw {
    /// The variable x.
    pub over: Variable,
    /// The number that it comes from.
    pub low: f64,
    /// The number that it goes to.
    pub high: f64,
    /// The x of the middle between low and high.
    pub midpoint: f64,
    /// How steep, per unit of x.
    pub steepness: f64,
}

impl Curve for LogisticLaw {
    fn over(&self) -> Variable {
        self.over
    }

    fn at(&self, x: f64) -> f64 {
        self.low + (self.high - self.low) / (1.0 + math::exp(-self.steepness * (x - self.midpoint)))
    }

    fn check(&self, _: &Domain, path: &Path, faults: &mut Vec<Fault>) {
        let numbers = [
            ("low", self.low, false),
            ("high", self.high, false),
            ("midpoint", self.midpoint, false),
            ("steepness", self.steepness, false),
        ];
        check_numbers(&numbers, path, faults);
    }
}

/// The probability of ending in the unit before `x`, given life up to it, from a cumulative hazard; 0 at x = 0.
fn hazard(x: f64, cumulative: impl Fn(f64) -> f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    let (before, total) = (cumulative((x - 1.0).max(0.0)), cumulative(x));
    if total == f64::INFINITY { 1.0 } else { -math::expm1(before - total) }
}

/// The hazard of one tick of a Weibull life length: 1 − exp(−((x/scale)^shape − ((x−1)/scale)^shape)), 0 at x = 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct WeibullLaw {
    /// The variable x.
    pub over: Variable,
    /// The x by which 63.2 % have ended; above 0.
    pub scale: f64,
    /// Below 1 the hazard falls with x, at 1 it is constant, above 1 it rises; above 0.
    pub shape: f64,
}

impl Curve for WeibullLaw {
    fn over(&self) -> Variable {
        self.over
    }

    fn at(&self, x: f64) -> f64 {
        hazard(x, |x| math::pow(x / self.scale, self.shape))
    }

    fn extremes(&self, _: f64, _: f64) -> Option<(f64, f64)> {
        Some((0.0, 1.0))
    }

    fn check(&self, _: &Domain, path: &Path, faults: &mut Vec<Fault>) {
        check_numbers(&[("scale", self.scale, true), ("shape", self.shape, true)], path, faults);
    }
}

/// The hazard of one cycle, 1 − exp(−alpha (i^beta − (i−1)^beta)), 0 at i = 0: the dead fraction by cycle i is
/// 1 − exp(−alpha i^beta), the mortality measured on robusta coffee branches (alpha = 8.89e-8, beta = 4.418).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct RobustaLaw {
    /// The variable i, usually `cycle`.
    pub over: Variable,
    /// Factor of the cumulative hazard; 0 means no mortality.
    pub alpha: f64,
    /// Power of the cumulative hazard; above 0.
    pub beta: f64,
}

impl Curve for RobustaLaw {
    fn over(&self) -> Variable {
        self.over
    }

    fn at(&self, x: f64) -> f64 {
        hazard(x, |i| self.alpha * math::pow(i, self.beta))
    }

    fn extremes(&self, _: f64, _: f64) -> Option<(f64, f64)> {
        Some((0.0, 1.0))
    }

    fn check(&self, _: &Domain, path: &Path, faults: &mut Vec<Fault>) {
        check_numbers(&[("alpha", self.alpha, false), ("beta", self.beta, true)], path, faults);
    }
}

/// The hazard of one tick of a Gompertz life length, 1 − exp(−c (e^(g x) − e^(g (x − 1)))), 0 at x = 0: the dead
/// fraction by x is 1 − exp(−c (e^(g x) − 1)) (Gompertz 1825).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct GompertzLaw {
    /// The variable x.
    pub over: Variable,
    /// Factor of the cumulative hazard; 0 means no mortality.
    pub c: f64,
    /// How fast the hazard rises, per unit of x; above 0.
    pub g: f64,
}

impl Curve for GompertzLaw {
    fn over(&self) -> Variable {
        self.over
    }

    fn at(&self, x: f64) -> f64 {
        hazard(x, |x| self.c * math::expm1(self.g * x))
    }

    fn extremes(&self, _: f64, _: f64) -> Option<(f64, f64)> {
        Some((0.0, 1.0))
    }

    fn check(&self, _: &Domain, path: &Path, faults: &mut Vec<Fault>) {
        check_numbers(&[("c", self.c, false), ("g", self.g, true)], path, faults);
    }
}
