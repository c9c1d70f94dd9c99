//! The architectural models of the plants of a recorded run.
//!
//! The classifier reads the first plants of a run from `components` and, where the run has the columns of mechanics,
//! from `records`. Absent: runs whose first plants have millions of components, which are not classified.

use super::{Characters, architectures};
use phytomer_outputs::read::Run;
use phytomer_outputs::rows::{ComponentRow, PoseRow};
use phytomer_outputs::{Error, Table};
use std::collections::BTreeMap;

/// The number of plants of a run that are classified.
pub const LOOKED_AT: u32 = 8;

/// A run whose first plants have more rows than this is not classified.
const MOST_ROWS: u64 = 4_000_000;

/// The models that the first plants of a run qualify for.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Qualified {
    /// The number of plants that were classified.
    pub plants: u32,
    /// The number of classified plants that qualify for each model, by the model's name.
    pub models: BTreeMap<&'static str, u32>,
}

/// The models that the first [`LOOKED_AT`] plants of a run qualify for. `None` where the run has no `components`, or
/// where its first plants have none (a sample without them, or a shard) or more than four million rows. Holds the rows
/// of these plants in memory.
///
/// # Errors
/// [`Error`] where a table cannot be read.
pub fn qualified(run: &Run, plants_of_run: u32) -> Result<Option<Qualified>, Error> {
    let rows = run.rows()?;
    let share = f64::from(LOOKED_AT.min(plants_of_run)) / f64::from(plants_of_run.max(1));
    let most = |table: Table| rows.get(&table).map_or(0, |rows| (*rows as f64 * share) as u64);
    if most(Table::Components) == 0 || most(Table::Components) > MOST_ROWS {
        return Ok(None);
    }
    let components = run.components(LOOKED_AT)?;
    let bends = run.schema(Table::Records)?.is_some_and(|schema| schema.field_with_name("curvature_per_m").is_ok());
    let poses = if bends && most(Table::Records) <= MOST_ROWS { run.poses(LOOKED_AT)? } else { Vec::new() };
    let mut found = Qualified::default();
    for components in components.chunk_by(|a, b| a.plant_id == b.plant_id) {
        let plant = components[0].plant_id;
        found.add(components, &poses.iter().filter(|pose| pose.plant_id == plant).copied().collect::<Vec<_>>());
    }
    Ok((found.plants > 0).then_some(found))
}

impl Qualified {
    fn add(&mut self, components: &[ComponentRow], poses: &[PoseRow]) {
        self.plants += 1;
        for model in architectures(&Characters::of(components, poses)) {
            *self.models.entry(model).or_default() += 1;
        }
    }
}
