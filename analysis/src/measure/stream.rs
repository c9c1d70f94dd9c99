//! Rows of a table, plant by plant: the one pass over a run that measures share.
//!
//! Rows are sorted by plot, so what is kept of plants is that of one plot at a time. Only the columns that a measure
//! names are read. Absent: what a measure keeps of a plant.

use super::columns::Columns;
use super::fault::Fault;
use super::groups::Groups;
use super::source::Source;
use phytomer_outputs::Table;
use std::collections::BTreeMap;

/// A function from the number of a row to what a measure takes of it; `None` leaves the row out.
pub(super) type RowOf<'a, R> = Box<dyn Fn(usize) -> Option<R> + 'a>;

/// What a measure reads, and what it keeps of a plant.
pub(super) trait Unit {
    /// What it takes of a row.
    type Row;
    /// What it keeps of the rows of a plant in a group.
    type OfPlant: Default;
    /// The table.
    fn table(&self) -> Table;
    /// The columns that it reads.
    fn columns(&self) -> Vec<&'static str>;
    /// What it takes of the rows of a batch.
    fn rows<'a>(&'a self, source: &'a Source, columns: &'a Columns<'a>) -> Result<RowOf<'a, Self::Row>, Fault>;
    /// Adds a row of a plant.
    fn add(&self, own: &mut Self::OfPlant, row: Self::Row);
}

/// A plant in a group.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Of {
    /// The number of the plant among those of all runs.
    pub plant: u32,
    pub group: u32,
    /// The plot, among those of the run.
    pub plot: i32,
}

/// Reads a run and tells each plant in each group, plot after plot.
///
/// # Errors
/// A table that is not there or cannot be read.
pub(super) fn each_plant<U: Unit>(
    unit: &U,
    source: &Source,
    groups: &mut Groups,
    mut tell: impl FnMut(Of, U::OfPlant),
) -> Result<(), Fault> {
    let table = unit.table();
    let path = source.run.path();
    if !source.run.has(table)? {
        return Err(Fault::NoTable { path: path.to_path_buf(), table: table.name() });
    }
    let of_plants = groups.of_plants(source);
    let mut names = vec!["plot_id", "plant_id"];
    names.extend(unit.columns());
    names.extend(groups.by.columns());
    let (mut plot, mut standing): (i32, BTreeMap<(u32, u32), U::OfPlant>) = (-1, BTreeMap::new());
    for batch in source.run.batches_with(table, &names)? {
        let batch = batch?;
        let columns = Columns { batch: &batch, run: path, table: table.name() };
        let keyed = groups.keyed(source, &columns, of_plants.as_deref())?;
        let (plots, plants) = (columns.ints("plot_id")?, columns.ints("plant_id")?);
        let row_of = unit.rows(source, &columns)?;
        for row in 0..columns.rows() {
            if plots[row] != plot {
                end_plot(&mut standing, plot, &mut tell);
                plot = plots[row];
            }
            let number = plants[row].unsigned_abs();
            if source.plants.get(number as usize).is_some_and(|plant| plant.guard) {
                continue;
            }
            if let Some(taken) = row_of(row) {
                let plant = source.first.saturating_add(number);
                unit.add(standing.entry((plant, keyed.at(row))).or_default(), taken);
            }
        }
    }
    end_plot(&mut standing, plot, &mut tell);
    Ok(())
}

fn end_plot<T>(standing: &mut BTreeMap<(u32, u32), T>, plot: i32, tell: &mut impl FnMut(Of, T)) {
    for ((plant, group), own) in std::mem::take(standing) {
        tell(Of { plant, group, plot }, own);
    }
}

/// The place of a group in a list, which grows to hold it.
pub(super) fn of_group<T: Default>(list: &mut Vec<T>, group: u32) -> &mut T {
    let at = group as usize;
    if list.len() <= at {
        list.resize_with(at + 1, T::default);
    }
    &mut list[at]
}
