//! How groups differ from the first at the last recorded age, each measure in a forest plot.
//!
//! Treatments of one run share the draws of their plants, so that plants of one replicate and number are pairs. Groups
//! of other runs are compared without pairs (Welch).

use super::plants::{Group, Grown, MEASURES, Measure};
use super::{LEVEL, percent};
use phytomer_measures::contrast::{Contrast as Difference, paired, unpaired};
use phytomer_measures::{Lack, Moments};
use phytomer_reports::{Axis, Cell, Contrast, Contrasts, Figure, Part, Plotted, Table};

/// A figure a measure, and one table of all; nothing where there is one group.
pub fn parts(grown: &Grown) -> Vec<Part> {
    let Some((first, others)) = grown.groups.split_first().filter(|(_, others)| !others.is_empty()) else {
        return Vec::new();
    };
    let mut rows = Vec::new();
    let mut parts = Vec::new();
    for (place, measure) in MEASURES.into_iter().enumerate() {
        let mut drawn = Vec::new();
        for group in others {
            let (pairs, found) = contrast(first, group, place);
            rows.push(row(measure, group, pairs, &found));
            let interval = found.map(|found| (found.difference.value, found.difference.interval));
            drawn.extend(interval.ok().map(|(value, interval)| Contrast {
                name: group.name.clone(),
                value,
                interval: [interval.low, interval.high],
            }));
        }
        parts.push(Part::Figure(figure(grown, first, measure, drawn)));
    }
    parts.push(Part::Table(format!("Differences from {} at age {}", first.name, grown.last_age), table(rows)));
    parts
}

/// The contrast of two groups, and whether it is of pairs.
fn contrast(first: &Group, other: &Group, place: usize) -> (bool, Result<Difference, Lack>) {
    let values = |group: &Group| group.last.values().filter_map(|values| values[place]).collect::<Vec<f64>>();
    if first.run != other.run {
        return (false, unpaired(&Moments::of(&values(first)), &Moments::of(&values(other)), LEVEL));
    }
    let differences = other.last.iter().filter_map(|(key, values)| {
        let pair = values[place].zip(first.last.get(key)?[place]);
        pair.map(|(own, reference)| own - reference)
    });
    (true, paired(&Moments::of(&differences.collect::<Vec<f64>>()), LEVEL))
}

fn figure(grown: &Grown, first: &Group, measure: Measure, rows: Vec<Contrast>) -> Figure {
    let words: Vec<String> = rows
        .iter()
        .map(|row| format!("{}: {:.3}, from {:.3} to {:.3}", row.name, row.value, row.interval[0], row.interval[1]))
        .collect();
    let title = format!("Difference of {} from {} at age {}", measure.title, first.name, grown.last_age);
    Figure {
        id: format!("contrast-{}", measure.column.replace('_', "-")),
        caption: format!("Bars are {} Student intervals; 0 is no difference.", percent(LEVEL)),
        words: format!("{title}. {}.", words.join("; ")),
        plotted: Plotted::Contrasts(Contrasts {
            x: Axis::of(&format!("difference of {}", measure.title), measure.unit),
            rows,
        }),
        title,
    }
}

fn row(measure: Measure, group: &Group, pairs: bool, found: &Result<Difference, Lack>) -> Vec<Cell> {
    let mut cells = vec![
        Cell::words(Axis::of(measure.title, measure.unit).label()),
        Cell::words(group.name.as_str()),
        Cell::words(if pairs { "paired" } else { "unpaired" }),
    ];
    match found {
        Ok(Difference { difference, p, effect, .. }) => {
            let p = p.as_ref().map_or(Cell::Empty, |p| Cell::number(*p));
            let effect = effect.as_ref().map_or(Cell::Empty, |effect| Cell::number(effect.value));
            let ends = [difference.interval.low, difference.interval.high].map(Cell::number);
            cells.push(Cell::number(difference.value));
            cells.extend(ends.into_iter().chain([p, effect, Cell::Empty]));
        }
        Err(lack) => cells.extend((0..5).map(|_| Cell::Empty).chain([Cell::words(lack.to_string())])),
    }
    cells
}

fn table(rows: Vec<Vec<Cell>>) -> Table {
    let columns = ["measure", "group", "plants are", "difference", "low", "high", "p", "effect size d", "why not"];
    Table { columns: columns.map(str::to_owned).into(), rows }
}
