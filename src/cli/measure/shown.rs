//! A measure as people and programs read it: a table with aligned columns, CSV, JSON.
//!
//! Numbers on a terminal have four significant digits, in files all that they have. An empty cell is a dash on the
//! terminal, nothing in CSV and null in JSON. Absent: what the numbers mean.

use phytomer_analysis::measure::{Card, Cell, Measured, Sheet};
use serde_json::{Map, Value};
use std::fmt::Write as _;

/// The rows that a terminal shows of a sheet; files have all.
const SHOWN: usize = 60;

/// The sheets of a measure and its notes.
pub fn table(card: &Card, measured: &Measured) -> String {
    let mut text = format!("{}: {}\n{}\n", card.name, card.tells, card.formula);
    for sheet in measured.sheets.iter().filter(|sheet| !sheet.rows.is_empty()) {
        text += "\n";
        text += &aligned(sheet);
    }
    for note in &measured.notes {
        let _ = write!(text, "\nnote: {note}");
    }
    text.trim_end().to_owned()
}

fn aligned(sheet: &Sheet) -> String {
    let head = sheet.columns.iter().map(|(name, unit)| match *unit {
        "" => (*name).to_owned(),
        unit => format!("{name} ({unit})"),
    });
    let mut lines: Vec<Vec<String>> = vec![head.collect()];
    lines.extend(sheet.rows.iter().take(SHOWN).map(|row| row.iter().map(short).collect()));
    let width = |column: usize| lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..sheet.columns.len()).map(width).collect();
    let words: Vec<bool> = (0..sheet.columns.len())
        .map(|column| sheet.rows.iter().any(|row| matches!(row[column], Cell::Word(_))))
        .collect();
    let mut text = String::new();
    for line in &lines {
        for ((cell, width), is_word) in line.iter().zip(&widths).zip(&words) {
            let _ = if *is_word { write!(text, "  {cell:<width$}") } else { write!(text, "  {cell:>width$}") };
        }
        text.truncate(text.trim_end().len());
        text += "\n";
    }
    if sheet.rows.len() > SHOWN {
        let _ = writeln!(text, "  … {} rows more; --out has them all", sheet.rows.len() - SHOWN);
    }
    text
}

/// A cell with four significant digits.
fn short(cell: &Cell) -> String {
    match cell {
        Cell::Word(word) => word.clone(),
        Cell::Count(count) => count.to_string(),
        Cell::Real(value) if *value == 0.0 => "0".to_owned(),
        Cell::Real(value) if value.abs() >= 1e6 || value.abs() < 1e-4 => format!("{value:.3e}"),
        Cell::Real(value) => {
            let digits = [1.0, 10.0, 100.0, 1000.0].iter().filter(|bound| value.abs() >= **bound).count();
            let after = (4 - digits.min(4)).max(usize::from(digits < 4));
            format!("{value:.after$}")
        }
        Cell::Nothing => "–".to_owned(),
    }
}

/// A sheet as CSV (RFC 4180), units in brackets behind the names.
pub fn csv(sheet: &Sheet) -> String {
    let quoted = |text: String| match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text,
    };
    let cell = |cell: &Cell| match cell {
        Cell::Word(word) => quoted(word.clone()),
        Cell::Count(count) => count.to_string(),
        Cell::Real(value) => value.to_string(),
        Cell::Nothing => String::new(),
    };
    let head = sheet.columns.iter().map(|(name, unit)| match *unit {
        "" => (*name).to_owned(),
        unit => quoted(format!("{name} [{unit}]")),
    });
    let mut text = head.collect::<Vec<_>>().join(",") + "\n";
    for row in &sheet.rows {
        text += &row.iter().map(cell).collect::<Vec<_>>().join(",");
        text += "\n";
    }
    text
}

/// The sheets as lists of objects, with the units of their columns.
pub fn as_json(measured: &Measured) -> Value {
    let cell = |cell: &Cell| match cell {
        Cell::Word(word) => Value::from(word.as_str()),
        Cell::Count(count) => Value::from(*count),
        Cell::Real(value) => Value::from(*value),
        Cell::Nothing => Value::Null,
    };
    let of = |sheet: &Sheet| {
        let row = |row: &Vec<Cell>| -> Map<String, Value> {
            sheet.columns.iter().zip(row).map(|((name, _), of)| ((*name).to_owned(), cell(of))).collect()
        };
        let units: Map<String, Value> =
            sheet.columns.iter().map(|(name, unit)| ((*name).to_owned(), Value::from(*unit))).collect();
        serde_json::json!({"units": units, "rows": sheet.rows.iter().map(row).collect::<Vec<_>>()})
    };
    measured.sheets.iter().map(|sheet| (sheet.name.to_owned(), of(sheet))).collect::<Map<_, _>>().into()
}

/// The measures with their units, groups and sources.
pub fn list(cards: &[Card]) -> String {
    let mut text = String::from(
        "Measures, and beside run, treatment, factors, species, replicate, block and plot what --by can be:\n",
    );
    let width = cards.iter().map(|card| card.name.len()).max().unwrap_or(0);
    for card in cards {
        let mut told = card.tells.to_owned();
        if !card.unit.is_empty() {
            let _ = write!(told, " Unit: {}.", card.unit);
        }
        if !card.groups.is_empty() {
            let _ = write!(told, " By {}.", card.groups.join(", "));
        }
        let _ = writeln!(text, "  {:<width$}  {told}\n  {:<width$}  {}", card.name, "", card.formula);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_short_on_a_terminal_and_whole_in_files() {
        let sheet = Sheet {
            name: "a",
            columns: vec![("group", ""), ("mean", "m")],
            rows: vec![
                vec![Cell::Word("a, \"b\"".into()), Cell::Real(0.123_456)],
                vec![Cell::Word("c".into()), Cell::Nothing],
            ],
        };
        assert_eq!(csv(&sheet), "group,mean [m]\n\"a, \"\"b\"\"\",0.123456\nc,\n");
        let shown = aligned(&sheet);
        assert!(shown.contains("0.1235") && shown.contains('–'), "{shown}");
        let reals = [12.345_67, 123.456, 1234.56, 12_345.6, -0.5, 2e-7, 3e9].map(|value| short(&Cell::Real(value)));
        assert_eq!(reals, ["12.35", "123.5", "1235", "12346", "-0.5000", "2.000e-7", "3.000e9"]);
    }
}
