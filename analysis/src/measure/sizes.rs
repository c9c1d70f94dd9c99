//! Measures of size: height, crown, leaf area, leaf area index, wood and other numbers of plants at an age.
//!
//! A row of `summary` is a value of a plant; dead plants are not measured. The interval is Student's of plants. The
//! leaf area index is leaf area over the ground of the plant, m²/m². Where a plot has several plants they share its
//! site: the design effect is the variance by plots over that by plants. Absent: differences (`contrast`).

use super::columns::Columns;
use super::fault::Fault;
use super::groups::Groups;
use super::result::{Cells, Column, Measured, Sheet};
use super::source::Source;
use super::stream::{Of, RowOf, Unit, each_plant, of_group};
use phytomer_measures::moments::Moments;
use phytomer_measures::ratio::Ratio;
use phytomer_measures::{Lack, proportion};
use phytomer_outputs::Table;
use std::collections::BTreeSet;

/// A number of plants at an age.
#[derive(Debug, Clone, Copy)]
pub(super) struct Size {
    pub column: &'static str,
    pub unit: &'static str,
    /// Whether it is taken per square metre of ground.
    pub per_ground: bool,
    /// The age; `None` for every recorded one.
    pub age: Option<u32>,
}

impl Unit for Size {
    type Row = f64;
    type OfPlant = Vec<f64>;

    fn table(&self) -> Table {
        Table::Summary
    }

    fn columns(&self) -> Vec<&'static str> {
        vec!["age", "alive", self.column]
    }

    fn rows<'a>(&'a self, source: &'a Source, columns: &'a Columns<'a>) -> Result<RowOf<'a, f64>, Fault> {
        let (ages, alive, values) = (columns.ints("age")?, columns.ints("alive")?, columns.numbers(self.column)?);
        let plants = columns.ints("plant_id")?;
        Ok(Box::new(move |row| {
            if alive[row] != 1 || self.age.is_some_and(|age| ages[row].unsigned_abs() != age) {
                return None;
            }
            let value = values[row]?;
            if !self.per_ground {
                return Some(value);
            }
            let ground = source.plants.get(plants[row].unsigned_abs() as usize)?.ground_area_m2?;
            (ground > 0.0).then(|| value / ground)
        }))
    }

    fn add(&self, own: &mut Vec<f64>, row: f64) {
        own.push(row);
    }
}

/// The values of the plants, one after the other, with where each stands.
pub(super) fn each_value(
    size: &Size,
    source: &Source,
    groups: &mut Groups,
    mut tell: impl FnMut(Of, f64),
) -> Result<(), Fault> {
    each_plant(size, source, groups, |of, own| own.into_iter().for_each(|value| tell(of, value)))
}

#[derive(Default)]
struct Found {
    plants: Moments,
    /// The plot that is being read, with the moments of its plants.
    plot: Option<(i32, Moments)>,
    plots: Ratio,
}

impl Found {
    fn add(&mut self, plot: i32, value: f64) {
        self.plants.add(value);
        match &mut self.plot {
            Some((now, moments)) if *now == plot => moments.add(value),
            _ => {
                self.end();
                self.plot = Some((plot, Moments::of(&[value])));
            }
        }
    }

    fn end(&mut self) {
        if let Some((_, moments)) = self.plot.take() {
            self.plots.add(&moments);
        }
    }
}

/// The mean of plants in each group.
pub(super) fn measure(size: &Size, sources: &[Source], groups: &mut Groups, level: f64) -> Result<Measured, Fault> {
    let mut found: Vec<Found> = Vec::new();
    for source in sources {
        each_value(size, source, groups, |of, value| of_group(&mut found, of.group).add(of.plot, value))?;
        found.iter_mut().for_each(Found::end);
    }
    let unit = size.unit;
    let columns: [Column; 8] = [
        ("group", ""),
        ("plants", ""),
        ("mean", unit),
        ("sd", unit),
        ("monte_carlo_error", unit),
        ("low", unit),
        ("high", unit),
        ("design_effect", ""),
    ];
    let (mut sheet, mut notes) = (Sheet::new("mean", &columns), BTreeSet::new());
    for (number, name) in groups.sorted() {
        let Some(of) = found.get(number as usize).filter(|of| of.plants.n > 0) else { continue };
        let estimate = of.plants.mean_of_plants(level);
        let effect = of.plots.mean(level).ok().and_then(|mean| mean.design_effect.ok());
        let row = Cells::of(name, &mut notes).count(of.plants.n).real(of.plants.mean);
        let row = row.maybe(of.plants.standard_deviation()).estimate("interval", estimate.map(|of| of.standard_error));
        let row = row.maybe(estimate.ok().map(|of| of.interval.low)).maybe(estimate.ok().map(|of| of.interval.high));
        sheet.rows.push(row.maybe(effect).done());
    }
    if sheet.rows.is_empty() {
        let why =
            if size.per_ground { "no living plant with a known ground area" } else { "no living plant with a value" };
        notes.insert(format!("no mean: {why} at this age"));
    }
    Ok(Measured { notes, ..Measured::of(vec![sheet]) })
}

/// Whether plants live.
struct Alive(Option<u32>);

impl Unit for Alive {
    type Row = bool;
    type OfPlant = (u64, u64);

    fn table(&self) -> Table {
        Table::Summary
    }

    fn columns(&self) -> Vec<&'static str> {
        vec!["age", "alive"]
    }

    fn rows<'a>(&'a self, _: &'a Source, columns: &'a Columns<'a>) -> Result<RowOf<'a, bool>, Fault> {
        let (ages, alive) = (columns.ints("age")?, columns.ints("alive")?);
        Ok(Box::new(move |row| self.0.is_none_or(|age| ages[row].unsigned_abs() == age).then(|| alive[row] == 1)))
    }

    fn add(&self, own: &mut (u64, u64), row: bool) {
        own.0 += u64::from(row);
        own.1 += 1;
    }
}

/// The share of plants that live, with Wilson's interval.
pub(super) fn living(age: Option<u32>, sources: &[Source], groups: &mut Groups, level: f64) -> Result<Measured, Fault> {
    let mut found: Vec<(u64, u64)> = Vec::new();
    for source in sources {
        each_plant(&Alive(age), source, groups, |of, own| {
            let group = of_group(&mut found, of.group);
            *group = (group.0 + own.0, group.1 + own.1);
        })?;
    }
    let columns: [Column; 6] =
        [("group", ""), ("plants", ""), ("living", ""), ("share", ""), ("low", ""), ("high", "")];
    let (mut sheet, mut notes) = (Sheet::new("living", &columns), BTreeSet::new());
    for (number, name) in groups.sorted() {
        let Some((living, plants)) = found.get(number as usize).copied().filter(|of| of.1 > 0) else { continue };
        let interval = proportion::wilson(living, plants, level);
        let row = Cells::of(name, &mut notes).count(plants).count(living).real(living as f64 / plants as f64);
        let row = row.estimate("interval", interval.map(|of| of.low)).maybe(interval.ok().map(|of| of.high));
        sheet.rows.push(row.done());
    }
    if sheet.rows.is_empty() {
        notes.insert(format!("no share: {}", Lack::Empty));
    }
    Ok(Measured { notes, ..Measured::of(vec![sheet]) })
}
