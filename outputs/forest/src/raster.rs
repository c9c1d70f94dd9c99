//! A raster as its file tells it: rows from the north to the south, and where its cells lie, if the file says so.
//!
//! Absent: what the numbers mean (`cover`, `height`).

use crate::fault::{RasterFault, Where};
use crate::place::Georeference;

/// So many cells may a raster have, of 2 bytes each; heights have 4.
pub const MOST_CELLS: u64 = 1 << 28;

/// A raster.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Raster<T> {
    pub columns: u32,
    pub rows: u32,
    pub georeference: Option<Georeference>,
    pub cells: Vec<T>,
}

/// A value of a cell, from what files hold.
pub(crate) trait Cell: Copy + Default {
    /// From a sample of 16 bits.
    fn of_sample(sample: u16) -> Self;
    /// From a number that is written out; what is expected where it cannot be one.
    fn of_number(number: f64) -> Result<Self, &'static str>;
    /// The value of a cell of which the file knows nothing; what is expected where there must be one.
    fn unknown() -> Result<Self, &'static str>;
}

/// The number of cells, where a raster may have so many.
pub(crate) fn cells_of(columns: u32, rows: u32, at: Where) -> Result<usize, RasterFault> {
    let cells = u64::from(columns) * u64::from(rows);
    if cells == 0 || cells > MOST_CELLS {
        let problem = format!("the raster has {columns} columns and {rows} rows");
        return Err(RasterFault::new(at, problem, format!("1 to {MOST_CELLS} cells")));
    }
    Ok(cells as usize)
}
