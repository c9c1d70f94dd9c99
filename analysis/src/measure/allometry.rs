//! Measure of allometry: how one size of plants scales with another, as a line through the logarithms of both.
//!
//! Standardised major axis, for how two sizes scale, and least squares, for predicting y from x (Warton et al. 2006);
//! each plant is a point, at one age. Unit: the slope has none. Plants in which a size is zero or missing are left out
//! and counted. Absent: lines through other axes.

use super::columns::Columns;
use super::fault::Fault;
use super::groups::Groups;
use super::result::{Cells, Column, Measured, Sheet};
use super::source::Source;
use super::stream::{RowOf, Unit, each_plant, of_group};
use phytomer_measures::line::Pairs;
use phytomer_outputs::Table;
use phytomer_sim::math::log;
use std::collections::BTreeSet;

/// Two sizes of plants at an age.
pub(super) struct Sizes {
    pub x: &'static str,
    pub y: &'static str,
    pub age: u32,
}

impl Unit for Sizes {
    type Row = Option<(f64, f64)>;
    type OfPlant = (Pairs, u64);

    fn table(&self) -> Table {
        Table::Summary
    }

    fn columns(&self) -> Vec<&'static str> {
        vec!["age", "alive", self.x, self.y]
    }

    fn rows<'a>(&'a self, _: &'a Source, columns: &'a Columns<'a>) -> Result<RowOf<'a, Self::Row>, Fault> {
        let (ages, alive) = (columns.ints("age")?, columns.ints("alive")?);
        let (x, y) = (columns.numbers(self.x)?, columns.numbers(self.y)?);
        Ok(Box::new(move |row| {
            (alive[row] == 1 && ages[row].unsigned_abs() == self.age).then(|| {
                let positive = |value: Option<f64>| value.filter(|value| *value > 0.0).map(log);
                positive(x[row]).zip(positive(y[row]))
            })
        }))
    }

    fn add(&self, own: &mut Self::OfPlant, row: Self::Row) {
        match row {
            Some((x, y)) => own.0.add(x, y),
            None => own.1 += 1,
        }
    }
}

/// The lines of each group.
pub(super) fn measure(sizes: &Sizes, sources: &[Source], groups: &mut Groups, level: f64) -> Result<Measured, Fault> {
    let mut found: Vec<(Pairs, u64)> = Vec::new();
    for source in sources {
        each_plant(sizes, source, groups, |of, own| {
            let group = of_group(&mut found, of.group);
            group.0.merge(&own.0);
            group.1 += own.1;
        })?;
    }
    let columns: [Column; 10] = [
        ("group", ""),
        ("line", ""),
        ("plants", ""),
        ("left_out", ""),
        ("slope", ""),
        ("se", ""),
        ("low", ""),
        ("high", ""),
        ("log_intercept", ""),
        ("r2", ""),
    ];
    let (mut sheet, mut notes) = (Sheet::new("allometry", &columns), BTreeSet::new());
    for (number, name) in groups.sorted() {
        let Some((pairs, left_out)) = found.get(number as usize) else { continue };
        for (word, line) in
            [("standardised major axis", pairs.major_axis(level)), ("least squares", pairs.least_squares(level))]
        {
            let row = Cells::of(name, &mut notes).word(word).count(pairs.len()).count(*left_out);
            let row = row.estimate(&format!("line by {word}"), line.map(|line| line.slope.value));
            let slope = line.ok().map(|line| line.slope);
            let row = row.maybe(slope.map(|of| of.standard_error)).maybe(slope.map(|of| of.interval.low));
            let row = row.maybe(slope.map(|of| of.interval.high)).maybe(line.ok().map(|line| line.intercept.value));
            sheet.rows.push(row.maybe(line.ok().map(|line| line.r2)).done());
        }
    }
    if sheet.rows.is_empty() {
        notes.insert("no line: no living plant at this age".to_owned());
    }
    notes.insert(format!("natural logarithms: ln {} = log_intercept + slope · ln {}", sizes.y, sizes.x));
    Ok(Measured { notes, ..Measured::of(vec![sheet]) })
}
