//! What a measure found: sheets of rows with named columns and units, and what could not be estimated.
//!
//! A cell without a value has none because something was missing, which a note says; no number stands for it, NaN never
//! does. Absent: how a sheet looks on a terminal or in a file.

use phytomer_measures::Lack;
use std::collections::BTreeSet;

/// A value of a sheet.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// A word.
    Word(String),
    /// A count, or a number of ticks.
    Count(u64),
    /// A number.
    Real(f64),
    /// Nothing could be estimated.
    Nothing,
}

/// The name of a column and its unit; an empty unit is a number without one.
pub type Column = (&'static str, &'static str);

/// Rows of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    /// The name of the sheet.
    pub name: &'static str,
    /// Its columns.
    pub columns: Vec<Column>,
    /// Its rows, a cell for each column.
    pub rows: Vec<Vec<Cell>>,
}

impl Sheet {
    /// A sheet without rows.
    pub fn new(name: &'static str, columns: &[Column]) -> Self {
        Self { name, columns: columns.to_vec(), rows: Vec::new() }
    }
}

/// What a measure found.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// The sheets, the first of which is the measure.
    pub sheets: Vec<Sheet>,
    /// What could not be estimated, and what is to be known when the sheets are read.
    pub notes: BTreeSet<String>,
}

impl Measured {
    /// The one number that a measure tells of a group, or of all; `None` where it tells none.
    pub fn number(&self, group: Option<&str>) -> Option<f64> {
        const VALUES: [&str; 4] = ["mean", "share", "median", "value"];
        let (sheet, column) = self.sheets.iter().find_map(|sheet| {
            let is_value = |column: &Column| VALUES.contains(&column.0);
            Some((sheet, sheet.columns.iter().position(is_value)?))
        })?;
        let of_group = |row: &&Vec<Cell>| group.is_none_or(|group| row.first() == Some(&Cell::Word(group.to_owned())));
        // Of several rows the last is that of the whole, such as Strahler's ratio.
        let row = sheet.rows.iter().rfind(of_group)?;
        match row.get(column) {
            Some(Cell::Real(value)) => Some(*value),
            Some(Cell::Count(count)) => Some(*count as f64),
            _ => None,
        }
    }

    /// A measure of these sheets, without notes.
    pub fn of(sheets: Vec<Sheet>) -> Self {
        Self { sheets, notes: BTreeSet::new() }
    }
}

/// Gathers the cells of a row, and the reasons where there is none.
pub(super) struct Cells<'a> {
    group: String,
    notes: &'a mut BTreeSet<String>,
    cells: Vec<Cell>,
}

impl<'a> Cells<'a> {
    /// A row of a group.
    pub fn of(group: &str, notes: &'a mut BTreeSet<String>) -> Self {
        Self { group: group.to_owned(), notes, cells: vec![Cell::Word(group.to_owned())] }
    }

    pub fn word(mut self, word: impl Into<String>) -> Self {
        self.cells.push(Cell::Word(word.into()));
        self
    }

    pub fn count(mut self, count: impl Into<u64>) -> Self {
        self.cells.push(Cell::Count(count.into()));
        self
    }

    pub fn maybe_count(mut self, count: Option<u32>) -> Self {
        self.cells.push(count.map_or(Cell::Nothing, |count| Cell::Count(count.into())));
        self
    }

    /// A number; one that is not finite is nothing.
    pub fn real(mut self, value: f64) -> Self {
        self.cells.push(if value.is_finite() { Cell::Real(value) } else { Cell::Nothing });
        self
    }

    pub fn maybe(self, value: Option<f64>) -> Self {
        self.real(value.unwrap_or(f64::NAN))
    }

    /// An estimate, or the reason why there is none as a note on `what`.
    pub fn estimate(mut self, what: &str, value: Result<f64, Lack>) -> Self {
        if let Err(lack) = value {
            self.lack(what, lack);
        }
        self.maybe(value.ok())
    }

    /// Notes what could not be estimated.
    pub fn lack(&mut self, what: &str, lack: Lack) {
        self.notes.insert(format!("{}: no {what}: {lack}", self.group));
    }

    pub fn done(self) -> Vec<Cell> {
        self.cells
    }
}
