//! Which of the productions of a module applies: the first that fits, or, where productions compete, a production that
//! is drawn.
//!
//! A weight that is not stated is 1, a weight below 0 is 0. Each production that fits is drawn with the probability of
//! its weight over the sum of the weights; where the sum is 0 no production applies.

use crate::code::{Rule, Rules};
use crate::evaluate::{Machine, Result};

/// Room for the variables of productions that are tried.
#[derive(Debug, Default)]
pub(crate) struct Frames {
    /// The variables of the production that applies.
    pub frame: Vec<f64>,
    kept: Vec<f64>,
    fitting: Vec<(u32, f64)>,
}

/// The production that applies; its variables are in `frames.frame`. `fits` tells whether a production's predecessor
/// and contexts are there, and binds their parameters.
#[inline]
pub(super) fn choose<'r>(
    rules: &'r Rules,
    candidates: &[u32],
    machine: &mut Machine<'_>,
    frames: &mut Frames,
    mut fits: impl FnMut(&Rule, &mut Machine<'_>, &mut [f64]) -> Result<bool>,
) -> Result<Option<&'r Rule>> {
    if rules.compete {
        return compete(rules, candidates, machine, frames, &mut fits);
    }
    for &candidate in candidates {
        let rule = &rules.rules[candidate as usize];
        if is_fit(rule, machine, &mut frames.frame, &mut fits)? {
            return Ok(Some(rule));
        }
    }
    Ok(None)
}

/// Whether a production applies.
#[inline]
fn is_fit(
    rule: &Rule,
    machine: &mut Machine<'_>,
    frame: &mut Vec<f64>,
    fits: &mut impl FnMut(&Rule, &mut Machine<'_>, &mut [f64]) -> Result<bool>,
) -> Result<bool> {
    machine.spend(rule.cost, rule.place, "the trials of productions")?;
    frame.clear();
    frame.resize(usize::from(rule.locals), 0.0);
    if !fits(rule, machine, frame)? {
        return Ok(false);
    }
    if !rule.before.is_empty() {
        machine.run(&rule.before, frame)?;
    }
    match &rule.condition {
        Some(condition) => Ok(machine.value(condition, frame)? != 0.0),
        None => Ok(true),
    }
}

fn compete<'r>(
    rules: &'r Rules,
    candidates: &[u32],
    machine: &mut Machine<'_>,
    frames: &mut Frames,
    fits: &mut impl FnMut(&Rule, &mut Machine<'_>, &mut [f64]) -> Result<bool>,
) -> Result<Option<&'r Rule>> {
    frames.fitting.clear();
    frames.kept.clear();
    let mut sum = 0.0;
    for &candidate in candidates {
        let rule = &rules.rules[candidate as usize];
        if !is_fit(rule, machine, &mut frames.frame, fits)? {
            continue;
        }
        let weight = match &rule.weight {
            Some(weight) => machine.value(weight, &frames.frame)?,
            None => 1.0,
        };
        if weight > 0.0 && weight.is_finite() {
            sum += weight;
            frames.fitting.push((candidate, weight));
            frames.kept.extend_from_slice(&frames.frame);
        }
    }
    let Some(chosen) = drawn(&frames.fitting, sum, machine) else { return Ok(None) };
    let locals = |number: u32| usize::from(rules.rules[number as usize].locals);
    let start = frames.fitting[..chosen].iter().map(|&(number, _)| locals(number)).sum::<usize>();
    let rule = &rules.rules[frames.fitting[chosen].0 as usize];
    frames.frame.clear();
    frames.frame.extend_from_slice(&frames.kept[start..start + usize::from(rule.locals)]);
    Ok(Some(rule))
}

/// The place of the production that is drawn. No draw is made for one alone.
fn drawn(fitting: &[(u32, f64)], sum: f64, machine: &mut Machine<'_>) -> Option<usize> {
    if fitting.len() <= 1 {
        return fitting.len().checked_sub(1);
    }
    let seed = machine.variables.seed;
    let mut left = machine.draws.uniform(seed) * sum;
    for (place, &(_, weight)) in fitting.iter().enumerate() {
        if left < weight {
            return Some(place);
        }
        left -= weight;
    }
    Some(fitting.len() - 1)
}
