//! The architectural models of the plants of a recorded run.
//!
//! The classifier reads the first plants of a run from `components` and, where the run has the columns of mechanics,
//! from `records`. Of measured plants no file tells the trend of an axis, so how the axes of its order lie stands for
//! it, and what else is not told is not held against a model. Absent: runs whose first plants have millions of
//! components, which are not classified.

use super::tolerance::{LEAST_COURSE, STEEP_DEG, TURNS_UP};
use super::{Characters, Untold, architectures};
use phytomer_outputs::read::Run;
use phytomer_outputs::rows::{ComponentRow, PoseRow};
use phytomer_outputs::{Error, Table};
use phytomer_sim::math::acos;
use phytomer_sim::plant::Class;
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
    let measured = run.json()["resolved_scenario"].get("measured").is_some();
    let bends =
        measured || run.schema(Table::Records)?.is_some_and(|schema| schema.field_with_name("curvature_per_m").is_ok());
    let poses = if bends && most(Table::Records) <= MOST_ROWS { run.poses(LOOKED_AT)? } else { Vec::new() };
    let mut found = Qualified::default();
    for components in components.chunk_by(|a, b| a.plant_id == b.plant_id) {
        let plant = components[0].plant_id;
        let poses: Vec<PoseRow> = poses.iter().filter(|pose| pose.plant_id == plant).copied().collect();
        if measured { found.add_measured(components, &poses) } else { found.add(components, &poses) }
    }
    Ok((found.plants > 0).then_some(found))
}

impl Qualified {
    fn add(&mut self, components: &[ComponentRow], poses: &[PoseRow]) {
        self.count(&Characters::of(components, poses));
    }

    fn add_measured(&mut self, components: &[ComponentRow], poses: &[PoseRow]) {
        let untold = Untold {
            flowers: !components.iter().any(|row| matches!(row.kind.class(), Class::Flower | Class::Fruit)),
            units: !components.iter().any(|row| row.unit_rank.is_some()),
            ends: true,
        };
        let trends = trends(components, poses);
        let told = |row: &ComponentRow| match row.kind.class() {
            Class::Internode => ComponentRow { trend_deg: trends.get(&row.order).copied(), ..*row },
            _ => *row,
        };
        let components: Vec<ComponentRow> = components.iter().map(told).collect();
        self.count(&Characters { untold, ..Characters::of(&components, poses) });
    }

    fn count(&mut self, characters: &Characters) {
        self.plants += 1;
        for model in architectures(characters) {
            *self.models.entry(model).or_default() += 1;
        }
    }
}

/// The trend of the axes of each order by how they lie at the last recorded age, degrees from the upward vertical: 0
/// for upright orders, 90 for level ones.
///
/// Orthotropic axes spring at any angle and turn up; plagiotropic ones keep theirs. So an order is upright where the
/// median of its axes is steep at the end, or turns up by a good part of its first angle. Axes of few internodes do not
/// show it yet.
fn trends(components: &[ComponentRow], poses: &[PoseRow]) -> BTreeMap<u32, f32> {
    let last = poses.iter().map(|pose| pose.age).max().unwrap_or_default();
    let mut axes: BTreeMap<u32, Vec<(u32, f32)>> = BTreeMap::new();
    for pose in poses.iter().filter(|pose| pose.age == last && !pose.dir_z.is_nan()) {
        axes.entry(pose.axis_id).or_default().push((pose.rank, pose.dir_z));
    }
    let orders: BTreeMap<u32, u32> = components.iter().map(|row| (row.axis_id, row.order)).collect();
    let mut of: BTreeMap<u32, [Vec<f64>; 2]> = BTreeMap::new();
    for (axis, mut course) in axes.into_iter().filter(|(_, course)| course.len() >= LEAST_COURSE) {
        course.sort_unstable_by_key(|(rank, _)| *rank);
        let third = course.len() / 3;
        let [first, end] = [&course[..third], &course[course.len() - third..]].map(inclination);
        let [ends, rises] = of.entry(orders.get(&axis).copied().unwrap_or(1)).or_default();
        ends.push(end);
        rises.push(if first > 0.0 { (first - end) / first } else { 0.0 });
    }
    let upright = |[ends, rises]: [Vec<f64>; 2]| median(ends) <= STEEP_DEG || median(rises) >= TURNS_UP;
    of.into_iter().map(|(order, of)| (order, if upright(of) { 0.0 } else { 90.0 })).collect()
}

/// The mean inclination of a stretch of an axis, degrees from the upward vertical.
fn inclination(of: &[(u32, f32)]) -> f64 {
    let mean = of.iter().map(|(_, dir_z)| f64::from(*dir_z)).sum::<f64>() / of.len().max(1) as f64;
    acos(mean.clamp(-1.0, 1.0)).to_degrees()
}

fn median(mut of: Vec<f64>) -> f64 {
    of.sort_unstable_by(f64::total_cmp);
    of.get(of.len() / 2).copied().unwrap_or_default()
}
