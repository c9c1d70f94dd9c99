//! The distributions of a count before they are compiled to tables: each has a kind, and parameters that are laws.
//!
//! A count is one distribution or a mixture of several, each with a weight. Absent: thresholds and cells
//! (`count_table`), and the probabilities of each kind (`mass`).

use super::count::{CountForm, Simple};
use super::domain::Domain;
use super::form::check_intervals;
use super::formula::Formula;
use super::mass::{MAX_COUNT, Mass};
use super::range::ValueRange;
use crate::fault::{Fault, Path};

const MAX_COMPONENTS: usize = 64;

const WHOLE: ValueRange = ValueRange { min: 0.0, max: MAX_COUNT as f64, what: "a whole number" };
const MEAN: ValueRange = ValueRange { min: 0.0, max: MAX_COUNT as f64, what: "a mean" };
const SUCCESSES: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: f64::INFINITY, what: "a number of successes" };
const SUCCESS: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: 1.0, what: "a probability" };

enum Kind {
    Constant,
    Binomial,
    Poisson,
    NegativeBinomial,
    Empirical(Mass),
}

/// A distribution that is ready for evaluation: its parameters are laws.
pub(super) struct Source<'a> {
    /// Its share in a mixture.
    pub weight: f64,
    kind: Kind,
    /// Its parameters, in the order in which [`Source::mass`] takes them.
    pub parameters: Vec<Formula<'a>>,
    shift: u32,
    path: Path,
}

/// The distributions of a count: a single one, or the components of its mixture. Fails with every fault found.
pub(super) fn sources<'a>(form: &CountForm, domain: &'a Domain, path: &Path) -> Result<Vec<Source<'a>>, Vec<Fault>> {
    form.simple().check_kind(Some(form.mixture.is_some()), path).map_err(|fault| vec![fault])?;
    check_intervals(&form.interval, path).map_err(|fault| vec![fault])?;
    let Some(components) = &form.mixture else {
        return Ok(vec![Source::new(1.0, &form.simple(), None, domain, path)?]);
    };
    let path = path.key("mixture");
    if components.len() > MAX_COMPONENTS {
        let problem = format!("{} distributions in a mixture", components.len());
        return Err(vec![Fault::new(&path, problem, format!("at most {MAX_COMPONENTS}"))]);
    }
    let weights: Vec<f64> = components.iter().map(|component| component.weight).collect();
    let total = check_weights(&weights, &path, Some("weight"))?;
    let (mut sources, mut faults) = (Vec::new(), Vec::new());
    for (i, component) in components.iter().enumerate() {
        let path = path.index(i);
        let kind = component.simple().check_kind(None, &path).map_err(|fault| vec![fault]);
        let weight = component.weight / total;
        match kind.and_then(|()| Source::new(weight, &component.simple(), Some(form.shift), domain, &path)) {
            Ok(source) => sources.push(source),
            Err(more) => faults.extend(more),
        }
    }
    if faults.is_empty() { Ok(sources) } else { Err(faults) }
}

/// The sum of weights, each finite and at least 0 and not all 0. `key` is the key of a weight in its table, if any.
fn check_weights(weights: &[f64], path: &Path, key: Option<&str>) -> Result<f64, Vec<Fault>> {
    let mut faults = Vec::new();
    for (i, weight) in weights.iter().enumerate().filter(|(_, w)| !w.is_finite() || **w < 0.0).take(8) {
        let path = key.map_or(path.index(i), |key| path.index(i).key(key));
        faults.push(Fault::new(&path, format!("the weight is {weight}"), "a finite weight of at least 0"));
    }
    let total: f64 = weights.iter().sum();
    if faults.is_empty() && !(total > 0.0 && total.is_finite()) {
        faults.push(Fault::new(path, format!("the weights sum to {total}"), "a finite sum above 0"));
    }
    if faults.is_empty() { Ok(total) } else { Err(faults) }
}

/// `count` as a 32-bit number, or a fault where it is above [`MAX_COUNT`], the largest that a table holds.
pub(super) fn check_count(count: u64, path: &Path) -> Result<u32, Fault> {
    match u32::try_from(count) {
        Ok(count) if count <= MAX_COUNT => Ok(count),
        _ => Err(Fault::new(path, format!("counts up to {count}"), format!("counts of at most {MAX_COUNT}"))),
    }
}

impl<'a> Source<'a> {
    pub fn constant(number: u32, path: &Path) -> Result<Self, Vec<Fault>> {
        let number = check_count(u64::from(number), path).map_err(|fault| vec![fault])?;
        let kind = Kind::Empirical(Mass::point(number));
        Ok(Self { weight: 1.0, kind, parameters: Vec::new(), shift: 0, path: path.clone() })
    }

    /// The distribution with the given weights of 0, 1, 2 …
    pub fn of_weights(weights: &[f64], path: &Path) -> Result<Self, Vec<Fault>> {
        check_weights(weights, path, None)?;
        let kind = Kind::Empirical(Mass::weights(weights));
        Ok(Self { weight: 1.0, kind, parameters: Vec::new(), shift: 0, path: path.clone() })
    }

    /// The distribution that `simple` states; `outer` is the shift of the mixture of which it is a component.
    fn new(
        weight: f64,
        simple: &Simple,
        outer: Option<u32>,
        domain: &'a Domain,
        path: &Path,
    ) -> Result<Self, Vec<Fault>> {
        let shift = u64::from(simple.shift) + u64::from(outer.unwrap_or(0));
        let shift = check_count(shift, &path.key("shift")).map_err(|fault| vec![fault])?;
        let (kind, laws, path) = if let Some(law) = simple.constant {
            (Kind::Constant, vec![(law, path.key("constant"), WHOLE)], path.key("constant"))
        } else if let Some(b) = simple.binomial {
            let path = path.key("binomial");
            let p = (&b.p, path.key("p"), ValueRange::PROBABILITY);
            (Kind::Binomial, vec![(&b.n, path.key("n"), WHOLE), p], path)
        } else if let Some(poisson) = simple.poisson {
            let path = path.key("poisson");
            (Kind::Poisson, vec![(&poisson.mean, path.key("mean"), MEAN)], path)
        } else if let Some(n) = simple.negative_binomial {
            let path = path.key("negative_binomial");
            let laws = vec![(&n.r, path.key("r"), SUCCESSES), (&n.p, path.key("p"), SUCCESS)];
            (Kind::NegativeBinomial, laws, path)
        } else {
            let (weights, path) = (simple.empirical.unwrap_or(&[]), path.key("empirical"));
            check_weights(weights, &path, None)?;
            (Kind::Empirical(Mass::weights(weights)), Vec::new(), path)
        };
        let (mut parameters, mut faults) = (Vec::new(), Vec::new());
        for (law, path, range) in laws {
            match Formula::checked(law, domain, &path, &range, range == WHOLE) {
                Ok(formula) => parameters.push(formula),
                Err(more) => faults.extend(more),
            }
        }
        if faults.is_empty() { Ok(Self { weight, kind, parameters, shift, path }) } else { Err(faults) }
    }

    /// Of the lowest and the highest value of the parameter at `place`, the value with the largest counts; it is
    /// clamped to the range that the parameter may have.
    pub fn end(&self, place: usize, (low, high): (f64, f64)) -> f64 {
        let probability = |p: f64| p.clamp(SUCCESS.min, SUCCESS.max);
        match (&self.kind, place) {
            (Kind::NegativeBinomial, 1) => probability(low),
            (Kind::Binomial, 1) => probability(high),
            _ => high.clamp(0.0, f64::from(MAX_COUNT)),
        }
    }

    /// The probabilities of the distribution with the given values of its parameters.
    pub fn mass(&self, parameters: &[f64]) -> Result<Mass, Fault> {
        let mass = match (&self.kind, parameters) {
            (Kind::Constant, &[value]) => Some(Mass::point(value as u32)),
            (Kind::Binomial, &[n, p]) => Mass::binomial(n as u32, p),
            (Kind::Poisson, &[mean]) => Mass::poisson(mean),
            (Kind::NegativeBinomial, &[r, p]) => Mass::negative_binomial(r, p),
            (Kind::Empirical(mass), _) => Some(mass.clone()),
            _ => None,
        };
        let limit = || Fault::new(&self.path, "the counts are too large", format!("counts of at most {MAX_COUNT}"));
        let mut mass = mass.ok_or_else(limit)?;
        check_count(mass.first.into(), &self.path)?;
        mass.first += self.shift;
        Ok(mass)
    }
}
