//! Measures of treatments: contrasts with effect sizes, components of variance, and the plants that a difference needs.
//!
//! Plants of one number, replicate and run seed draw alike in every treatment, so their differences are pairs: what
//! differs comes of the treatment. Each level is held against the first; intervals are not adjusted for their number.
//! One value of each plant is in memory. Absent: the formulas (`phytomer_measures::contrast`, `variance`, `power`).

use super::fault::Fault;
use super::groups::{By, Groups, level as level_of};
use super::result::{Cells, Column, Measured, Sheet};
use super::sizes::{Size, each_value};
use super::source::Source;
use super::stream::of_group;
use phytomer_measures::Lack;
use phytomer_measures::contrast::{Contrast, paired, unpaired};
use phytomer_measures::moments::Moments;
use phytomer_measures::power::{Design, plants};
use phytomer_measures::variance::components;
use std::collections::{BTreeMap, BTreeSet};

/// What makes two plants a pair: the seed of the run, replicate, number, and the levels of the other factors.
type Pair = (u64, i32, u32, Vec<String>);

/// The values of the plants of each group, by pair.
type Values = Vec<BTreeMap<Pair, f64>>;

fn values(size: &Size, sources: &[Source], groups: &mut Groups) -> Result<Values, Fault> {
    let mut found = Values::new();
    let by = groups.by.clone();
    for source in sources {
        let others: Vec<Vec<String>> = (0..source.treatments.len() as u32).map(|of| others(source, of, &by)).collect();
        each_value(size, source, groups, |of, value| {
            let Some(plant) = source.plants.get((of.plant - source.first) as usize) else { return };
            let pair = (source.seed(), plant.replicate, plant.number, others[plant.treatment as usize].clone());
            of_group(&mut found, of.group).insert(pair, value);
        })?;
    }
    Ok(found)
}

/// The levels of the factors that the groups are not made by.
fn others(source: &Source, treatment: u32, by: &By) -> Vec<String> {
    let of = |factor: &String| level_of(source, treatment, factor);
    match by {
        By::Factor(own) => source.levels.keys().filter(|factor| *factor != own).map(of).collect(),
        By::Run => vec![source.treatments[treatment as usize].clone()],
        _ => Vec::new(),
    }
}

/// Moments of the differences of the plants that two groups share as pairs.
fn differences(first: &BTreeMap<Pair, f64>, second: &BTreeMap<Pair, f64>) -> Moments {
    let mut moments = Moments::default();
    for (pair, value) in second {
        if let Some(before) = first.get(pair) {
            moments.add(value - before);
        }
    }
    moments
}

fn moments_of(values: &BTreeMap<Pair, f64>) -> Moments {
    let mut moments = Moments::default();
    values.values().for_each(|value| moments.add(*value));
    moments
}

/// The groups that have values, in the order of their names.
fn named<'a>(found: &'a Values, groups: &'a Groups) -> Vec<(&'a str, &'a BTreeMap<Pair, f64>)> {
    let of = |(number, name)| Some((name, found.get(number as usize)?)).filter(|(_, values)| !values.is_empty());
    groups.sorted().into_iter().filter_map(of).collect()
}

/// Each level against the first.
pub(super) fn contrasts(size: &Size, sources: &[Source], groups: &mut Groups, level: f64) -> Result<Measured, Fault> {
    let found = values(size, sources, groups)?;
    let unit = size.unit;
    let columns: [Column; 11] = [
        ("contrast", ""),
        ("design", ""),
        ("n", ""),
        ("difference", unit),
        ("se", unit),
        ("low", unit),
        ("high", unit),
        ("p", ""),
        ("effect", ""),
        ("effect_low", ""),
        ("effect_high", ""),
    ];
    let (mut sheet, mut notes) = (Sheet::new("contrast", &columns), BTreeSet::new());
    let named = named(&found, groups);
    if named.len() < 2 {
        notes.insert(format!("no contrast: {}", Lack::Groups { found: named.len() as u64, needed: 2 }));
    }
    for (name, values) in named.iter().skip(1) {
        let (first, of) = (&named[0], format!("{name} − {}", named[0].0));
        let pairs = differences(first.1, values);
        let (a, b) = (moments_of(first.1), moments_of(values));
        for (design, n, contrast) in
            [("paired", pairs.n, paired(&pairs, level)), ("unpaired", a.n + b.n, unpaired(&a, &b, level))]
        {
            let row = Cells::of(&of, &mut notes).word(design).count(n);
            sheet.rows.push(in_cells(row, design, contrast));
        }
    }
    Ok(Measured { notes, ..Measured::of(vec![sheet]) })
}

fn in_cells(row: Cells<'_>, design: &str, contrast: Result<Contrast, Lack>) -> Vec<super::result::Cell> {
    let what = format!("{design} contrast");
    let row = row.estimate(&what, contrast.map(|of| of.difference.value));
    let difference = contrast.ok().map(|of| of.difference);
    let row = row.maybe(difference.map(|of| of.standard_error)).maybe(difference.map(|of| of.interval.low));
    let row = row.maybe(difference.map(|of| of.interval.high));
    let Ok(contrast) = contrast else { return row.maybe(None).maybe(None).maybe(None).maybe(None).done() };
    let row = row.maybe(contrast.p.ok()).estimate(&format!("{design} effect size"), contrast.effect.map(|of| of.value));
    let effect = contrast.effect.ok().map(|of| of.interval);
    row.maybe(effect.map(|of| of.low)).maybe(effect.map(|of| of.high)).done()
}

/// The variance between and within groups.
pub(super) fn variances(size: &Size, sources: &[Source], groups: &mut Groups, level: f64) -> Result<Measured, Fault> {
    let mut found: Vec<Moments> = Vec::new();
    for source in sources {
        each_value(size, source, groups, |of, value| of_group(&mut found, of.group).add(value))?;
    }
    let columns: [Column; 12] = [
        ("of", ""),
        ("groups", ""),
        ("plants", ""),
        ("variance_between", "unit²"),
        ("variance_within", "unit²"),
        ("share_between", ""),
        ("low", ""),
        ("high", ""),
        ("f", ""),
        ("df_between", ""),
        ("df_within", ""),
        ("p", ""),
    ];
    let (mut sheet, mut notes) = (Sheet::new("variance", &columns), BTreeSet::new());
    match components(&found, level) {
        Err(lack) => {
            notes.insert(format!("no components of variance: {lack}"));
        }
        Ok(of) => {
            let row = Cells::of(size.column, &mut notes).count(of.groups).count(of.n).real(of.between).real(of.within);
            let row = row.estimate("share between groups", of.intraclass);
            let row = row.maybe(of.interval.ok().map(|of| of.low)).maybe(of.interval.ok().map(|of| of.high));
            let row = row.estimate("F", of.f).count(of.df[0]).count(of.df[1]).maybe(of.p.ok());
            sheet.rows.push(row.done());
            if of.between < 0.0 {
                notes.insert("the variance between groups is negative: they differ less than chance lets them".into());
            }
        }
    }
    Ok(Measured { notes, ..Measured::of(vec![sheet]) })
}

/// The plants that a wanted difference needs, from the spread in these runs.
pub(super) fn needed(
    size: &Size,
    (sources, groups): (&[Source], &mut Groups),
    (wanted, power, level): (f64, f64, f64),
) -> Result<Measured, Fault> {
    let found = values(size, sources, groups)?;
    let unit = size.unit;
    let columns: [Column; 6] =
        [("of", ""), ("design", ""), ("plants_seen", ""), ("sd", unit), ("effect", ""), ("needed", "")];
    let (mut sheet, mut notes) = (Sheet::new("power", &columns), BTreeSet::new());
    let named = named(&found, groups);
    let mut within = Moments::default();
    for (name, values) in &named {
        let own = moments_of(values);
        within.merge(&own);
        row_of(&mut sheet, (name, &mut notes), (Design::Unpaired, &own), (wanted, power, level));
    }
    for (name, values) in named.iter().skip(1) {
        let of = format!("{name} − {}", named[0].0);
        let pairs = differences(named[0].1, values);
        row_of(&mut sheet, (&of, &mut notes), (Design::Paired, &pairs), (wanted, power, level));
    }
    if within.n == 0 {
        notes.insert(format!("no number of plants: {}", Lack::Empty));
    }
    notes.insert("needed: plants in each of two groups where unpaired, pairs where paired".to_owned());
    Ok(Measured { notes, ..Measured::of(vec![sheet]) })
}

fn row_of(
    sheet: &mut Sheet,
    (name, notes): (&str, &mut BTreeSet<String>),
    (design, of): (Design, &Moments),
    (wanted, power, level): (f64, f64, f64),
) {
    let deviation = of.standard_deviation().ok_or(Lack::Plants { found: of.n, needed: 2 });
    let effect = deviation.and_then(|sd| if sd > 0.0 { Ok(wanted / sd) } else { Err(Lack::NoVariance) });
    let needed = effect.and_then(|d| plants(design, d, power, 1.0 - level));
    let word = if design == Design::Paired { "paired" } else { "unpaired" };
    let row = Cells::of(name, notes).word(word).count(of.n).maybe(deviation.ok()).maybe(effect.ok());
    sheet.rows.push(row.estimate("number of plants", needed.map(|n| n as f64)).done());
}
