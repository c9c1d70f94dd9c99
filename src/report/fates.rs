//! How long plants live: survival by Kaplan & Meier, and whether groups differ (log-rank).

use super::plants::Grown;
use super::{LEVEL, percent};
use phytomer_measures::survival::{Lives, kaplan_meier, log_rank};
use phytomer_reports::{Axis, Cell, Chart, Figure, Mark, Part, Plotted, Point, Series, Table};

/// The figure of survival, and a table of the lives of each group.
pub fn parts(grown: &Grown) -> Vec<Part> {
    let groups = || grown.groups.iter().filter(|group| group.grows);
    let series = groups().filter_map(|group| {
        let curve = kaplan_meier(&group.lives, LEVEL).ok()?;
        let start = Point { interval: Some([1.0, 1.0]), ..Point::at(0.0, 1.0) };
        let steps = curve.steps.iter().map(|step| Point {
            interval: step.interval.map(|interval| [interval.low, interval.high]),
            ..Point::at(f64::from(step.ticks), step.survival)
        });
        Some(Series { name: group.name.clone(), mark: Mark::Steps, points: [start].into_iter().chain(steps).collect() })
    });
    let series: Vec<Series> = series.collect();
    let words: Vec<String> = series
        .iter()
        .filter_map(|series| {
            series.points.last().map(|last| format!("{}: {:.3} at age {}", series.name, last.y, last.x))
        })
        .collect();
    let figure = Figure {
        id: "survival".to_owned(),
        title: "Plants that live by age".to_owned(),
        caption: format!(
            "Kaplan–Meier estimate; a plant that lives at the end of its run, or whose plot ended at a limit, is censored. The \
             numbers have {} intervals.",
            percent(LEVEL)
        ),
        words: format!("Share of plants alive by age in {}. {}.", grown.tick, words.join("; ")),
        plotted: Plotted::Chart(Chart {
            x: Axis::of("age", &grown.tick),
            y: Axis::of("share of plants alive", ""),
            series,
        }),
    };
    let mut parts = vec![Part::Figure(figure), Part::Table("Lives of plants".to_owned(), lives(grown))];
    let groups: Vec<&Lives> = groups().map(|group| &group.lives).collect();
    if groups.len() > 1 {
        parts.push(Part::Text(match log_rank(&groups) {
            Ok(test) => {
                format!("Log-rank test of equal lives: χ² = {:.3}, {} df, {}.", test.statistic, test.df, chance(test.p))
            }
            Err(lack) => format!("No log-rank test of equal lives: {lack}."),
        }));
    }
    parts
}

fn lives(grown: &Grown) -> Table {
    let columns = ["group", "plants", "died", "median life (ticks)", "low", "high"].map(str::to_owned).into();
    let row = |group: &super::plants::Group| {
        let curve = kaplan_meier(&group.lives, LEVEL).ok();
        let whole = |ticks: Option<u32>| ticks.map_or(Cell::Empty, |ticks| Cell::number(f64::from(ticks)));
        let median = curve.as_ref().and_then(|curve| curve.outlasted_by(0.5).ok());
        let [low, high] = curve.map_or([None, None], |curve| curve.interval_of(0.5)).map(whole);
        let counts = [group.plants, group.lives.ended()].map(|count| Cell::number(count as f64));
        let [plants, died] = counts;
        vec![Cell::words(group.name.as_str()), plants, died, whole(median), low, high]
    };
    Table { columns, rows: grown.groups.iter().filter(|group| group.grows).map(row).collect() }
}

/// A probability in words: "p = 0.0312", "p < 0.0001".
fn chance(p: f64) -> String {
    if p < 1e-4 { "p < 0.0001".to_owned() } else { format!("p = {p:.4}") }
}
