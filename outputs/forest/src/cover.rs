//! What grows in each cell: 14 bits of trees and 2 of grass (Weber & Penn 1995 §6).
//!
//! Trees are not exclusive, grasses are: bits 14 and 15 are a number from 0, no grass, to 3. Absent: how many plants a
//! cell has (`planting`).

use crate::fault::{RasterFault, Where};
use crate::place::Georeference;
use crate::raster::{Cell, Raster};
use crate::reading::read;

/// So many trees have a bit.
pub const TREES: u8 = 14;
/// So many grasses have a number, from 1.
pub const GRASSES: u8 = 3;

/// The raster of a landscape's plants.
#[derive(Debug, Clone, PartialEq)]
pub struct Cover {
    columns: u32,
    place: Georeference,
    rows: u32,
    cells: Vec<u16>,
}

impl Cell for u16 {
    fn of_sample(sample: u16) -> Self {
        sample
    }

    fn of_number(number: f64) -> Result<Self, &'static str> {
        let fits = number.fract() == 0.0 && (0.0..=65_535.0).contains(&number);
        if fits { Ok(number as u16) } else { Err("a whole number from 0 to 65535: 14 bits of trees and 2 of grass") }
    }

    /// Nothing grows there.
    fn unknown() -> Result<Self, &'static str> {
        Ok(0)
    }
}

impl Cover {
    /// Reads the file of a raster. What the file does not say of the place of its cells, the caller does.
    ///
    /// # Errors
    /// What is wrong with it, and where; so is a raster of which nobody tells how large its cells are.
    pub fn read(bytes: &[u8], stated: Option<Georeference>) -> Result<Self, RasterFault> {
        let Raster { columns, rows, georeference, cells } = read::<u16>(bytes)?;
        let place = georeference.or(stated).ok_or_else(|| {
            RasterFault::new(Where::Byte(0), "the raster has no scale", "`cell_m`, the side of a cell in metres")
        })?;
        Ok(Self { columns, place, rows, cells })
    }

    /// Columns and rows.
    pub fn size(&self) -> [u32; 2] {
        [self.columns, self.rows]
    }

    /// Where its cells lie.
    pub fn place(&self) -> Georeference {
        self.place
    }

    /// The rows from the north to the south.
    pub(crate) fn rows(&self) -> impl Iterator<Item = &[u16]> {
        self.cells.chunks_exact(self.columns as usize)
    }

    /// The x of the eastern and the y of the northern edge, metres.
    pub fn far_edges(&self) -> [f64; 2] {
        let Georeference { cell_m, west_m, south_m } = self.place;
        [west_m + f64::from(self.columns) * cell_m, south_m + f64::from(self.rows) * cell_m]
    }
}
