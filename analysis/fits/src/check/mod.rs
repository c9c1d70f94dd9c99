//! Whether a fit can be believed: refits of simulated data, a measure that was not fitted, and cross-validation.
//!
//! (a) Data of the same design are drawn from the law that was taken and fitted again: bias of each parameter, and how
//! often its interval holds the value that was drawn from (parametric bootstrap, Efron & Tibshirani 1993 §6.5). (b) A
//! measure that is no part of the fit is compared with those of the drawn data (Gelman, Meng & Stern 1996). (c) Parts
//! of the plants are left out in turn and predicted by the law of the others: the mean ln L of a left-out observation.
//! Absent: designs of unequal windows.

use crate::branching::chain::{self, Asked};
use crate::branching::{Shoots, zones};
use crate::crown;
use crate::data::Data;
use crate::draws::Draws;
use crate::fit::Fit;
use crate::mortality::{self, Followed, Hazard, Observed, SeenOnce};
use crate::nodes::{self, Family, Part, fit_mixture, fit_single};
use crate::outcome::Outcome;
use crate::special::proportion_interval;
use crate::{activity, nodes::laws::Counts};
use phytomer_sim::math;

/// What came of the refits for a parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Refitted {
    /// The parameter.
    pub name: String,
    /// The value that was drawn from.
    pub truth: f64,
    /// The mean of the refits less the truth.
    pub bias: f64,
    /// The standard error of the bias.
    pub error: f64,
    /// The share of intervals that hold the truth.
    pub coverage: f64,
    /// The exact 95 % interval of that share.
    pub within: [f64; 2],
}

/// A measure that was not fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct Predicted {
    /// The measure.
    pub name: &'static str,
    /// Of the data.
    pub measured: f64,
    /// Mean of the drawn data.
    pub mean: f64,
    /// The share of drawn data with at least the measured value.
    pub above: f64,
}

/// The check of a fit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Checked {
    /// Refits that could be made, of how many.
    pub refits: (usize, usize),
    /// Parameters.
    pub parameters: Vec<Refitted>,
    /// The measure that was not fitted.
    pub predicted: Option<Predicted>,
    /// Laws with the mean ln L of an observation that was left out; empty where the data are not divided.
    pub left_out: Vec<(String, f64)>,
}

/// The parts into which plants are divided.
const PARTS: usize = 5;

/// What is drawn and fitted again.
enum Design<'a> {
    Counts { n: usize, b: f64, ticks: f64, days: Option<f64> },
    Mortality { observed: &'a Observed, hazard: Hazard, at: Vec<f64> },
    Nodes { law: Counts, units: usize },
    Crown { pairs: &'a [crown::Pair], at: [f64; 3] },
}

/// Checks an outcome by so many refits; `None` for laws that are not drawn (waiting times, fates).
pub fn check(outcome: &Outcome, data: &Data, times: usize, seed: u64) -> Checked {
    let mut checked = Checked { left_out: left_out(data), ..Checked::default() };
    let Some(design) = design(outcome, data) else { return checked };
    let own = measure(data);
    let (mut fits, mut above, mut sum) = (Vec::new(), 0, 0.0);
    for time in 0..times {
        let drawn = design.draw(&mut Draws::new(seed, time as u64));
        if let Some((_, measured)) = own {
            let value = measure(&drawn).map_or(f64::NAN, |measure| measure.1);
            above += usize::from(value >= measured);
            sum += value;
        }
        fits.extend(design.refit(&drawn));
    }
    checked.refits = (fits.len(), times);
    checked.predicted = own.map(|(name, measured)| {
        let n = times.max(1) as f64;
        Predicted { name, measured, mean: sum / n, above: above as f64 / n }
    });
    checked.parameters = outcome.taken().estimates.iter().filter_map(|e| refitted(&e.name, e.value, &fits)).collect();
    checked
}

fn refitted(name: &str, truth: f64, fits: &[Fit]) -> Option<Refitted> {
    let found: Vec<_> = fits.iter().filter_map(|fit| fit.estimate(name)).collect();
    let n = found.len() as f64;
    if found.len() < 10 || found.iter().all(|e| e.low.is_none() && e.high.is_none()) {
        return None;
    }
    let bias = found.iter().map(|e| e.value - truth).sum::<f64>() / n;
    let variance = found.iter().map(|e| (e.value - truth - bias) * (e.value - truth - bias)).sum::<f64>() / (n - 1.0);
    let holds =
        found.iter().filter(|e| e.low.is_none_or(|low| low <= truth) && e.high.is_none_or(|high| truth <= high));
    let holds = holds.count() as f64;
    let within = proportion_interval(holds, n, 0.05);
    Some(Refitted { name: name.to_owned(), truth, bias, error: (variance / n).sqrt(), coverage: holds / n, within })
}

fn design<'a>(outcome: &Outcome, data: &'a Data) -> Option<Design<'a>> {
    let taken = outcome.taken();
    Some(match data {
        Data::Counts { nodes, days } => {
            Design::Counts { n: nodes.len(), b: taken.value("b"), ticks: taken.value("ticks"), days: *days }
        }
        Data::Mortality(observed) => {
            let hazard = mortality::HAZARDS.into_iter().find(|hazard| hazard.words() == taken.law)?;
            let at = taken.estimates.iter().map(|e| e.value).collect();
            Design::Mortality { observed, hazard, at }
        }
        Data::Nodes(counts) => Design::Nodes { law: law_of(taken)?, units: counts.iter().sum::<f64>() as usize },
        Data::Crown(pairs) => Design::Crown { pairs, at: ["b1", "b2", "w"].map(|name| taken.value(name)) },
        Data::Days(_) | Data::Branching(..) => return None,
    })
}

/// The law of counts by the names of its estimates.
fn law_of(fit: &Fit) -> Option<Counts> {
    let part = |mark: &str| {
        let of = |name: &str| fit.estimate(&format!("{name}{mark}")).map(|e| e.value);
        match (of("mean"), of("n"), of("r"), of("p")) {
            (Some(mean), ..) => Some(Part::Poisson { mean }),
            (_, Some(n), _, Some(p)) => Some(Part::Binomial { n: n as u32, p }),
            (_, _, Some(r), Some(p)) => Some(Part::NegativeBinomial { r, p }),
            _ => None,
        }
    };
    let shift = fit.estimate("shift").map_or(0, |shift| shift.value as u32);
    let parts = match fit.estimate("weight_1").map(|weight| weight.value) {
        Some(weight) => vec![(weight, part("_1")?), (1.0 - weight, part("_2")?)],
        None => vec![(1.0, part("")?)],
    };
    Some(Counts { parts, shift })
}

impl Design<'_> {
    fn draw(&self, draws: &mut Draws) -> Data {
        match self {
            // A part of a tick is a tick that some axes have.
            Self::Counts { n, b, ticks, days } => {
                let whole = ticks.floor();
                let ticks = |draws: &mut Draws| whole as u32 + u32::from(draws.happens(ticks - whole));
                let nodes = (0..*n).map(|_| {
                    let ticks = ticks(draws);
                    draws.binomial(ticks, *b)
                });
                Data::Counts { nodes: nodes.collect(), days: *days }
            }
            Self::Mortality { observed, hazard, at } => Data::Mortality(drawn_deaths(observed, *hazard, at, draws)),
            Self::Nodes { law, units } => {
                let masses = law.masses(4096);
                let mut counts = Vec::new();
                for _ in 0..*units {
                    let nodes = draws.among(&masses);
                    counts.resize(counts.len().max(nodes + 1), 0.0);
                    counts[nodes] += 1.0;
                }
                Data::Nodes(counts)
            }
            Self::Crown { pairs, at } => Data::Crown(crown::drawn(pairs, *at, draws)),
        }
    }

    /// The same law; `None` where the drawn data do not have it.
    fn refit(&self, drawn: &Data) -> Option<Fit> {
        match (self, drawn) {
            (Self::Counts { .. }, Data::Counts { nodes, days }) => {
                activity::counts::Moments::of(nodes).activity(*days).ok()
            }
            (Self::Mortality { hazard, .. }, Data::Mortality(observed)) => mortality::fit(observed, *hazard).ok(),
            (Self::Nodes { law, .. }, Data::Nodes(counts)) => same_law(law, counts).map(|fitted| fitted.1),
            (Self::Crown { .. }, Data::Crown(pairs)) => crown::fit(pairs).ok(),
            _ => None,
        }
    }
}

fn same_law(law: &Counts, counts: &[f64]) -> Option<nodes::laws::Fitted> {
    let families: Vec<Family> = law.parts.iter().map(|(_, part)| part.family()).collect();
    match families.as_slice() {
        [alone] => fit_single(counts, *alone, law.shift).ok(),
        [first, second] => fit_mixture(counts, [*first, *second]).ok(),
        _ => None,
    }
}

fn drawn_deaths(observed: &Observed, hazard: Hazard, at: &[f64], draws: &mut Draws) -> Observed {
    let dead_by = |age: f64| -math::expm1(-hazard.cumulative(at, age));
    match observed {
        Observed::SeenOnce(ages) => {
            let seen = |age: &SeenOnce| {
                let dead = draws.binomial(age.axes as u32, dead_by(age.age));
                SeenOnce { dead: f64::from(dead), ..*age }
            };
            Observed::SeenOnce(ages.iter().map(seen).collect())
        }
        Observed::Followed(axes) => {
            // What died is known to have been followed to the last age at least of those that did not.
            let last = axes.iter().map(|axis| axis.age).fold(0.0, f64::max);
            let life = |axis: &Followed| {
                let end = if axis.died { last } else { axis.age };
                let share = draws.share();
                let age = (1..=end as u32).map(f64::from).find(|age| dead_by(*age) > share);
                Followed { age: age.unwrap_or(end), died: age.is_some() }
            };
            Observed::Followed(axes.iter().map(life).collect())
        }
    }
}

/// A measure that no estimator uses.
fn measure(data: &Data) -> Option<(&'static str, f64)> {
    match data {
        Data::Counts { nodes, .. } => Some(("the largest number of nodes", f64::from(*nodes.iter().max()?))),
        Data::Mortality(Observed::Followed(axes)) => {
            let mut ages: Vec<f64> = axes.iter().filter(|axis| axis.died).map(|axis| axis.age).collect();
            ages.sort_by(f64::total_cmp);
            Some(("the median age of those that died", *ages.get(ages.len() / 2)?))
        }
        Data::Nodes(counts) => {
            let last = counts.iter().rposition(|count| *count > 0.0)?;
            Some(("the largest number of nodes", last as f64))
        }
        Data::Crown(pairs) => {
            let equal = pairs.iter().filter(|pair| pair.nodes[0] == pair.nodes[1]).count();
            Some(("the share of pairs of equal branches", equal as f64 / pairs.len() as f64))
        }
        Data::Mortality(Observed::SeenOnce(_)) | Data::Days(_) | Data::Branching(..) => None,
    }
}

/// Cross-validation by shoot, for fates, and by axis, for those followed.
fn left_out(data: &Data) -> Vec<(String, f64)> {
    match data {
        Data::Branching(shoots, _) if shoots.shoots.len() >= 2 * PARTS => of_shoots(shoots),
        Data::Mortality(Observed::Followed(axes)) if axes.len() >= 10 * PARTS => of_axes(axes),
        _ => Vec::new(),
    }
}

/// Those of a part, and the others.
fn divided<T: Clone>(all: &[T], part: usize) -> (Vec<T>, Vec<T>) {
    let of =
        |own: bool| all.iter().enumerate().filter(move |(k, _)| (k % PARTS == part) == own).map(|(_, x)| x.clone());
    (of(true).collect(), of(false).collect())
}

fn of_axes(axes: &[Followed]) -> Vec<(String, f64)> {
    let of = |hazard: Hazard| {
        let mut sum = 0.0;
        for part in 0..PARTS {
            let (own, others) = divided(axes, part);
            let fit = mortality::fit(&Observed::Followed(others), hazard).ok()?;
            let at: Vec<f64> = fit.estimates.iter().map(|e| e.value).collect();
            sum += Observed::Followed(own).log_likelihood(&|age| hazard.cumulative(&at, age));
        }
        Some((hazard.words().to_owned(), sum / axes.len() as f64))
    };
    mortality::HAZARDS.into_iter().filter_map(of).collect()
}

/// Zones of several widths and chains of several zones. A fate that a zone never had is given a thousandth.
fn of_shoots(shoots: &Shoots) -> Vec<(String, f64)> {
    let mut told = Vec::new();
    let buds = shoots.buds() as f64;
    let parts: Vec<(Shoots, Shoots)> = (0..PARTS)
        .map(|part| divided(&shoots.shoots, part))
        .map(|(own, others)| {
            (Shoots { fates: shoots.fates, shoots: own }, Shoots { fates: shoots.fates, shoots: others })
        })
        .collect();
    for width in [4, 6, 9] {
        let of = |(own, others): &(Shoots, Shoots)| zones::fit(others, width).0.log_likelihood(own);
        told.push((format!("zones of {width} ranks"), parts.iter().map(of).sum::<f64>() / buds));
    }
    for zones in [4, 6] {
        let of = |(own, others): &(Shoots, Shoots)| {
            let asked = Asked { zones, ends: None, seed: 1988, beginnings: 6 };
            chain::fit(others, &asked).map_or(f64::NAN, |(chain, _)| chain.softened().log_likelihood(own))
        };
        told.push((format!("chain of {zones} zones"), parts.iter().map(of).sum::<f64>() / buds));
    }
    told.retain(|told| told.1.is_finite());
    told
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::{Law, Table, columns, read};
    use crate::outcome::fit;
    use crate::wanted::Wanted;

    fn checked(law: Law, sample: &str, times: usize) -> Checked {
        let data = read(law, &Table::from_csv("t.csv", sample.as_bytes()).unwrap()).unwrap();
        let outcome = fit(law, &data, &Wanted::default()).unwrap();
        check(&outcome, &data, times, 1988)
    }

    fn sample(words: &str) -> &'static str {
        columns::LAWS.iter().find(|law| law.1 == words).unwrap().3
    }

    /// 200 refits: the coverage of 95 % lies within 4 errors, .015 each, of itself.
    #[test]
    fn refits_of_what_was_drawn_hold_the_truth() {
        for (law, words) in [(Law::Activity, "activity"), (Law::Mortality, "mortality, seen once")] {
            let checked = checked(law, sample(words), 200);
            assert!(checked.refits.0 >= 190, "{words}: {:?}", checked.refits);
            assert!(!checked.parameters.is_empty());
            for parameter in &checked.parameters {
                println!("{words}: {parameter:?}");
                assert!((parameter.coverage - 0.95).abs() <= 0.062, "{words}: {parameter:?}");
                assert!(parameter.within[0] <= parameter.coverage && parameter.coverage <= parameter.within[1]);
            }
        }
    }

    #[test]
    fn what_was_left_out_is_predicted_by_the_better_law() {
        let chains = checked(Law::Branching, sample("branching"), 0).left_out;
        println!("{chains:?}");
        let best = |words: &str| {
            let of = chains.iter().filter(|law| law.0.starts_with(words)).map(|law| law.1);
            of.fold(f64::NEG_INFINITY, f64::max)
        };
        assert!(best("chain") > best("zones"), "{chains:?}");
        assert_eq!(checked(Law::Mortality, sample("mortality, followed"), 0).left_out.len(), 5);
    }
}
