//! What a fit tells a person: the law that is taken with its intervals, its rivals, tests and notes.
//!
//! Absent: `fit.json`, which has all of it in numbers.

use phytomer_fits::check::Checked;
use phytomer_fits::outcome::Outcome;
use phytomer_fits::{Estimate, Fit, Test};
use std::fmt::Write as _;

/// The table for stdout.
pub fn table(outcome: &Outcome) -> String {
    let taken = outcome.taken();
    let mut text = format!("{}  (n {}{})\n", taken.law, taken.n, bic(taken));
    taken.estimates.iter().for_each(|estimate| line(&mut text, estimate));
    for (a, b, r) in taken.correlated() {
        let _ = writeln!(text, "  {a} and {b} are correlated: {r:.3}");
    }
    taken.tests.iter().chain(&outcome.tests).for_each(|test| tested(&mut text, test));
    let others = outcome.fits.iter().enumerate().filter(|(place, _)| *place != outcome.taken);
    for (place, fit) in others {
        let near = if place < outcome.rivals { "rival" } else { "other" };
        let _ = writeln!(text, "{near}: {}{}", fit.law, bic(fit));
    }
    if outcome.rivals > 1 {
        text.push_str("Laws within 2 of the least BIC are rivals; the one with the fewest parameters is taken.\n");
    }
    taken.notes.iter().for_each(|note| {
        let _ = writeln!(text, "note: {note}");
    });
    text.truncate(text.trim_end().len());
    text
}

fn bic(fit: &Fit) -> String {
    fit.bic().map_or_else(String::new, |bic| format!(", BIC {bic:.2}"))
}

fn line(text: &mut String, estimate: &Estimate) {
    let _ = write!(text, "  {:<14} {}", estimate.name, shown(estimate.value));
    let _ = match (estimate.low.map(shown), estimate.high.map(shown)) {
        (Some(low), Some(high)) => writeln!(text, "  (95 %: {low} to {high})"),
        (Some(low), None) => writeln!(text, "  (95 %: {low} or more)"),
        (None, Some(high)) => writeln!(text, "  (95 %: {high} or less)"),
        (None, None) => writeln!(text),
    };
}

/// Five decimals, or a power of ten for what is smaller than a thousandth.
fn shown(value: f64) -> String {
    if value == 0.0 || value.abs() >= 1e-3 { format!("{value:.5}") } else { format!("{value:.3e}") }
}

fn tested(text: &mut String, test: &Test) {
    let Test { name, statistic, df, p } = test;
    let _ = if *df > 0.0 {
        writeln!(text, "  {name}: χ² {statistic:.2}, {df} df, p {p:.3}")
    } else {
        writeln!(text, "  {name} {statistic:.1}")
    };
}

/// What came of `--check`.
pub fn checked(checked: &Checked) -> String {
    let (made, times) = checked.refits;
    let mut text = format!("check: {made} of {times} tables drawn from the law were fitted again\n");
    for p in &checked.parameters {
        let _ = write!(text, "  {:<14} bias {:+.5} ± {:.5}", p.name, p.bias, p.error);
        let _ = match p.coverage.map(|(share, limits)| (100.0 * share, limits.map(|limit| 100.0 * limit))) {
            Some((share, [low, high])) => {
                writeln!(text, "; intervals hold the truth in {share:.1} % (95 %: {low:.1} to {high:.1})")
            }
            None => writeln!(text),
        };
    }
    if let Some(measure) = &checked.predicted {
        let (measured, mean, above) = (measure.measured, measure.mean, 100.0 * measure.above);
        let _ = writeln!(
            text,
            "  not fitted: {} is {measured:.3}; {mean:.3} on average when drawn, as large or larger in {above:.1} %",
            measure.name
        );
    }
    for (law, mean) in &checked.left_out {
        let _ = writeln!(text, "  left out and predicted, mean ln L: {law} {mean:.4}");
    }
    text.truncate(text.trim_end().len());
    text
}
