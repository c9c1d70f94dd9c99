//! Measure of life: survival by dimension in ticks, with the log-rank test between groups.
//!
//! S(t) = Π (1 − d/n) (Kaplan & Meier 1958); Greenwood's standard error takes lives as independent, that of plants and
//! the interval do not. Unit: share of lives. The design effect of a step is the ratio of both variances. Absent:
//! causes (`causes`).

use super::fault::Fault;
use super::groups::Groups;
use super::lives::{Living, keep};
use super::result::{Cells, Measured, Sheet};
use super::source::Source;
use super::stream::{each_plant, of_group};
use phytomer_measures::Lack;
use phytomer_measures::survival::{Curve, Lives, LogRank, kaplan_meier, log_rank, log_rank_of_plants};
use std::collections::BTreeSet;

/// The lives of each group.
pub(super) fn lives(living: Living, sources: &[Source], groups: &mut Groups) -> Result<Vec<Lives>, Fault> {
    let mut found: Vec<Lives> = Vec::new();
    for source in sources {
        each_plant(&living, source, groups, |of, own| keep(of_group(&mut found, of.group), of.plant, &own))?;
    }
    Ok(found)
}

/// Survival of each group.
pub(super) fn measure(living: Living, sources: &[Source], groups: &mut Groups, level: f64) -> Result<Measured, Fault> {
    let found = lives(living, sources, groups)?;
    let mut notes = BTreeSet::new();
    let mut curves = Sheet::new(
        "survival",
        &[
            ("group", ""),
            ("dimension", "tick"),
            ("at_risk", ""),
            ("ended", ""),
            ("censored", ""),
            ("hazard", "1/tick"),
            ("survival", ""),
            ("greenwood_se", ""),
            ("plant_se", ""),
            ("low", ""),
            ("high", ""),
            ("design_effect", ""),
        ],
    );
    let mut medians = Sheet::new(
        "median",
        &[
            ("group", ""),
            ("lives", ""),
            ("ended", ""),
            ("plants", ""),
            ("median", "tick"),
            ("low", "tick"),
            ("high", "tick"),
        ],
    );
    for (number, name) in groups.sorted() {
        let Some(lives) = found.get(number as usize).filter(|lives| !lives.is_empty()) else { continue };
        match kaplan_meier(lives, level) {
            Ok(curve) => {
                rows(&mut curves, name, &curve, &mut notes);
                medians.rows.push(median(name, lives, &curve, &mut notes));
            }
            Err(lack) => {
                notes.insert(format!("{name}: no survival: {lack}"));
            }
        }
    }
    if curves.rows.is_empty() {
        notes.insert(format!("no survival: {}", Lack::Empty));
    }
    let mut measured = Measured::of(vec![curves, medians]);
    if found.iter().filter(|lives| !lives.is_empty()).count() > 1 {
        measured.sheets.push(tests(&found, &mut notes));
    }
    measured.notes = notes;
    Ok(measured)
}

fn rows(sheet: &mut Sheet, name: &str, curve: &Curve, notes: &mut BTreeSet<String>) {
    if curve.clusters < 2 {
        notes.insert(format!("{name}: no interval: {}", Lack::Plants { found: curve.clusters, needed: 2 }));
    }
    for step in &curve.steps {
        let effect = step.greenwood.zip(step.of_plants).filter(|(independent, _)| *independent > 0.0);
        let row = Cells::of(name, notes).count(step.ticks).count(step.at_risk).count(step.ended).count(step.censored);
        let row = row.real(step.hazard).real(step.survival).maybe(step.greenwood).maybe(step.of_plants);
        let row = row.maybe(step.interval.map(|of| of.low)).maybe(step.interval.map(|of| of.high));
        sheet.rows.push(row.maybe(effect.map(|(a, b)| b * b / (a * a))).done());
    }
}

fn median(name: &str, lives: &Lives, curve: &Curve, notes: &mut BTreeSet<String>) -> Vec<super::result::Cell> {
    let mut row = Cells::of(name, notes).count(lives.len()).count(lives.ended()).count(curve.clusters);
    let found = curve.outlasted_by(0.5);
    if let Err(lack) = found {
        row.lack("median", lack);
    }
    let [low, high] = curve.interval_of(0.5);
    row.maybe_count(found.ok()).maybe_count(low).maybe_count(high).done()
}

fn tests(found: &[Lives], notes: &mut BTreeSet<String>) -> Sheet {
    let mut sheet =
        Sheet::new("log_rank", &[("test", ""), ("statistic", ""), ("df", ""), ("df_of_plants", ""), ("p", "")]);
    let groups: Vec<&Lives> = found.iter().collect();
    let of: [(&str, Result<LogRank, Lack>); 2] =
        [("of plants (T², F)", log_rank_of_plants(&groups)), ("as if lives were independent (χ²)", log_rank(&groups))];
    for (name, test) in of {
        let mut row = Cells::of(name, notes);
        match test {
            Ok(test) => {
                let row = row.real(test.statistic).count(test.df);
                let row = row.maybe_count(test.of_plants.map(|df| df as u32)).real(test.p);
                sheet.rows.push(row.done());
            }
            Err(lack) => row.lack("log-rank test", lack),
        }
    }
    sheet
}
