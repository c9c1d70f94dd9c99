//! Measures of angles at an age, from the poses in `records`: divergence of leaves along an axis, and insertion of
//! leaves and axes.
//!
//! Divergence: the angle about the axis from a leaf to the first leaf of the next node, anticlockwise as seen from the
//! tip, both directions projected across the internode that bears the second. Insertion: the angle between the
//! direction of the leaf, or of the first internode of an axis, and that of the internode that bears it. Both are of
//! the plant as it stands, bent and turned. Circular means (Mardia & Jupp 2000) with intervals of plants. Unit:
//! degrees.

use super::columns::Columns;
use super::fault::Fault;
use super::groups::Groups;
use super::result::{Cells, Column, Measured, Sheet};
use super::source::Source;
use super::stream::{RowOf, Unit, each_plant, of_group};
use phytomer_measures::Lack;
use phytomer_measures::circular::{Directions, OfPlant as Angles};
use phytomer_outputs::Table;
use phytomer_sim::math::{acos, atan2};
use std::collections::{BTreeMap, BTreeSet};

/// Which angle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Angle {
    Divergence,
    LeafInsertion,
    AxisInsertion,
}

/// An angle at an age.
pub(super) struct AtAge {
    pub angle: Angle,
    pub age: u32,
}

type Vector = [f64; 3];

/// The directions of the components of a plant.
#[derive(Default)]
pub(super) struct OfPlant {
    /// Of internodes, by their numbers.
    internodes: BTreeMap<i32, Vector>,
    /// Of leaves and first internodes: axis, rank, what bears it and its direction.
    borne: Vec<(i32, i32, i32, Vector)>,
}

/// A component.
pub(super) struct Row {
    component: i32,
    axis: i32,
    rank: i32,
    parent: i32,
    direction: Vector,
    is_internode: bool,
}

impl Unit for AtAge {
    type Row = Row;
    type OfPlant = OfPlant;

    fn table(&self) -> Table {
        Table::Records
    }

    fn columns(&self) -> Vec<&'static str> {
        vec!["age", "kind", "component_id", "axis_id", "rank", "parent_id", "dir_x", "dir_y", "dir_z"]
    }

    fn rows<'a>(&'a self, _: &'a Source, columns: &'a Columns<'a>) -> Result<RowOf<'a, Row>, Fault> {
        let kinds = columns.words("kind")?;
        let of: Vec<(bool, bool)> =
            kinds.words.iter().map(|kind| (kind.ends_with("internode"), kind == "leaf")).collect();
        let int = |name: &str| columns.ints(name);
        let (ages, component, axis) = (int("age")?, int("component_id")?, int("axis_id")?);
        let (rank, parent) = (int("rank")?, int("parent_id")?);
        let number = |name: &str| columns.numbers(name);
        let (x, y, z) = (number("dir_x")?, number("dir_y")?, number("dir_z")?);
        Ok(Box::new(move |row| {
            let (is_internode, is_leaf) = of[kinds.at(row)?];
            if ages[row].unsigned_abs() != self.age || !(is_internode || is_leaf) {
                return None;
            }
            let direction = [x[row]?, y[row]?, z[row]?];
            Some(Row {
                component: component[row],
                axis: axis[row],
                rank: rank[row],
                parent: parent[row],
                direction,
                is_internode,
            })
        }))
    }

    fn add(&self, own: &mut OfPlant, row: Row) {
        if row.is_internode {
            own.internodes.insert(row.component, row.direction);
        }
        let wanted = match self.angle {
            Angle::AxisInsertion => row.is_internode && row.rank == 1 && row.parent >= 0,
            _ => !row.is_internode,
        };
        if wanted {
            own.borne.push((row.axis, row.rank, row.parent, row.direction));
        }
    }
}

impl OfPlant {
    fn insertions(&self) -> Angles {
        let mut angles = Angles::default();
        for (_, _, parent, direction) in &self.borne {
            if let Some(bearer) = self.internodes.get(parent) {
                angles.add(acos(dot(*direction, *bearer).clamp(-1.0, 1.0)));
            }
        }
        angles
    }

    fn divergences(&mut self) -> Angles {
        let mut angles = Angles::default();
        // Of several leaves of a node the first in the order of numbers stays first: the sort is stable.
        self.borne.sort_by_key(|(axis, rank, ..)| (*axis, *rank));
        self.borne.dedup_by_key(|(axis, rank, ..)| (*axis, *rank));
        for pair in self.borne.windows(2) {
            let [(axis, rank, _, before), (next_axis, next_rank, parent, after)] = [pair[0], pair[1]];
            let bearer = self.internodes.get(&parent).filter(|_| axis == next_axis && next_rank == rank + 1);
            let angle = bearer.and_then(|bearer| turn(before, after, *bearer));
            angle.into_iter().for_each(|angle| angles.add(angle));
        }
        angles
    }
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The angle about `along` from one direction to another; `None` where one of them points along it.
fn turn(from: Vector, to: Vector, along: Vector) -> Option<f64> {
    /// The least part of a direction across the axis: single precision holds no more.
    const LEAST: f64 = 1e-3;
    let across = |of: Vector| {
        let part = dot(of, along);
        let across = [0, 1, 2].map(|i| of[i] - part * along[i]);
        (dot(across, across).sqrt() > LEAST).then_some(across)
    };
    let (from, to) = (across(from)?, across(to)?);
    Some(atan2(dot(cross(from, to), along), dot(from, to)))
}

/// The mean angle in each group.
pub(super) fn measure(unit: &AtAge, sources: &[Source], groups: &mut Groups, level: f64) -> Result<Measured, Fault> {
    let mut found: Vec<Directions> = Vec::new();
    for source in sources {
        each_plant(unit, source, groups, |of, mut own| {
            let angles = match unit.angle {
                Angle::Divergence => own.divergences(),
                _ => own.insertions(),
            };
            of_group(&mut found, of.group).add(&angles);
        })?;
    }
    let columns: [Column; 9] = [
        ("group", ""),
        ("plants", ""),
        ("angles", ""),
        ("mean", "deg"),
        ("circular_sd", "deg"),
        ("monte_carlo_error", "deg"),
        ("low", "deg"),
        ("high", "deg"),
        ("resultant", ""),
    ];
    let (mut sheet, mut notes) = (Sheet::new("angle", &columns), BTreeSet::new());
    for (number, name) in groups.sorted() {
        let Some(Ok(mean)) = found.get(number as usize).map(|of| of.mean(level)) else { continue };
        let degrees = |angle: f64| angle.to_degrees();
        // A divergence is told from 0 to 360°, with its interval about it.
        let shift = match mean.angle {
            Ok(angle) if angle < 0.0 => 360.0,
            _ => 0.0,
        };
        let row = Cells::of(name, &mut notes).count(mean.plants).count(mean.n);
        let row = row.estimate("mean angle", mean.angle.map(|angle| degrees(angle) + shift));
        let row = row.maybe(mean.deviation.ok().map(degrees));
        let row = row.estimate("interval", mean.standard_error.map(degrees));
        let row = row.maybe(mean.interval.ok().map(|of| degrees(of.low) + shift));
        sheet.rows.push(row.maybe(mean.interval.ok().map(|of| degrees(of.high) + shift)).real(mean.resultant).done());
    }
    if sheet.rows.is_empty() {
        notes.insert(format!("no angle at age {}: {}", unit.age, Lack::Empty));
    }
    Ok(Measured { notes, ..Measured::of(vec![sheet]) })
}
