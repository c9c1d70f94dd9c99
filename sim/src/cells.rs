//! Cells of space that plants of a plot claim from one another, as growth in a voxel space needs them.
//!
//! In the first half of a tick each plant claims the cells that it wants; then the claims are granted in a fixed order,
//! each whole or not at all, and in the second half each plant grows with what it was granted. Two tips that want one
//! cell never both get it, and no result depends on the threads. Absent: the size of a cell, which the models of all
//! plants that share cells agree on (`Grow::cell_m`).

use std::collections::BTreeMap;

/// A cell of space, by its place on the lattice.
pub type Cell = [i32; 3];

/// What one plant claims at a tick, in the order in which it wants it: each claim the cells that it needs together,
/// such as those of a segment.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Claims(pub Vec<Vec<Cell>>);

/// The cells of a plot.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Cells {
    /// Whether plants claim cells; growth then follows the clock.
    pub shared: bool,
    /// The place of the plot, metres: the middle of the base of the cell [0, 0, 0].
    pub origin: [f64; 3],
    /// The cells that have been granted, with the number of the plant that has each.
    granted: BTreeMap<Cell, u32>,
}

impl Cells {
    /// Grants each claim on cells of which no other plant has any, in the order of the plants and of their claims; of
    /// each plant which of its claims were granted. A granted cell stays with its plant. Cost: two searches a cell.
    pub fn grant(&mut self, claims: &[(u32, Claims)]) -> Vec<Vec<bool>> {
        let mut grant = |plant: u32, cells: &[Cell]| {
            let is_free = cells.iter().all(|cell| self.holder(*cell).is_none_or(|holder| holder == plant));
            if is_free {
                self.granted.extend(cells.iter().map(|cell| (*cell, plant)));
            }
            is_free
        };
        claims.iter().map(|(plant, claims)| claims.0.iter().map(|cells| grant(*plant, cells)).collect()).collect()
    }

    /// The plant that has a cell.
    pub fn holder(&self, cell: Cell) -> Option<u32> {
        self.granted.get(&cell).copied()
    }

    /// The cells of a plot at another place, `by` metres farther.
    pub fn moved(&self, by: [f64; 3]) -> Self {
        Self { origin: [0, 1, 2].map(|k| self.origin[k] + by[k]), ..self.clone() }
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
        let claims = |cells: &[Cell]| Claims(cells.iter().map(|cell| vec![*cell]).collect());
        let (a, b, c) = ([0, 0, 0], [1, 0, 0], [0, -1, 2]);
        let granted = cells.grant(&[(7, claims(&[a, b])), (3, claims(&[b, c])), (9, Claims::default())]);
        assert_eq!(granted, [vec![true, true], vec![false, true], vec![]]);
        let later = cells.grant(&[(3, claims(&[a, c])), (7, claims(&[a]))]);
        assert_eq!(later, [vec![false, true], vec![true]], "a plant is granted again what it has");
        assert_eq!([a, b, c].map(|cell| cells.holder(cell)), [Some(7), Some(7), Some(3)]);
        cells.clear();
        assert_eq!(cells.holder(a), None);
    }

    /// Of a claim that is refused no cell stays with its plant.
    #[test]
    fn a_claim_is_granted_whole_or_not_at_all() {
        let mut cells = Cells::default();
        let (a, b, c) = ([0, 0, 0], [1, 0, 0], [2, 0, 0]);
        let granted = cells.grant(&[(1, Claims(vec![vec![a, b]])), (2, Claims(vec![vec![c, b], vec![c]]))]);
        assert_eq!(granted, [vec![true], vec![false, true]]);
        let granted = cells.grant(&[(3, Claims(vec![vec![b, [9; 3]]]))]);
        assert_eq!(granted, [[false]]);
        assert_eq!([a, b, c, [9; 3]].map(|cell| cells.holder(cell)), [Some(1), Some(1), Some(2), None]);
    }
}
