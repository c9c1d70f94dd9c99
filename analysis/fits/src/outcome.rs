//! From the rows of a law to what is told of it: all rivals, the one that is taken, tests, and the keys of a species.
//!
//! Absent: files, and the species that the keys go to.

use crate::activity::counts::Moments;
use crate::activity::stationarity::{Window, stationarity};
use crate::activity::waiting::waiting;
use crate::branching::chain::{self, Asked};
use crate::branching::order::orders;
use crate::branching::runs::runs;
use crate::branching::{Shoots, zones};
use crate::choice::choose;
use crate::crown;
use crate::data::columns::{made, waits};
use crate::data::{Data, Law};
use crate::fit::{Fit, Test};
use crate::mortality;
use crate::nodes;
use crate::problem::Problem;
use crate::stated::{self, Stated};
use crate::wanted::Wanted;
use std::collections::BTreeMap;

/// What came of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// The law that was asked for; `None` for what was simulated.
    pub law: Option<Law>,
    /// All rivals in order of BIC.
    pub fits: Vec<Fit>,
    /// The place of the law that is taken.
    pub taken: usize,
    /// How many of the first are within 2 of the least BIC.
    pub rivals: usize,
    /// Tests of the data themselves.
    pub tests: Vec<Test>,
    /// The keys of a species.
    pub stated: Vec<Stated>,
}

impl Outcome {
    /// The law that is taken.
    pub fn taken(&self) -> &Fit {
        &self.fits[self.taken]
    }

    fn alone(law: Law, fit: Fit, stated: Vec<Stated>) -> Self {
        Self { law: Some(law), fits: vec![fit], taken: 0, rivals: 1, tests: Vec::new(), stated }
    }
}

/// The seed of what a fit draws.
const SEED: u64 = 1988;

/// Fits a law.
///
/// # Errors
/// What keeps it from being estimated.
pub fn fit(law: Law, data: &Data, wanted: &Wanted) -> Result<Outcome, Problem> {
    match data {
        Data::Counts { nodes, days } => {
            let fit = Moments::of(nodes).activity(*days)?;
            let stated = stated::activity(&fit, wanted);
            Ok(Outcome::alone(law, fit, stated))
        }
        Data::Days(axes) => of_days(law, axes, wanted),
        Data::Mortality(observed) => {
            let choice = mortality::fit_all(observed)?;
            let stated = stated::mortality(choice.taken(), observed.axes(), wanted);
            let (taken, rivals) = (choice.taken, choice.rivals);
            Ok(Outcome { law: Some(law), fits: choice.fits, taken, rivals, tests: Vec::new(), stated })
        }
        Data::Nodes(counts) => {
            let (laws, choice) = nodes::fit_all(counts)?;
            let stated = stated::nodes(&laws[choice.taken], choice.taken(), wanted);
            let (taken, rivals) = (choice.taken, choice.rivals);
            Ok(Outcome { law: Some(law), fits: choice.fits, taken, rivals, tests: Vec::new(), stated })
        }
        Data::Crown(pairs) => {
            let fit = crown::fit(pairs)?;
            let stated = stated::crown(&fit, wanted);
            Ok(Outcome::alone(law, fit, stated))
        }
        Data::Branching(shoots, words) => of_branching(law, shoots, words, wanted),
    }
}

/// Counts of a window, or waiting times; with the test of steady growth.
fn of_days(law: Law, axes: &[BTreeMap<u32, u32>], wanted: &Wanted) -> Result<Outcome, Problem> {
    let last = axes.iter().filter_map(|days| days.keys().next_back()).max().copied().unwrap_or(0);
    let fit = match wanted.window {
        Some((from, to)) => Moments::of(&made(axes, from, to)).activity(Some(f64::from(to.saturating_sub(from))))?,
        None => {
            let before = wanted.begun_before(axes);
            let mut fit = waiting(&waits(axes, before))?;
            fit.notes.push(format!("waits begun before day {before} of {last}"));
            fit
        }
    };
    let stated = stated::activity(&fit, wanted);
    let (from, to) = wanted.window.unwrap_or((0, last));
    let tick = (fit.value("days_per_tick").round() as u32).max(1);
    let test = steady(axes, from, to, tick);
    let mut outcome = Outcome::alone(law, fit, stated);
    match test {
        Ok(test) => {
            if test.p < 0.01 {
                let note = "growth was not steady over these days: there are seasons or stops; take a shorter window";
                outcome.fits[0].notes.push(note.to_owned());
            }
            outcome.tests.push(test);
        }
        Err(problem) => outcome.fits[0].notes.push(format!("whether growth was steady is not known: {problem}")),
    }
    Ok(outcome)
}

/// The nodes made in windows of a tick.
fn steady(axes: &[BTreeMap<u32, u32>], from: u32, to: u32, tick: u32) -> Result<Test, Problem> {
    let window = |start: u32| {
        let made = made(axes, start, start + tick);
        Window { axes: made.len() as f64, nodes: f64::from(made.iter().sum::<u32>()) }
    };
    let starts = (from..to.saturating_sub(tick - 1)).step_by(tick as usize);
    stationarity(&starts.map(window).collect::<Vec<_>>())
}

/// Zones of independent buds against a chain of zones, with the runs test of both and the Markov order.
fn of_branching(law: Law, shoots: &Shoots, words: &[String], wanted: &Wanted) -> Result<Outcome, Problem> {
    let (of_zones, mut zoned) = zones::fit(shoots, wanted.zone);
    let told = runs(shoots, SEED, 400, |buds, draws| of_zones.draw(buds, draws));
    zoned.tests.push(runs_test(&told));
    let ends = words.iter().position(|word| *word == wanted.latent);
    let mut fits = vec![zoned];
    let mut chains = Vec::new();
    for ends in if ends.is_some() { vec![ends, None] } else { vec![None] } {
        let asked = asked_chain(wanted, ends);
        if let Ok((chain, mut fit)) = chain::fit(shoots, &asked) {
            fit.law =
                if ends.is_some() { format!("{}, {} alone at both ends", fit.law, wanted.latent) } else { fit.law };
            let told = runs(shoots, SEED, 400, |buds, draws| chain.draw(buds, draws));
            fit.tests.push(runs_test(&told));
            chains.push((fit.law.clone(), chain));
            fits.push(fit);
        }
    }
    let advice = "ask for wider zones";
    let choice = choose(fits).ok_or(Problem::NoMaximum { law: "branching", advice })?;
    let (taken, rivals) = (choice.taken, choice.rivals);
    let of_chain = chains.iter().find(|(law, _)| *law == choice.taken().law);
    let stated = match of_chain {
        Some((_, chain)) => stated::chain(chain, shoots, words, wanted),
        None => stated::zones(&of_zones, shoots, words, wanted),
    };
    let mut outcome = Outcome { law: Some(law), fits: choice.fits, taken, rivals, tests: Vec::new(), stated };
    let notes = &mut outcome.fits[taken].notes;
    if let Some(best) = orders(shoots).ok().and_then(choose) {
        notes.push(format!("of Markov chains without zones the best is that of order {}", order_of(best.taken())));
    }
    Ok(outcome)
}

/// What is asked of a chain of zones.
pub(crate) fn asked_chain(wanted: &Wanted, ends: Option<usize>) -> Asked {
    Asked { zones: wanted.chain, ends, seed: SEED, beginnings: 20 }
}

fn order_of(fit: &Fit) -> &str {
    fit.law.rsplit(' ').next().unwrap_or("?")
}

fn runs_test(told: &crate::branching::runs::Runs) -> Test {
    let z = told.z();
    let name = format!("runs of equal fates: {}, expected {:.0} ± {:.0}; z", told.measured, told.mean, told.sd);
    Test { name, statistic: z, df: 0.0, p: 2.0 * crate::special::normal_below(-z.abs()) }
}
