//! `shade.parquet`: a row for each state of the plan, zone and month, and `arrangement.parquet`: a row for each spot.
//!
//! The states are `planned`, what stands by the file, and `arranged`, that with the chosen trees. The row of a year has
//! no month. Absent: what the hours are made of (`hours`).

use crate::hours::Shade;
use arrow_array::types::Int32Type;
use arrow_array::{ArrayRef, DictionaryArray, Float64Array, Int32Array, RecordBatch, StringArray};
use arrow_schema::{DataType, Field, Schema, SchemaRef};
use parquet::arrow::ArrowWriter;
use parquet::basic::{Compression, ZstdLevel};
use parquet::file::properties::WriterProperties;
use std::collections::HashMap;
use std::io::Write;
use std::sync::Arc;

/// Why a table is not written.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    /// Parquet or the disk.
    #[error("the table cannot be written")]
    Parquet(#[from] parquet::errors::ParquetError),
    /// A column that does not fit the others, which is a mistake of this program.
    #[error("the table cannot be made")]
    Arrow(#[from] arrow_schema::ArrowError),
}

/// A column: its name, its unit, what it is, and whether it may be null.
type Column = (&'static str, &'static str, &'static str, bool);

/// The columns of `shade.parquet`.
pub const HOURS: [Column; 11] = [
    ("state", "", "planned: what stands by the file; arranged: that with the chosen trees.", false),
    ("zone", "", "The name of the zone.", false),
    ("month", "", "The month, 1 to 12; null in the row of the whole year.", true),
    ("area_m2", "m2", "The area of the zone.", false),
    ("sun_h", "h/d", "How long the sun is up, hours a day.", false),
    (
        "shade_h",
        "h/d",
        "How long the zone lies in the shade while the sun is up, hours a day: the mean by area.",
        false,
    ),
    ("building_h", "h/d", "How long it lies in the shade of a building.", false),
    ("plant_h", "h/d", "How long it lies in the shade of a plant and of no building.", false),
    ("share", "", "The share of the daylight in the shade; null where the sun is not up.", true),
    (
        "mostly_shaded",
        "",
        "The share of the area in the shade for half of the daylight or longer; null as before.",
        true,
    ),
    (
        "error_h",
        "h/d",
        "What shade_h may be off by, estimated from changes between moments and from the cells of the grid.",
        false,
    ),
];

/// The columns of `arrangement.parquet`.
pub const SPOTS: [Column; 7] = [
    ("spot", "", "The name of the spot.", false),
    ("x_m", "m", "Its place to the east.", false),
    ("y_m", "m", "Its place to the north.", false),
    ("row", "", "Its row, 1 in front; null where it has none.", true),
    ("candidate", "", "The name of the candidate that is planted there; null where the spot stays empty.", true),
    ("cost", "", "What the candidate costs; null where the spot stays empty.", true),
    ("height_m", "m", "How high the candidate is; null where the spot stays empty.", true),
];

/// A spot and what is planted there.
#[derive(Debug, Clone, PartialEq)]
pub struct Spot {
    /// Its name.
    pub name: String,
    /// Its place, metres.
    pub place: [f64; 2],
    /// Its row.
    pub row: Option<u32>,
    /// The name, the cost and the height of what is planted.
    pub planted: Option<(String, f64, f64)>,
}

/// Writes the hours of some states, each with its name, of zones with these names and areas.
///
/// # Errors
/// Those of `out`.
pub fn write_hours(
    states: &[(&str, &Shade)],
    zones: &[(&str, f64)],
    version: &str,
    out: impl Write + Send,
) -> Result<(), TableError> {
    let rows = states.iter().flat_map(|(state, shade)| {
        let zones = zones.iter().zip(&shade.zones);
        zones.flat_map(move |(zone, months)| months.iter().enumerate().map(move |row| (*state, *zone, row)))
    });
    let rows: Vec<_> = rows.collect();
    let texts = |of: &dyn Fn(usize) -> String| -> ArrayRef {
        let values: Vec<String> = (0..rows.len()).map(of).collect();
        Arc::new(values.iter().map(String::as_str).collect::<DictionaryArray<Int32Type>>())
    };
    let number =
        |of: &dyn Fn(usize) -> f64| -> ArrayRef { Arc::new(Float64Array::from_iter_values((0..rows.len()).map(of))) };
    let maybe =
        |of: &dyn Fn(usize) -> Option<f64>| -> ArrayRef { Arc::new((0..rows.len()).map(of).collect::<Float64Array>()) };
    let told = |row: usize| *rows[row].2.1;
    let months = rows.iter().map(|(_, _, (month, _))| (*month < 12).then_some(*month as i32 + 1));
    let columns: Vec<ArrayRef> = vec![
        texts(&|row| rows[row].0.to_owned()),
        texts(&|row| rows[row].1.0.to_owned()),
        Arc::new(months.collect::<Int32Array>()),
        number(&|row| rows[row].1.1),
        number(&|row| told(row).sun_h),
        number(&|row| told(row).shade_h()),
        number(&|row| told(row).building_h),
        number(&|row| told(row).plant_h),
        maybe(&|row| told(row).share()),
        maybe(&|row| told(row).share().map(|_| told(row).mostly_shaded)),
        number(&|row| told(row).error_h),
    ];
    write(&HOURS, columns, version, out)
}

/// Writes what is planted at each spot.
///
/// # Errors
/// Those of `out`.
pub fn write_spots(spots: &[Spot], version: &str, out: impl Write + Send) -> Result<(), TableError> {
    let planted = || spots.iter().map(|spot| spot.planted.as_ref());
    let columns: Vec<ArrayRef> = vec![
        Arc::new(StringArray::from_iter_values(spots.iter().map(|spot| spot.name.as_str()))),
        Arc::new(Float64Array::from_iter_values(spots.iter().map(|spot| spot.place[0]))),
        Arc::new(Float64Array::from_iter_values(spots.iter().map(|spot| spot.place[1]))),
        Arc::new(spots.iter().map(|spot| spot.row.map(|row| row as i32)).collect::<Int32Array>()),
        Arc::new(planted().map(|planted| planted.map(|(name, _, _)| name.as_str())).collect::<StringArray>()),
        Arc::new(planted().map(|planted| planted.map(|(_, cost, _)| *cost)).collect::<Float64Array>()),
        Arc::new(planted().map(|planted| planted.map(|(_, _, height)| *height)).collect::<Float64Array>()),
    ];
    write(&SPOTS, columns, version, out)
}

/// Writes columns that are described so.
fn write(about: &[Column], columns: Vec<ArrayRef>, version: &str, out: impl Write + Send) -> Result<(), TableError> {
    let field = |((name, unit, description, may_be_null), column): (&Column, &ArrayRef)| {
        let mut metadata = HashMap::from([("description".to_owned(), (*description).to_owned())]);
        metadata.extend((!unit.is_empty()).then(|| ("unit".to_owned(), (*unit).to_owned())));
        Field::new(*name, column.data_type().clone(), *may_be_null).with_metadata(metadata)
    };
    let schema: SchemaRef = Arc::new(Schema::new(about.iter().zip(&columns).map(field).collect::<Vec<Field>>()));
    let floats = schema.fields().iter().filter(|field| field.data_type() == &DataType::Float64);
    let plain = WriterProperties::builder()
        .set_created_by(format!("phytomer version {version}"))
        .set_compression(Compression::ZSTD(ZstdLevel::try_new(1)?));
    // Few numbers are there twice.
    let properties = floats
        .fold(plain, |properties, field| properties.set_column_dictionary_enabled(field.name().as_str().into(), false));
    let mut writer = ArrowWriter::try_new(out, Arc::clone(&schema), Some(properties.build()))?;
    writer.write(&RecordBatch::try_new(schema, columns)?)?;
    writer.close()?;
    Ok(())
}
