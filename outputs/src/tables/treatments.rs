//! The table `treatments`: a row a treatment, with a column for each factor of the run.
//!
//! Its rows follow from the plan of the run alone, a lone control's too, and are written once, in part 0. Factors are
//! the user's, so their columns are made here and are no constants. Absent: the scenarios of the treatments, which
//! `run.json` has.

use super::arrow::{self, key_values};
use super::columns::TREATMENTS;
use super::part::PartReport;
use super::plan::Factor;
use super::{RunPlan, Table, TableError};
use crate::storage::durable::HashingFile;
use crate::storage::space::Watch;
use arrow_array::types::Int32Type;
use arrow_array::{ArrayRef, DictionaryArray, Int32Array, RecordBatch};
use arrow_schema::{ArrowError, DataType, Field, Schema};
use parquet::arrow::ArrowWriter;
use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

/// What the column of a factor says of itself.
pub fn description_of(factor: &Factor) -> String {
    format!("The level of the factor `{}`.", factor.name)
}

/// The rows of the table, with the metadata of the run.
///
/// # Errors
/// Where Arrow refuses the columns, as it would two factors of one name.
pub fn batch(plan: &RunPlan) -> Result<RecordBatch, TableError> {
    let metadata = key_values(Table::Treatments, plan).into_iter();
    let metadata = metadata.map(|pair| (pair.key, pair.value.unwrap_or_default())).collect();
    let table = Table::Treatments.name();
    rows(plan, metadata).map_err(|source| TableError::Batch { table, source: source.into() })
}

fn rows(plan: &RunPlan, metadata: HashMap<String, String>) -> Result<RecordBatch, ArrowError> {
    let provenance = &plan.provenance;
    let mut fields: Vec<Field> = TREATMENTS.iter().map(arrow::field).collect();
    let words = |words: &[String]| -> ArrayRef {
        Arc::new(words.iter().map(String::as_str).collect::<DictionaryArray<Int32Type>>())
    };
    let index = Int32Array::from_iter_values(0..provenance.treatments.len() as i32);
    let mut columns: Vec<ArrayRef> = vec![Arc::new(index), words(&provenance.treatments)];
    for factor in &provenance.factors {
        let holds = DataType::Dictionary(Box::new(DataType::Int32), Box::new(DataType::Utf8));
        let described = HashMap::from([("description".to_owned(), description_of(factor))]);
        fields.push(Field::new(&factor.name, holds, false).with_metadata(described));
        columns.push(words(&factor.levels));
    }
    RecordBatch::try_new(Arc::new(Schema::new(fields).with_metadata(metadata)), columns)
}

/// Writes the part file of the table.
///
/// # Errors
/// A failed write.
pub(crate) fn write(path: &Path, plan: &RunPlan, watch: &Arc<Watch>) -> Result<PartReport, TableError> {
    let properties = arrow::properties(Table::Treatments, plan).map_err(TableError::write(path))?;
    let rows = rows(plan, HashMap::new()).map_err(|source| TableError::write(path)(source.into()))?;
    let writer = ArrowWriter::try_new(HashingFile::create(path, watch)?, rows.schema(), Some(properties));
    let mut writer = writer.map_err(TableError::write(path))?;
    writer.write(&rows).map_err(TableError::write(path))?;
    let file = writer.into_inner().map_err(TableError::write(path))?;
    let (bytes, sha256) = file.finish()?;
    Ok(PartReport { rows: rows.num_rows() as u64, bytes, sha256 })
}
