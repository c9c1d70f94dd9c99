//! Grey PNG files of 16 bits, read row by row.
//!
//! Absent: colours, palettes and transparency, which are faults: their bits are no bits of trees.

use crate::fault::{RasterFault, Where};
use crate::raster::{Cell, MOST_CELLS, Raster, cells_of};
use png::{BitDepth, ColorType, Decoder, Limits, Transformations};
use std::io::Cursor;

/// The byte of a PNG file at which its number of bits stands.
const DEPTH: usize = 24;
/// The byte of a PNG file at which its kind of colour stands.
const COLOUR: usize = 25;
/// The byte at which its width stands.
const WIDTH: usize = 16;

pub(crate) fn read<T: Cell>(bytes: &[u8]) -> Result<Raster<T>, RasterFault> {
    let broken = |error: png::DecodingError| {
        RasterFault::new(Where::Byte(bytes.len()), format!("this PNG cannot be read: {error}"), "a whole PNG file")
    };
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: 2 * MOST_CELLS as usize });
    decoder.set_transformations(Transformations::IDENTITY);
    let mut reader = decoder.read_info().map_err(broken)?;
    let info = reader.info();
    let (columns, rows, depth, colour) = (info.width, info.height, info.bit_depth, info.color_type);
    if depth != BitDepth::Sixteen {
        let problem = format!("the cells have {} bits", depth as u8);
        return Err(RasterFault::new(Where::Byte(DEPTH), problem, "16 bits a cell"));
    }
    if colour != ColorType::Grayscale {
        return Err(RasterFault::new(Where::Byte(COLOUR), "the cells are colours", "one grey value a cell"));
    }
    let count = cells_of(columns, rows, Where::Byte(WIDTH))?;
    let mut cells = Vec::new();
    if info.interlaced {
        let mut all = vec![0; count * 2];
        reader.next_frame(&mut all).map_err(broken)?;
        cells.extend(all.as_chunks::<2>().0.iter().map(|pair| T::of_sample(u16::from_be_bytes(*pair))));
    } else {
        while let Some(row) = reader.next_row().map_err(broken)? {
            cells.extend(row.data().as_chunks::<2>().0.iter().map(|pair| T::of_sample(u16::from_be_bytes(*pair))));
        }
    }
    if cells.len() != count {
        return Err(RasterFault::new(Where::Byte(bytes.len()), "rows are missing", format!("{rows} rows")));
    }
    Ok(Raster { columns, rows, georeference: None, cells })
}
