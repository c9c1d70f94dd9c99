//! The curves with which agronomists describe the response to an input such as nitrogen: each rises to a plateau.
//!
//! Sources: E. A. Mitscherlich 1909, *Landwirtschaftliche Jahrbücher* 38: 537–552, the law of diminishing returns, in
//! which the soil's own supply is the offset; M. E. Cerrato & A. M. Blackmer 1990, *Agronomy Journal* 82: 138–143, who
//! compare it with the linear and the quadratic response with plateau. They stand over any variable. The logistic curve
//! and tables are in `curves`.

use phytomer_sim::math;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::curves::{Curve, check_numbers};
use super::domain::Domain;
use super::variable::Variable;
use crate::fault::{Fault, Path};

/// The law of diminishing returns: max (1 − exp(−rate (x + offset))).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct MitscherlichLaw {
    /// The variable x, usually `nitrogen`.
    pub over: Variable,
    /// The number that it tends to. 1 if not given.
    #[serde(default = "one")]
    pub max: f64,
    /// The share of what is missing to `max` that a small unit of x adds; above 0.
    pub rate: f64,
    /// What counts beside x, such as a supply that x does not hold. 0 if not given.
    #[serde(default)]
    pub offset: f64,
}

fn one() -> f64 {
    1.0
}

impl Curve for MitscherlichLaw {
    fn over(&self) -> Variable {
        self.over
    }

    fn at(&self, x: f64) -> f64 {
        -self.max * math::expm1(-self.rate * (x + self.offset))
    }

    fn check(&self, _: &Domain, path: &Path, faults: &mut Vec<Fault>) {
        let numbers = [("max", self.max, false), ("rate", self.rate, true), ("offset", self.offset, false)];
        check_numbers(&numbers, path, faults);
    }
}

/// A straight line up to a plateau: start + slope min(x, plateau_from).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct LinearPlateauLaw {
    /// The variable x.
    pub over: Variable,
    /// The number at x = 0.
    pub start: f64,
    /// What each unit of x adds below the plateau.
    pub slope: f64,
    /// The x from which on nothing is added.
    pub plateau_from: f64,
}

impl Curve for LinearPlateauLaw {
    fn over(&self) -> Variable {
        self.over
    }

    fn at(&self, x: f64) -> f64 {
        self.start + self.slope * x.min(self.plateau_from)
    }

    fn check(&self, _: &Domain, path: &Path, faults: &mut Vec<Fault>) {
        check_plateau([self.start, self.slope, self.plateau_from], path, faults);
    }
}

/// A parabola up to the plateau at its vertex: start + slope (x − x² / (2 plateau_from)).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub struct QuadraticPlateauLaw {
    /// The variable x.
    pub over: Variable,
    /// The number at x = 0.
    pub start: f64,
    /// What a small unit of x adds at x = 0; it adds ever less, and nothing at the plateau.
    pub slope: f64,
    /// The x of the vertex, from which on nothing is added.
    pub plateau_from: f64,
}

impl Curve for QuadraticPlateauLaw {
    fn over(&self) -> Variable {
        self.over
    }

    fn at(&self, x: f64) -> f64 {
        let x = x.min(self.plateau_from);
        self.start + self.slope * (x - x * x / (2.0 * self.plateau_from))
    }

    fn check(&self, _: &Domain, path: &Path, faults: &mut Vec<Fault>) {
        check_plateau([self.start, self.slope, self.plateau_from], path, faults);
    }
}

fn check_plateau([start, slope, plateau_from]: [f64; 3], path: &Path, faults: &mut Vec<Fault>) {
    let numbers = [("start", start, false), ("slope", slope, false), ("plateau_from", plateau_from, true)];
    check_numbers(&numbers, path, faults);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1 − exp(−.02 (N + 20)) at 0, 60, 120 and 240 kg/ha, divided by its value at 120.
    #[test]
    fn diminishing_returns_of_nitrogen() {
        let law = MitscherlichLaw { over: Variable::Nitrogen, max: 1.0, rate: 0.02, offset: 20.0 };
        for (nitrogen, expected) in [(0.0, 0.351_026), (60.0, 0.849_779), (120.0, 1.0), (240.0, 1.058_874)] {
            let relative = law.at(nitrogen) / law.at(120.0);
            assert!((relative - expected).abs() < 5e-7, "{nitrogen}: {relative}");
        }
        assert_eq!(law.at(-20.0), 0.0);
        assert_eq!(MitscherlichLaw { max: 3.0, ..law.clone() }.at(60.0), 3.0 * law.at(60.0));
        assert_eq!(law.extremes(0.0, 240.0), Some((law.at(0.0), law.at(240.0))));
    }

    #[test]
    fn plateaus_begin_where_they_are_stated() {
        let (over, start, slope, plateau_from) = (Variable::Nitrogen, 0.4, 0.01, 60.0);
        let linear = LinearPlateauLaw { over, start, slope, plateau_from };
        assert_eq!([0.0, 30.0, 60.0, 240.0].map(|x| linear.at(x)), [0.4, 0.7, 1.0, 1.0]);
        let quadratic = QuadraticPlateauLaw { over, start, slope, plateau_from };
        // .4 + .01 (30 − 900/120) and .4 + .01 · 60/2
        let expected = [0.4, 0.625, 0.7, 0.7];
        for (x, expected) in [0.0, 30.0, 60.0, 240.0].into_iter().zip(expected) {
            assert!((quadratic.at(x) - expected).abs() < 1e-15, "{x}: {}", quadratic.at(x));
        }
        let near = (quadratic.at(60.0) - quadratic.at(60.0 - 1e-4)) / 1e-4;
        assert!(near.abs() < 1e-6, "no corner at the vertex: {near}");
        assert_eq!(quadratic.extremes(0.0, 1e5), Some((0.4, quadratic.at(60.0))));
    }
}
