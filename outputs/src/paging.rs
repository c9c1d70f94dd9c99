//! The rows of `records` for a page, with the values that the table holds.
//!
//! A page keeps the columns that do not follow from the plant, its age and its form. Places and directions follow from
//! the form; treatment, plot, plant, tick and age are the same for a whole plant. The columns of mechanics are kept for
//! runs that record them. Absent: how a page stores the values (`phytomer_pages`).

use crate::tables::columns::{RECORDS, RECORDS_OF_POSE};
use crate::tables::schema::{self, Type};
use crate::tables::{ComponentIndex, Membership, TableError, each_record};
use phytomer_pages::{Column, Holds, Table};
use phytomer_sim::Tick;
use phytomer_sim::plant::Plant;

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

/// Fills tables of pages.
#[derive(Debug)]
pub struct Rows {
    columns: Vec<Column>,
    places: Vec<usize>,
    index: ComponentIndex,
}

impl Rows {
    /// For a run with or without the columns of mechanics.
    pub fn new(mechanics: bool) -> Self {
        let count = if mechanics { RECORDS.len() } else { RECORDS_OF_POSE };
        let columns: Vec<Column> = RECORDS[..count].iter().map(of_page).collect();
        let places = columns.iter().enumerate().filter(|(_, column)| column.kept).map(|(place, _)| place).collect();
        Self { columns, places, index: ComponentIndex::default() }
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
            table.row(number, values.iter().copied());
        })
    }
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
        assert_eq!((with, without), (RECORDS.len() - DERIVED.len(), RECORDS_OF_POSE - DERIVED.len()));
    }
}
