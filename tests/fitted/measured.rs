//! The measured counts, as tables.
//!
//! The project has no copy of them: [`absent`] finds their folder, and skips or fails a test without them. Absent: the
//! meaning of the numbers.

use crate::absent;

/// A table of comma-separated values, its columns by name.
pub struct Table {
    names: Vec<String>,
    rows: Vec<Vec<String>>,
}

/// A row of a table.
#[derive(Clone, Copy)]
pub struct Row<'a> {
    table: &'a Table,
    values: &'a [String],
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

    pub fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        self.rows.iter().map(|values| Row { table: self, values })
    }

    /// The number of each count in the rows of a data set: columns `n_nodes` and `count`.
    pub fn histogram(&self, dataset: &str) -> Vec<f64> {
        let mut counts = Vec::new();
        for row in self.rows().filter(|row| row.text("dataset") == dataset) {
            add(&mut counts, row.number("n_nodes") as usize, row.number("count"));
        }
        assert!(!counts.is_empty(), "no data set {dataset}");
        counts
    }
}

impl<'a> Row<'a> {
    pub fn text(self, column: &str) -> &'a str {
        let place = self.table.names.iter().position(|name| name == column);
        &self.values[place.unwrap_or_else(|| panic!("no column {column}"))]
    }

    pub fn number(self, column: &str) -> f64 {
        self.maybe(column).unwrap_or_else(|| panic!("{column} is {}", self.text(column)))
    }

    /// `None` where nothing was measured.
    pub fn maybe(self, column: &str) -> Option<f64> {
        self.text(column).parse().ok()
    }
}

/// Adds to the cell of a number, making cells up to it.
pub fn add(counts: &mut Vec<f64>, number: usize, count: f64) {
    if counts.len() <= number {
        counts.resize(number + 1, 0.0);
    }
    counts[number] += count;
}

/// How often each number occurs.
pub fn counted(numbers: impl IntoIterator<Item = usize>) -> Vec<f64> {
    let mut counts = Vec::new();
    numbers.into_iter().for_each(|number| add(&mut counts, number, 1.0));
    counts
}

/// Mean and variance (n − 1) of a sample.
pub fn moments(sample: &[f64]) -> (f64, f64) {
    let n = sample.len() as f64;
    let mean = sample.iter().sum::<f64>() / n;
    (mean, sample.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0))
}
