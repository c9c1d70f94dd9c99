//! The measured counts as tables, by the names of their columns.
//!
//! Absent: the meaning of the numbers.

use crate::absent;

/// A table of comma-separated values.
pub struct Table {
    names: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A file of the measured plants; `None`, with the reason printed, where the test is to be skipped.
    pub fn read(file: &str) -> Option<Self> {
        let text = absent::measured(file)?;
        let split = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
        let mut lines = text.lines();
        let names = split(lines.next().unwrap_or_else(|| panic!("{file} is empty")));
        Some(Self { names, rows: lines.map(split).collect() })
    }

    /// The rows whose value in a column is this, with the values of other columns.
    pub fn of<'a, const N: usize>(&'a self, filter: (&str, &'a str), columns: [&str; N]) -> Vec<[&'a str; N]> {
        let place =
            |name: &str| self.names.iter().position(|own| own == name).unwrap_or_else(|| panic!("no column {name}"));
        let (by, places) = (place(filter.0), columns.map(place));
        let of = self.rows.iter().filter(|row| row[by] == filter.1);
        of.map(|row| places.map(|place| row[place].as_str())).collect()
    }

    /// All rows, as numbers.
    pub fn numbers<const N: usize>(&self, columns: [&str; N]) -> Vec<[f64; N]> {
        let place =
            |name: &str| self.names.iter().position(|own| own == name).unwrap_or_else(|| panic!("no column {name}"));
        let places = columns.map(place);
        self.rows.iter().map(|row| places.map(|place| row[place].parse().expect("a number"))).collect()
    }
}

/// Whether a number is that of a table with so many decimals.
#[track_caller]
pub fn is(what: &str, found: f64, expected: f64, decimals: u32) {
    let half: f64 = format!("0.5e-{decimals}").parse().expect("a power of ten");
    assert!((found - expected).abs() <= half * 1.000_001, "{what}: {found}, expected {expected}");
}
