//! Activity from dates: the days between successive nodes of an axis.
//!
//! A bud grows at a tick with probability b, so k ticks pass between two nodes, P(k) = b (1 − b)^(k−1); the days are
//! k·tick with a normal jitter of variance k·sd². Days are counted whole, so a wait of w days has the probability of
//! (w − ½, w + ½); a wait that was still going on after c days that of more than c + ½. Absent: seasons, which
//! [`super::stationarity`] tests.

use crate::fit::{Fit, Test};
use crate::likelihood::{Model, Scale};
use crate::problem::Problem;
use crate::special::normal_below;
use phytomer_sim::math;

/// A wait between two nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wait {
    /// Whole days.
    pub days: f64,
    /// Whether it ended; a wait that did not is censored.
    pub ended: bool,
}

/// Ticks beyond which a wait has no weight: (1 − b)^k is then below 10⁻¹⁶ for any b above .3.
const MOST_TICKS: u32 = 110;
/// The fewest waits.
const FEWEST: usize = 10;

/// b, the days of a tick, and the standard deviation of the days of one tick.
///
/// # Errors
/// Fewer than 10 waits, all of them censored, or waits that are all equal.
pub fn waiting(waits: &[Wait]) -> Result<Fit, Problem> {
    let ended: Vec<f64> = waits.iter().filter(|wait| wait.ended).map(|wait| wait.days).collect();
    if ended.len() < FEWEST {
        let purpose = "activity from waiting times";
        return Err(Problem::TooFew { what: "waits that ended", found: ended.len(), needed: FEWEST, purpose });
    }
    if ended.iter().all(|days| *days == ended[0]) {
        let consequence = "the spread of a tick cannot be estimated; use the counts of nodes instead";
        return Err(Problem::Degenerate { what: format!("every wait took {} days", ended[0]), consequence });
    }
    let counted = counted(waits);
    let log_likelihood = |at: &[f64]| log_likelihood(&counted, at);
    let parameters = [("b", Scale::Share), ("days_per_tick", Scale::Positive), ("sd", Scale::Positive)];
    let model = Model {
        law: "activity, from waiting times",
        parameters: &parameters,
        log_likelihood: &log_likelihood,
        n: waits.len(),
    };
    let middle = median(&ended);
    let starts = [0.9, 0.6].map(|b| vec![b, middle, (middle / 6.0).max(0.5)]);
    let mut fit = model.fit(&starts)?;
    fit.tests.extend(goodness(&counted, &fit));
    let censored = waits.len() - ended.len();
    fit.notes.push(format!("{} waits, {censored} of them censored", waits.len()));
    Ok(fit)
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[sorted.len() / 2].max(1.0)
}

/// Equal waits with their number.
fn counted(waits: &[Wait]) -> Vec<(Wait, f64)> {
    let mut sorted = waits.to_vec();
    sorted.sort_by(|a, b| a.ended.cmp(&b.ended).then(a.days.total_cmp(&b.days)));
    let mut counted: Vec<(Wait, f64)> = Vec::new();
    for wait in sorted {
        match counted.last_mut() {
            Some((last, number)) if *last == wait => *number += 1.0,
            _ => counted.push((wait, 1.0)),
        }
    }
    counted
}

/// The probability of at most `days` days.
fn below(days: f64, at: &[f64]) -> f64 {
    let (b, tick, sd) = (at[0], at[1], at[2]);
    let (mut sum, mut weight) = (0.0, b);
    for k in (1..=MOST_TICKS).map(f64::from) {
        sum += weight * normal_below((days - k * tick) / (sd * k.sqrt()));
        weight *= 1.0 - b;
        if weight < 1e-13 {
            break;
        }
    }
    sum
}

/// ln L of waits at b, the days of a tick and the deviation.
pub(crate) fn log_likelihood_of(waits: &[Wait], at: &[f64]) -> f64 {
    log_likelihood(&counted(waits), at)
}

fn log_likelihood(counted: &[(Wait, f64)], at: &[f64]) -> f64 {
    let (mut sum, mut last) = (0.0, (f64::NAN, 0.0));
    for (wait, number) in counted {
        // The upper limit of a day is the lower one of the next.
        let lower = if wait.days - 0.5 == last.0 { last.1 } else { below(wait.days - 0.5, at) };
        last = (wait.days + 0.5, below(wait.days + 0.5, at));
        let probability = if wait.ended { last.1 - lower } else { 1.0 - last.1 };
        sum += number * math::log(probability.max(1e-300));
    }
    sum
}

/// The waits that ended, in cells of at least 5 expected, against those of the law.
fn goodness(counted: &[(Wait, f64)], fit: &Fit) -> Option<Test> {
    let at: Vec<f64> = fit.estimates.iter().map(|estimate| estimate.value).collect();
    let ended: Vec<&(Wait, f64)> = counted.iter().filter(|(wait, _)| wait.ended).collect();
    let all: f64 = ended.iter().map(|(_, number)| number).sum();
    let last = ended.last()?.0.days as u32;
    let (mut cells, mut observed, mut from) = (Vec::new(), 0.0, 0.0);
    for day in 0..=last {
        let here = ended.iter().filter(|(wait, _)| wait.days == f64::from(day)).map(|(_, number)| number);
        observed += here.sum::<f64>();
        let to = below(f64::from(day) + 0.5, &at);
        if all * (to - from) >= 5.0 && all * (1.0 - to) >= 5.0 {
            cells.push((observed, all * (to - from)));
            (observed, from) = (0.0, to);
        }
    }
    cells.push((observed, all * (1.0 - from)));
    let df = cells.len().checked_sub(1 + at.len()).filter(|df| *df > 0)?;
    let statistic = cells.iter().map(|(o, e)| (o - e) * (o - e) / e).sum();
    Some(Test::chi2("waits by days, in cells of at least 5 expected", statistic, df))
}
