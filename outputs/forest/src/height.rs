//! The height of the ground, between the middles of the cells of a raster.
//!
//! Absent: slopes; plants stand upright.

use crate::fault::{RasterFault, Where};
use crate::place::Georeference;
use crate::raster::{Cell, Raster};
use crate::reading::read;

/// The heights of a landscape.
#[derive(Debug, Clone, PartialEq)]
pub struct Heights {
    columns: u32,
    rows: u32,
    place: Georeference,
    cells: Vec<f32>,
    /// Metres of one and of zero of the cells' numbers.
    scale_m: f64,
    offset_m: f64,
}

impl Cell for f32 {
    fn of_sample(sample: u16) -> Self {
        Self::from(sample)
    }

    fn of_number(number: f64) -> Result<Self, &'static str> {
        let single = number as Self;
        if single.is_finite() { Ok(single) } else { Err("a height in metres") }
    }

    fn unknown() -> Result<Self, &'static str> {
        Err("a height: plants may stand there")
    }
}

impl Heights {
    /// Reads the file of a raster: its heights are number × `scale_m` + `offset_m`.
    ///
    /// # Errors
    /// As [`crate::Cover::read`].
    pub fn read(bytes: &[u8], stated: Option<Georeference>, scale_m: f64, offset_m: f64) -> Result<Self, RasterFault> {
        let Raster { columns, rows, georeference, cells } = read::<f32>(bytes)?;
        let place = georeference.or(stated).ok_or_else(|| {
            RasterFault::new(Where::Byte(0), "the raster has no scale", "`cell_m`, the side of a cell in metres")
        })?;
        Ok(Self { columns, rows, place, cells, scale_m, offset_m })
    }

    /// Whether it covers the rectangle from one corner to the other, but for half a cell.
    pub fn covers(&self, west_south: [f64; 2], east_north: [f64; 2]) -> bool {
        let Georeference { cell_m, west_m, south_m } = self.place;
        let slack = cell_m / 2.0 + 1e-6;
        let (east, north) = (west_m + f64::from(self.columns) * cell_m, south_m + f64::from(self.rows) * cell_m);
        west_south[0] >= west_m - slack
            && west_south[1] >= south_m - slack
            && east_north[0] <= east + slack
            && east_north[1] <= north + slack
    }

    /// The height at a place, metres: bilinear between the middles of cells, and that of the nearest beyond them.
    pub fn at(&self, x_m: f64, y_m: f64) -> f64 {
        let Georeference { cell_m, west_m, south_m } = self.place;
        let along = |place: f64, cells: u32| {
            let last = f64::from(cells - 1);
            let place = place.clamp(0.0, last);
            let low = place.floor().min((last - 1.0).max(0.0));
            (low as usize, place - low)
        };
        let (column, right) = along((x_m - west_m) / cell_m - 0.5, self.columns);
        let (row, down) = along(f64::from(self.rows) - (y_m - south_m) / cell_m - 0.5, self.rows);
        let cell = |row: usize, column: usize| {
            let (row, column) = (row.min(self.rows as usize - 1), column.min(self.columns as usize - 1));
            f64::from(self.cells[row * self.columns as usize + column])
        };
        let row_at = |row: usize| cell(row, column) * (1.0 - right) + cell(row, column + 1) * right;
        (row_at(row) * (1.0 - down) + row_at(row + 1) * down) * self.scale_m + self.offset_m
    }
}
