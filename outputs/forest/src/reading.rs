//! The formats of rasters, and which of them a file has.
//!
//! Absent: reading each of them (`ascii`, `pgm`, `png_raster`).

use crate::fault::RasterFault;
use crate::raster::{Cell, Raster};
use crate::{ascii, pgm, png_raster};

/// The formats of rasters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// PNG, grey, 16 bits.
    Png,
    /// Portable grey map, with a maximum above 255.
    Pgm,
    /// ESRI ASCII grid.
    Ascii,
}

impl Format {
    /// That of a file, by how it begins.
    pub fn of(bytes: &[u8]) -> Self {
        if bytes.starts_with(b"\x89PNG") {
            Self::Png
        } else if bytes.starts_with(b"P5") || bytes.starts_with(b"P2") {
            Self::Pgm
        } else {
            Self::Ascii
        }
    }
}

/// Reads a raster of any format.
pub(crate) fn read<T: Cell>(bytes: &[u8]) -> Result<Raster<T>, RasterFault> {
    match Format::of(bytes) {
        Format::Png => png_raster::read(bytes),
        Format::Pgm => pgm::read(bytes),
        Format::Ascii => ascii::read(bytes),
    }
}
