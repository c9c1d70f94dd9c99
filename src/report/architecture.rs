//! The architecture of plants, by the measures of `phytomer measure`: how long axes live, activity and nodes by order,
//! branching, and where the leaf area is.
//!
//! A measure that a run cannot give, for want of a table or of an end, is told with its reason. Absent: the measures
//! themselves (`phytomer_analysis::measure`).

use super::{LEVEL, Reported, percent};
use phytomer_analysis::measure::{Asked, Cell as Found, MEASURES, Measured, Sheet, measure};
use phytomer_reports::{Axis, Cell, Chart, Figure, Mark, Part, Plotted, Point, Series, Table};

/// The measures that are told as tables: the name, what it is grouped by, and the words above it.
const TABLES: [(&str, Option<&str>, &str); 3] = [
    ("activity", Some("order"), "Share of clock steps at which living buds grew, by order"),
    ("nodes-per-unit", Some("order"), "Nodes per growth unit, by order"),
    ("branching", None, "Axes for one of the order before, and Strahler's ratio"),
];

/// The measures of which measured plants have none: no file tells when what is not in it any more has died.
const OF_GROWTH: [&str; 2] = ["axis-life", "activity"];

/// The figures and tables of all runs.
pub fn parts(runs: &[Reported]) -> Vec<Part> {
    let lives = gathered(runs, "axis-life", Some("order"), |sheet, name| lines(sheet, name, Mark::Steps, of_life));
    let profile =
        gathered(runs, "crown-profile", Some("treatment"), |sheet, name| lines(sheet, name, Mark::Line, of_layer));
    let lived = || {
        figure(
            "axis-life",
            "Axes that live by their dimension",
            "Kaplan–Meier estimate of axes with all that they bear, by order; the numbers have intervals of plants.",
            [Axis::of("dimension", "ticks since the first internode"), Axis::of("share of axes alive", "")],
            lives.0,
        )
    };
    let mut parts = Vec::new();
    parts.extend(runs.iter().any(|reported| reported.trial.is_some()).then(lived));
    parts.push(figure(
        "crown-profile",
        "Leaf area by height at the last recorded age",
        "The mean leaf area of a plant in layers of half a metre; the numbers have intervals of plants.",
        [Axis::of("leaf area in the layer", "m²"), Axis::of("middle of the layer above the seed", "m")],
        profile.0,
    ));
    parts.extend(lives.1.into_iter().chain(profile.1).map(Part::Text));
    for (name, by, words) in TABLES {
        for reported in runs {
            parts.extend(match found(reported, name, by) {
                Ok(found) => tables(&found, &format!("{words}: {}", reported.name)),
                Err(reason) => vec![Part::Text(reason)],
            });
        }
    }
    parts
}

fn figure(id: &str, title: &str, caption: &str, [x, y]: [Axis; 2], series: Vec<Series>) -> Part {
    let names: Vec<&str> = series.iter().map(|series| series.name.as_str()).collect();
    Part::Figure(Figure {
        id: id.to_owned(),
        title: title.to_owned(),
        caption: format!("{caption} The level is {}.", percent(LEVEL)),
        words: format!("{title}, of {}. The numbers stand below the figure.", names.join(", ")),
        plotted: Plotted::Chart(Chart { x, y, series }),
    })
}

/// A measure of a run, or why there is none.
fn found(reported: &Reported, name: &str, by: Option<&str>) -> Result<Measured, String> {
    let lack = |reason: String| format!("{}: `{name}` is not told: {reason}.", reported.name);
    if reported.trial.is_none() && OF_GROWTH.contains(&name) {
        return Err(lack("it is of plants that are followed while they grow, and these were measured".to_owned()));
    }
    let card =
        MEASURES.iter().find(|card| card.name == name).ok_or_else(|| lack("there is no such measure".to_owned()))?;
    let asked = Asked { by: by.map(str::to_owned), level: LEVEL, ..Asked::default() };
    measure(&[reported.run.path()], card, &asked).map_err(|fault| lack(fault.to_string()))
}

/// The series of the first sheet of a measure, of all runs, and the reasons of the runs without.
fn gathered(
    runs: &[Reported],
    name: &str,
    by: Option<&str>,
    series: impl Fn(&Sheet, Option<&str>) -> Vec<Series>,
) -> (Vec<Series>, Vec<String>) {
    let (mut all, mut reasons) = (Vec::new(), Vec::new());
    for reported in runs {
        let of_run = (runs.len() > 1).then_some(reported.name.as_str());
        match found(reported, name, by) {
            Ok(found) => all.extend(found.sheets.first().map(|sheet| series(sheet, of_run)).unwrap_or_default()),
            Err(reason) => reasons.push(reason),
        }
    }
    (all, reasons)
}

/// The rows of a sheet by their group, each as a point.
fn lines(sheet: &Sheet, run: Option<&str>, mark: Mark, point: fn(&Row) -> Option<Point>) -> Vec<Series> {
    let mut all: Vec<Series> = Vec::new();
    for cells in &sheet.rows {
        let row = Row { sheet, cells };
        let Some((group, point)) = row.word("group").zip(point(&row)) else { continue };
        let group = if group.parse::<u32>().is_ok() { format!("order {group}") } else { group.to_owned() };
        let name = run.map_or_else(|| group.clone(), |run| format!("{run}: {group}"));
        match all.last_mut().filter(|series| series.name == name) {
            Some(series) => series.points.push(point),
            None => all.push(Series { name, mark, points: vec![point] }),
        }
    }
    all
}

/// A row of a sheet.
struct Row<'a> {
    sheet: &'a Sheet,
    cells: &'a [Found],
}

impl Row<'_> {
    fn cell(&self, column: &str) -> Option<&Found> {
        self.cells.get(self.sheet.columns.iter().position(|(name, _)| *name == column)?)
    }

    fn word(&self, column: &str) -> Option<&str> {
        match self.cell(column)? {
            Found::Word(word) => Some(word),
            _ => None,
        }
    }

    fn number(&self, column: &str) -> Option<f64> {
        match self.cell(column)? {
            Found::Real(value) => Some(*value),
            Found::Count(count) => Some(*count as f64),
            _ => None,
        }
    }

    fn interval(&self) -> Option<[f64; 2]> {
        self.number("low").zip(self.number("high")).map(|(low, high)| [low, high])
    }
}

fn of_life(row: &Row) -> Option<Point> {
    let at = Point::at(row.number("dimension")?, row.number("survival")?);
    Some(Point { interval: row.interval(), ..at })
}

/// A layer of the crown: its leaf area across, its height upwards.
fn of_layer(row: &Row) -> Option<Point> {
    Some(Point::at(row.number("leaf_area")?, 0.5 * (row.number("from")? + row.number("to")?)))
}

/// The sheets of a measure as tables, and its notes.
fn tables(found: &Measured, words: &str) -> Vec<Part> {
    let table = |sheet: &Sheet| {
        let columns =
            sheet.columns.iter().map(|(name, unit)| Axis::of(&name.replace('_', " "), unit).label()).collect();
        let cell = |cell: &Found| match cell {
            Found::Word(word) => Cell::words(word.as_str()),
            Found::Count(count) => Cell::number(*count as f64),
            Found::Real(value) => Cell::number(*value),
            Found::Nothing => Cell::Empty,
        };
        let rows = sheet.rows.iter().map(|row| row.iter().map(cell).collect()).collect();
        Part::Table(words.to_owned(), Table { columns, rows })
    };
    let notes: Vec<String> = found.notes.iter().cloned().collect();
    let told = (!notes.is_empty()).then(|| Part::Text(format!("{words}: {}.", notes.join("; "))));
    found.sheets.iter().filter(|sheet| !sheet.rows.is_empty()).map(table).chain(told).collect()
}
