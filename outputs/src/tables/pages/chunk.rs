//! A column chunk: pages that are cut where the crate `parquet` cuts them, compressed, and told of as it tells of them.
//!
//! A page ends after the batch of rows in which it has as many as a page may have; a dictionary that has become too
//! large gives way after the batch in which it has. Batches are those of that crate's writer of columns, so that its
//! files and these are the same bytes; `tests` compares the two. Absent: the values themselves (`coding`).

use super::levels::Levels;
use super::{Chunk, Described};
use bytes::Bytes;
use parquet::basic::{Compression, Encoding, EncodingMask, PageType};
use parquet::column::page::{CompressedPage, Page, PageWriter};
use parquet::column::writer::ColumnCloseResult;
use parquet::errors::{ParquetError, Result};
use parquet::file::metadata::{ColumnChunkMetaData, LevelHistogram, OffsetIndexBuilder, PageEncodingStats};
use parquet::file::statistics::Statistics;
use parquet::file::writer::{SerializedPageWriter, TrackedWrite};
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::ops::Range;
use zstd::bulk::Compressor;
use zstd::zstd_safe::compress_bound;

/// A data page, compressed.
struct DataPage {
    rows: usize,
    encoding: Encoding,
    bytes: Vec<u8>,
    uncompressed: usize,
    /// The bytes of its words.
    of_words: Option<i64>,
}

/// The data pages of a chunk that is being written.
pub struct Pages<'a> {
    of: &'a Described,
    levels: &'a Levels,
    pages: Vec<DataPage>,
    /// The first row of the page that is being filled.
    from: usize,
    buffer: Vec<u8>,
}

/// A dictionary: its values, and their number.
pub struct Dictionary {
    pub bytes: Vec<u8>,
    pub values: usize,
}

impl<'a> Pages<'a> {
    /// No pages.
    pub fn of(of: &'a Described, levels: &'a Levels) -> Self {
        Self { of, levels, pages: Vec::new(), from: 0, buffer: Vec::new() }
    }

    /// The rows of a batch: where nothing has to be looked at to tell nulls, as many as a page may have.
    pub fn batch(&self) -> usize {
        let properties = &self.of.properties;
        match self.levels {
            Levels::Alike { .. } => properties.data_page_row_count_limit(),
            Levels::Always(_) | Levels::Mixed(_) => properties.write_batch_size(),
        }
    }

    /// Whether the page that is being filled, up to a row, has as many rows as a page may have.
    pub fn is_full(&self, to: usize) -> bool {
        to - self.from >= self.of.properties.data_page_row_count_limit()
    }

    /// Ends the page before a row, if it has any; `body` adds its values, and tells their encoding and the bytes of
    /// words.
    pub fn cut(&mut self, to: usize, body: impl FnOnce(&mut Vec<u8>) -> (Encoding, Option<i64>)) -> Result<()> {
        let rows = self.from..to;
        if rows.is_empty() {
            return Ok(());
        }
        self.from = to;
        self.buffer.clear();
        self.levels.put(rows.clone(), &mut self.buffer);
        let (encoding, of_words) = body(&mut self.buffer);
        let bytes = compressed(&self.buffer, self.of.compression)?;
        let uncompressed = self.buffer.len();
        self.pages.push(DataPage { rows: rows.len(), encoding, bytes, uncompressed, of_words });
        Ok(())
    }

    /// The chunk of all pages, with its dictionary if it has one, and what is told of it.
    pub fn close(self, dictionary: Option<Dictionary>, statistics: Statistics) -> Result<Chunk> {
        let Self { of, levels, pages, .. } = self;
        let mut file = TrackedWrite::new(Vec::new());
        let mut told = Told::default();
        let mut writer = SerializedPageWriter::new(&mut file);
        if let Some(Dictionary { bytes, values }) = dictionary {
            let encoding = of.properties.dictionary_page_encoding();
            let uncompressed = bytes.len();
            let buf = Bytes::from(compressed(&bytes, of.compression)?);
            let page = Page::DictionaryPage { buf, num_values: values as u32, encoding, is_sorted: false };
            told.dictionary = true;
            told.write(&mut writer, CompressedPage::new(page, uncompressed), None)?;
        }
        let mut index = OffsetIndexBuilder::new();
        for DataPage { rows, encoding, bytes, uncompressed, of_words } in pages {
            let page = Page::DataPage {
                buf: bytes.into(),
                num_values: rows as u32,
                encoding,
                def_level_encoding: Encoding::RLE,
                rep_level_encoding: Encoding::RLE,
                statistics: None,
            };
            index.append_row_count(rows as i64);
            index.append_unencoded_byte_array_data_bytes(of_words);
            told.of_words = of_words.map_or(told.of_words, |bytes| Some(told.of_words.unwrap_or(0) + bytes));
            told.write(&mut writer, CompressedPage::new(page, uncompressed), Some(&mut index))?;
        }
        let rows = levels.rows();
        let metadata = told.metadata(of, levels, statistics)?;
        let bytes = Bytes::from(file.into_inner()?);
        let close = ColumnCloseResult {
            bytes_written: bytes.len() as u64,
            rows_written: rows as u64,
            metadata,
            bloom_filter: None,
            column_index: None,
            offset_index: Some(index.build()),
        };
        Ok(Chunk { bytes, close })
    }
}

/// What is told of the pages of a chunk.
#[derive(Default)]
struct Told {
    dictionary: bool,
    data_at: Option<u64>,
    compressed: usize,
    uncompressed: usize,
    encodings: BTreeSet<Encoding>,
    pages: Vec<PageEncodingStats>,
    of_words: Option<i64>,
}

impl Told {
    fn write(
        &mut self,
        writer: &mut SerializedPageWriter<'_, Vec<u8>>,
        page: CompressedPage,
        index: Option<&mut OffsetIndexBuilder>,
    ) -> Result<()> {
        let (page_type, encoding) = (page.page_type(), page.encoding());
        self.encodings.insert(encoding);
        match self.pages.last_mut() {
            Some(last) if last.page_type == page_type && last.encoding == encoding => last.count += 1,
            _ => self.pages.push(PageEncodingStats { page_type, encoding, count: 1 }),
        }
        let written = writer.write_page(page)?;
        if page_type == PageType::DATA_PAGE {
            self.data_at.get_or_insert(written.offset);
        }
        self.compressed += written.compressed_size;
        self.uncompressed += written.uncompressed_size;
        index.into_iter().for_each(|index| {
            index.append_offset_and_size(written.offset as i64, written.compressed_size as i32);
        });
        Ok(())
    }

    fn metadata(self, of: &Described, levels: &Levels, statistics: Statistics) -> Result<ColumnChunkMetaData> {
        let encodings: BTreeSet<Encoding> = self.encodings.into_iter().chain([Encoding::RLE]).collect();
        let rows = levels.rows();
        let present = levels.present(0..rows);
        let told = matches!(levels, Levels::Alike { .. } | Levels::Mixed(_));
        let histogram = told.then(|| LevelHistogram::from(vec![(rows - present) as i64, present as i64]));
        ColumnChunkMetaData::builder(of.column.clone())
            .set_compression(of.compression)
            .set_encodings_mask(EncodingMask::new_from_encodings(encodings.iter()))
            .set_page_encoding_stats(self.pages)
            .set_total_compressed_size(self.compressed as i64)
            .set_total_uncompressed_size(self.uncompressed as i64)
            .set_num_values(rows as i64)
            .set_data_page_offset(self.data_at.unwrap_or(0) as i64)
            .set_dictionary_page_offset(self.dictionary.then_some(0))
            .set_statistics(statistics)
            .set_unencoded_byte_array_data_bytes(self.of_words)
            .set_repetition_level_histogram(None)
            .set_definition_level_histogram(histogram)
            .build()
    }
}

/// A column that is written row after row.
pub trait Writing {
    /// How many of the next rows are written before a page or a dictionary is looked at.
    fn part(&self, rows: Range<usize>) -> usize;

    /// Writes rows.
    fn write(&mut self, rows: Range<usize>) -> Result<()>;
}

/// Writes all rows of a column in the batches of the crate's writer.
pub fn write_all(rows: usize, batch: usize, column: &mut impl Writing) -> Result<()> {
    for from in (0..rows).step_by(batch) {
        let end = rows.min(from + batch);
        let part = column.part(from..end).max(1);
        for from in (from..end).step_by(part) {
            column.write(from..end.min(from + part))?;
        }
    }
    Ok(())
}

thread_local! {
    /// The compressor of a thread, and its level: to make one takes longer than to compress a page.
    static COMPRESSOR: RefCell<Option<(i32, Compressor<'static>)>> = const { RefCell::new(None) };
}

fn compressed(bytes: &[u8], compression: Compression) -> Result<Vec<u8>> {
    let Compression::ZSTD(level) = compression else {
        return Err(ParquetError::General(format!("pages are compressed by zstd, not by {compression}")));
    };
    let level = level.compression_level();
    COMPRESSOR.with_borrow_mut(|kept| {
        if kept.as_ref().is_none_or(|(of, _)| *of != level) {
            *kept = Some((level, Compressor::new(level)?));
        }
        let mut out = Vec::with_capacity(compress_bound(bytes.len()));
        if let Some((_, compressor)) = kept {
            compressor.compress_to_buffer(bytes, &mut out)?;
        }
        Ok(out)
    })
}
