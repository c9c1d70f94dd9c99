//! The columns of a batch of rows, by name and as numbers or words.
//!
//! Whole numbers, real numbers and truths of any width are read alike, so that a measure does not depend on how a
//! column is stored. Absent: reading of files.

use super::fault::Fault;
use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type};
use arrow_array::{Array, ArrayRef, PrimitiveArray, RecordBatch};
use arrow_schema::DataType;
use std::path::Path;

/// A batch of a table of a run.
pub(super) struct Columns<'a> {
    pub batch: &'a RecordBatch,
    pub run: &'a Path,
    pub table: &'static str,
}

/// A column of words: a place in a short list for each row.
pub(super) struct Words {
    /// The words that occur.
    pub words: Vec<String>,
    keys: Vec<i32>,
}

impl Words {
    /// The place of the word of a row in `words`; `None` for null.
    pub fn at(&self, row: usize) -> Option<usize> {
        usize::try_from(self.keys[row]).ok()
    }
}

impl Columns<'_> {
    fn array(&self, name: &str) -> Result<&ArrayRef, Fault> {
        self.batch.column_by_name(name).ok_or_else(|| self.missing(name))
    }

    fn missing(&self, name: &str) -> Fault {
        Fault::NoColumn {
            path: self.run.to_path_buf(),
            table: self.table,
            column: name.to_owned(),
            hint: "a run of a newer phytomer may have it: grow it again".to_owned(),
        }
    }

    /// A column of whole numbers, −1 for null.
    pub fn ints(&self, name: &str) -> Result<Vec<i32>, Fault> {
        let array = self.array(name)?;
        let found: Vec<i32> = match array.data_type() {
            DataType::Int32 => whole(array.as_primitive::<Int32Type>()),
            DataType::Int16 => array.as_primitive::<Int16Type>().iter().map(|v| v.map_or(-1, i32::from)).collect(),
            DataType::Int8 => array.as_primitive::<Int8Type>().iter().map(|v| v.map_or(-1, i32::from)).collect(),
            DataType::Boolean => array.as_boolean().iter().map(|v| v.map_or(-1, i32::from)).collect(),
            _ => return Err(self.missing(name)),
        };
        Ok(found)
    }

    /// A column of numbers; `None` for null.
    pub fn numbers(&self, name: &str) -> Result<Vec<Option<f64>>, Fault> {
        let array = self.array(name)?;
        let found: Vec<Option<f64>> = match array.data_type() {
            DataType::Float64 => array.as_primitive::<Float64Type>().iter().collect(),
            DataType::Float32 => array.as_primitive::<Float32Type>().iter().map(|v| v.map(f64::from)).collect(),
            DataType::Int64 => array.as_primitive::<Int64Type>().iter().map(|v| v.map(|v| v as f64)).collect(),
            _ => self.ints(name)?.into_iter().map(|v| (v >= 0).then_some(f64::from(v))).collect(),
        };
        Ok(found.into_iter().map(|value| value.filter(|value| value.is_finite())).collect())
    }

    /// A column of words.
    pub fn words(&self, name: &str) -> Result<Words, Fault> {
        let array = self.array(name)?;
        let dictionary = array.as_any_dictionary_opt().ok_or_else(|| self.missing(name))?;
        let values = dictionary.values().as_string_opt::<i32>().ok_or_else(|| self.missing(name))?;
        let words: Vec<String> = values.iter().map(|word| word.unwrap_or_default().to_owned()).collect();
        let keys = dictionary.keys();
        if values.is_empty() {
            return Ok(Words { words: Vec::new(), keys: vec![-1; keys.len()] });
        }
        let normalized = dictionary.normalized_keys();
        let key = |(row, key): (usize, usize)| if keys.is_null(row) { -1 } else { key as i32 };
        Ok(Words { words, keys: normalized.into_iter().enumerate().map(key).collect() })
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.batch.num_rows()
    }

    /// Whether the table has a column.
    pub fn has(&self, name: &str) -> bool {
        self.batch.column_by_name(name).is_some()
    }
}

/// The values of a column, −1 for null. Values are copied in one go, since most columns have no null.
fn whole(array: &PrimitiveArray<Int32Type>) -> Vec<i32> {
    let mut values = array.values().to_vec();
    if let Some(nulls) = array.nulls().filter(|nulls| nulls.null_count() > 0) {
        values.iter_mut().zip(nulls.iter()).filter(|(_, valid)| !valid).for_each(|(value, _)| *value = -1);
    }
    values
}
