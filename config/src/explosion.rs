//! The growth explosion: a species that is expected to outgrow the limit of its scenario is refused before the first
//! tick.
//!
//! Absent: the expectation itself, which a growth model gives.

use phytomer_sim::expectation::Certainty;
use phytomer_sim::model::GrowthModel;

use crate::cohorts::Cohort;
use crate::document::Node;
use crate::load::{integer_at, path_of};
use crate::report::Fault;
use crate::scenario::Scenario;
use crate::species::Species;
use crate::trial::{Treatment, Trial};

/// A fault where a plant is expected to have more components than the scenario allows, since it would be cut off later.
/// The number is the exact expectation, or a lower bound of it for a species whose expectation has no closed form. An
/// estimate or an upper bound gives no fault; the limit then holds while the plant grows. `until` is the last age of
/// which the expectation tells, [`foreseen_until`].
pub(crate) fn fault_of(
    node: &Node,
    scenario: &Scenario,
    (species, model): (&Species, &dyn GrowthModel),
    until: u32,
) -> Option<Fault> {
    let (most, key) = (scenario.limits.components(), scenario.limits.binding());
    let means = model.expectation(until)?;
    let expected = means.least_components(until);
    if expected <= f64::from(most) {
        return None;
    }
    let set = integer_at(node, &["limits", key]).is_some();
    let path = path_of(&if set { ["limits", key] } else { ["ages", "until"] });
    let (name, expected, most) = (&species.about.name, in_words(expected), in_words(most.into()));
    let least = if means.certainty() == Certainty::Exact { "" } else { "at least " };
    let problem = format!(
        "the growth explodes: by age {until} a plant of `{name}` is expected to have {least}{expected} components"
    );
    let expected = format!("at most {most} (limits.{key}): an earlier last age, or fewer branches");
    Some(Fault::new(node.locate(&path), &path, problem, expected))
}

/// The last age of a cohort of the trial, by its index, up to which its model alone decides how it grows in some
/// treatment: a pest, or shade, may keep a plant small from the first tick on, obstacles that block too, and a cut from
/// its tick on. `None` where there is no such age.
pub(crate) fn foreseen_until(trial: &Trial, cohort: usize) -> Option<u32> {
    let Cohort { species, until, .. } = trial.cohorts().get(cohort)?;
    let of_treatment = |(place, treatment): (usize, &Treatment)| {
        trial.rows_of_cohorts(place).iter().any(|row| row.contains(&cohort)).then_some(())?;
        let own = treatment.species.iter().position(|known| known == species)?;
        let last = treatment.scenario.last_age_of_species(own).min(*until);
        let uncut = trial.first_cut(place).map_or(last, |first| last.min(first.saturating_sub(1)));
        let scenario = &treatment.scenario;
        let alone = scenario.pest.is_empty() && scenario.light.is_none() && !scenario.site.blocks_shoots();
        Some(uncut).filter(|uncut| *uncut > 0 && alone)
    };
    trial.treatments().iter().enumerate().filter_map(of_treatment).max()
}

/// A large number as text, such as "12 000" or "3.4e12".
fn in_words(x: f64) -> String {
    match x {
        x if x.is_nan() || x.is_infinite() => "more than can be counted".to_owned(),
        x if x >= 1e9 => format!("{x:.1e}"),
        x => {
            let digits = format!("{x:.0}");
            let mut out = String::new();
            for (i, digit) in digits.chars().enumerate() {
                if i > 0 && (digits.len() - i) % 3 == 0 {
                    out.push(' ');
                }
                out.push(digit);
            }
            out
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_numbers_are_readable() {
        assert_eq!(in_words(12_345_678.4), "12 345 678");
        assert_eq!(in_words(100.0), "100");
        assert_eq!(in_words(2.96e12), "3.0e12");
        assert_eq!(in_words(f64::INFINITY), "more than can be counted");
    }
}
