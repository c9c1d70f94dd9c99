//! `instances.parquet`: a row for each plant of a forest.
//!
//! The rows of a species stand together, in the order in which the species are stated; within it row by row of the
//! raster from the north. Row groups have the size of those of runs. Absent: what a variant looks like.

use crate::cover::Cover;
use crate::height::Heights;
use crate::planting::Planting;
use arrow_array::builder::{Float32Builder, Float64Builder, Int32Builder};
use arrow_array::types::Int32Type;
use arrow_array::{ArrayRef, DictionaryArray, Int32Array, RecordBatch, StringArray};
use arrow_schema::{DataType, Field, Schema, SchemaRef};
use parquet::arrow::ArrowWriter;
use parquet::basic::{Compression, Encoding, ZstdLevel};
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::schema::types::ColumnPath;
use std::collections::HashMap;
use std::io::Write;
use std::sync::Arc;

/// The rows of a row group.
const ROW_GROUP: usize = 122_880;

/// Why the table is not written.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    /// Parquet or the disk.
    #[error("the table of instances cannot be written")]
    Parquet(#[from] parquet::errors::ParquetError),
    /// A column that does not fit the others, which is a mistake of this program.
    #[error("the table of instances cannot be made")]
    Arrow(#[from] arrow_schema::ArrowError),
}

/// Each column: its name, its unit, what it is.
const COLUMNS: [(&str, &str, &str); 7] = [
    ("species", "", "The name of the species."),
    ("variant", "", "The number of the species' variant, from 0."),
    ("x_m", "m", "The place to the east."),
    ("y_m", "m", "The place to the north."),
    ("z_m", "m", "The height of the ground."),
    ("turn_rad", "rad", "The turn about the vertical, from the east to the north."),
    ("scale", "", "The size over that of the variant."),
];

fn schema() -> SchemaRef {
    let of = |name: &str| match name {
        "species" => DataType::Dictionary(Box::new(DataType::Int32), Box::new(DataType::Utf8)),
        "variant" => DataType::Int32,
        "turn_rad" | "scale" => DataType::Float32,
        _ => DataType::Float64,
    };
    let field = |(name, unit, description): (&str, &str, &str)| {
        let mut metadata = HashMap::from([("description".to_owned(), description.to_owned())]);
        metadata.extend((!unit.is_empty()).then(|| ("unit".to_owned(), unit.to_owned())));
        Field::new(name, of(name), false).with_metadata(metadata)
    };
    Arc::new(Schema::new(COLUMNS.map(field).to_vec()))
}

fn properties(version: &str) -> Result<WriterProperties, TableError> {
    let plain = WriterProperties::builder()
        .set_created_by(format!("phytomer version {version}"))
        .set_compression(Compression::ZSTD(ZstdLevel::try_new(1)?))
        .set_max_row_group_row_count(Some(ROW_GROUP))
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_dictionary_enabled(false)
        .set_column_dictionary_enabled(ColumnPath::from("species"), true)
        .set_column_encoding(ColumnPath::from("variant"), Encoding::DELTA_BINARY_PACKED);
    let floats = COLUMNS[2..].iter().fold(plain, |properties, (name, _, _)| {
        properties.set_column_encoding(ColumnPath::from(*name), Encoding::BYTE_STREAM_SPLIT)
    });
    Ok(floats.build())
}

/// The columns of a row group that is being filled.
#[derive(Default)]
struct Rows {
    species: Vec<i32>,
    variant: Int32Builder,
    places: [Float64Builder; 3],
    turn: Float32Builder,
    scale: Float32Builder,
}

impl Rows {
    fn batch(&mut self, schema: &SchemaRef, names: &Arc<StringArray>) -> Result<RecordBatch, TableError> {
        let keys = Int32Array::from(std::mem::take(&mut self.species));
        let species = DictionaryArray::<Int32Type>::try_new(keys, Arc::clone(names) as ArrayRef)?;
        let mut columns: Vec<ArrayRef> = vec![Arc::new(species), Arc::new(self.variant.finish())];
        columns.extend(self.places.iter_mut().map(|place| Arc::new(place.finish()) as ArrayRef));
        columns.extend([Arc::new(self.turn.finish()) as ArrayRef, Arc::new(self.scale.finish())]);
        Ok(RecordBatch::try_new(Arc::clone(schema), columns)?)
    }
}

/// Writes the plants of all plantings, each with the name of its species, and gives the number of each.
///
/// # Errors
/// Those of `out`.
pub fn write_instances(
    cover: &Cover,
    heights: Option<&Heights>,
    plantings: &[(&str, Planting)],
    version: &str,
    out: impl Write + Send,
) -> Result<Vec<u64>, TableError> {
    let schema = schema();
    let names = Arc::new(StringArray::from_iter_values(plantings.iter().map(|(name, _)| *name)));
    let mut writer = ArrowWriter::try_new(out, Arc::clone(&schema), Some(properties(version)?))?;
    let (mut rows, mut counts) = (Rows::default(), Vec::new());
    for (number, (_, planting)) in (0_i32..).zip(plantings) {
        let mut count = 0;
        planting.each(cover, heights, |instance| {
            count += 1;
            rows.species.push(number);
            rows.variant.append_value(instance.variant as i32);
            rows.places.iter_mut().zip(instance.place_m).for_each(|(column, place)| column.append_value(place));
            rows.turn.append_value(instance.turn_rad as f32);
            rows.scale.append_value(instance.scale as f32);
            if rows.species.len() == ROW_GROUP {
                writer.write(&rows.batch(&schema, &names)?)?;
            }
            Ok::<(), TableError>(())
        })?;
        counts.push(count);
    }
    if !rows.species.is_empty() {
        writer.write(&rows.batch(&schema, &names)?)?;
    }
    writer.close()?;
    Ok(counts)
}
