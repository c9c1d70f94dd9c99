//! One column of `records` by itself: what each component of a plant would have there, without a table.
//!
//! The rows are those of the table, made by the same code, so that what is coloured by a column shows what the table says.

use super::buffers::{Columns, Values};
use super::schema::Column;
use super::{RecordColumns, Scene, Standing, columns};
use crate::Error;
use phytomer_sim::Tick;
use phytomer_sim::plant::Plant;

/// Components whose rows are made at once.
const ROWS: usize = 512;

/// The value of a column for each component of a plant at an age, by its number; NaN where it is null and for components
/// that do not stand. Words are given by their places in the column's list.
///
/// # Errors
/// [`Error::PlantTooLarge`].
pub fn record_values(plant: &Plant, age: Tick, column: &Column) -> Result<Vec<f64>, Error> {
    let mut standing = Standing::default();
    standing.read(plant)?;
    standing.find_tips(plant, age);
    let place = columns::RECORDS.iter().position(|known| known.name == column.name).unwrap_or(0);
    let scene = Scene { plant, standing: &standing, age, mechanics: true };
    let mut values = vec![f64::NAN; standing.len() as usize];
    let (mut next, mut numbers, mut rows, mut filled) = (0, Vec::new(), Vec::new(), RecordColumns::default());
    while next < standing.len() {
        standing.select(age, ROWS, &mut next, &mut numbers);
        filled.fill(plant.id, &scene, &numbers, &mut rows);
        let mut taken = filled.take();
        let column = numbers_of(&taken[place]);
        for (number, value) in numbers.iter().zip(column) {
            values[*number as usize] = value;
        }
        taken.iter_mut().for_each(Values::clear);
        filled.give_back(taken);
    }
    Ok(values)
}

/// The numbers of a buffer, null as NaN.
fn numbers_of(values: &Values) -> Vec<f64> {
    let whole = |value: i64| if value < 0 { f64::NAN } else { value as f64 };
    match values {
        Values::Bool(values) | Values::Word(values) => values.iter().map(|value| whole(i64::from(*value))).collect(),
        Values::Int(values) => values.iter().map(|value| whole(i64::from(*value))).collect(),
        Values::Key(values) => values.iter().map(|value| *value as f64).collect(),
        Values::Float(values) => values.iter().map(|value| f64::from(*value)).collect(),
        Values::Double(values) => values.clone(),
    }
}
