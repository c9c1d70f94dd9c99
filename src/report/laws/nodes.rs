//! Nodes per growth unit: the shares of grown units as bars, the law as a broken line, measured units as points.
//!
//! Absent: units without nodes, which no table tells of.

use super::homogeneity::homogeneity;
use super::{Axes, LEVEL, Told, law, peak, stated};
use phytomer_fits::data::Data;
use phytomer_measures::proportion::wilson;
use phytomer_measures::shares::Shares;
use phytomer_reports::{Axis, Mark, Point, Series};

pub fn tell(axes: &Axes, short: bool, grown: &Shares, told: &mut Told) {
    let kind = if short { "short growth units" } else { "growth units" };
    let stated = axes.stated(|number, order, _| stated::nodes(number, order, short));
    // Field counts do not tell short units from long ones: they are held against the long ones.
    let measured: Vec<(&str, Vec<f64>)> = axes.measured().filter(|_| !short).filter_map(of_units).collect();
    let shares = shares_of(grown);
    if let Err(why) = stated.as_ref().map_err(String::as_str)
        && axes.grows
    {
        told.words.push(format!("Nodes of {kind} of {}: the law is not drawn, for {why}.", axes.name));
    }
    if let Some(only) = only(&shares).filter(|_| measured.is_empty()) {
        let nodes = if only == 1 { "node" } else { "nodes" };
        told.words.push(format!("Each of the {} {kind} of {} has {only} {nodes}.", grown.units(), axes.name));
        return;
    }
    let first = shares.iter().position(|share| *share > 0.0).unwrap_or(1);
    let mut series = vec![Series {
        name: axes.own().to_owned(),
        mark: Mark::Bars,
        points: shares.iter().enumerate().skip(first).map(|(nodes, share)| point(nodes, grown, *share)).collect(),
    }];
    series.extend(stated.ok().map(|law_of| {
        let seen = shares.len().max(measured.iter().map(|(_, counts)| counts.len()).max().unwrap_or(0));
        let told = |(nodes, share): &(usize, &f64)| (1..seen).contains(nodes) && (**share >= 1e-4 || *nodes >= first);
        law(law_of.iter().enumerate().filter(told).map(|(nodes, share)| (nodes as f64, *share)))
    }));
    for (file, counts) in &measured {
        series.push(of_counts(file, counts));
        let units: f64 = counts.iter().sum();
        let row: Vec<f64> = shares.iter().map(|share| share * grown.units() as f64).collect();
        let means = [(units, mean(counts)), (grown.units() as f64, mean(&row))];
        told.test("nodes per growth unit", axes, means, homogeneity(counts, &row));
    }
    let title = format!("Nodes of {kind} of {}", axes.name);
    let words: Vec<String> = series.iter().filter_map(peak).collect();
    let text = [
        title.clone(),
        format!(
            "{} units that have a node. The numbers of bars have intervals of plants; measured units have Wilson's, as if \
             they were independent.",
            grown.units()
        ),
        format!("{title}, as shares. {}.", words.join("; ")),
    ];
    let id = format!("nodes-{}{}", axes.id, if short { "-short" } else { "" });
    told.figure(id, text, [Axis::of("nodes of a growth unit", ""), Axis::of("share of growth units", "")], series);
}

fn of_units(of: &super::Measured) -> Option<(&str, Vec<f64>)> {
    match &of.data {
        // Those without nodes are not among the grown ones.
        Data::Nodes(counts) => {
            let mut counts = counts.clone();
            counts.iter_mut().take(1).for_each(|none| *none = 0.0);
            Some((of.file.as_str(), counts))
        }
        _ => None,
    }
}

fn shares_of(grown: &Shares) -> Vec<f64> {
    (0..grown.kinds()).map(|nodes| grown.share(nodes, LEVEL).map_or(0.0, |(share, _)| share)).collect()
}

/// The number of nodes that all units have.
fn only(shares: &[f64]) -> Option<usize> {
    shares.iter().position(|share| *share == 1.0)
}

fn point(nodes: usize, grown: &Shares, share: f64) -> Point {
    let interval = grown.share(nodes, LEVEL).ok().and_then(|(_, interval)| interval);
    Point { interval: interval.map(|of| [of.low, of.high]), ..Point::at(nodes as f64, share) }
}

fn of_counts(file: &str, counts: &[f64]) -> Series {
    let all: f64 = counts.iter().sum();
    let point = |(nodes, count): (usize, &f64)| {
        let interval = wilson(*count as u64, all as u64, LEVEL).ok().map(|of| [of.low, of.high]);
        Point { interval, ..Point::at(nodes as f64, count / all) }
    };
    let first = counts.iter().position(|count| *count > 0.0).unwrap_or(0);
    let points = counts.iter().enumerate().skip(first).map(point).collect();
    Series { name: format!("measured, {file}"), mark: Mark::Points, points }
}

fn mean(counts: &[f64]) -> Option<f64> {
    let all: f64 = counts.iter().sum();
    let sum: f64 = counts.iter().enumerate().map(|(nodes, count)| nodes as f64 * count).sum();
    (all > 0.0).then(|| sum / all)
}
