//! One column of `records` by itself: the value of each component of a plant at an age, without a table.
//!
//! The values are made by the code that fills the table, so that a picture coloured by a column agrees with the table.
//! Absent: the colours (`colouring`).

use super::buffers::{Columns, Values};
use super::schema::Column;
use super::{ComponentIndex, Membership, PlantAtAge, RecordColumns, TableError, columns};
use phytomer_sim::Tick;
use phytomer_sim::plant::Plant;
use phytomer_sim::site::light::Field;

/// The number of components whose rows are made at a time.
const ROWS: usize = 512;

/// The values of a column of `records` for all components of a plant at an age, by component number. NaN stands for
/// null and for components that do not stand. A word is given as its index in the column's list, a name as its index in
/// the run's list. Takes as long as making the rows of `records` of the plant.
///
/// # Errors
/// [`TableError::PlantTooLarge`].
pub fn record_values(of: Membership, plant: &Plant, age: Tick, column: &Column) -> Result<Vec<f64>, TableError> {
    let place = columns::RECORDS.iter().position(|known| known.name == column.name).unwrap_or(0);
    let mut values = vec![f64::NAN; plant.components() as usize];
    each_record((of, plant, age), &[place], &mut ComponentIndex::default(), &mut |number, row| {
        values[number as usize] = row[0];
    })?;
    Ok(values)
}

/// The shares of light of the leaves and apical buds of a plant at an age, by component number, as `records` has them:
/// NaN for others. The light is that of the plot as the plant stands in it.
///
/// # Errors
/// [`TableError::PlantTooLarge`].
pub fn light_values(plant: &Plant, age: Tick, light: &Field) -> Result<Vec<f64>, TableError> {
    let mut index = ComponentIndex::default();
    index.read(plant)?;
    index.find_tips(plant, age);
    let lit = Some(Some(light));
    let shown = PlantAtAge { of: Membership::default(), plant, index: &index, age, mechanics: false, lit };
    let (mut next, mut numbers, mut values) = (0, Vec::new(), vec![f64::NAN; plant.components() as usize]);
    while next < index.len() {
        index.select(age, ROWS, &mut next, &mut numbers);
        for number in &numbers {
            values[*number as usize] = f64::from(shown.light_of(index.component(*number), Some(light)));
        }
    }
    Ok(values)
}

/// Tells of each component that stands at an age its number and its values in some columns of `records`, by their
/// places, as [`record_values`] has them; in the order of their numbers. `index` is working memory, kept between calls.
///
/// # Errors
/// [`TableError::PlantTooLarge`].
pub fn each_record(
    (of, plant, age): (Membership, &Plant, Tick),
    places: &[usize],
    index: &mut ComponentIndex,
    tell: &mut dyn FnMut(u32, &[f64]),
) -> Result<(), TableError> {
    index.read(plant)?;
    index.find_tips(plant, age);
    let shown = PlantAtAge { of, plant, index, age, mechanics: true, lit: None };
    let (mut next, mut numbers, mut rows, mut filled) = (0, Vec::new(), Vec::new(), RecordColumns::default());
    let mut row = vec![f64::NAN; places.len()];
    while next < index.len() {
        index.select(age, ROWS, &mut next, &mut numbers);
        filled.fill(&shown, &numbers, &mut rows);
        let mut taken = filled.take();
        let columns: Vec<Vec<f64>> = places.iter().map(|place| numbers_of(&taken[*place])).collect();
        for (at, number) in numbers.iter().enumerate() {
            row.iter_mut().zip(&columns).for_each(|(value, column)| *value = column[at]);
            tell(*number, &row);
        }
        taken.iter_mut().for_each(Values::clear);
        filled.give_back(taken);
    }
    Ok(())
}

/// The values of a buffer as numbers; NaN stands for null.
fn numbers_of(values: &Values) -> Vec<f64> {
    let whole = |value: i64| if value < 0 { f64::NAN } else { value as f64 };
    match values {
        Values::Bool(values) | Values::Word(values) => values.iter().map(|value| whole(i64::from(*value))).collect(),
        Values::Int(values) | Values::Name(values) => values.iter().map(|value| whole(i64::from(*value))).collect(),
        Values::Date(values) => values.iter().map(|value| f64::from(*value)).collect(),
        Values::Key(values) => values.iter().map(|value| *value as f64).collect(),
        Values::Float(values) => values.iter().map(|value| f64::from(*value)).collect(),
        Values::Double(values) => values.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read::Run;
    use crate::specimen::{plan, plot, run};
    use crate::tables::Table;
    use arrow_array::types::{Float32Type, Int32Type};
    use arrow_array::{Array, PrimitiveArray};
    use phytomer_sim::{Plot, RecordError, Recorder, grow};
    use std::collections::BTreeMap;

    /// Keeps the values of two columns at an age.
    struct Kept(Tick, [Vec<f64>; 2]);

    impl Recorder for Kept {
        fn wants(&self, age: Tick) -> bool {
            age == self.0
        }

        fn record(&mut self, age: Tick, plot: &Plot) -> Result<(), RecordError> {
            let column = |name: &str| columns::RECORDS.iter().find(|column| column.name == name).unwrap();
            for (kept, name) in self.1.iter_mut().zip(["diameter_m", "birth_age"]) {
                *kept = record_values(Membership::of(plot, 0), &plot.plants[0], age, column(name))?;
            }
            Ok(())
        }
    }

    #[test]
    fn a_column_by_itself_is_that_of_the_table() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run");
        run(&path, plan(1, 1));
        let mut kept = Kept(7, Default::default());
        grow(&mut plot(0, 100_000), 12, &mut kept).unwrap();
        let mut table = BTreeMap::new();
        for batch in Run::open(&path).unwrap().batches(Table::Records).unwrap() {
            let batch = batch.unwrap();
            let whole = |name: &str| {
                let array = batch.column_by_name(name).unwrap().as_any();
                array.downcast_ref::<PrimitiveArray<Int32Type>>().unwrap().clone()
            };
            let diameters = batch.column_by_name("diameter_m").unwrap().as_any();
            let diameters = diameters.downcast_ref::<PrimitiveArray<Float32Type>>().unwrap();
            let (ages, components, births) = (whole("age"), whole("component_id"), whole("birth_age"));
            for row in (0..batch.num_rows()).filter(|row| ages.value(*row) == 7) {
                let diameter = diameters.is_valid(row).then(|| f64::from(diameters.value(row)));
                table.insert(components.value(row) as usize, (diameter, f64::from(births.value(row))));
            }
        }
        assert!(table.len() > 10);
        let Kept(_, [diameters, births]) = kept;
        for (number, (diameter, birth)) in diameters.iter().zip(&births).enumerate() {
            let (in_table, born) = table.get(&number).copied().unwrap_or((None, f64::NAN));
            assert_eq!((!diameter.is_nan()).then_some(*diameter), in_table, "component {number}");
            assert!(*birth == born || birth.is_nan() && born.is_nan(), "component {number}: {birth} {born}");
        }
    }
}
