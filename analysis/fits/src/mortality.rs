//! Mortality of axes, buds or branches: which cumulative hazard H(i) makes the dead fraction 1 − exp(−H(i)) by age i.
//!
//! Constant λ i, power (i/scale)^shape (the α iᵝ of robusta coffee, α = scale^−shape), Gompertz c (e^{g i} − 1), the
//! last two also with a constant hazard λ i added (Makeham). Axes are followed to their death or the end of the study,
//! or seen once, n of each age with the dead among them. BIC takes as n the deaths of those followed (Volinsky &
//! Raftery 2000), and the ages of those seen once, each of which is one binomial observation. Absent: causes and
//! covariates.

use crate::choice::{Choice, choose};
use crate::fit::{Estimate, Fit, Test};
use crate::likelihood::{Model, Scale};
use crate::optimum::largest;
use crate::problem::Problem;
use crate::special::{ln_choose, x_ln_y};
use phytomer_sim::math;

/// An axis that was followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Followed {
    /// The age at its death, or when it was last seen alive; whole ticks or cycles.
    pub age: f64,
    /// Whether it died.
    pub died: bool,
}

/// Axes of one age that were seen once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeenOnce {
    /// Their age.
    pub age: f64,
    /// How many there were.
    pub axes: f64,
    /// How many of them were dead.
    pub dead: f64,
}

/// What was observed.
#[derive(Debug, Clone, PartialEq)]
pub enum Observed {
    /// Axes followed to their death.
    Followed(Vec<Followed>),
    /// Axes seen once.
    SeenOnce(Vec<SeenOnce>),
}

/// The cumulative hazards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hazard {
    /// λ i.
    Constant,
    /// (i/scale)^shape.
    Power,
    /// The same with λ i.
    PowerAndConstant,
    /// c (e^{g i} − 1).
    Gompertz,
    /// The same with λ i.
    GompertzAndConstant,
}

/// All rivals.
pub const HAZARDS: [Hazard; 5] =
    [Hazard::Constant, Hazard::Power, Hazard::PowerAndConstant, Hazard::Gompertz, Hazard::GompertzAndConstant];

const RATE: (&str, Scale) = ("constant", Scale::Positive);
const POWER: [(&str, Scale); 2] = [("scale", Scale::Positive), ("shape", Scale::Positive)];
const GOMPERTZ: [(&str, Scale); 2] = [("c", Scale::Positive), ("g", Scale::Positive)];

impl Hazard {
    /// The law in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Constant => "constant hazard",
            Self::Power => "power",
            Self::PowerAndConstant => "power and constant hazard",
            Self::Gompertz => "Gompertz",
            Self::GompertzAndConstant => "Gompertz and constant hazard",
        }
    }

    fn parameters(self) -> Vec<(&'static str, Scale)> {
        match self {
            Self::Constant => vec![RATE],
            Self::Power => POWER.to_vec(),
            Self::PowerAndConstant => [&POWER[..], &[RATE]].concat(),
            Self::Gompertz => GOMPERTZ.to_vec(),
            Self::GompertzAndConstant => [&GOMPERTZ[..], &[RATE]].concat(),
        }
    }

    /// H(age), 0 at age 0.
    pub fn cumulative(self, at: &[f64], age: f64) -> f64 {
        if age <= 0.0 {
            return 0.0;
        }
        let power = || math::exp(at[1] * (math::log(age) - math::log(at[0])));
        let gompertz = || at[0] * math::expm1(at[1] * age);
        match self {
            Self::Constant => at[0] * age,
            Self::Power => power(),
            Self::PowerAndConstant => power() + at[2] * age,
            Self::Gompertz => gompertz(),
            Self::GompertzAndConstant => gompertz() + at[2] * age,
        }
    }

    /// Where the search begins: a hazard that leaves the observed share alive at the last age.
    fn starts(self, last: f64, dead: f64) -> Vec<Vec<f64>> {
        let total = -math::log1p(-dead.clamp(0.01, 0.99));
        let power = |shape: f64| vec![last / math::exp(math::log(total) / shape), shape];
        let gompertz = |turns: f64| vec![total / math::expm1(turns), turns / last];
        let and = |start: Vec<f64>| [start, vec![0.1 * total / last]].concat();
        match self {
            Self::Constant => vec![vec![total / last]],
            Self::Power => [1.0, 4.0].map(power).to_vec(),
            Self::PowerAndConstant => [2.0, 5.0].map(power).map(and).to_vec(),
            Self::Gompertz => [0.5, 4.0].map(gompertz).to_vec(),
            Self::GompertzAndConstant => [1.0, 6.0].map(gompertz).map(and).to_vec(),
        }
    }
}

impl Observed {
    fn last(&self) -> f64 {
        match self {
            Self::Followed(axes) => axes.iter().map(|axis| axis.age).fold(0.0, f64::max),
            Self::SeenOnce(ages) => ages.iter().map(|age| age.age).fold(0.0, f64::max),
        }
    }

    /// All axes, the dead among them, and how many different ages tell anything.
    fn totals(&self) -> (f64, f64, usize) {
        let mut ages: Vec<f64> = match self {
            Self::Followed(axes) => axes.iter().filter(|axis| axis.died).map(|axis| axis.age).collect(),
            Self::SeenOnce(seen) => seen.iter().map(|age| age.age).filter(|age| *age > 0.0).collect(),
        };
        ages.sort_by(f64::total_cmp);
        ages.dedup();
        let (axes, dead) = match self {
            Self::Followed(axes) => (axes.len() as f64, axes.iter().filter(|axis| axis.died).count() as f64),
            Self::SeenOnce(seen) => seen.iter().fold((0.0, 0.0), |(n, dead), age| (n + age.axes, dead + age.dead)),
        };
        (axes, dead, ages.len())
    }

    /// The dead fraction at the last age, roughly.
    fn dead_at_last(&self) -> f64 {
        match self {
            Self::Followed(_) => self.totals().1 / self.totals().0,
            Self::SeenOnce(ages) => {
                let last = ages.iter().max_by(|a, b| a.age.total_cmp(&b.age));
                last.map_or(0.5, |age| age.dead / age.axes)
            }
        }
    }

    /// ln L of a cumulative hazard.
    pub fn log_likelihood(&self, cumulative: &dyn Fn(f64) -> f64) -> f64 {
        match self {
            Self::Followed(axes) => axes.iter().map(|axis| of_followed(*axis, cumulative)).sum(),
            Self::SeenOnce(ages) => ages.iter().map(|age| of_seen(*age, cumulative)).sum(),
        }
    }

    /// How many axes were observed.
    pub fn axes(&self) -> usize {
        self.totals().0 as usize
    }

    fn check(&self) -> Result<(), Problem> {
        let (axes, dead, ages) = self.totals();
        if axes <= 0.0 {
            return Err(Problem::TooFew { what: "axes", found: 0, needed: 1, purpose: "mortality" });
        }
        if dead <= 0.0 {
            let consequence = "no hazard can be estimated; follow them for longer";
            return Err(Problem::Degenerate {
                what: format!("none of {axes} axes died (all are censored)"),
                consequence,
            });
        }
        if ages == 0 {
            let consequence = "no hazard can be estimated; count older axes";
            return Err(Problem::Degenerate { what: "all axes were seen at age 0".to_owned(), consequence });
        }
        if matches!(self, Self::SeenOnce(_)) && dead >= axes {
            let consequence = "no hazard can be estimated; count younger axes";
            return Err(Problem::Degenerate { what: format!("all {axes} axes were dead"), consequence });
        }
        Ok(())
    }
}

/// A death in tick i has S(i − 1) − S(i), an axis alive after tick i has S(i).
fn of_followed(axis: Followed, cumulative: &dyn Fn(f64) -> f64) -> f64 {
    let total = cumulative(axis.age);
    if !axis.died {
        return -total;
    }
    let before = cumulative((axis.age - 1.0).max(0.0));
    -before + math::log((-math::expm1(before - total)).max(1e-300))
}

fn of_seen(age: SeenOnce, cumulative: &dyn Fn(f64) -> f64) -> f64 {
    let total = cumulative(age.age);
    let dead = (-math::expm1(-total)).max(1e-300);
    ln_choose(age.axes, age.dead) + x_ln_y(age.dead, dead) - (age.axes - age.dead) * total
}

/// Fits one law.
///
/// # Errors
/// Nothing died, everything was dead, or there are fewer different ages than parameters.
pub fn fit(observed: &Observed, hazard: Hazard) -> Result<Fit, Problem> {
    observed.check()?;
    let (_, dead, ages) = observed.totals();
    let parameters = hazard.parameters();
    if ages < parameters.len() {
        let (what, purpose) = ("different ages", hazard.words());
        return Err(Problem::TooFew { what, found: ages, needed: parameters.len(), purpose });
    }
    let log_likelihood = |at: &[f64]| observed.log_likelihood(&|age| hazard.cumulative(at, age));
    let n = if matches!(observed, Observed::SeenOnce(_)) { ages } else { dead as usize };
    let model = Model { law: hazard.words(), parameters: &parameters, log_likelihood: &log_likelihood, n };
    let mut fit = model.fit(&hazard.starts(observed.last(), observed.dead_at_last()))?;
    let at: Vec<f64> = fit.estimates.iter().map(|estimate| estimate.value).collect();
    fit.tests.extend(goodness(observed, hazard, &at));
    if matches!(hazard, Hazard::Power | Hazard::PowerAndConstant) {
        fit.estimates.push(Estimate::bare("alpha", math::exp(-at[1] * math::log(at[0]))));
    }
    if matches!(hazard, Hazard::PowerAndConstant | Hazard::GompertzAndConstant) && at[2] * observed.last() < 1e-6 {
        fit.notes.push("the constant hazard tends to 0: the law without it says the same".to_owned());
    }
    Ok(fit)
}

/// Fits all laws that have no more parameters than the data have ages, and chooses.
///
/// # Errors
/// No law can be fitted.
pub fn fit_all(observed: &Observed) -> Result<Choice, Problem> {
    observed.check()?;
    let mut fits = Vec::new();
    let mut refused = None;
    for hazard in HAZARDS {
        match fit(observed, hazard) {
            Ok(fit) => fits.push(fit),
            Err(problem) => refused = refused.or(Some(problem)),
        }
    }
    let advice = "count axes of more ages";
    choose(fits).ok_or_else(|| refused.unwrap_or(Problem::NoMaximum { law: "mortality", advice }))
}

/// Seen once: the dead and the living of each age. Followed: deaths in runs of ages with at least 5 expected.
fn goodness(observed: &Observed, hazard: Hazard, at: &[f64]) -> Option<Test> {
    let Observed::SeenOnce(ages) = observed else { return followed_goodness(observed, hazard, at) };
    let seen: Vec<&SeenOnce> = ages.iter().filter(|age| age.age > 0.0).collect();
    let df = seen.len().checked_sub(at.len()).filter(|df| *df > 0)?;
    let off = |age: &&SeenOnce| {
        let p = -math::expm1(-hazard.cumulative(at, age.age));
        let off = age.dead - age.axes * p;
        off * off / (age.axes * p * (1.0 - p)).max(1e-300)
    };
    Some(Test::chi2("dead at each age", seen.iter().map(off).sum(), df))
}

/// Deaths expected of those at risk in each tick, against those seen.
fn followed_goodness(observed: &Observed, hazard: Hazard, at: &[f64]) -> Option<Test> {
    let Observed::Followed(axes) = observed else { return None };
    let last = observed.last() as u32;
    let (mut cells, mut open) = (Vec::new(), (0.0, 0.0));
    for tick in (1..=last).map(f64::from) {
        let at_risk = axes.iter().filter(|axis| axis.age >= tick).count() as f64;
        let dead = axes.iter().filter(|axis| axis.died && axis.age == tick).count() as f64;
        let p = -math::expm1(hazard.cumulative(at, tick - 1.0) - hazard.cumulative(at, tick));
        open = (open.0 + dead, open.1 + at_risk * p);
        if open.1 >= 5.0 {
            cells.push(std::mem::take(&mut open));
        }
    }
    if let Some(cell) = cells.last_mut() {
        *cell = (cell.0 + open.0, cell.1 + open.1);
    }
    let df = cells.len().checked_sub(at.len()).filter(|df| *df > 0)?;
    Some(Test::chi2("deaths by age", cells.iter().map(|(o, e)| (o - e) * (o - e) / e).sum(), df))
}

/// α and β of 1 − exp(−α iᵝ) by least squares of the dead fractions, as the law of robusta coffee was published. Early
/// deaths have hardly any weight in it: for comparison, not for use.
pub fn least_squares(ages: &[SeenOnce]) -> (f64, f64) {
    let off = |at: &[f64]| {
        let of = |age: &SeenOnce| {
            let dead = -math::expm1(-Hazard::Power.cumulative(&[math::exp(at[0]), math::exp(at[1])], age.age));
            let off = age.dead / age.axes - dead;
            off * off
        };
        -1e6 * ages.iter().map(of).sum::<f64>()
    };
    let last = ages.iter().map(|age| age.age).fold(1.0, f64::max);
    let found = largest(&off, &[math::log(last), math::log(3.0)], 0.3);
    let (scale, shape) = (math::exp(found.at[0]), math::exp(found.at[1]));
    (math::exp(-shape * math::log(scale)), shape)
}
