//! Charts as data: axes with units, series of points with intervals, and contrasts.
//!
//! Absent: how they look (`drawn`, `vega`).

use super::table::{Cell, Table};

/// An axis.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Axis {
    /// What is along it.
    pub title: String,
    /// Its unit; empty where there is none.
    pub unit: String,
}

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// A line from point to point, with a band from `low` to `high`.
    Line,
    /// A broken line, for what a law says.
    Dashed,
    /// A line that keeps its height until the next point, as of survival.
    Steps,
    /// The same, broken, for what a law says of survival.
    DashedSteps,
    /// Points, with bars from `low` to `high`.
    Points,
    /// Bars of one width around x, as of counts.
    Bars,
}

/// A point of a series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Its place along the first axis.
    pub x: f64,
    /// Its value.
    pub y: f64,
    /// The ends of its interval.
    pub interval: Option<[f64; 2]>,
}

impl Point {
    /// A point without an interval.
    pub fn at(x: f64, y: f64) -> Self {
        Self { x, y, interval: None }
    }

    fn is_finite(&self) -> bool {
        let ends = self.interval.unwrap_or([0.0; 2]);
        [self.x, self.y, ends[0], ends[1]].into_iter().all(f64::is_finite)
    }
}

/// Points of one name.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// The name.
    pub name: String,
    /// How it is drawn.
    pub mark: Mark,
    /// Its points.
    pub points: Vec<Point>,
}

/// Series over two axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// The axis across.
    pub x: Axis,
    /// The axis upwards.
    pub y: Axis,
    /// What is drawn, in the order of the legend.
    pub series: Vec<Series>,
}

/// A difference with its interval.
#[derive(Debug, Clone, PartialEq)]
pub struct Contrast {
    /// What is compared.
    pub name: String,
    /// The difference.
    pub value: f64,
    /// The ends of its interval.
    pub interval: [f64; 2],
}

/// Contrasts one below the other (a forest plot), with a line at 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Contrasts {
    /// The axis of the differences.
    pub x: Axis,
    /// The contrasts, from above.
    pub rows: Vec<Contrast>,
}

/// Anything that is drawn as a figure.
#[derive(Debug, Clone, PartialEq)]
pub enum Plotted {
    /// Series.
    Chart(Chart),
    /// Contrasts.
    Contrasts(Contrasts),
}

impl Axis {
    /// An axis by its title and its unit.
    pub fn of(title: &str, unit: &str) -> Self {
        Self { title: title.to_owned(), unit: unit.to_owned() }
    }

    /// The title with the unit.
    pub fn label(&self) -> String {
        if self.unit.is_empty() { self.title.clone() } else { format!("{} ({})", self.title, self.unit) }
    }
}

impl Plotted {
    /// The same without points that are no numbers; `None` where nothing is left.
    pub fn finite(&self) -> Option<Self> {
        match self {
            Self::Chart(chart) => {
                let mut chart = chart.clone();
                chart.series.iter_mut().for_each(|series| series.points.retain(Point::is_finite));
                chart.series.retain(|series| !series.points.is_empty());
                (!chart.series.is_empty()).then_some(Self::Chart(chart))
            }
            Self::Contrasts(contrasts) => {
                let mut contrasts = contrasts.clone();
                let is_finite =
                    |row: &Contrast| [row.value, row.interval[0], row.interval[1]].iter().all(|x| x.is_finite());
                contrasts.rows.retain(is_finite);
                (!contrasts.rows.is_empty()).then_some(Self::Contrasts(contrasts))
            }
        }
    }

    /// The numbers that are drawn, a row a point. A point that is no number has an empty cell.
    pub fn table(&self) -> Table {
        match self {
            Self::Chart(chart) => chart.table(),
            Self::Contrasts(Contrasts { x, rows }) => Table {
                columns: vec!["contrast".to_owned(), x.label(), "low".to_owned(), "high".to_owned()],
                rows: rows
                    .iter()
                    .map(|row| {
                        let [low, high] = row.interval.map(Cell::number);
                        vec![Cell::Text(row.name.clone()), Cell::number(row.value), low, high]
                    })
                    .collect(),
            },
        }
    }
}

impl Chart {
    fn table(&self) -> Table {
        let has_intervals = self.series.iter().flat_map(|series| &series.points).any(|point| point.interval.is_some());
        let mut columns = vec!["series".to_owned(), self.x.label(), self.y.label()];
        if has_intervals {
            columns.extend(["low".to_owned(), "high".to_owned()]);
        }
        let row = |series: &Series, point: &Point| {
            let mut row = vec![Cell::Text(series.name.clone()), Cell::number(point.x), Cell::number(point.y)];
            if has_intervals {
                let ends = point.interval.map_or([Cell::Empty, Cell::Empty], |ends| ends.map(Cell::number));
                row.extend(ends);
            }
            row
        };
        let rows = self.series.iter().flat_map(|series| series.points.iter().map(move |point| row(series, point)));
        Table { columns, rows: rows.collect() }
    }
}
