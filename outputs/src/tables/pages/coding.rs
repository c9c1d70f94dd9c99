//! Columns of numbers, words and truth values in the encodings that are declared for them.
//!
//! A dictionary is tried first where one is declared. Absent: how pages are cut and told of (`chunk`).

use super::chunk::{Dictionary, Pages, Writing, write_all};
use super::dictionary::{Seen, SeenWords};
use super::hybrid::{self, width_of};
use super::levels::Levels;
use super::numbers::{Number, put_delta, put_plain, put_split, put_truths};
use super::{Chunk, Described};
use crate::tables::schema::Encoding as Declared;
use parquet::basic::Encoding;
use parquet::data_type::ByteArray;
use parquet::errors::Result;
use parquet::file::statistics::{Statistics, ValueStatistics};
use std::ops::Range;

/// The least and the greatest value of a chunk, if it has values.
type Ends<T> = Option<[T; 2]>;

/// A column of numbers; `told` makes statistics of its ends and of its number of nulls.
pub fn numbers<T: Number>(
    values: &[T],
    levels: &Levels,
    of: &Described,
    told: impl Fn(Ends<T>, u64) -> Statistics,
) -> Result<Chunk> {
    let values = &*levels.values(values);
    let statistics = told(ends(values), (levels.rows() - values.len()) as u64);
    let seen = matches!(of.encoding, Declared::Dictionary | Declared::Repeated).then(Seen::none);
    let pages = Pages::of(of, levels);
    let batch = pages.batch();
    let mut column =
        Numbers { values, levels, of, pages, batch, seen, places: Vec::new(), at: 0, from: 0, given: None };
    write_all(levels.rows(), batch, &mut column)?;
    column.cut(levels.rows())?;
    let dictionary = column.given.take().or_else(|| column.seen.as_ref().map(listed));
    column.pages.close(dictionary, statistics)
}

struct Numbers<'a, T> {
    values: &'a [T],
    levels: &'a Levels,
    of: &'a Described,
    pages: Pages<'a>,
    batch: usize,
    /// The dictionary, while there is one.
    seen: Option<Seen<T>>,
    /// The places of the values of the present page in the dictionary.
    places: Vec<u32>,
    /// The first value that is not written, and the first of the present page.
    at: usize,
    from: usize,
    /// The dictionary as it was when it became too large: values after it are written without one.
    given: Option<Dictionary>,
}

fn listed<T: Number>(seen: &Seen<T>) -> Dictionary {
    let mut bytes = Vec::new();
    put_plain(&seen.list, &mut bytes);
    Dictionary { bytes, values: seen.list.len() }
}

impl<T: Number> Numbers<'_, T> {
    fn cut(&mut self, to: usize) -> Result<()> {
        let values = &self.values[self.from..self.at];
        let (places, seen, encoding) = (&self.places, &self.seen, self.of.encoding);
        self.pages.cut(to, |out| match (seen, encoding) {
            (Some(seen), _) => (put_places(places, seen.list.len(), out), None),
            (None, Declared::Delta) => {
                put_delta(values, out);
                (Encoding::DELTA_BINARY_PACKED, None)
            }
            (None, Declared::Split | Declared::Repeated) => {
                put_split(values, out);
                (Encoding::BYTE_STREAM_SPLIT, None)
            }
            (None, Declared::Plain | Declared::Dictionary) => {
                put_plain(values, out);
                (Encoding::PLAIN, None)
            }
        })?;
        self.places.clear();
        self.from = self.at;
        Ok(())
    }
}

impl<T: Number> Writing for Numbers<'_, T> {
    /// A batch that could make the dictionary much too large is written in parts that just fill it.
    fn part(&self, rows: Range<usize>) -> usize {
        let Some(seen) = &self.seen else { return rows.len() };
        let limit = self.of.dictionary_limit();
        let present = self.levels.present(rows.clone());
        if T::SIZE * self.batch <= limit || present == 0 {
            return rows.len();
        }
        let fit = (limit.saturating_sub(seen.list.len() * T::SIZE) / T::SIZE).clamp(1, present);
        (fit * rows.len()).div_ceil(present)
    }

    fn write(&mut self, rows: Range<usize>) -> Result<()> {
        let until = self.at + self.levels.present(rows.clone());
        if let Some(seen) = &mut self.seen {
            self.places.extend(self.values[self.at..until].iter().map(|value| seen.place(*value)));
        }
        self.at = until;
        if self.pages.is_full(rows.end) {
            self.cut(rows.end)?;
        }
        let limit = self.of.dictionary_limit();
        if self.seen.as_ref().is_some_and(|seen| seen.list.len() * T::SIZE >= limit) {
            self.cut(rows.end)?;
            self.given = self.seen.take().as_ref().map(listed);
        }
        Ok(())
    }
}

/// Adds places in a list, after their width.
fn put_places(places: &[u32], listed: usize, out: &mut Vec<u8>) -> Encoding {
    let width = width_of(listed.saturating_sub(1) as u64);
    out.push(width);
    hybrid::put(places, width, out);
    Encoding::RLE_DICTIONARY
}

/// The least and the greatest of some numbers; those that are none are left out, and a zero is the lower or the upper
/// one.
fn ends<T: Number>(values: &[T]) -> Ends<T> {
    let is_number = |value: &&T| value.partial_cmp(value).is_some();
    let first = *values.iter().find(is_number)?;
    let (mut least, mut greatest) = (first, first);
    for &value in values {
        least = if value < least { value } else { least };
        greatest = if value > greatest { value } else { greatest };
    }
    Some([least.with_sign_of_zero(true), greatest.with_sign_of_zero(false)])
}

/// A column of truth values: 0 or 1 where a row has one.
pub fn truths(values: &[i8], levels: &Levels, of: &Described) -> Result<Chunk> {
    let values = &*levels.values(values);
    let any = |truth: bool| values.iter().any(|value| (*value > 0) == truth);
    let ends = (!values.is_empty()).then(|| [!any(false), any(true)]);
    let statistics = told(ends, (levels.rows() - values.len()) as u64);
    let pages = Pages::of(of, levels);
    let batch = pages.batch();
    let mut column = Truths { values, levels, pages, at: 0, from: 0 };
    write_all(levels.rows(), batch, &mut column)?;
    column.cut(levels.rows())?;
    column.pages.close(None, statistics)
}

fn told(ends: Ends<bool>, nulls: u64) -> Statistics {
    let [least, greatest] = ends.map_or([None; 2], |ends| ends.map(Some));
    ValueStatistics::new(least, greatest, None, Some(nulls), false).into()
}

struct Truths<'a> {
    values: &'a [i8],
    levels: &'a Levels,
    pages: Pages<'a>,
    at: usize,
    from: usize,
}

impl Truths<'_> {
    fn cut(&mut self, to: usize) -> Result<()> {
        let values = &self.values[self.from..self.at];
        self.from = self.at;
        self.pages.cut(to, |out| {
            put_truths(values, out);
            (Encoding::PLAIN, None)
        })
    }
}

impl Writing for Truths<'_> {
    fn part(&self, rows: Range<usize>) -> usize {
        rows.len()
    }

    fn write(&mut self, rows: Range<usize>) -> Result<()> {
        self.at += self.levels.present(rows.clone());
        if self.pages.is_full(rows.end) { self.cut(rows.end) } else { Ok(()) }
    }
}

/// A column of words: places in the words of the column, all of which are there.
pub fn words<T: Copy + TryInto<usize>>(values: &[T], levels: &Levels, of: &Described) -> Result<Chunk> {
    let values = &*levels.values(values);
    let nulls = (levels.rows() - values.len()) as u64;
    let pages = Pages::of(of, levels);
    let batch = pages.batch();
    let (seen, places) = (SeenWords::none(&of.same), Vec::new());
    let mut column = Words { values, levels, of, pages, seen, places, bytes: 0, at: 0 };
    write_all(levels.rows(), batch, &mut column)?;
    column.cut(levels.rows())?;
    let list = column.seen.list;
    let mut bytes = Vec::new();
    for word in &list {
        bytes.extend((word.len() as u32).to_le_bytes());
        bytes.extend(word.as_bytes());
    }
    let end = |word: Option<&&str>| word.map(|word| ByteArray::from(*word));
    let [least, greatest] = [end(list.iter().min()), end(list.iter().max())];
    let statistics = ValueStatistics::new(least, greatest, None, Some(nulls), false);
    column.pages.close(Some(Dictionary { bytes, values: list.len() }), statistics.into())
}

struct Words<'a, T> {
    values: &'a [T],
    levels: &'a Levels,
    of: &'a Described,
    pages: Pages<'a>,
    seen: SeenWords<'a>,
    places: Vec<u32>,
    /// The bytes of the words of the present page.
    bytes: i64,
    at: usize,
}

impl<T> Words<'_, T> {
    fn cut(&mut self, to: usize) -> Result<()> {
        let (places, listed, bytes) = (&self.places, self.seen.list.len(), std::mem::take(&mut self.bytes));
        self.pages.cut(to, |out| (put_places(places, listed, out), Some(bytes)))?;
        self.places.clear();
        Ok(())
    }
}

impl<T: Copy + TryInto<usize>> Writing for Words<'_, T> {
    fn part(&self, rows: Range<usize>) -> usize {
        rows.len()
    }

    fn write(&mut self, rows: Range<usize>) -> Result<()> {
        let until = self.at + self.levels.present(rows.clone());
        for value in &self.values[self.at..until] {
            let place = self.seen.place((*value).try_into().unwrap_or(0), &self.of.words);
            self.bytes += self.seen.list[place as usize].len() as i64;
            self.places.push(place);
        }
        self.at = until;
        if self.pages.is_full(rows.end) { self.cut(rows.end) } else { Ok(()) }
    }
}
