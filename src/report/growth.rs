//! Growth curves: the mean of each measure by age, with Student's band, and measured plants beside them.

use super::field::Field;
use super::plants::{Grown, MEASURES, Measure};
use super::{LEVEL, percent};
use phytomer_measures::Moments;
use phytomer_reports::{Axis, Chart, Figure, Mark, Part, Plotted, Point, Series};

/// A figure a measure.
pub fn parts(grown: &Grown, field: Option<&Field>) -> Vec<Part> {
    let part = |(place, measure): (usize, Measure)| {
        let figure = figure(grown, field, place, measure);
        let told =
            matches!(&figure.plotted, Plotted::Chart(chart) if chart.series.iter().any(|of| !of.points.is_empty()));
        if told || grown.groups.iter().any(|group| group.grows) {
            return Part::Figure(figure);
        }
        Part::Text(format!("{}: the file of the measured plants does not tell it.", figure.title))
    };
    MEASURES.into_iter().enumerate().map(part).collect()
}

fn figure(grown: &Grown, field: Option<&Field>, place: usize, measure: Measure) -> Figure {
    let simulated = grown.groups.iter().map(|group| {
        let ages = group.ages.iter().map(|(age, moments)| (*age, moments[place]));
        // A single age is a point, which a line would not show.
        let mark = if group.ages.len() > 1 { Mark::Line } else { Mark::Points };
        series(&group.name, mark, ages)
    });
    let measured = field.map(|field| field.ages(measure.column)).unwrap_or_default();
    let measured = (!measured.is_empty()).then(|| series("measured", Mark::Points, measured));
    let series: Vec<Series> = simulated.chain(measured).collect();
    let title = format!("{} by age", capital(measure.title));
    Figure {
        id: format!("growth-{}", measure.column.replace('_', "-")),
        caption: format!(
            "Means of the living plants; bands and bars are {} Student intervals of plant values, and are absent with \
             fewer than two plants.",
            percent(LEVEL)
        ),
        words: in_words(&series, measure, &grown.tick),
        title,
        plotted: Plotted::Chart(Chart {
            x: Axis::of("age", &grown.tick),
            y: Axis::of(measure.title, measure.unit),
            series,
        }),
    }
}

fn series(name: &str, mark: Mark, ages: impl IntoIterator<Item = (u32, Moments)>) -> Series {
    let point = |(age, moments): (u32, Moments)| {
        let interval = moments.mean_of_plants(LEVEL).ok().map(|mean| [mean.interval.low, mean.interval.high]);
        (moments.n > 0).then(|| Point { interval, ..Point::at(f64::from(age), moments.mean) })
    };
    Series { name: name.to_owned(), mark, points: ages.into_iter().filter_map(point).collect() }
}

/// What the figure shows, for those who do not see it: each series from its first to its last point.
fn in_words(series: &[Series], measure: Measure, tick: &str) -> String {
    let of = |series: &Series| {
        let (first, last) = (series.points.first()?, series.points.last()?);
        let unit = if measure.unit.is_empty() { String::new() } else { format!(" {}", measure.unit) };
        Some(format!(
            "{}: {:.3}{unit} at age {} to {:.3}{unit} at age {}",
            series.name, first.y, first.x, last.y, last.x
        ))
    };
    let told: Vec<String> = series.iter().filter_map(of).collect();
    format!("Mean {} by age in {tick}. {}.", measure.title, told.join("; "))
}

fn capital(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}
