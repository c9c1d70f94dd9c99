//! Where the cells of a raster lie, in metres.
//!
//! x goes to the east and y to the north; the first row of a file is the northernmost. Absent: projections.

/// The size and the place of a raster's cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Georeference {
    /// The length of a cell's side, metres.
    pub cell_m: f64,
    /// The x of the western edge, metres.
    pub west_m: f64,
    /// The y of the southern edge, metres.
    pub south_m: f64,
}
