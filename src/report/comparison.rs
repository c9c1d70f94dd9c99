//! Measured plants beside simulated ones of the same age: means and their difference (Welch), a row a group, measure
//! and age.

use super::field::Field;
use super::plants::{Grown, MEASURES};
use super::{LEVEL, percent};
use phytomer_measures::contrast::unpaired;
use phytomer_reports::{Axis, Cell, Part, Table};

/// What was compared, and the table.
pub fn parts(grown: &Grown, field: &Field) -> Vec<Part> {
    let rows = rows(grown, field);
    let mut words = format!(
        "{} rows of {}. Ages that both have are compared: the difference is measured less simulated, with Welch's {} interval.",
        field.rows,
        field.name,
        percent(LEVEL)
    );
    if !field.passed_over.is_empty() {
        words += &format!(" Columns that are not compared: {}.", field.passed_over.join(", "));
    }
    if rows.is_empty() {
        words += " No age of the measured plants was recorded in the run, so that nothing is compared.";
        return vec![Part::Text(words)];
    }
    let columns = [
        "measure",
        "age (ticks)",
        "group",
        "simulated plants",
        "simulated mean",
        "measured plants",
        "measured mean",
        "difference",
        "low",
        "high",
        "p",
        "why not",
    ];
    let table = Table { columns: columns.map(str::to_owned).into(), rows };
    vec![Part::Text(words), Part::Table("Measured and simulated plants".to_owned(), table)]
}

fn rows(grown: &Grown, field: &Field) -> Vec<Vec<Cell>> {
    let mut rows = Vec::new();
    for (place, measure) in MEASURES.into_iter().enumerate() {
        for (age, measured) in field.ages(measure.column) {
            for group in &grown.groups {
                let Some(simulated) = group.ages.get(&age).map(|moments| moments[place]).filter(|of| of.n > 0) else {
                    continue;
                };
                let mut row = vec![
                    Cell::words(Axis::of(measure.title, measure.unit).label()),
                    Cell::number(f64::from(age)),
                    Cell::words(group.name.as_str()),
                    Cell::number(simulated.n as f64),
                    Cell::number(simulated.mean),
                    Cell::number(measured.n as f64),
                    Cell::number(measured.mean),
                    Cell::number(measured.mean - simulated.mean),
                ];
                match unpaired(&simulated, &measured, LEVEL) {
                    Ok(found) => {
                        let ends = [found.difference.interval.low, found.difference.interval.high];
                        row.extend(ends.map(Cell::number));
                        row.extend([found.p.map_or(Cell::Empty, Cell::number), Cell::Empty]);
                    }
                    Err(lack) => row.extend([Cell::Empty, Cell::Empty, Cell::Empty, Cell::words(lack.to_string())]),
                }
                rows.push(row);
            }
        }
    }
    rows
}
