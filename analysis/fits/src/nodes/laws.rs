//! The rivals of a histogram of nodes: single laws, shifted ones, mixtures; the choice among them.
//!
//! After EM the continuous parameters are brought to the top by the common search, which gives covariance and profile
//! intervals; the n of each binomial part has a profile of its own, over whole numbers, each with all else at its best.
//! Where the Poisson limit n → ∞ lies within the interval too, n has no upper limit, and the fit says so.

use super::mixture::{self, Asked, Mixture, log_likelihood};
use super::part::{Family, MOST_TRIALS, Part};
use crate::choice::{Choice, WITHIN, choose};
use crate::fit::{Estimate, Fit, Test};
use crate::likelihood::{Model, Scale};
use crate::problem::Problem;
use phytomer_sim::math;

/// Half the 95 % quantile of χ² with one degree of freedom.
const DROP: f64 = 1.920_729_410_347_062;
/// The pairs of families that are tried. Two negative binomials have no more to say than one with a Poisson.
pub const PAIRS: [[Family; 2]; 7] = [
    [Family::Poisson, Family::Poisson],
    [Family::Poisson, Family::Binomial],
    [Family::Binomial, Family::Poisson],
    [Family::Poisson, Family::NegativeBinomial],
    [Family::Binomial, Family::Binomial],
    [Family::Binomial, Family::NegativeBinomial],
    [Family::NegativeBinomial, Family::Binomial],
];

/// A fitted law of counts, as a species can state it.
#[derive(Debug, Clone, PartialEq)]
pub struct Counts {
    /// Weights and parts, the one of the lesser mean first.
    pub parts: Vec<(f64, Part)>,
    /// Added to what is drawn.
    pub shift: u32,
}

impl Counts {
    /// P(0), P(1) … P(last).
    pub fn masses(&self, last: usize) -> Vec<f64> {
        let mut masses = vec![0.0; last + 1];
        for (weight, part) in &self.parts {
            let own = part.masses(last.saturating_sub(self.shift as usize));
            masses.iter_mut().skip(self.shift as usize).zip(own).for_each(|(sum, mass)| *sum += weight * mass);
        }
        masses
    }

    /// The law as a formula.
    pub fn words(&self) -> String {
        let part = |(weight, part): &(f64, Part)| {
            if self.parts.len() == 1 { part.words() } else { format!("{weight:.3} {}", part.words()) }
        };
        let parts = self.parts.iter().map(part).collect::<Vec<_>>().join(" + ");
        if self.shift == 0 { parts } else { format!("{} + {parts}", self.shift) }
    }

    /// Its families, whatever their order, and whether it is shifted.
    fn kind(&self) -> (Vec<Family>, bool) {
        let mut families: Vec<Family> = self.parts.iter().map(|(_, part)| part.family()).collect();
        families.sort();
        (families, self.shift > 0)
    }

    fn parameters(&self) -> usize {
        let own: usize = self.parts.iter().map(|(_, part)| part.family().parameters()).sum();
        own + self.parts.len() - 1 + usize::from(self.shift > 0)
    }
}

/// A law with its fit.
pub type Fitted = (Counts, Fit);

/// The counts without the cells that are empty at the end.
fn checked(counts: &[f64]) -> Result<&[f64], Problem> {
    if let Some(found) = counts.iter().copied().find(|count| !(*count >= 0.0 && count.is_finite())) {
        return Err(Problem::Impossible { what: "a number of growth units".to_owned(), found, expected: "0 or more" });
    }
    let different = counts.iter().filter(|count| **count > 0.0).count();
    let last = counts.iter().rposition(|count| *count > 0.0);
    let units: f64 = counts.iter().sum();
    match last {
        None => Err(Problem::TooFew { what: "growth units", found: 0, needed: 2, purpose: "a law of nodes" }),
        Some(_) if units < 2.0 => {
            Err(Problem::TooFew { what: "growth units", found: 1, needed: 2, purpose: "a law of nodes" })
        }
        Some(last) if different == 1 => Err(Problem::Degenerate {
            what: format!("every growth unit has {last} nodes (V = 0)"),
            consequence: "a constant says it; no distribution can be fitted",
        }),
        Some(last) => Ok(&counts[..=last]),
    }
}

/// One family, with what is added to its numbers.
///
/// # Errors
/// No likelihood has a top: see [`Family::fitted`].
pub fn fit_single(counts: &[f64], family: Family, shift: u32) -> Result<Fitted, Problem> {
    let counts = checked(counts)?;
    let moved = &counts[(shift as usize).min(counts.len() - 1)..];
    let advice = "the counts vary no more than a Poisson number; a Poisson or a binomial says them";
    let part = family.fitted(moved, None).ok_or(Problem::NoMaximum { law: "a negative binomial", advice })?;
    polished(counts, Counts { parts: vec![(1.0, part)], shift })
}

/// A mixture of two families.
///
/// # Errors
/// EM ends with one part alone from every beginning.
pub fn fit_mixture(counts: &[f64], families: [Family; 2]) -> Result<Fitted, Problem> {
    let counts = checked(counts)?;
    let advice = "one part alone says the counts";
    polished(counts, of_two(counts, families).ok_or(Problem::NoMaximum { law: "a mixture", advice })?)
}

/// The best mixture, the part of the lesser mean first.
fn of_two(counts: &[f64], families: [Family; 2]) -> Option<Counts> {
    let mixture = nearby_trials(counts, mixture::fitted(counts, families)?);
    let mut parts = vec![(mixture.weight, mixture.parts[0]), (1.0 - mixture.weight, mixture.parts[1])];
    parts.sort_by(|a, b| a.1.mean().total_cmp(&b.1.mean()));
    Some(Counts { parts, shift: 0 })
}

/// EM may stay at an n beside the best: whole numbers next to each n are tried until none is better.
fn nearby_trials(counts: &[f64], start: Mixture) -> Mixture {
    let (mut best, mut value) = (start, start.log_likelihood(counts));
    let families = start.parts.map(Part::family);
    loop {
        let own = best.parts.map(trials);
        let steps = [(0, -1), (0, 1), (1, -1), (1, 1), (0, 4), (1, 4), (0, -4), (1, -4)];
        let moved = steps.iter().filter_map(|&(part, by)| {
            let mut trials = own;
            trials[part] = Some(own[part]?.checked_add_signed(by).filter(|n| (1..=MOST_TRIALS).contains(n))?);
            mixture::nearby(counts, Asked { families, trials }, &best)
        });
        match moved.max_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((better, mixture)) if better > value + 1e-5 => (best, value) = (mixture, better),
            _ => return best,
        }
    }
}

fn trials(part: Part) -> Option<u32> {
    if let Part::Binomial { n, .. } = part { Some(n) } else { None }
}

/// The parameters that are not whole numbers, with names.
fn named(law: &Counts) -> (Vec<(&'static str, Scale)>, Vec<f64>) {
    let (mut names, mut values) = (Vec::new(), Vec::new());
    let mut add = |name, scale, value| {
        names.push((name, scale));
        values.push(value);
    };
    let two = law.parts.len() > 1;
    if two {
        add("weight_1", Scale::Share, law.parts[0].0);
    }
    for (place, (_, part)) in law.parts.iter().enumerate() {
        let of = |alone, first, second| {
            if !two {
                alone
            } else if place == 0 {
                first
            } else {
                second
            }
        };
        match *part {
            Part::Poisson { mean } => add(of("mean", "mean_1", "mean_2"), Scale::Positive, mean),
            Part::Binomial { p, .. } => add(of("p", "p_1", "p_2"), Scale::Share, p),
            Part::NegativeBinomial { r, p } => {
                add(of("r", "r_1", "r_2"), Scale::Positive, r);
                add(of("p", "p_1", "p_2"), Scale::Share, p);
            }
        }
    }
    (names, values)
}

/// The law with other values of those parameters.
fn with(law: &Counts, values: &[f64]) -> Counts {
    let mut left = values.iter().copied();
    let mut next = || left.next().unwrap_or(f64::NAN);
    let weight = if law.parts.len() > 1 { next() } else { 1.0 };
    let weights = [weight, 1.0 - weight];
    let part = |(place, (_, part)): (usize, &(f64, Part))| {
        let part = match *part {
            Part::Poisson { .. } => Part::Poisson { mean: next() },
            Part::Binomial { n, .. } => Part::Binomial { n, p: next() },
            Part::NegativeBinomial { .. } => Part::NegativeBinomial { r: next(), p: next() },
        };
        (weights[place], part)
    };
    Counts { parts: law.parts.iter().enumerate().map(part).collect(), shift: law.shift }
}

/// Brings a law to the top of its likelihood, with covariance, intervals, the profile of n and the test.
fn polished(counts: &[f64], law: Counts) -> Result<Fitted, Problem> {
    let (names, values) = named(&law);
    let last = counts.len() - 1;
    let f = |at: &[f64]| log_likelihood(counts, &with(&law, at).masses(last));
    let units: f64 = counts.iter().sum();
    let model = Model { law: "a law of nodes", parameters: &names, log_likelihood: &f, n: units as usize };
    let mut fit = model.fit(std::slice::from_ref(&values))?;
    if law.parts.len() == 1 {
        // One part is at its top already: the search moves it by roundings alone.
        fit.estimates.iter_mut().zip(values).for_each(|(estimate, value)| estimate.value = value);
    }
    let at: Vec<f64> = fit.estimates.iter().map(|estimate| estimate.value).collect();
    let law = with(&law, &at);
    fit.law = law.words();
    fit.parameters = law.parameters();
    for (place, (_, part)) in law.parts.iter().enumerate() {
        if let Part::Binomial { n, .. } = *part {
            let name = if law.parts.len() == 1 { "n".to_owned() } else { format!("n_{}", place + 1) };
            let top = fit.log_likelihood.unwrap_or(f64::NAN);
            let (estimate, along) = profile(counts, &law, place, n, top);
            if estimate.high.is_none() {
                fit.notes.push(format!("{name} has no upper limit: a Poisson part says nearly as much"));
            }
            let share = name.replace('n', "p");
            fit.estimates.iter_mut().filter(|of| of.name == share).for_each(|of| widen(of, along, estimate.high));
            fit.estimates.push(Estimate { name, ..estimate });
        }
    }
    if law.shift > 0 {
        fit.estimates.push(Estimate::bare("shift", f64::from(law.shift)));
    }
    fit.tests.extend(goodness(counts, &law));
    Ok((law, fit))
}

/// The limits of the p of a binomial part, found at one n, with what p does along the profile of n; none below where n
/// has none above.
fn widen(share: &mut Estimate, along: [f64; 2], most: Option<f64>) {
    let wider = |limit: f64, end: f64| {
        let [at, off] = [limit - share.value, end - share.value];
        (at * at + off * off).sqrt()
    };
    let low = share.low.map(|low| (share.value - wider(low, along[0])).max(0.0)).filter(|_| most.is_some());
    let high = share.high.map(|high| (share.value + wider(high, along[1])).min(1.0));
    (share.low, share.high) = (low, high);
}

/// The n whose profile lies within the 95 % interval, each with all else at its best, and the least and the greatest p
/// among them.
fn profile(counts: &[f64], law: &Counts, place: usize, n: u32, top: f64) -> (Estimate, [f64; 2]) {
    let within = |value: f64| value >= top - DROP;
    let share = |law: &Counts| if let Part::Binomial { p, .. } = law.parts[place].1 { p } else { f64::NAN };
    let mut along = [share(law); 2];
    let mut walk = |ns: &mut dyn Iterator<Item = u32>| {
        let (mut last, mut reached) = (law.clone(), n);
        for n in ns {
            match held(counts, &last, place, Some(n)) {
                Some((value, found)) if within(value) => {
                    along = [along[0].min(share(&found)), along[1].max(share(&found))];
                    (last, reached) = (found, n);
                }
                _ => break,
            }
        }
        reached
    };
    let (low, high) = (walk(&mut (1..n).rev()), walk(&mut (n + 1..=MOST_TRIALS)));
    let endless = held(counts, law, place, None).is_some_and(|found| within(found.0));
    let high = (!endless && high < MOST_TRIALS).then_some(f64::from(high));
    (Estimate { name: String::new(), value: f64::from(n), error: None, low: Some(f64::from(low)), high }, along)
}

/// The largest ln L near a law with the n of one part held, or with a Poisson part in its place.
fn held(counts: &[f64], law: &Counts, place: usize, n: Option<u32>) -> Option<(f64, Counts)> {
    let family = |k: usize| if k == place && n.is_none() { Family::Poisson } else { law.parts[k].1.family() };
    if law.parts.len() == 1 {
        let moved = &counts[law.shift as usize..];
        let part = family(0).fitted(moved, n)?;
        return Some((part.log_likelihood(moved), Counts { parts: vec![(1.0, part)], shift: law.shift }));
    }
    let mut trials = [None; 2];
    trials[place] = n;
    let start = Mixture { weight: law.parts[0].0, parts: [law.parts[0].1, law.parts[1].1] };
    let (value, found) = mixture::nearby(counts, Asked { families: [family(0), family(1)], trials }, &start)?;
    let parts = vec![(found.weight, found.parts[0]), (1.0 - found.weight, found.parts[1])];
    Some((value, Counts { parts, shift: 0 }))
}

/// Pearson's χ² over cells of at least 5 expected.
fn goodness(counts: &[f64], law: &Counts) -> Option<Test> {
    let units: f64 = counts.iter().sum();
    let masses = law.masses(counts.len() - 1);
    let (mut cells, mut open, mut left): (Vec<(f64, f64)>, _, _) = (Vec::new(), (0.0, 0.0), units);
    for (count, mass) in counts.iter().zip(&masses) {
        open = (open.0 + count, open.1 + units * mass);
        if open.1 >= 5.0 && left - open.1 >= 5.0 {
            left -= open.1;
            cells.push(std::mem::take(&mut open));
        }
    }
    // The last cell has the whole tail.
    cells.push((open.0, left));
    let df = cells.len().checked_sub(1 + law.parameters()).filter(|df| *df > 0)?;
    Some(Test::chi2(
        "nodes, in cells of at least 5 expected",
        cells.iter().map(|(o, e)| (o - e) * (o - e) / e).sum(),
        df,
    ))
}

/// Every rival: the three families, shifted by up to the least count, and the mixtures. The laws are in the order of
/// the fits of the choice. Those beyond 2 of the least BIC have neither errors nor limits.
///
/// # Errors
/// Fewer than two growth units, or all of the same number of nodes.
pub fn fit_all(counts: &[f64]) -> Result<(Vec<Counts>, Choice), Problem> {
    let counts = checked(counts)?;
    let advice = "count more growth units";
    let units: f64 = counts.iter().sum();
    let mut laws: Vec<(f64, Counts)> = candidates(counts).into_iter().map(|law| brought_up(counts, law)).collect();
    let bic = |law: &(f64, Counts)| law.1.parameters() as f64 * math::log(units) - 2.0 * law.0;
    laws.sort_by(|a, b| bic(a).total_cmp(&bic(b)));
    // Of a pair of families EM may find two tops; the higher one is the pair's law.
    let mut seen = Vec::new();
    laws.retain(|law| {
        let kind = law.1.kind();
        !seen.contains(&kind) && {
            seen.push(kind);
            true
        }
    });
    let least = laws.first().map(bic).filter(|bic| bic.is_finite());
    let least = least.ok_or(Problem::NoMaximum { law: "nodes", advice })?;
    let fitted: Vec<Fitted> = laws
        .into_iter()
        .filter_map(
            |law| if bic(&law) <= least + WITHIN { polished(counts, law.1).ok() } else { Some(plain(units, law)) },
        )
        .collect();
    let choice = choose(fitted.iter().map(|fitted| fitted.1.clone()).collect());
    let choice = choice.ok_or(Problem::NoMaximum { law: "nodes", advice })?;
    let law_of = |fit: &Fit| fitted.iter().find(|fitted| fitted.1 == *fit).map(|fitted| fitted.0.clone());
    Ok((choice.fits.iter().filter_map(law_of).collect(), choice))
}

/// The laws as the M step and EM find them.
fn candidates(counts: &[f64]) -> Vec<Counts> {
    let least = counts.iter().position(|count| *count > 0.0).unwrap_or(0) as u32;
    let mut laws = Vec::new();
    for family in [Family::Poisson, Family::Binomial, Family::NegativeBinomial] {
        let shifted = |shift: u32| {
            let moved = &counts[shift as usize..];
            let part = family.fitted(moved, None)?;
            Some((part.log_likelihood(moved), Counts { parts: vec![(1.0, part)], shift }))
        };
        laws.extend(shifted(0).map(|law| law.1));
        // Of all shifts the best is the rival.
        let best = (1..=least).filter_map(shifted).max_by(|a, b| a.0.total_cmp(&b.0));
        laws.extend(best.map(|law| law.1));
    }
    laws.extend(PAIRS.iter().filter_map(|families| of_two(counts, *families)));
    laws
}

/// From where EM ended to the top.
fn brought_up(counts: &[f64], law: Counts) -> (f64, Counts) {
    let value = |law: &Counts| log_likelihood(counts, &law.masses(counts.len() - 1));
    if law.parts.len() == 1 {
        return (value(&law), law);
    }
    let (names, values) = named(&law);
    let f = |at: &[f64]| value(&with(&law, at));
    let model = Model { law: "a law of nodes", parameters: &names, log_likelihood: &f, n: 0 };
    match model.top(&[values]) {
        Ok((at, top)) => (top, with(&law, &at)),
        Err(_) => (f64::NEG_INFINITY, law),
    }
}

/// A law that is no rival: its numbers alone.
fn plain(units: f64, (top, law): (f64, Counts)) -> Fitted {
    let (names, values) = named(&law);
    let mut estimates: Vec<Estimate> =
        names.iter().zip(values).map(|((name, _), value)| Estimate::bare(name, value)).collect();
    estimates.extend((law.shift > 0).then(|| Estimate::bare("shift", f64::from(law.shift))));
    let fit = Fit {
        law: law.words(),
        estimates,
        covariance: Vec::new(),
        log_likelihood: Some(top),
        parameters: law.parameters(),
        n: units as usize,
        tests: Vec::new(),
        notes: Vec::new(),
    };
    (law, fit)
}
