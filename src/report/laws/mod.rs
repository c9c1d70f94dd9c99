//! Distributions: what grew, what its species states, and what was measured, in one figure each.
//!
//! Nodes per growth unit, the lives of apical buds and the fates of axillary buds, by the order of axes. Treatments of
//! a run are taken together. A law without one distribution, and a figure that would show one number, are told in
//! words. Absent: the counts of a run (`phytomer_analysis::measure::distributions`).

mod fates;
mod homogeneity;
mod lives;
pub mod measured;
mod nodes;
mod stated;

use super::{LEVEL, Reported, percent};
use homogeneity::Outcome;
use measured::Measured;
use phytomer_analysis::measure::distributions::{Distributions, Sought, distributions};
use phytomer_config::Model;
use phytomer_fits::data::Data;
use phytomer_models::buds::{Buds, Order};
use phytomer_reports::{Axis, Cell, Chart, Figure, Mark, Part, Plotted, Series, Table};

/// The ranks of a zone.
const ZONE: usize = 6;

/// How distributions are told.
#[derive(Debug, Clone, Default)]
pub struct Asked {
    /// What was measured.
    pub measured: Vec<Measured>,
    /// Whether ranks of buds are counted from the base of growth units, not from the tip.
    pub from_base: bool,
}

/// The axes of one order of a species of a run, and how they are named.
struct Axes<'a> {
    /// In titles: "order 2", with species and run where there are several.
    name: String,
    /// In the names of files.
    id: String,
    number: u32,
    /// Whether they grew; else they were measured.
    grows: bool,
    /// `None` where the species has no such order, or none at all.
    laws: Option<(&'a Buds, &'a Order)>,
    asked: &'a Asked,
}

/// The figures and tables of all runs.
pub fn parts(runs: &[Reported], asked: &Asked) -> Vec<Part> {
    let mut orders: Vec<u32> = of_fates(asked).map(|(order, ..)| order).collect();
    if orders.is_empty() {
        orders.push(1);
    }
    let sought = Sought { fates: orders, zone: ZONE, from_tip: !asked.from_base };
    let mut parts = Vec::new();
    for (place, reported) in runs.iter().enumerate() {
        match distributions(reported.run.path(), &sought) {
            Ok(found) => of_run(place, reported, runs.len() > 1, &found, asked, &mut parts),
            Err(fault) => parts.push(Part::Text(format!("{}: distributions are not told: {fault}.", reported.name))),
        }
    }
    parts
}

/// The measured shoots, with their orders and the words of their fates.
fn of_fates(asked: &Asked) -> impl Iterator<Item = (u32, &phytomer_fits::branching::Shoots, &[String])> {
    asked.measured.iter().filter_map(|of| match &of.data {
        Data::Branching(shoots, words) => Some((of.order, shoots, words.as_slice())),
        _ => None,
    })
}

fn of_run(
    place: usize,
    reported: &Reported,
    several: bool,
    found: &Distributions,
    asked: &Asked,
    parts: &mut Vec<Part>,
) {
    let mut told = Told::default();
    let species: std::collections::BTreeSet<&str> = found.lives.keys().map(|(species, _)| species.as_str()).collect();
    let axes = |name: &str, number: u32| {
        let laws = reported.species.iter().find(|one| one.about.name == name).and_then(|one| match &one.model {
            Model::Buds(buds) => Some((buds, buds.order.get(number.checked_sub(1)? as usize)?)),
            _ => None,
        });
        let of_species = if species.len() > 1 { format!(" of {name}") } else { String::new() };
        let of_run = if several { format!(", {}", reported.name) } else { String::new() };
        let id: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
        let id = if species.len() > 1 { format!("{id}-{number}") } else { number.to_string() };
        let id = if several { format!("{}-{id}", place + 1) } else { id };
        let grows = reported.trial.is_some();
        Axes { name: format!("order {number}{of_species}{of_run}"), id, number, grows, laws, asked }
    };
    for ((species, number, short), shares) in &found.nodes {
        nodes::tell(&axes(species, *number), *short, shares, &mut told);
    }
    if reported.trial.is_none() {
        told.words.push(format!("Of the buds of {}, which were not measured, nothing is told.", reported.name));
        return told.into_parts(parts);
    }
    for ((species, number), lives) in &found.lives {
        lives::tell(&axes(species, *number), lives, &mut told);
    }
    for ((species, number), fates) in &found.fates {
        fates::tell(&axes(species, *number), fates, &mut told);
    }
    for of in asked.measured.iter().filter(|of| !grows(found, of)) {
        told.words.push(format!(
            "{} has no axes of order {} that {} could be held against.",
            reported.name, of.order, of.file
        ));
    }
    told.into_parts(parts);
}

/// Whether something grew that measured data can be held against.
fn grows(found: &Distributions, of: &Measured) -> bool {
    match of.data {
        Data::Nodes(_) => found.nodes.keys().any(|(_, order, short)| *order == of.order && !short),
        Data::Mortality(_) => found.lives.keys().any(|(_, order)| *order == of.order),
        _ => found.fates.keys().any(|(_, order)| *order == of.order),
    }
}

/// What is told of a run: figures, then tables, then what there is no figure of.
#[derive(Default)]
struct Told {
    figures: Vec<Figure>,
    tests: Vec<Vec<Cell>>,
    runs: Vec<Vec<Cell>>,
    words: Vec<String>,
}

impl Told {
    fn into_parts(self, parts: &mut Vec<Part>) {
        parts.extend(self.figures.into_iter().map(Part::Figure));
        let table = |caption: &str, columns: &[&str], rows: Vec<Vec<Cell>>| {
            let columns = columns.iter().map(|name| (*name).to_owned()).collect();
            (!rows.is_empty()).then(|| Part::Table(caption.to_owned(), Table { columns, rows }))
        };
        let columns = ["what", "axes", "measured units", "measured mean", "grown units", "grown mean", "χ²", "df", "p"];
        let caption = "Measured units beside grown ones (Pearson's test of homogeneity, cells of at least 5 expected; units \
                       are taken as independent, and parameters that were fitted to the same units are not counted)";
        parts.extend(table(caption, &columns, self.tests));
        let columns = ["axes", "shoots", "units", "mean", "low", "high"];
        parts.extend(table("Runs of equal fates along a growth unit", &columns, self.runs));
        parts.extend((!self.words.is_empty()).then(|| Part::Text(self.words.join(" "))));
    }

    /// A row of the table of tests.
    fn test(&mut self, what: &str, axes: &Axes, means: [(f64, Option<f64>); 2], outcome: Option<Outcome>) {
        let mut row = vec![Cell::words(what), Cell::words(axes.name.as_str())];
        for (units, mean) in means {
            row.extend([Cell::number(units), mean.map_or(Cell::Empty, Cell::number)]);
        }
        let of = outcome.map(|Outcome { statistic, df, p }| [statistic, df, p]);
        row.extend(of.map_or([Cell::Empty, Cell::Empty, Cell::Empty], |of| of.map(Cell::number)));
        self.tests.push(row);
    }

    fn figure(&mut self, id: String, [title, caption, words]: [String; 3], [x, y]: [Axis; 2], series: Vec<Series>) {
        let plotted = Plotted::Chart(Chart { x, y, series });
        let caption = format!("{caption} Intervals are of {}.", percent(LEVEL));
        self.figures.push(Figure { id, title, caption, words, plotted });
    }
}

impl Axes<'_> {
    /// What their own units are called in a figure.
    fn own(&self) -> &'static str {
        if self.grows { "grown" } else { "of the run" }
    }

    /// What a species states of these axes.
    fn stated<T>(&self, law: impl Fn(u8, &Order, &Buds) -> Result<T, String>) -> Result<T, String> {
        let (buds, order) = self.laws.ok_or("its model states no laws of buds")?;
        law(u8::try_from(self.number).unwrap_or(u8::MAX), order, buds)
    }

    /// The measured data of this order.
    fn measured(&self) -> impl Iterator<Item = &Measured> {
        self.asked.measured.iter().filter(|of| of.order == self.number)
    }
}

/// The series of a law.
fn law(points: impl Iterator<Item = (f64, f64)>) -> Series {
    let points = points.map(|(x, y)| phytomer_reports::Point::at(x, y)).collect();
    Series { name: "law".to_owned(), mark: Mark::Dashed, points }
}

/// The word of a series in the words of a figure, with the place and the height of its peak.
fn peak(series: &Series) -> Option<String> {
    let top = series.points.iter().max_by(|a, b| a.y.total_cmp(&b.y))?;
    Some(format!("{}: at most {:.3}, at {}", series.name, top.y, top.x))
}
