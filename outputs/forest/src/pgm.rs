//! Portable grey maps of 16 bits, in bytes (P5) and as text (P2).
//!
//! The samples are taken as they are: the maximum scales nothing. Absent: maxima of up to 255, whose cells have 8 bits.

use crate::fault::{RasterFault, Where};
use crate::raster::{Cell, Raster, cells_of};
use crate::words::{Words, said};

pub(crate) fn read<T: Cell>(bytes: &[u8]) -> Result<Raster<T>, RasterFault> {
    let mut words = Words::of(bytes, true);
    let binary = words.next().1 == Some(b"P5");
    let mut whole = |what: &str| {
        let (at, word) = words.next();
        let number = word.and_then(|word| std::str::from_utf8(word).ok()?.parse::<u32>().ok());
        number
            .map(|number| (at, number))
            .ok_or_else(|| RasterFault::new(at, format!("{} stands for {what}", said(word)), "a whole number"))
    };
    let ((at, columns), (_, rows)) = (whole("the number of columns")?, whole("the number of rows")?);
    let (greatest_at, greatest) = whole("the greatest value")?;
    if greatest <= 255 {
        let expected = "16 bits a cell: a greatest value from 256 to 65535";
        return Err(RasterFault::new(
            greatest_at,
            format!("the cells have 8 bits: the greatest is {greatest}"),
            expected,
        ));
    }
    if greatest > 65_535 {
        return Err(RasterFault::new(greatest_at, format!("the greatest value is {greatest}"), "256 to 65535"));
    }
    let count = cells_of(columns, rows, at)?;
    let cells = if binary {
        // One blank stands between the header and the cells.
        let body = bytes.get(words.at + 1..).unwrap_or_default();
        let Some(body) = body.get(..count.saturating_mul(2)) else {
            let problem = format!("the file is too short for {columns} × {rows} cells");
            return Err(RasterFault::new(Where::Byte(bytes.len()), problem, "2 bytes for each cell"));
        };
        body.as_chunks::<2>().0.iter().map(|pair| T::of_sample(u16::from_be_bytes(*pair))).collect()
    } else {
        text(&mut words, count, bytes.len())?
    };
    Ok(Raster { columns, rows, georeference: None, cells })
}

fn text<T: Cell>(words: &mut Words<'_>, count: usize, length: usize) -> Result<Vec<T>, RasterFault> {
    let mut cells = Vec::with_capacity(count.min(length));
    while cells.len() < count {
        let (at, word) = words.next();
        let sample = word.and_then(|word| std::str::from_utf8(word).ok()?.parse::<u16>().ok());
        let fault = || RasterFault::new(at, format!("{} stands for a cell", said(word)), "a number from 0 to 65535");
        cells.push(T::of_sample(sample.ok_or_else(fault)?));
    }
    Ok(cells)
}
