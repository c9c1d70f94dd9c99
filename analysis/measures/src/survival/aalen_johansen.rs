//! The share of lives that have ended by each cause, by duration (Aalen & Johansen 1978).
//!
//! F_k(t) = Σ S(s − 1) d_k(s) / n(s): with causes that compete, one minus the Kaplan–Meier curve of one cause is no
//! share of anything. The variance is that of plants, by the influence of each plant on F_k.

use super::kaplan_meier::log_log;
use super::lives::{Counts, Lives};
use crate::{Interval, Lack, quantile};

/// The share of lives ended by one cause up to a duration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Incidence {
    /// The number of the cause.
    pub cause: usize,
    /// The duration, ticks.
    pub ticks: u32,
    /// The lives that ended by the cause at this duration.
    pub ended: u64,
    /// The share of all lives that ended by the cause at this duration or before.
    pub share: f64,
    /// Its standard error, of plants; `None` with fewer than two plants.
    pub of_plants: Option<f64>,
    /// Its interval, of plants, by ln(−ln(1 − F)).
    pub interval: Option<Interval>,
}

/// The shares of lives ended by each cause, cause after cause, at the durations at which the cause ended a life, with
/// intervals of plants at `level`.
///
/// # Errors
/// [`Lack::Empty`] without lives, [`Lack::NoEvents`] where all are censored.
pub fn aalen_johansen(lives: &Lives, level: f64) -> Result<Vec<Incidence>, Lack> {
    match (lives.is_empty(), lives.ended()) {
        (true, _) => return Err(Lack::Empty),
        (_, 0) => return Err(Lack::NoEvents),
        _ => {}
    }
    let whole = lives.whole(lives.durations());
    let clusters = lives.clusters();
    let t = if clusters < 2 { None } else { Some(quantile::t_for(level, (clusters - 1) as f64)?) };
    let mut found = Vec::new();
    for cause in 0..lives.causes() {
        let errors = t.map(|_| errors_of_plants(lives, &whole, cause));
        let (mut survival, mut share) = (1.0, 0.0);
        for at in 0..whole.ended.len() {
            let ended = whole.by_cause[cause][at];
            share += if ended > 0.0 { survival * ended / whole.at_risk[at] } else { 0.0 };
            survival *= 1.0 - whole.hazard(at);
            if ended == 0.0 {
                continue;
            }
            let of_plants = errors.as_ref().map(|errors| errors[at]);
            let interval = of_plants.zip(t).and_then(|(error, t)| log_log(1.0 - share, t * error));
            let interval = interval.map(|of| Interval { low: 1.0 - of.high, high: 1.0 - of.low });
            found.push(Incidence { cause, ticks: at as u32, ended: ended as u64, share, of_plants, interval });
        }
    }
    Ok(found)
}

/// The standard errors of plants of the share ended by a cause, by duration.
fn errors_of_plants(lives: &Lives, whole: &Counts, cause: usize) -> Vec<f64> {
    let (durations, k) = (whole.ended.len(), lives.clusters() as f64);
    let mut squares = vec![0.0; durations];
    for table in lives.clusters.iter().filter(|table| !table.is_empty()) {
        let own = table.counts(durations, lives.causes());
        // The influences of the plant on the share, and on ln S before the duration.
        let (mut of_share, mut of_log, mut survival) = (0.0, 0.0, 1.0);
        for (at, square) in squares.iter_mut().enumerate() {
            let (n, hazard) = (whole.at_risk[at], whole.hazard(at));
            if n > 0.0 {
                let of_cause = whole.by_cause[cause][at] / n;
                let shift = (own.by_cause[cause][at] - own.at_risk[at] * of_cause) / n;
                of_share += survival * (of_log * of_cause + shift);
                of_log -=
                    if hazard < 1.0 { (own.ended[at] - own.at_risk[at] * hazard) / (n * (1.0 - hazard)) } else { 0.0 };
                survival *= 1.0 - hazard;
            }
            *square += of_share * of_share;
        }
    }
    squares.into_iter().map(|square: f64| (square * k / (k - 1.0)).sqrt()).collect()
}
