//! The fates of axillary buds by rank: a figure a fate, with grown shares by zone, the law by rank, and measured
//! shoots.
//!
//! How many runs of equal fates a growth unit has tells whether neighbours are alike, which shares do not. Absent:
//! estimates (`phytomer_fits::branching`).

use super::homogeneity::{Outcome, homogeneity};
use super::stated::{self, Along, FatesByRank};
use super::{Axes, LEVEL, Told, ZONE, law, peak};
use phytomer_analysis::measure::distributions::{Fates, LATENT};
use phytomer_fits::branching::Shoots;
use phytomer_measures::Moments;
use phytomer_measures::quantile::chi2_above;
use phytomer_measures::ratio::Ratio;
use phytomer_measures::shares::Shares;
use phytomer_reports::{Axis, Cell, Mark, Point, Series};

pub fn tell(axes: &Axes, grown: &Fates, told: &mut Told) {
    let from_tip = !axes.asked.from_base;
    let along = Along { from_tip, ranks: grown.zones.len() * ZONE, latent: LATENT, branch: "branch" };
    let stated = axes.stated(|number, order, buds| stated::fates(number, order, &buds.states, along));
    if let Err(why) = &stated {
        told.words.push(format!("Fates of axillary buds of {}: the law is not drawn, for {why}.", axes.name));
    }
    let measured: Vec<(&str, Fates)> = axes.measured().filter_map(|of| of_shoots(of, &grown.words)).collect();
    let stated = stated.ok();
    let mut words: Vec<&String> = grown.words.iter().collect();
    let of_others = stated.iter().flat_map(FatesByRank::keys).chain(measured.iter().flat_map(|(_, of)| &of.words));
    for word in of_others {
        if !words.contains(&word) {
            words.push(word);
        }
    }
    for word in words {
        figure(axes, word, grown, stated.as_ref(), &measured, told);
    }
    runs(axes, "grown", grown, told);
    for (file, of) in &measured {
        runs(axes, &format!("measured, {file}"), of, told);
        let units = [of, grown].map(|of| (of.zones.iter().map(Shares::units).sum::<u64>() as f64, None));
        told.test("fates of axillary buds by zone", axes, units, by_zone(of, grown));
    }
}

fn figure(
    axes: &Axes,
    word: &str,
    grown: &Fates,
    stated: Option<&FatesByRank>,
    measured: &[(&str, Fates)],
    told: &mut Told,
) {
    // A single zone is a point, which a line would not show.
    let mark = if grown.zones.len() > 1 { Mark::Line } else { Mark::Points };
    let mut series = vec![of_zones("grown", mark, grown, word)];
    series.extend(stated.map(|stated| {
        let shares = stated.get(word).cloned().unwrap_or_default();
        law((1..).zip(shares).map(|(rank, share)| (f64::from(rank), share)))
    }));
    series.extend(measured.iter().map(|(file, of)| of_zones(&format!("measured, {file}"), Mark::Points, of, word)));
    // A fate that no bud has is no figure.
    if series.iter().flat_map(|series| &series.points).all(|point| point.y == 0.0) {
        return;
    }
    let end = if axes.asked.from_base { "base" } else { "tip" };
    let title = format!("Axillary buds of {} that are {word}, by rank", axes.name);
    let peaks: Vec<String> = series.iter().filter_map(peak).collect();
    let text = [
        title.clone(),
        format!(
            "{} growth units, in zones of {ZONE} ranks, with a band of plants; measured shoots with bars of shoots.",
            grown.units
        ),
        format!("{title} from the {end}, as a share of all buds there. {}.", peaks.join("; ")),
    ];
    let id: String = word.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    let across = Axis::of(&format!("rank from the {end}"), "");
    told.figure(format!("fates-{}-{id}", axes.id), text, [across, Axis::of("share of axillary buds", "")], series);
}

/// The shares of a fate in each zone, at the middle of its ranks.
fn of_zones(name: &str, mark: Mark, of: &Fates, word: &str) -> Series {
    let number = of.words.iter().position(|own| own == word);
    let point = |(zone, shares): (usize, &Shares)| {
        let middle = (zone * ZONE) as f64 + 0.5 * (ZONE + 1) as f64;
        let (share, interval) = match number {
            Some(number) => shares.share(number, LEVEL).ok()?,
            None => (0.0, None),
        };
        Some(Point { interval: interval.map(|of| [of.low, of.high]), ..Point::at(middle, share) })
    };
    Series { name: name.to_owned(), mark, points: of.zones.iter().enumerate().filter_map(point).collect() }
}

/// Measured shoots as the fates of grown ones; each shoot is taken for a plant.
fn of_shoots<'a>(of: &'a super::Measured, known: &[String]) -> Option<(&'a str, Fates)> {
    let phytomer_fits::data::Data::Branching(Shoots { shoots, .. }, own) = &of.data else { return None };
    let mut words = known.to_vec();
    for word in own {
        if !words.contains(word) {
            words.push(word.clone());
        }
    }
    let numbers: Vec<usize> = own.iter().map(|own| words.iter().position(|word| word == own).unwrap_or(0)).collect();
    let mut fates = Fates { words, zones: Vec::new(), units: shoots.len() as u64, runs: Ratio::default() };
    for shoot in shoots {
        let along: Vec<usize> = shoot.iter().map(|fate| numbers[*fate]).collect();
        fates.zones.resize(fates.zones.len().max(along.len().div_ceil(ZONE)), Shares::default());
        for (zone, buds) in fates.zones.iter_mut().zip(along.chunks(ZONE)) {
            let mut counts = vec![0; fates.words.len()];
            buds.iter().for_each(|fate| counts[*fate] += 1);
            zone.add(&counts);
        }
        let changes = along.windows(2).filter(|pair| pair[0] != pair[1]).count();
        fates.runs.add(&Moments::of(&[(1 + changes) as f64]));
    }
    Some((of.file.as_str(), fates))
}

/// A row of the table of runs.
fn runs(axes: &Axes, name: &str, of: &Fates, told: &mut Told) {
    let Ok(mean) = of.runs.mean(LEVEL) else { return };
    let interval = mean.estimate.ok().map(|estimate| [estimate.interval.low, estimate.interval.high].map(Cell::number));
    let [low, high] = interval.unwrap_or([Cell::Empty, Cell::Empty]);
    let units = Cell::number(mean.units as f64);
    told.runs.push(vec![
        Cell::words(axes.name.as_str()),
        Cell::words(name),
        units,
        Cell::number(mean.value),
        low,
        high,
    ]);
}

/// The sum over zones of the tests of their fates.
fn by_zone(measured: &Fates, grown: &Fates) -> Option<Outcome> {
    let counts = |of: &Fates, zone: usize| -> Vec<f64> {
        let Some(shares) = of.zones.get(zone) else { return Vec::new() };
        let share = |word: &String| of.words.iter().position(|own| own == word);
        let of_word =
            |word| share(word).and_then(|kind| shares.share(kind, LEVEL).ok()).map_or(0.0, |(share, _)| share);
        measured.words.iter().map(|word| of_word(word) * shares.units() as f64).collect()
    };
    let zones = (0..measured.zones.len()).filter_map(|zone| homogeneity(&counts(measured, zone), &counts(grown, zone)));
    let (statistic, df) = zones.fold((0.0, 0.0), |(statistic, df), of| (statistic + of.statistic, df + of.df));
    Some(Outcome { statistic, df, p: chi2_above(statistic, df).ok()? })
}
