//! Columns as finished Parquet column chunks, encoded here: faster than by the crate `parquet`, and the same bytes.
//!
//! The crate stays the writer of files, of their metadata and of their index, and it encodes what is left to it: words
//! longer than statistics hold, lists of words larger than a dictionary may be, places outside of a list, which it
//! refuses. [`encode`] takes O(n) for n rows; a chunk is held in memory until its row group is written. Absent: the
//! values (`buffers`), the threads (`encode` of the tables).

mod chunk;
mod coding;
mod dictionary;
mod hybrid;
mod levels;
mod numbers;

#[cfg(test)]
mod tests;

use super::buffers::{NO_DATE, Values};
use super::schema::{Column, Encoding};
use arrow_array::StringArray;
use bytes::Bytes;
use levels::Levels;
use parquet::basic::Compression;
use parquet::column::writer::ColumnCloseResult;
use parquet::errors::Result;
use parquet::file::properties::WriterPropertiesPtr;
use parquet::file::statistics::{Statistics, ValueStatistics};
use parquet::file::writer::SerializedRowGroupWriter;
use parquet::schema::types::ColumnDescPtr;
use std::io::Write;

/// A column as its pages need it.
pub struct Described {
    column: ColumnDescPtr,
    properties: WriterPropertiesPtr,
    compression: Compression,
    encoding: Encoding,
    nullable: bool,
    words: Vec<String>,
    /// For each word the first one that is the same.
    same: Vec<u32>,
    /// Whether its words are few and short enough for a dictionary and for statistics.
    is_short: bool,
}

impl Described {
    /// A declared column of a file with these properties; `words` are those of the column.
    pub fn of(declared: &Column, column: ColumnDescPtr, properties: WriterPropertiesPtr, words: &StringArray) -> Self {
        let words: Vec<String> = words.iter().flatten().map(str::to_owned).collect();
        let first = |word: &String| words.iter().position(|known| known == word).unwrap_or(0) as u32;
        let same = words.iter().map(first).collect();
        let longest = properties.statistics_truncate_length().unwrap_or(usize::MAX);
        let limit = properties.column_dictionary_page_size_limit(column.path());
        let bytes: usize = words.iter().map(|word| word.len() + size_of::<u32>()).sum();
        let is_short = bytes < limit && words.iter().all(|word| word.len() <= longest);
        let compression = properties.compression(column.path());
        let (encoding, nullable) = (declared.encoding, declared.nullable);
        Self { column, properties, compression, encoding, nullable, words, same, is_short }
    }

    /// The bytes at which a dictionary is too large.
    fn dictionary_limit(&self) -> usize {
        self.properties.column_dictionary_page_size_limit(self.column.path())
    }
}

/// An encoded column of a row group.
pub struct Chunk {
    bytes: Bytes,
    close: ColumnCloseResult,
}

impl Chunk {
    /// Writes it as the next column of a row group.
    ///
    /// # Errors
    /// Those of the file.
    pub fn append<W: Write + Send>(self, group: &mut SerializedRowGroupWriter<'_, W>) -> Result<()> {
        group.append_column(&self.bytes, self.close)
    }
}

/// Encodes a column; `None` where that is left to the crate.
///
/// # Errors
/// Those of compression.
pub fn encode(values: &Values, of: &Described) -> Result<Option<Chunk>> {
    macro_rules! numbers {
        ($values:expr, $applies:expr) => {{
            let levels = Levels::of($values, of.nullable, $applies);
            let signed = of.column.sort_order().is_signed();
            coding::numbers($values, &levels, of, |ends, nulls| {
                let [least, greatest] = ends.map_or([None; 2], |ends| ends.map(Some));
                let told = ValueStatistics::new(least, greatest, None, Some(nulls), false);
                Statistics::from(told.with_backwards_compatible_min_max(signed))
            })?
        }};
    }
    Ok(Some(match values {
        Values::Int(values) => numbers!(values, |value| value >= 0),
        Values::Date(values) => numbers!(values, |value| value != NO_DATE),
        Values::Key(values) => numbers!(values, |_| true),
        Values::Float(values) => numbers!(values, |value: f32| !value.is_nan()),
        Values::Double(values) => numbers!(values, |value: f64| !value.is_nan()),
        Values::Bool(values) => coding::truths(values, &Levels::of(values, of.nullable, |value| value >= 0), of)?,
        Values::Word(values) if of.has_all(values.iter().map(|value| i64::from(*value))) => {
            coding::words(values, &Levels::of(values, of.nullable, |value| value >= 0), of)?
        }
        Values::Name(values) if of.has_all(values.iter().map(|value| i64::from(*value))) => {
            coding::words(values, &Levels::of(values, of.nullable, |value| value >= 0), of)?
        }
        Values::Word(_) | Values::Name(_) => return Ok(None),
    }))
}

impl Described {
    /// Whether all places are those of words that can be encoded here.
    fn has_all(&self, mut places: impl Iterator<Item = i64>) -> bool {
        let least = if self.nullable { i64::MIN } else { 0 };
        self.encoding == Encoding::Dictionary
            && self.is_short
            && places.all(|place| (least..self.words.len() as i64).contains(&place))
    }
}
