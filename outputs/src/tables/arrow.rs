//! The declared columns of a table as Arrow and Parquet take them: types, field metadata, encodings, key-value
//! metadata.
//!
//! Nothing in a file depends on the clock, the machine or the number of threads; `created_by` names this program.

use super::columns::SCHEMA_VERSION;
use super::schema::{Column, Encoding, Type};
use super::{Factor, RunPlan, Table};
use arrow_schema::{DataType, Field, Schema, SchemaRef};
use parquet::basic::{Compression, Encoding as ParquetEncoding, ZstdLevel};
use parquet::errors::ParquetError;
use parquet::file::metadata::{KeyValue, SortingColumn};
use parquet::file::properties::{EnabledStatistics, WriterProperties, WriterPropertiesBuilder};
use parquet::schema::types::ColumnPath;
use phytomer_sim::plant::Kind;
use std::collections::HashMap;
use std::sync::Arc;

/// The largest dictionary, in bytes, of a column with [`Encoding::Repeated`]; a column with more values is written
/// without.
const SMALL_DICTIONARY: usize = 64 * 1024;

/// The Arrow schema of a table with these columns. The metadata of a field has its `unit` and its `description`.
pub fn schema(columns: &[Column]) -> SchemaRef {
    Arc::new(Schema::new(columns.iter().map(field).collect::<Vec<_>>()))
}

/// A column as an Arrow field.
pub fn field(column: &Column) -> Field {
    let mut metadata = HashMap::from([("description".to_owned(), column.description.to_owned())]);
    if !column.unit.is_empty() {
        metadata.insert("unit".to_owned(), column.unit.to_owned());
    }
    Field::new(column.name, data_type(column.holds), column.nullable).with_metadata(metadata)
}

fn data_type(holds: Type) -> DataType {
    match holds {
        Type::Bool => DataType::Boolean,
        Type::Int => DataType::Int32,
        Type::Key => DataType::Int64,
        Type::Date => DataType::Date32,
        Type::Float => DataType::Float32,
        Type::Double => DataType::Float64,
        Type::Word(_) => DataType::Dictionary(Box::new(DataType::Int8), Box::new(DataType::Utf8)),
        Type::Name(_) => DataType::Dictionary(Box::new(DataType::Int32), Box::new(DataType::Utf8)),
    }
}

/// The writer properties of the files of a table: encodings, compression, metadata.
///
/// # Errors
/// Where zstd has no such level as the plan states.
pub fn properties(table: Table, plan: &RunPlan) -> Result<WriterProperties, ParquetError> {
    let base = basis(plan.compression_level)?
        .set_created_by(format!("phytomer version {}", plan.provenance.version))
        .set_sorting_columns(Some(sorting(table, plan.columns(table))))
        .set_key_value_metadata(Some(key_values(table, plan)));
    let declared = plan.columns(table).iter().fold(base, encode);
    let factors = plan.provenance.factors.iter().filter(|_| table == Table::Treatments);
    let words = |properties: WriterPropertiesBuilder, factor: &Factor| {
        properties.set_column_dictionary_enabled(ColumnPath::from(factor.name.as_str()), true)
    };
    Ok(factors.fold(declared, words).build())
}

/// What the files of all tables have, without the encodings of their columns.
pub(super) fn basis(compression_level: i32) -> Result<WriterPropertiesBuilder, ParquetError> {
    Ok(WriterProperties::builder()
        .set_compression(Compression::ZSTD(ZstdLevel::try_new(compression_level)?))
        .set_max_row_group_row_count(Some(super::ROW_GROUP))
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_dictionary_enabled(false))
}

/// States the encoding of a column.
pub(super) fn encode(properties: WriterPropertiesBuilder, column: &Column) -> WriterPropertiesBuilder {
    let path = || ColumnPath::from(column.name);
    match column.encoding {
        Encoding::Plain => properties.set_column_encoding(path(), ParquetEncoding::PLAIN),
        Encoding::Delta => properties.set_column_encoding(path(), ParquetEncoding::DELTA_BINARY_PACKED),
        Encoding::Split => properties.set_column_encoding(path(), ParquetEncoding::BYTE_STREAM_SPLIT),
        Encoding::Dictionary => properties.set_column_dictionary_enabled(path(), true),
        Encoding::Repeated => properties
            .set_column_encoding(path(), ParquetEncoding::BYTE_STREAM_SPLIT)
            .set_column_dictionary_enabled(path(), true)
            .set_column_dictionary_page_size_limit(path(), SMALL_DICTIONARY),
    }
}

fn sorting(table: Table, columns: &[Column]) -> Vec<SortingColumn> {
    let place = |name: &&str| columns.iter().position(|column| column.name == *name);
    let sorted = |place: usize| SortingColumn { column_idx: place as i32, descending: false, nulls_first: false };
    table.sorted_by().iter().filter_map(place).map(sorted).collect()
}

/// The key-value metadata of each file of a table, which all parts share.
pub fn key_values(table: Table, plan: &RunPlan) -> Vec<KeyValue> {
    let provenance = &plan.provenance;
    let entry = |key: &str, value: String| KeyValue::new(format!("phytomer.{key}"), value);
    vec![
        entry("table", table.name().to_owned()),
        entry("schema_version", SCHEMA_VERSION.to_owned()),
        entry("version", provenance.version.clone()),
        entry("git_hash", provenance.git_hash.clone()),
        entry("scenario", provenance.scenario.clone()),
        entry("treatments", serde_json::json!(provenance.treatments).to_string()),
        entry("species", serde_json::json!(provenance.species).to_string()),
        entry("ticks_per_year", serde_json::json!(provenance.ticks_per_year).to_string()),
        entry("seed", provenance.seed.to_string()),
        entry("units", units(plan.mechanics && table == Table::Records)),
        entry("rounding", rounding(plan)),
        entry("plant_ontology", plant_ontology().to_string()),
    ]
}

fn units(mechanics: bool) -> String {
    let of_mechanics = if mechanics { ", kilograms, newton metres" } else { "" };
    format!(
        "metres, square metres, cubic metres, radians{of_mechanics}; ticks of the plot, ages in ticks since the plant was sown; Z is up"
    )
}

fn rounding(plan: &RunPlan) -> String {
    match plan.precision_m {
        Some(precision) => {
            format!("positions to the greatest power of two not above {precision} m, directions to 2^-12")
        }
        None => "none".to_owned(),
    }
}

/// The Plant Ontology terms as JSON, by the names of kinds.
pub fn plant_ontology() -> serde_json::Value {
    Kind::ALL.map(|kind| (kind.tag().to_owned(), serde_json::Value::from(kind.ontology_term()))).into_iter().collect()
}
