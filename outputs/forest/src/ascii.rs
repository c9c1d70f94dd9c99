//! ESRI ASCII grids: a header with the size and the place of the cells, and numbers from the north to the south.
//!
//! Absent: cells that are not square (`dx`, `dy`), which are a fault.

use crate::fault::{RasterFault, Where};
use crate::place::Georeference;
use crate::raster::{Cell, Raster, cells_of};
use crate::words::{Words, number, said};

#[derive(Default)]
struct Header {
    columns: Option<u32>,
    rows: Option<u32>,
    cell_m: Option<f64>,
    /// West and south, and whether they are of the middle of the first cell.
    west: Option<(f64, bool)>,
    south: Option<(f64, bool)>,
    unknown: Option<f64>,
}

pub(crate) fn read<T: Cell>(bytes: &[u8]) -> Result<Raster<T>, RasterFault> {
    let mut words = Words::of(bytes, false);
    let (header, mut at) = header(&mut words)?;
    let missing = |key: &str| {
        let problem = format!("the header has no `{key}`");
        RasterFault::new(at, problem, "ncols, nrows, xllcorner, yllcorner and cellsize, and then the cells")
    };
    let columns = header.columns.ok_or_else(|| missing("ncols"))?;
    let rows = header.rows.ok_or_else(|| missing("nrows"))?;
    let cell_m = header.cell_m.ok_or_else(|| missing("cellsize"))?;
    let (west, south) =
        (header.west.ok_or_else(|| missing("xllcorner"))?, header.south.ok_or_else(|| missing("yllcorner"))?);
    let edge = |(place, of_middle): (f64, bool)| if of_middle { place - cell_m / 2.0 } else { place };
    let georeference = Some(Georeference { cell_m, west_m: edge(west), south_m: edge(south) });
    let count = cells_of(columns, rows, at)?;
    // A cell is written with at least one letter and one blank.
    if count > bytes.len().saturating_sub(words.at) / 2 + 1 {
        let problem = format!("the file is too short for {columns} × {rows} cells");
        return Err(RasterFault::new(at, problem, "a number for each cell"));
    }
    let mut cells = Vec::with_capacity(count);
    while cells.len() < count {
        let (place, word) = words.next();
        let told = |expected: &str| RasterFault::new(place, format!("{} stands for a cell", said(word)), expected);
        let value = word.and_then(number).ok_or_else(|| told("a number for each cell"))?;
        let cell = if header.unknown == Some(value) { T::unknown() } else { T::of_number(value) };
        cells.push(cell.map_err(told)?);
    }
    let (place, more) = words.next();
    at = place;
    match more {
        None => Ok(Raster { columns, rows, georeference, cells }),
        Some(_) => Err(RasterFault::new(at, format!("{} follows the last cell", said(more)), "the end of the file")),
    }
}

/// The header, and the place behind it.
fn header(words: &mut Words<'_>) -> Result<(Header, Where), RasterFault> {
    let mut header = Header::default();
    loop {
        let before = words.at;
        let (place, word) = words.next();
        let key = word.map(|word| String::from_utf8_lossy(&word[..word.len().min(40)]).to_ascii_lowercase());
        let Some(key) = key.filter(|key| key.starts_with(|c: char| c.is_ascii_alphabetic())) else {
            *words = words.back_to(before);
            return Ok((header, place));
        };
        let (at, value) = words.number();
        let value = value.ok_or_else(|| RasterFault::new(at, format!("`{key}` has no number"), "a number"))?;
        let whole = || {
            let fits = value.fract() == 0.0 && (1.0..=f64::from(u32::MAX)).contains(&value);
            let fault = || RasterFault::new(at, format!("`{key}` is {value}"), "a whole number of at least 1");
            if fits { Ok(Some(value as u32)) } else { Err(fault()) }
        };
        match key.as_str() {
            "ncols" => header.columns = whole()?,
            "nrows" => header.rows = whole()?,
            "cellsize" if value > 0.0 && value <= 1e6 => header.cell_m = Some(value),
            "cellsize" => return Err(RasterFault::new(at, format!("`cellsize` is {value}"), "0 to 1,000,000 metres")),
            "xllcorner" => header.west = Some((value, false)),
            "yllcorner" => header.south = Some((value, false)),
            "xllcenter" => header.west = Some((value, true)),
            "yllcenter" => header.south = Some((value, true)),
            "nodata_value" => header.unknown = Some(value),
            _ => {
                let expected = "ncols, nrows, xllcorner, yllcorner, cellsize or NODATA_value";
                return Err(RasterFault::new(place, format!("{} stands in the header", said(word)), expected));
            }
        }
    }
}
