//! The grids of Ulam's model: their cells, and the cells that face each.
//!
//! In a grid of triangles the cell that faces another is the one opposite at a corner, which is the other cell turned
//! about that corner by half a turn; in a grid of squares it is the one beyond an edge. Directions are numbered
//! counter-clockwise from the first: of triangles those at 30° + 60° k, of which a cell has each second, of squares
//! those at 90° k. Absent: which cells are coloured.

use phytomer_sim::math::sincos;
use std::f64::consts::PI;

/// A cell: the column and the row of its grid, and of triangles whether it points down.
pub(super) type Cell = [i32; 3];

/// A grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Tiling {
    Triangles,
    Squares,
}

impl Tiling {
    /// The directions in which other cells face a cell, the upward one first.
    pub fn around(self, cell: Cell) -> &'static [u8] {
        match (self, cell[2]) {
            (Self::Triangles, 0) => &[1, 3, 5],
            (Self::Triangles, _) => &[4, 0, 2],
            (Self::Squares, _) => &[1, 2, 3, 0],
        }
    }

    /// The cell that faces `cell` in one of its directions.
    pub fn facing(self, [i, j, down]: Cell, direction: u8) -> Cell {
        // A triangle (i, j) that points up has the corners (i, j), (i + 1, j) and (i, j + 1) of the lattice, one that
        // points down the corners (i + 1, j), (i, j + 1) and (i + 1, j + 1).
        let (x, y) = match (self, direction) {
            (Self::Triangles, 1) => (-1, 1),
            (Self::Triangles, 3) => (-1, -1),
            (Self::Triangles, 5) => (1, -1),
            (Self::Triangles, 4) => (1, -1),
            (Self::Triangles, 0) => (1, 1),
            (Self::Triangles, _) => (-1, 1),
            (Self::Squares, 0) => (1, 0),
            (Self::Squares, 1) => (0, 1),
            (Self::Squares, 2) => (-1, 0),
            (Self::Squares, _) => (0, -1),
        };
        let turned = if self == Self::Triangles { 1 - down } else { 0 };
        [i.wrapping_add(x), j.wrapping_add(y), turned]
    }

    /// A direction as a unit vector in the plane of the grid.
    pub fn vector(self, direction: u8) -> [f64; 2] {
        let sixths = match self {
            Self::Triangles => 0.5 + f64::from(direction),
            Self::Squares => 1.5 * f64::from(direction),
        };
        let (sin, cos) = sincos(PI / 3.0 * sixths);
        [cos, sin]
    }

    /// The distance between the middles of cells that face one another, of that of the edges of a cell.
    pub fn step(self) -> f64 {
        match self {
            // Twice the radius of the circle about a triangle.
            Self::Triangles => 2.0 / 3.0_f64.sqrt(),
            Self::Squares => 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The middle of a cell, of edges of 1.
    fn middle(tiling: Tiling, [i, j, down]: Cell) -> [f64; 2] {
        let (i, j) = (f64::from(i), f64::from(j));
        match tiling {
            Tiling::Squares => [i, j],
            Tiling::Triangles => {
                let third = if down == 0 { 1.0 / 3.0 } else { 2.0 / 3.0 };
                [(i + third) + 0.5 * (j + third), 0.75_f64.sqrt() * (j + third)]
            }
        }
    }

    /// Each direction leads to the middle of the cell that faces there, and back.
    #[test]
    fn directions_lead_from_middle_to_middle() {
        for tiling in [Tiling::Triangles, Tiling::Squares] {
            for cell in [[0, 0, 0], [3, -2, 0], [0, 0, 1], [-4, 7, 1]] {
                let cell = if tiling == Tiling::Squares { [cell[0], cell[1], 0] } else { cell };
                for &direction in tiling.around(cell) {
                    let facing = tiling.facing(cell, direction);
                    let (from, to) = (middle(tiling, cell), middle(tiling, facing));
                    let vector = tiling.vector(direction);
                    for k in 0..2 {
                        let led = from[k] + tiling.step() * vector[k];
                        assert!((led - to[k]).abs() < 1e-12, "{tiling:?} {cell:?} {direction}: {led} {to:?}");
                    }
                    let all = if tiling == Tiling::Triangles { 6 } else { 4 };
                    let back = (direction + all / 2) % all;
                    assert!(tiling.around(facing).contains(&back));
                    assert_eq!(tiling.facing(facing, back), cell);
                }
            }
        }
    }
}
