//! Cells of space that plants of a plot claim from one another, as growth in a voxel space needs them.
//!
//! In the first half of a tick each plant claims the cells that it wants; then the cells are granted in a fixed order,
//! and in the second half each plant grows with what it was granted. Two tips that want one cell never both get it, and
//! no result depends on the threads. Absent: the size of a cell, which model and site agree on.

use std::collections::BTreeMap;

/// A cell of space, by its place on the lattice.
pub type Cell = [i32; 3];

/// The cells that one plant claims at a tick, in the order in which it wants them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Claims(pub Vec<Cell>);

/// The cells of a plot.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Cells {
    /// Whether plants claim cells; growth then follows the clock.
    pub shared: bool,
    /// The cells that have been granted, with the number of the plant that has each.
    granted: BTreeMap<Cell, u32>,
}

impl Cells {
    /// Grants each claim on a cell that no other plant has, in the order of the plants and of their claims; of each
    /// plant which of its claims were granted. A granted cell stays with its plant. Cost: a search a claim.
    pub fn grant(&mut self, claims: &[(u32, Claims)]) -> Vec<Vec<bool>> {
        let mut grant = |plant: u32, cell: Cell| *self.granted.entry(cell).or_insert(plant) == plant;
        claims.iter().map(|(plant, claims)| claims.0.iter().map(|cell| grant(*plant, *cell)).collect()).collect()
    }

    /// The plant that has a cell.
    pub fn holder(&self, cell: Cell) -> Option<u32> {
        self.granted.get(&cell).copied()
    }

    /// Takes all cells back.
    pub fn clear(&mut self) {
        self.granted.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_goes_to_the_first_that_claims_it_and_stays_there() {
        let mut cells = Cells::default();
        let claims = |cells: &[Cell]| Claims(cells.to_vec());
        let (a, b, c) = ([0, 0, 0], [1, 0, 0], [0, -1, 2]);
        let granted = cells.grant(&[(7, claims(&[a, b])), (3, claims(&[b, c])), (9, Claims::default())]);
        assert_eq!(granted, [vec![true, true], vec![false, true], vec![]]);
        let later = cells.grant(&[(3, claims(&[a, c])), (7, claims(&[a]))]);
        assert_eq!(later, [vec![false, true], vec![true]], "a plant is granted again what it has");
        assert_eq!([a, b, c].map(|cell| cells.holder(cell)), [Some(7), Some(7), Some(3)]);
        cells.clear();
        assert_eq!(cells.holder(a), None);
    }
}
