//! Tables of a run folder as a test reads them: by the parquet crate alone, whole columns in double precision.
//!
//! Nothing here depends on the columns of this program, so that tests which recompute numbers from tables are
//! independent of the code that wrote them.

#![allow(dead_code, reason = "each test program uses a part of it")]

use arrow_array::types::{Date32Type, Float32Type, Float64Type, Int8Type, Int32Type};
use arrow_array::{Array, BooleanArray, DictionaryArray, PrimitiveArray, StringArray};
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::Path;

/// All rows of one table.
#[derive(Debug, Default)]
pub struct Columns {
    numbers: BTreeMap<String, Vec<f64>>,
    words: BTreeMap<String, Vec<String>>,
}

impl Columns {
    /// The table in a folder of a run, part after part.
    pub fn of(run: &Path, table: &str) -> Self {
        let parts = fs::read_dir(run.join(table)).unwrap_or_else(|error| panic!("no table {table}: {error}"));
        let mut parts: Vec<_> = parts.map(|part| part.expect("an entry").path()).collect();
        parts.sort();
        let mut columns = Self::default();
        for part in parts {
            let reader = ParquetRecordBatchReaderBuilder::try_new(File::open(part).expect("a part")).expect("Parquet");
            for batch in reader.build().expect("a reader") {
                let batch = batch.expect("a batch");
                for (field, array) in batch.schema().fields().iter().zip(batch.columns()) {
                    columns.add(field.name(), array.as_ref());
                }
            }
        }
        columns
    }

    fn add(&mut self, name: &str, array: &dyn Array) {
        if let Some(words) = array.as_any().downcast_ref::<DictionaryArray<Int8Type>>() {
            let typed = words.downcast_dict::<StringArray>().expect("words");
            let words = typed.into_iter().map(|word| word.unwrap_or_default().to_owned());
            self.words.entry(name.to_owned()).or_default().extend(words);
        } else if let Some(names) = array.as_any().downcast_ref::<DictionaryArray<Int32Type>>() {
            let typed = names.downcast_dict::<StringArray>().expect("names");
            let names = typed.into_iter().map(|name| name.unwrap_or_default().to_owned());
            self.words.entry(name.to_owned()).or_default().extend(names);
        } else if let Some(numbers) = numbers(array) {
            self.numbers.entry(name.to_owned()).or_default().extend(numbers);
        }
    }

    /// A column of numbers; null is NaN, truth values are 0 and 1, and dates are days since 1970-01-01.
    #[track_caller]
    pub fn numbers(&self, name: &str) -> &[f64] {
        self.numbers.get(name).unwrap_or_else(|| panic!("no column {name}"))
    }

    /// A column of words; null is the empty word.
    #[track_caller]
    pub fn words(&self, name: &str) -> &[String] {
        self.words.get(name).unwrap_or_else(|| panic!("no column {name}"))
    }

    /// The names of all columns of numbers.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.numbers.keys().map(String::as_str)
    }
}

/// The numbers of an array; 64-bit hashes, which double precision cannot hold, are none.
fn numbers(array: &dyn Array) -> Option<Vec<f64>> {
    fn all<N, V: Copy>(rows: impl Iterator<Item = Option<V>>, as_number: impl Fn(V) -> N) -> Vec<f64>
    where
        f64: From<N>,
    {
        rows.map(|value| value.map_or(f64::NAN, |value| f64::from(as_number(value)))).collect()
    }
    let any = array.as_any();
    if let Some(values) = any.downcast_ref::<PrimitiveArray<Int32Type>>() {
        return Some(all(values.iter(), |value| value));
    }
    if let Some(values) = any.downcast_ref::<PrimitiveArray<Date32Type>>() {
        return Some(all(values.iter(), |value| value));
    }
    if let Some(values) = any.downcast_ref::<PrimitiveArray<Float32Type>>() {
        return Some(all(values.iter(), |value| value));
    }
    if let Some(values) = any.downcast_ref::<PrimitiveArray<Float64Type>>() {
        return Some(all(values.iter(), |value| value));
    }
    any.downcast_ref::<BooleanArray>().map(|values| all(values.iter(), u8::from))
}
