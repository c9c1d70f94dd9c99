//! Tables of a report, as CSV (RFC 4180) and as HTML.
//!
//! Absent: charts, which give their own tables.

use super::escape::text;
use std::fmt::Write as _;

/// A cell of a table.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// Words.
    Text(String),
    /// A finite number.
    Number(f64),
    /// Nothing: not applicable, or not to be estimated.
    Empty,
}

/// Rows under named columns.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// The columns, with their units.
    pub columns: Vec<String>,
    /// The rows, each with as many cells.
    pub rows: Vec<Vec<Cell>>,
}

impl Cell {
    /// A number; what is none is empty.
    pub fn number(value: f64) -> Self {
        if value.is_finite() { Self::Number(value) } else { Self::Empty }
    }

    /// Words.
    pub fn words(words: impl Into<String>) -> Self {
        Self::Text(words.into())
    }

    fn exact(&self) -> String {
        match self {
            Self::Text(words) => words.clone(),
            Self::Number(value) => format!("{value}"),
            Self::Empty => String::new(),
        }
    }
}

/// A number as people read it: four digits.
pub(super) fn rounded(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        return "0".to_owned();
    }
    if !(1e-4..1e7).contains(&size) {
        return format!("{value:.3e}");
    }
    let decimals = [(1000.0, 0), (100.0, 1), (10.0, 2), (1.0, 3), (0.1, 4), (0.01, 5)];
    let decimals = decimals.into_iter().find(|(least, _)| size >= *least).map_or(6, |(_, decimals)| decimals);
    let told = format!("{value:.decimals$}");
    if told.contains('.') { told.trim_end_matches('0').trim_end_matches('.').to_owned() } else { told }
}

impl Table {
    /// The table as CSV with all digits, lines ended by CR LF.
    pub fn csv(&self) -> String {
        let mut out = String::new();
        let mut line = |cells: &mut dyn Iterator<Item = String>| {
            let cells: Vec<String> = cells.map(|cell| quoted(&cell)).collect();
            out += &cells.join(",");
            out += "\r\n";
        };
        line(&mut self.columns.iter().cloned());
        self.rows.iter().for_each(|row| line(&mut row.iter().map(Cell::exact)));
        out
    }

    /// The table as HTML, numbers to four digits.
    pub fn html(&self) -> String {
        let mut out = String::from("<table><thead><tr>");
        for column in &self.columns {
            let _ = write!(out, "<th scope=\"col\">{}</th>", text(column));
        }
        out += "</tr></thead><tbody>";
        for row in &self.rows {
            out += "<tr>";
            for cell in row {
                let _ = match cell {
                    Cell::Text(words) => write!(out, "<td>{}</td>", text(words)),
                    Cell::Number(value) => write!(out, "<td class=\"number\">{}</td>", rounded(*value)),
                    Cell::Empty => write!(out, "<td></td>"),
                };
            }
            out += "</tr>";
        }
        out + "</tbody></table>"
    }
}

/// A cell of CSV. A text that a spreadsheet would take for a formula begins with an apostrophe.
fn quoted(cell: &str) -> String {
    let is_number = cell.parse::<f64>().is_ok();
    let cell = if !is_number && cell.starts_with(['=', '+', '-', '@']) { format!("'{cell}") } else { cell.to_owned() };
    if cell.contains([',', '"', '\n', '\r']) { format!("\"{}\"", cell.replace('"', "\"\"")) } else { cell }
}
