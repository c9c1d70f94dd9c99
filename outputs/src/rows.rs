//! Rows of `components` and `records` for analysis: read back from a run, or made from a plant in memory by the code
//! that fills the tables, so that both agree.
//!
//! From `records` only the columns for the direction and curvature of internodes are taken. Rows are sorted by plot,
//! and in `records` by tick before plant. So the first plants of a run are found by reading the rows up to the end of
//! the last plot that has such a plant. Absent: all other columns, which any reader of Parquet gives.

use crate::read::Run;
use crate::run_folder::Error;
use crate::tables::columns::{CAUSES, KINDS, ORIGINS};
use crate::tables::{ComponentColumns, ComponentIndex, Membership, PlantAtAge, RecordColumns, Table, TableError};
use arrow_array::types::{Float32Type, Int8Type, Int32Type};
use arrow_array::{Array, DictionaryArray, PrimitiveArray, RecordBatch, StringArray};
use phytomer_sim::plant::{Cause, Class, Kind, Origin};
use phytomer_sim::{Plot, Tick};
use std::path::Path;

/// One row of `components`, in the units of its columns.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(missing_docs, reason = "the columns are described in tables::columns::COMPONENTS")]
pub struct ComponentRow {
    pub plant_id: u32,
    pub component_id: u32,
    pub axis_id: u32,
    pub bearing_axis_id: Option<u32>,
    pub order: u32,
    pub kind: Kind,
    pub origin: Origin,
    pub position: Option<u32>,
    pub rank: Option<u32>,
    pub unit_rank: Option<u32>,
    pub birth_age: Tick,
    pub death_age: Option<Tick>,
    pub shed_age: Option<Tick>,
    pub cause_of_death: Option<Cause>,
    pub trend_deg: Option<f32>,
}

/// The direction and curvature of an internode at a recorded age.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(missing_docs, reason = "the columns are described in tables::columns::RECORDS")]
pub struct PoseRow {
    pub plant_id: u32,
    pub age: Tick,
    pub axis_id: u32,
    pub rank: u32,
    /// NaN where nobody measured it.
    pub dir_z: f32,
    /// `None` where the run has no columns of mechanics, or the wood does not bend.
    pub curvature_per_m: Option<f32>,
}

/// The rows of `components` of one plant in memory, up to the tick `last` of its plot, in the order of component
/// numbers. `at` is the index of the plant in the plot. Empty where the plant is not sown by then.
///
/// # Errors
/// [`TableError::PlantTooLarge`].
pub fn components_of(plot: &Plot, at: usize, last: Tick) -> Result<Vec<ComponentRow>, TableError> {
    let (of, plant) = (Membership::of(plot, at), &plot.plants[at]);
    let Some(last) = of.age_at(last) else { return Ok(Vec::new()) };
    let mut index = ComponentIndex::default();
    index.read(plant)?;
    let mut columns = ComponentColumns::default();
    columns.fill(of, (plant, &index, &[]), 0..index.len(), last, &mut Vec::new());
    let c = &columns;
    let row = |i: usize| ComponentRow {
        plant_id: c.plant[i].unsigned_abs(),
        component_id: c.component[i].unsigned_abs(),
        axis_id: c.axis[i].unsigned_abs(),
        bearing_axis_id: number(c.bearing_axis[i]),
        order: c.order[i].unsigned_abs(),
        kind: Kind::ALL[c.kind[i] as usize],
        origin: Origin::ALL[c.origin[i] as usize],
        position: number(c.position[i]),
        rank: number(c.rank[i]),
        unit_rank: number(c.unit_rank[i]),
        birth_age: c.birth[i].unsigned_abs(),
        death_age: number(c.death[i]),
        shed_age: number(c.shed[i]),
        cause_of_death: usize::try_from(c.cause[i]).ok().map(|cause| Cause::ALL[cause]),
        trend_deg: real(c.trend[i]),
    };
    Ok((0..columns.component.len()).map(row).collect())
}

/// The poses of the internodes of one plant in memory at a tick of its plot, for which the plant must have been posed.
/// `at` is the index of the plant in the plot. Empty where the plant is not sown by then.
///
/// # Errors
/// [`TableError::PlantTooLarge`].
pub fn poses_of(plot: &Plot, at: usize, tick: Tick) -> Result<Vec<PoseRow>, TableError> {
    let (of, plant) = (Membership::of(plot, at), &plot.plants[at]);
    let Some(age) = of.age_at(tick) else { return Ok(Vec::new()) };
    let mut index = ComponentIndex::default();
    index.read(plant)?;
    index.find_tips(plant, age);
    let (mut columns, mut numbers, mut rows) = (RecordColumns::default(), Vec::new(), Vec::new());
    let shown = PlantAtAge { of, plant, index: &index, age, mechanics: true, lit: None };
    let mut next = 0;
    while next < index.len() {
        index.select(age, usize::MAX, &mut next, &mut numbers);
        columns.fill(&shown, &numbers, &mut rows);
    }
    let c = &columns;
    let row = |i: usize| PoseRow {
        plant_id: c.plant[i].unsigned_abs(),
        age,
        axis_id: c.axis[i].unsigned_abs(),
        rank: c.rank[i].unsigned_abs(),
        dir_z: c.dir_z[i],
        curvature_per_m: real(c.curvature[i]),
    };
    Ok((0..c.component.len()).filter(|i| is_internode(Kind::ALL[c.kind[*i] as usize])).map(row).collect())
}

fn is_internode(kind: Kind) -> bool {
    kind.class() == Class::Internode
}

fn number(value: i32) -> Option<u32> {
    u32::try_from(value).ok()
}

fn real(value: f32) -> Option<f32> {
    (!value.is_nan()).then_some(value)
}

impl Run {
    /// The rows of `components` of the plants with numbers below `plants`, all in memory; empty where the run has no
    /// such table.
    ///
    /// # Errors
    /// Where a part cannot be read.
    pub fn components(&self, plants: u32) -> Result<Vec<ComponentRow>, Error> {
        let mut found = Vec::new();
        self.each_batch(Table::Components, plants, |columns, rows| components_in(columns, plants, rows, &mut found))?;
        Ok(found)
    }

    /// The poses of the internodes of the plants with numbers below `plants` at each recorded age, all in memory; empty
    /// where the run has no `records`.
    ///
    /// # Errors
    /// Where a part cannot be read.
    pub fn poses(&self, plants: u32) -> Result<Vec<PoseRow>, Error> {
        let mut found = Vec::new();
        self.each_batch(Table::Records, plants, |columns, rows| poses_in(columns, plants, rows, &mut found))?;
        Ok(found)
    }

    /// Calls a function with each batch of a table and the number of its first rows that may belong to plants with
    /// numbers below `plants`: the rows up to the end of the last plot that has such a plant.
    fn each_batch(
        &self,
        table: Table,
        plants: u32,
        mut show: impl FnMut(&Batch<'_>, usize) -> Result<(), TableError>,
    ) -> Result<(), Error> {
        let last = self.last_plot_of(plants)?;
        for batch in self.batches(table)? {
            let batch = batch?;
            let columns = Batch { batch: &batch, path: self.path(), table };
            // Rows are sorted by plot, so the rows of later plots come last.
            let plots = columns.ints("plot_id")?.values();
            let wanted = plots.partition_point(|plot| last.is_none_or(|last| plot.unsigned_abs() <= last));
            show(&columns, wanted)?;
            if wanted < plots.len() {
                break;
            }
        }
        Ok(())
    }

    /// The last plot that has a plant with a number below `plants`, from the table `plants`. `None` where the table
    /// does not have all these plants: in a run of an older program, or where plots are not grown yet.
    fn last_plot_of(&self, plants: u32) -> Result<Option<u32>, Error> {
        let (mut last, mut found) = (Some(0), 0);
        for batch in self.batches(Table::Plants)? {
            let batch = batch?;
            let columns = Batch { batch: &batch, path: self.path(), table: Table::Plants };
            let (plot, plant) = (columns.ints("plot_id")?, columns.ints("plant_id")?);
            for row in (0..batch.num_rows()).filter(|row| value(plant, *row) < Some(plants)) {
                found += 1;
                last = last.max(value(plot, row));
            }
            if found == plants {
                return Ok(last);
            }
        }
        Ok(None)
    }
}

/// Adds those of the first `rows` rows of a batch that belong to plants with numbers below `plants`.
fn components_in(batch: &Batch<'_>, plants: u32, rows: usize, found: &mut Vec<ComponentRow>) -> Result<(), TableError> {
    let int = |name| batch.ints(name);
    let (plant, component, axis) = (int("plant_id")?, int("component_id")?, int("axis_id")?);
    let (bearing, order, position) = (int("bearing_axis_id")?, int("order")?, int("position")?);
    let (rank, unit_rank, birth) = (int("rank")?, int("unit_rank")?, int("birth_age")?);
    let (death, shed, trend) = (int("death_age")?, int("shed_age")?, batch.floats("trend_deg")?);
    let (kind, origin) = (batch.words("kind", &KINDS)?, batch.words("origin", &ORIGINS)?);
    let cause = batch.words("cause_of_death", &CAUSES)?;
    for i in (0..rows).filter(|i| value(plant, *i) < Some(plants)) {
        found.push(ComponentRow {
            plant_id: value(plant, i).unwrap_or_default(),
            component_id: value(component, i).unwrap_or_default(),
            axis_id: value(axis, i).unwrap_or_default(),
            bearing_axis_id: value(bearing, i),
            order: value(order, i).unwrap_or_default(),
            kind: kind[i].map_or(Kind::Internode, |place| Kind::ALL[place]),
            origin: origin[i].map_or(Origin::Seed, |place| Origin::ALL[place]),
            position: value(position, i),
            rank: value(rank, i),
            unit_rank: value(unit_rank, i),
            birth_age: value(birth, i).unwrap_or_default(),
            death_age: value(death, i),
            shed_age: value(shed, i),
            cause_of_death: cause[i].map(|place| Cause::ALL[place]),
            trend_deg: trend.is_valid(i).then(|| trend.value(i)),
        });
    }
    Ok(())
}

/// Adds the poses in the first `rows` rows of a batch of `records`, for plants with numbers below `plants`.
fn poses_in(batch: &Batch<'_>, plants: u32, rows: usize, found: &mut Vec<PoseRow>) -> Result<(), TableError> {
    let (plant, age) = (batch.ints("plant_id")?, batch.ints("age")?);
    let (axis, rank) = (batch.ints("axis_id")?, batch.ints("rank")?);
    let (kind, dir_z) = (batch.words("kind", &KINDS)?, batch.floats("dir_z")?);
    let curvature = batch.batch.column_by_name("curvature_per_m").and_then(|column| column.as_any().downcast_ref());
    let curvature: Option<&PrimitiveArray<Float32Type>> = curvature;
    for (i, kind) in kind.iter().enumerate().take(rows).filter(|(i, _)| value(plant, *i) < Some(plants)) {
        if kind.is_some_and(|place| is_internode(Kind::ALL[place])) {
            found.push(PoseRow {
                plant_id: value(plant, i).unwrap_or_default(),
                age: value(age, i).unwrap_or_default(),
                axis_id: value(axis, i).unwrap_or_default(),
                rank: value(rank, i).unwrap_or_default(),
                dir_z: if dir_z.is_valid(i) { dir_z.value(i) } else { f32::NAN },
                curvature_per_m: curvature.filter(|of| of.is_valid(i)).map(|of| of.value(i)),
            });
        }
    }
    Ok(())
}

fn value(column: &PrimitiveArray<Int32Type>, row: usize) -> Option<u32> {
    column.is_valid(row).then(|| column.value(row).unsigned_abs())
}

/// The columns of a batch by their names.
struct Batch<'a> {
    batch: &'a RecordBatch,
    path: &'a Path,
    table: Table,
}

impl<'a> Batch<'a> {
    fn column<A: 'static>(&self, column: &'static str) -> Result<&'a A, TableError> {
        let array = self.batch.column_by_name(column).and_then(|array| array.as_any().downcast_ref());
        array.ok_or(TableError::Column { path: self.path.join(self.table.name()), column })
    }

    fn ints(&self, column: &'static str) -> Result<&'a PrimitiveArray<Int32Type>, TableError> {
        self.column(column)
    }

    fn floats(&self, column: &'static str) -> Result<&'a PrimitiveArray<Float32Type>, TableError> {
        self.column(column)
    }

    /// The index of each row's word in the list `words`; `None` for null.
    fn words(&self, column: &'static str, words: &[&str]) -> Result<Vec<Option<usize>>, TableError> {
        let array: &DictionaryArray<Int8Type> = self.column(column)?;
        let missing = || TableError::Column { path: self.path.join(self.table.name()), column };
        let values: &StringArray = array.values().as_any().downcast_ref().ok_or_else(missing)?;
        let places: Vec<Option<usize>> =
            values.iter().map(|word| words.iter().position(|known| Some(*known) == word)).collect();
        Ok(array.keys().iter().map(|key| places.get(usize::try_from(key?).ok()?).copied().flatten()).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::specimen;
    use phytomer_sim::grow;
    use phytomer_sim::pose::pose;

    #[test]
    fn a_plant_in_memory_and_its_tables_give_the_same_rows() {
        let folder = tempfile::tempdir().unwrap();
        let plan = specimen::plan(2, 2);
        let last = plan.until;
        specimen::run(folder.path(), plan);
        let run = Run::open(folder.path()).unwrap();
        let rows = run.components(1).unwrap();
        assert!(rows.len() > 20 && rows.iter().all(|row| row.plant_id == 0));
        let mut plot = specimen::plot(0, 100_000);
        grow(&mut plot, last, &mut ()).unwrap();
        assert_eq!(rows, components_of(&plot, 0, last).unwrap());
        pose(&mut plot.plants[0], last);
        let poses: Vec<_> = run.poses(1).unwrap().into_iter().filter(|row| row.age == last).collect();
        let here = poses_of(&plot, 0, last).unwrap();
        assert_eq!(poses.len(), here.len());
        for (recorded, here) in poses.iter().zip(&here) {
            assert_eq!((recorded.axis_id, recorded.rank, recorded.dir_z), (here.axis_id, here.rank, here.dir_z));
        }
    }
}
