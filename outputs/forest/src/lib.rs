//! Forests from rasters: where the plants of a landscape stand (Weber & Penn 1995 §6).
//!
//! A [`Cover`] is a raster of 16 bits: bits 0 to 13 say which of 14 trees stand in a cell, bits 14 and 15 which of
//! three grasses. [`Planting`] gives each cell its plants, with draws that are keyed by the cell, so that a cell that
//! changes changes its own plants alone and nothing has to be kept: every pass makes the same plants again. Rasters are
//! PNG, PGM and ESRI ASCII. Absent: what the plants look like, scenes (`phytomer_usd`), and files, which the caller
//! has.

mod ascii;
mod cover;
mod fault;
mod height;
mod pgm;
mod place;
mod planting;
mod png_raster;
mod raster;
mod reading;
mod table;
#[cfg(test)]
mod tests;
mod words;

pub use cover::{Cover, GRASSES, TREES};
pub use fault::{RasterFault, Where};
pub use height::Heights;
pub use place::Georeference;
pub use planting::{Count, Instance, Planting, What};
pub use raster::MOST_CELLS;
pub use reading::Format;
pub use table::{TableError, write_instances};
