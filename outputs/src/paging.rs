//! The rows of `records` for a page, with the values that the table holds.
//!
//! A page keeps the columns that do not follow from the plant, its age and its form. Places and directions follow from
//! the form, but how an internode is turned about its direction does not, and is told; treatment, plot, plant, tick and
//! age are the same for a whole plant. The columns of mechanics are kept for runs that record them. Absent: how a page
//! stores the values (`phytomer_pages`).

use crate::tables::columns::{RECORDS, RECORDS_OF_POSE};
use crate::tables::schema::{self, Type};
use crate::tables::{ComponentIndex, Membership, TableError, each_record};
use phytomer_pages::{Column, Holds, Table};
use phytomer_sim::Tick;
use phytomer_sim::plant::{Class, Kind, Plant};
use std::collections::BTreeMap;

/// The columns that a page does not keep.
const DERIVED: [&str; 15] = [
    "treatment",
    "plot_id",
    "plant_id",
    "tick",
    "age",
    "component_id",
    "x_m",
    "y_m",
    "z_m",
    "dir_x",
    "dir_y",
    "dir_z",
    "up_x",
    "up_y",
    "up_z",
];

/// The directions of a component.
const DIRECTIONS: [&str; 6] = ["dir_x", "dir_y", "dir_z", "up_x", "up_y", "up_z"];

/// Fills tables of pages.
#[derive(Debug)]
pub struct Rows {
    columns: Vec<Column>,
    /// The places of the columns that are kept, and then of those of directions.
    places: Vec<usize>,
    /// The place of the kind among them.
    kind: usize,
    index: ComponentIndex,
}

impl Rows {
    /// For a run with or without the columns of mechanics.
    pub fn new(mechanics: bool) -> Self {
        let count = if mechanics { RECORDS.len() } else { RECORDS_OF_POSE };
        let columns: Vec<Column> = RECORDS[..count].iter().map(of_page).collect();
        let place = |name: &str| columns.iter().position(|column| column.name == name).unwrap_or_default();
        let kept = (0..count).filter(|place| columns[*place].kept);
        let places: Vec<usize> = kept.chain(DIRECTIONS.map(place)).collect();
        let kind = places.iter().position(|known| *known == place("kind")).unwrap_or_default();
        Self { columns, places, kind, index: ComponentIndex::default() }
    }

    /// The columns of the tables.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Adds the rows of a plant at an age, which the page numbers as `at`.
    ///
    /// # Errors
    /// [`TableError::PlantTooLarge`].
    pub fn show(
        &mut self,
        table: &mut Table,
        (of, plant, age): (Membership, &Plant, Tick),
        at: f32,
    ) -> Result<(), TableError> {
        table.begin(at);
        each_record((of, plant, age), &self.places, &mut self.index, &mut |number, values| {
            let (kept, directions) = values.split_at(values.len() - DIRECTIONS.len());
            table.row(number, kept.iter().copied());
            if let ([x, y, z, u, v, w], true) = (directions, is_internode(kept[self.kind])) {
                table.turned(number, [*x, *y, *z], [*u, *v, *w]);
            }
        })
    }
}

impl Rows {
    /// Adds rows of a measured plant as its table has them, with all columns of `records` in their order; how
    /// internodes are turned is what the plant that is drawn has.
    pub fn show_told<'r>(
        &self,
        table: &mut Table,
        plant: &Plant,
        rows: impl Iterator<Item = (u32, &'r [f64])>,
        at: f32,
    ) {
        let nodes = plant.nodes.component.iter().zip(0..);
        let nodes: BTreeMap<u32, usize> = nodes.map(|(component, node)| (*component, node)).collect();
        let kept = self.places.len() - DIRECTIONS.len();
        table.begin(at);
        for (number, values) in rows {
            let value = |place: &usize| values.get(*place).copied().unwrap_or(f64::NAN);
            table.row(number, self.places[..kept].iter().map(value));
            if let Some(node) = nodes.get(&number) {
                let [heading, up] = [plant.frames.heading[*node], plant.frames.up[*node]].map(|of| of.map(f64::from));
                table.turned(number, heading, up);
            }
        }
    }
}

/// Whether a kind, as `records` has it, is an internode.
fn is_internode(kind: f64) -> bool {
    Kind::ALL.get(kind as usize).is_some_and(|kind| kind.class() == Class::Internode)
}

fn of_page(column: &schema::Column) -> Column {
    let holds = match column.holds {
        Type::Word(words) => Holds::Words(words.iter().map(|word| (*word).to_owned()).collect()),
        Type::Bool => Holds::Truth,
        Type::Float | Type::Double => Holds::Real,
        Type::Int | Type::Key | Type::Date | Type::Name(_) => Holds::Whole,
    };
    let kept = !DERIVED.contains(&column.name);
    Column { name: column.name, unit: column.unit, description: column.description, holds, kept }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A column that is renamed in `records` would be kept twice over without this.
    #[test]
    fn what_is_derived_are_columns_of_records() {
        let known = |name: &&str| RECORDS.iter().any(|column| column.name == *name);
        assert!(DERIVED.iter().all(known));
        let [with, without] = [true, false].map(|mechanics| Rows::new(mechanics).places.len());
        let told = DERIVED.len() - DIRECTIONS.len();
        assert_eq!((with, without), (RECORDS.len() - told, RECORDS_OF_POSE - told));
        assert!(DIRECTIONS.iter().all(|name| DERIVED.contains(name)));
    }
}
