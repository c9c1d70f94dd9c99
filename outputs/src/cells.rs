//! Any Parquet file as named columns of text, for tables of measured plants.
//!
//! Whole and decimal numbers, truth values (1 and 0), texts and dictionaries of texts; a null is an empty text. So are
//! columns of a run, and small tables of texts and numbers are written. Absent: lists, structures, dates, and how the
//! tables of runs are found (`read`).

use crate::destination::Destination;
use crate::read::Run;
use crate::tables::Table;
use arrow_array::cast::AsArray;
use arrow_array::types::{
    ArrowDictionaryKeyType, Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type, UInt8Type, UInt16Type,
    UInt32Type, UInt64Type,
};
use arrow_array::{Array, ArrayRef, ArrowPrimitiveType, Float64Array, RecordBatch, StringArray};
use arrow_schema::DataType;
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::basic::{Compression, ZstdLevel};
use parquet::file::properties::WriterProperties;
use std::fs::File;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Arc;

/// The names of the columns, and the rows.
pub type Cells = (Vec<String>, Vec<Vec<String>>);

/// The most rows that are read.
const MOST_ROWS: usize = 20_000_000;

/// Reads a file.
///
/// # Errors
/// In words: it cannot be opened, is no Parquet file, is damaged, or has a column of a type that is not read.
pub fn read(path: &Path) -> Result<Cells, String> {
    let file = File::open(path).map_err(|error| format!("cannot be read: {error}"))?;
    // The reader of Parquet panics on some damaged files.
    catch_unwind(AssertUnwindSafe(|| of_file(file))).unwrap_or_else(|_| Err("is a damaged Parquet file".to_owned()))
}

fn of_file(file: File) -> Result<Cells, String> {
    let builder =
        ParquetRecordBatchReaderBuilder::try_new(file).map_err(|error| format!("is no Parquet file: {error}"))?;
    let names: Vec<String> = builder.schema().fields().iter().map(|field| field.name().clone()).collect();
    let mut rows: Vec<Vec<String>> = Vec::new();
    for batch in builder.build().map_err(|error| format!("cannot be read: {error}"))? {
        let batch = batch.map_err(|error| format!("is a damaged Parquet file: {error}"))?;
        let columns: Result<Vec<Vec<String>>, String> =
            batch.columns().iter().zip(&names).map(|(column, name)| texts(column, name)).collect();
        let columns = columns?;
        if rows.len() + batch.num_rows() > MOST_ROWS {
            return Err(format!("has more than {MOST_ROWS} rows"));
        }
        rows.extend((0..batch.num_rows()).map(|row| columns.iter().map(|column| column[row].clone()).collect()));
    }
    Ok((names, rows))
}

fn texts(column: &ArrayRef, name: &str) -> Result<Vec<String>, String> {
    Ok(match column.data_type() {
        DataType::Int8 => numbers::<Int8Type>(column),
        DataType::Int16 => numbers::<Int16Type>(column),
        DataType::Int32 => numbers::<Int32Type>(column),
        DataType::Int64 => numbers::<Int64Type>(column),
        DataType::UInt8 => numbers::<UInt8Type>(column),
        DataType::UInt16 => numbers::<UInt16Type>(column),
        DataType::UInt32 => numbers::<UInt32Type>(column),
        DataType::UInt64 => numbers::<UInt64Type>(column),
        DataType::Float32 => numbers::<Float32Type>(column),
        DataType::Float64 => numbers::<Float64Type>(column),
        DataType::Boolean => {
            column.as_boolean().iter().map(|v| v.map_or("", |v| if v { "1" } else { "0" }).into()).collect()
        }
        DataType::Utf8 => column.as_string::<i32>().iter().map(|v| v.unwrap_or_default().to_owned()).collect(),
        DataType::LargeUtf8 => column.as_string::<i64>().iter().map(|v| v.unwrap_or_default().to_owned()).collect(),
        DataType::Dictionary(key, value) if **value == DataType::Utf8 => match **key {
            DataType::Int8 => words::<Int8Type>(column),
            DataType::Int16 => words::<Int16Type>(column),
            DataType::Int32 => words::<Int32Type>(column),
            DataType::Int64 => words::<Int64Type>(column),
            _ => return Err(format!("has the column `{name}` of a type that is not read")),
        },
        other => return Err(format!("has the column `{name}` of type {other}, which is not read")),
    })
}

fn numbers<T: ArrowPrimitiveType>(column: &ArrayRef) -> Vec<String>
where
    T::Native: std::fmt::Display,
{
    column.as_primitive::<T>().iter().map(|v| v.map_or_else(String::new, |v| v.to_string())).collect()
}

fn words<K: ArrowDictionaryKeyType>(column: &ArrayRef) -> Vec<String> {
    let dictionary = column.as_dictionary::<K>();
    let values = dictionary.values().as_string::<i32>();
    let word = |key: Option<usize>| key.map_or_else(String::new, |key| values.value(key).to_owned());
    dictionary.keys_iter().map(word).collect()
}

/// The values of a column that is written.
#[derive(Debug, Clone, PartialEq)]
pub enum Written {
    /// Texts.
    Texts(Vec<String>),
    /// Numbers; `None` is null.
    Numbers(Vec<Option<f64>>),
}

/// Writes a small table as a Parquet file, zstd.
///
/// # Errors
/// In words: columns of unequal lengths, or a failed write.
pub fn write(path: &Path, columns: Vec<(&str, Written)>) -> Result<(), String> {
    let failed = |error: &dyn std::fmt::Display| format!("cannot write {}: {error}", path.display());
    let columns = columns.into_iter().map(|(name, values)| {
        let array: ArrayRef = match values {
            Written::Texts(texts) => Arc::new(StringArray::from(texts)),
            Written::Numbers(numbers) => Arc::new(Float64Array::from(numbers)),
        };
        (name, array, true)
    });
    let batch = RecordBatch::try_from_iter_with_nullable(columns).map_err(|error| failed(&error))?;
    let mut file = Destination::create(path).map_err(|error| failed(&error))?;
    let properties = WriterProperties::builder().set_compression(Compression::ZSTD(ZstdLevel::default())).build();
    let mut writer = ArrowWriter::try_new(&mut file, batch.schema(), Some(properties)).map_err(|e| failed(&e))?;
    writer.write(&batch).and_then(|()| writer.close()).map_err(|error| failed(&error))?;
    file.finish().map(drop).map_err(|error| failed(&error))
}

/// Columns of a table of a run as texts, row after row; the columns are in the order of the table.
///
/// # Errors
/// In words: a table that cannot be read.
pub fn of_run(run: &Run, table: Table, columns: &[&str]) -> Result<Cells, String> {
    let (mut names, mut rows): Cells = (Vec::new(), Vec::new());
    for batch in run.batches_with(table, columns).map_err(|error| error.to_string())? {
        let batch = batch.map_err(|error| error.to_string())?;
        names = batch.schema().fields().iter().map(|field| field.name().clone()).collect();
        let columns: Result<Vec<Vec<String>>, String> =
            batch.columns().iter().zip(&names).map(|(column, name)| texts(column, name)).collect();
        let columns = columns?;
        rows.extend((0..batch.num_rows()).map(|row| columns.iter().map(|column| column[row].clone()).collect()));
        if rows.len() > MOST_ROWS {
            return Err(format!("it has more than {MOST_ROWS} rows"));
        }
    }
    Ok((names, rows))
}

#[cfg(test)]
mod tests {
    use super::*;
    use arrow_array::{BooleanArray, DictionaryArray, Int32Array};

    #[test]
    fn what_was_written_is_read_as_text() {
        let fates: DictionaryArray<Int32Type> = vec![Some("long"), None].into_iter().collect();
        let columns: Vec<(&str, ArrayRef)> = vec![
            ("nodes", Arc::new(Int32Array::from(vec![Some(7), None]))),
            ("length", Arc::new(Float64Array::from(vec![0.5, 2.0]))),
            ("died", Arc::new(BooleanArray::from(vec![true, false]))),
            ("axis", Arc::new(StringArray::from(vec!["a", "b"]))),
            ("fate", Arc::new(fates)),
        ];
        let batch = RecordBatch::try_from_iter(columns).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.parquet");
        let mut writer = ArrowWriter::try_new(File::create(&path).unwrap(), batch.schema(), None).unwrap();
        writer.write(&batch).unwrap();
        writer.close().unwrap();
        let (names, rows) = read(&path).unwrap();
        assert_eq!(names, ["nodes", "length", "died", "axis", "fate"]);
        assert_eq!(rows, [["7", "0.5", "1", "a", "long"], ["", "2", "0", "b", ""]]);
        std::fs::write(&path, "nodes\n3\n").unwrap();
        assert!(read(&path).unwrap_err().contains("is no Parquet file"));
    }
}
