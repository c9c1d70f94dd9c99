//! `view` of a run of measured plants: one of them, some side by side, or all in their places, at the ages at which
//! they were measured.
//!
//! Absent: the page of them (`phytomer::run::measured`).

use super::super::budget::length;
use super::super::measured::Measured;
use super::super::span::Span;
use super::super::{Misuse, Verdict, amounts, out};
use super::View;
use anyhow::{Context, Result};
use phytomer::run::measured::MeasuredView;
use phytomer_outputs::Destination;
use phytomer_sim::Tick;
use std::collections::BTreeSet;
use std::path::Path;

/// Writes the page of the plants that are asked for.
pub fn obey(view: &View, measured: &Measured) -> Result<Verdict> {
    measured.refuse([("-D", !view.constants.is_empty())])?;
    let ages = ages(view.ages, measured)?;
    let (numbers, without) = numbers(view, measured, &ages)?;
    let name = Path::new(&measured.folder).file_name().map(|name| name.to_string_lossy().into_owned());
    let page = MeasuredView {
        plants: &measured.plants,
        name: name.unwrap_or_else(|| measured.shown()),
        numbers,
        in_places: view.plot.is_some(),
        ages: ages.iter().map(|age| (*age, measured.caption(*age))).collect(),
        tolerance: view.tolerance,
        detail: view.detail,
    };
    let mut file = Destination::create(&view.out)?;
    let page = page.page();
    let (plants, within) = (page.subjects.len() as u64, length(f64::from(page.tolerance)));
    let detail = view.detail_in_words(page.detail);
    page.write(&mut file).with_context(|| format!("cannot write {}", view.out.display()))?;
    let bytes = amounts::bytes(file.finish()? as f64);
    let (plants, ages) = (amounts::of(plants, "plant"), amounts::of(ages.len() as u64, "age"));
    out::tell(&view.out, &format!("{plants} as measured at {ages}{without}, within {within}{detail}, {bytes}"))?;
    Ok(Verdict::Done)
}

/// The ages of the page: those of the run within the span that is asked for.
fn ages(asked: Option<Span>, measured: &Measured) -> Result<Vec<Tick>, Misuse> {
    let ticks = measured.plants.ticks();
    let Some(span) = asked else { return Ok(ticks) };
    if span.step.is_some() {
        let told = "--ages: measured plants have the ages at which they were measured, and no step between them";
        return Err(Misuse(told.to_owned()));
    }
    let within = |tick: &&Tick| (span.first..=span.last).contains(&f64::from(**tick));
    let chosen: Vec<Tick> = ticks.iter().filter(within).copied().collect();
    if chosen.is_empty() {
        return Err(measured.no_age(&format!("--ages {}..{}", span.first, span.last)));
    }
    Ok(chosen)
}

/// The plants that are shown, and of a plot how many are not, in words.
fn numbers(view: &View, measured: &Measured, ages: &[Tick]) -> Result<(Vec<u32>, String), Misuse> {
    let drawn: BTreeSet<u32> = ages.iter().flat_map(|age| measured.plants.at(*age).into_keys()).collect();
    if let Some(plot) = view.plot {
        if plot > 0 {
            return Err(Misuse(format!("--plot {plot}: {} has one plot, 0", measured.shown())));
        }
        if drawn.is_empty() {
            return Err(measured.lacks(0));
        }
        let without = measured.plants.count() as usize - drawn.len();
        let told = if without == 0 { String::new() } else { format!(" ({without} without places are not drawn)") };
        return Ok((drawn.into_iter().collect(), told));
    }
    let asked = if view.plants.is_empty() { vec![view.plant] } else { view.plants.clone() };
    for (place, number) in asked.iter().enumerate() {
        if asked[..place].contains(number) {
            return Err(Misuse(format!("--plants: plant {number} is named twice")));
        }
        if !drawn.contains(number) {
            return Err(measured.lacks(*number));
        }
    }
    Ok((asked, String::new()))
}
