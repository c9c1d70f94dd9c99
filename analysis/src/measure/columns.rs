//! The columns of a batch of rows, by name and as numbers or words.
//!
//! Whole numbers, real numbers and truths of any width are read alike, so that a measure does not depend on how a
//! column is stored. Absent: reading of files.

use super::fault::Fault;
use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type};
use arrow_array::{Array, ArrayRef, PrimitiveArray, RecordBatch};
use arrow_schema::DataType;
use std::borrow::Cow;
use std::path::Path;

/// A batch of a table of a run.
pub(super) struct Columns<'a> {
    pub batch: &'a RecordBatch,
    pub run: &'a Path,
    pub table: &'static str,
}

/// A column of words: a place in a short list for each row.
pub(super) struct Words<'a> {
    /// The words that occur.
    pub words: Vec<String>,
    keys: Keys<'a>,
}

/// The places of words, as the column has them.
enum Keys<'a> {
    Bytes(&'a PrimitiveArray<Int8Type>),
    Ints(Cow<'a, [i32]>),
}

impl Words<'_> {
    /// The place of the word of a row in `words`; `None` for null.
    #[inline]
    pub fn at(&self, row: usize) -> Option<usize> {
        match &self.keys {
            Keys::Bytes(keys) if keys.is_null(row) => None,
            Keys::Bytes(keys) => usize::try_from(keys.value(row)).ok(),
            Keys::Ints(keys) => usize::try_from(keys[row]).ok(),
        }
    }
}

impl<'a> Columns<'a> {
    fn array(&self, name: &str) -> Result<&'a ArrayRef, Fault> {
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

    /// A column of whole numbers, −1 for null. One of 32 bits without nulls is not copied.
    pub fn ints(&self, name: &str) -> Result<Cow<'a, [i32]>, Fault> {
        let array = self.array(name)?;
        Ok(match array.data_type() {
            DataType::Int32 => whole(array.as_primitive::<Int32Type>()),
            DataType::Int16 => array.as_primitive::<Int16Type>().iter().map(|v| v.map_or(-1, i32::from)).collect(),
            DataType::Int8 => array.as_primitive::<Int8Type>().iter().map(|v| v.map_or(-1, i32::from)).collect(),
            DataType::Boolean => array.as_boolean().iter().map(|v| v.map_or(-1, i32::from)).collect(),
            _ => return Err(self.missing(name)),
        })
    }

    /// A column of numbers; `None` for null.
    pub fn numbers(&self, name: &str) -> Result<Vec<Option<f64>>, Fault> {
        let array = self.array(name)?;
        let found: Vec<Option<f64>> = match array.data_type() {
            DataType::Float64 => array.as_primitive::<Float64Type>().iter().collect(),
            DataType::Float32 => array.as_primitive::<Float32Type>().iter().map(|v| v.map(f64::from)).collect(),
            DataType::Int64 => array.as_primitive::<Int64Type>().iter().map(|v| v.map(|v| v as f64)).collect(),
            _ => self.ints(name)?.iter().map(|v| (*v >= 0).then_some(f64::from(*v))).collect(),
        };
        Ok(found.into_iter().map(|value| value.filter(|value| value.is_finite())).collect())
    }

    /// A column of words. The places that tables store, of 8 or 32 bits, are not copied.
    pub fn words(&self, name: &str) -> Result<Words<'a>, Fault> {
        let array = self.array(name)?;
        let dictionary = array.as_any_dictionary_opt().ok_or_else(|| self.missing(name))?;
        let values = dictionary.values().as_string_opt::<i32>().ok_or_else(|| self.missing(name))?;
        let words: Vec<String> = values.iter().map(|word| word.unwrap_or_default().to_owned()).collect();
        let keys = dictionary.keys();
        let keys = match (keys.as_primitive_opt::<Int8Type>(), keys.as_primitive_opt::<Int32Type>()) {
            _ if words.is_empty() => Keys::Ints(Cow::Owned(vec![-1; keys.len()])),
            (Some(bytes), _) => Keys::Bytes(bytes),
            (None, Some(ints)) => Keys::Ints(whole(ints)),
            (None, None) => {
                let key = |(row, key): (usize, usize)| if keys.is_null(row) { -1 } else { key as i32 };
                Keys::Ints(dictionary.normalized_keys().into_iter().enumerate().map(key).collect())
            }
        };
        Ok(Words { words, keys })
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

/// The values of a column, −1 for null.
fn whole(array: &PrimitiveArray<Int32Type>) -> Cow<'_, [i32]> {
    let Some(nulls) = array.nulls().filter(|nulls| nulls.null_count() > 0) else {
        return Cow::Borrowed(array.values());
    };
    let mut values = array.values().to_vec();
    values.iter_mut().zip(nulls.iter()).filter(|(_, valid)| !valid).for_each(|(value, _)| *value = -1);
    Cow::Owned(values)
}
