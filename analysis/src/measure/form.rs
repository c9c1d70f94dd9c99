//! The form of plants at an age, from the poses in `records`: axiality of branchings, and the outline of the crown.
//!
//! `phytomer_measures::form` has formulas and source. A branching is an internode that bears both the next internode of
//! its axis and the first internode of another axis; each lateral is one. The outline has the tips of internodes, about
//! the vertical through the seed. Both are of the plant as it stands. Means with intervals of plants. Unit: degrees for
//! the half-angle of the cone, else none.

use super::columns::Columns;
use super::fault::Fault;
use super::source::Source;
use super::stream::{RowOf, Unit};
use phytomer_measures::form::{Outline, axiality};
use phytomer_measures::moments::Moments;
use phytomer_outputs::Table;
use phytomer_sim::math::atan2;
use std::collections::BTreeMap;

type Vector = [f64; 3];

/// What is measured of the form.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    Axiality,
    /// The half-angle of the cone, degrees.
    Cone,
    /// The height of the widest place over that of the plant.
    Widest,
}

/// The internodes of plants at an age.
pub(super) struct Standing {
    pub form: Form,
    pub age: u32,
}

/// An internode.
pub(super) struct Internode {
    component: i32,
    axis: i32,
    parent: i32,
    direction: Vector,
    tip: Vector,
}

/// The internodes of a plant, or its outline.
#[derive(Default)]
pub(super) struct OfPlant {
    internodes: Vec<(i32, i32, i32, Vector)>,
    outline: Outline,
}

impl Unit for Standing {
    type Row = Internode;
    type OfPlant = OfPlant;

    fn table(&self) -> Table {
        Table::Records
    }

    fn columns(&self) -> Vec<&'static str> {
        let places = ["x_m", "y_m", "z_m", "dir_x", "dir_y", "dir_z", "length_m"];
        [&["age", "kind", "component_id", "axis_id", "parent_id"][..], &places].concat()
    }

    fn rows<'a>(&'a self, _: &'a Source, columns: &'a Columns<'a>) -> Result<RowOf<'a, Internode>, Fault> {
        let kinds = columns.words("kind")?;
        let is_internode: Vec<bool> = kinds.words.iter().map(|kind| kind.ends_with("internode")).collect();
        let int = |name: &str| columns.ints(name);
        let (ages, component, axis, parent) = (int("age")?, int("component_id")?, int("axis_id")?, int("parent_id")?);
        let number = |name: &str| columns.numbers(name);
        let places = [number("x_m")?, number("y_m")?, number("z_m")?];
        let directions = [number("dir_x")?, number("dir_y")?, number("dir_z")?];
        let lengths = number("length_m")?;
        Ok(Box::new(move |row| {
            if ages[row].unsigned_abs() != self.age || !is_internode[kinds.at(row)?] {
                return None;
            }
            let direction = [directions[0][row]?, directions[1][row]?, directions[2][row]?];
            let base = [places[0][row]?, places[1][row]?, places[2][row]?];
            let length = lengths[row]?;
            let tip = [0, 1, 2].map(|i| base[i] + length * direction[i]);
            let (component, axis, parent) = (component[row], axis[row], parent[row]);
            Some(Internode { component, axis, parent, direction, tip })
        }))
    }

    fn add(&self, own: &mut OfPlant, row: Internode) {
        match self.form {
            Form::Axiality => own.internodes.push((row.component, row.axis, row.parent, row.direction)),
            Form::Cone | Form::Widest => own.outline.add(row.tip),
        }
    }
}

impl Standing {
    /// The values of a plant: one a branching, or one in all.
    pub fn values(&self, own: &OfPlant) -> Moments {
        let one = |value: Option<f64>| value.map(|value| Moments::of(&[value])).unwrap_or_default();
        match self.form {
            Form::Axiality => branchings(&own.internodes),
            Form::Cone => one(own.outline.half_angle().map(f64::to_degrees)),
            Form::Widest => one(own.outline.widest_share()),
        }
    }
}

/// The axiality of each lateral against the internode that goes on.
fn branchings(internodes: &[(i32, i32, i32, Vector)]) -> Moments {
    let bearers: BTreeMap<i32, (i32, Vector)> =
        internodes.iter().map(|(component, axis, _, direction)| (*component, (*axis, *direction))).collect();
    let goes_on = |(_, axis, parent, direction): &(i32, i32, i32, Vector)| {
        let (bearer, along) = bearers.get(parent)?;
        (axis == bearer).then(|| (*parent, angle(*along, *direction)))
    };
    let onward: BTreeMap<i32, f64> = internodes.iter().filter_map(goes_on).collect();
    let mut values = Moments::default();
    for (_, axis, parent, direction) in internodes {
        let (Some((bearer, along)), Some(main)) = (bearers.get(parent), onward.get(parent)) else { continue };
        if axis != bearer {
            axiality(*main, angle(*along, *direction)).into_iter().for_each(|value| values.add(value));
        }
    }
    values
}

/// The angle between two directions; also of all but equal ones, which a cosine would not tell apart.
fn angle(a: Vector, b: Vector) -> f64 {
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let length = |of: Vector| (of[0] * of[0] + of[1] * of[1] + of[2] * of[2]).sqrt();
    atan2(length(cross), a[0] * b[0] + a[1] * b[1] + a[2] * b[2])
}
