//! The product-limit estimate of survival (Kaplan & Meier 1958) with Greenwood's variance (1926) and that of plants.
//!
//! S(t) = Π (1 − d/n); Greenwood: Var ln S = Σ d / (n (n − d)), for independent lives. Of plants: the influence of a
//! plant on ln S is −Σ (d_p − n_p h) / (n (1 − h)), and the variance k/(k − 1) times the sum of their squares over k
//! plants; where each life is a plant that is Greenwood's but for k/(k − 1). Intervals are those of ln(−ln S)
//! (Kalbfleisch & Prentice 2002, §1.4), of plants with Student's t. Not to be read where few are at risk.

use super::lives::{Counts, Lives};
use crate::{Interval, Lack, quantile};
use phytomer_sim::math::{exp, log};

/// What a product of shares may lie above its exact value: a survival of one half is at the median.
const ROUNDING: f64 = 1e-12;

/// One duration of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// The duration, ticks.
    pub ticks: u32,
    /// The lives at risk: those that lasted as long or longer.
    pub at_risk: u64,
    /// The lives that ended at this duration.
    pub ended: u64,
    /// The lives that were censored at this duration.
    pub censored: u64,
    /// The share of the lives at risk that ended.
    pub hazard: f64,
    /// The share of lives that last longer.
    pub survival: f64,
    /// Greenwood's standard error of the survival; `None` once nothing survives.
    pub greenwood: Option<f64>,
    /// The standard error of plants; `None` with fewer than two plants, and once nothing survives.
    pub of_plants: Option<f64>,
    /// The interval of plants.
    pub interval: Option<Interval>,
}

/// Survival by duration.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The durations at which a life ended or was censored.
    pub steps: Vec<Step>,
    /// The number of clusters of plants behind the intervals.
    pub clusters: u64,
}

/// Survival of lives by duration, with intervals of plants at `level`.
///
/// # Errors
/// [`Lack::Empty`] without lives; [`Lack::OutOfRange`] where the level is not between 0 and 1.
pub fn kaplan_meier(lives: &Lives, level: f64) -> Result<Curve, Lack> {
    if lives.is_empty() {
        return Err(Lack::Empty);
    }
    let (whole, clusters) = (lives.whole(lives.durations()), lives.clusters());
    let t = match clusters {
        0 | 1 => None,
        clusters => Some(quantile::t_for(level, (clusters - 1) as f64)?),
    };
    let of_plants = variances_of_plants(lives, &whole);
    let (mut steps, mut survival, mut greenwood) = (Vec::new(), 1.0, 0.0);
    for at in 0..whole.ended.len() {
        let (n, d) = (whole.at_risk[at], whole.ended[at]);
        survival *= 1.0 - whole.hazard(at);
        greenwood += if n > d { d / (n * (n - d)) } else { 0.0 };
        if d + whole.censored[at] == 0.0 {
            continue;
        }
        let variance = of_plants.as_ref().map(|variances| variances[at]).filter(|_| survival > 0.0);
        steps.push(Step {
            ticks: at as u32,
            at_risk: n as u64,
            ended: d as u64,
            censored: whole.censored[at] as u64,
            hazard: whole.hazard(at),
            survival,
            greenwood: (survival > 0.0).then(|| survival * greenwood.sqrt()),
            of_plants: variance.map(|variance| survival * variance.sqrt()),
            interval: variance.zip(t).and_then(|(variance, t)| log_log(survival, t * survival * variance.sqrt())),
        });
    }
    Ok(Curve { steps, clusters })
}

/// The interval of a share by ln(−ln S), from a half width on the scale of the share; `None` where the share is 0 or 1.
pub(super) fn log_log(share: f64, half: f64) -> Option<Interval> {
    if !(share > 0.0 && share < 1.0) {
        return None;
    }
    let loss = -log(share);
    let half = half / (share * loss);
    Some(Interval { low: exp(-loss * exp(half)), high: exp(-loss * exp(-half)) })
}

/// The variances of ln S of plants by duration; `None` with fewer than two plants.
fn variances_of_plants(lives: &Lives, whole: &Counts) -> Option<Vec<f64>> {
    let k = lives.clusters() as f64;
    if k < 2.0 {
        return None;
    }
    let mut squares = vec![0.0; whole.ended.len()];
    for table in lives.clusters.iter().filter(|table| !table.is_empty()) {
        let own = table.counts(whole.ended.len(), lives.causes());
        let mut influence = 0.0;
        for (at, square) in squares.iter_mut().enumerate() {
            let (n, hazard) = (whole.at_risk[at], whole.hazard(at));
            if hazard < 1.0 && n > 0.0 {
                influence += (own.ended[at] - own.at_risk[at] * hazard) / (n * (1.0 - hazard));
            }
            *square += influence * influence;
        }
    }
    Some(squares.into_iter().map(|square| square * k / (k - 1.0)).collect())
}

impl Curve {
    /// The step of the longest duration up to `ticks`; `None` before the first.
    pub fn at(&self, ticks: u32) -> Option<&Step> {
        self.steps.iter().take_while(|step| step.ticks <= ticks).last()
    }

    /// The shortest duration that at most the share `share` of the lives outlasts: the median for a share of one half.
    ///
    /// # Errors
    /// [`Lack::NotReached`] where more survive at the end.
    pub fn outlasted_by(&self, share: f64) -> Result<u32, Lack> {
        self.steps.iter().find(|step| step.survival <= share + ROUNDING).map(|step| step.ticks).ok_or(Lack::NotReached)
    }

    /// The ends of the interval of [`Curve::outlasted_by`]: the durations at which the interval of survival begins and
    /// ceases to hold the share (Brookmeyer & Crowley 1982); an end is `None` where it is not reached.
    pub fn interval_of(&self, share: f64) -> [Option<u32>; 2] {
        let first = |below: &dyn Fn(&Step) -> Option<bool>| {
            self.steps.iter().find(|step| below(step).unwrap_or(step.survival <= 0.0)).map(|step| step.ticks)
        };
        let low = first(&|step| step.interval.map(|interval| interval.low <= share));
        let high = first(&|step| step.interval.map(|interval| interval.high <= share));
        if self.clusters < 2 { [None, None] } else { [low, high] }
    }
}
