//! Whether measured units are distributed as grown ones: Pearson's test of homogeneity of two rows of counts.
//!
//! Neighbouring cells are pooled until five of the measured are expected in each. Units are taken as independent, which
//! those of one plant are not: the test then refuses too often. Parameters that were fitted to the same counts cost a
//! degree of freedom each, which is not known here. Absent: intervals of shares.

use phytomer_measures::quantile::chi2_above;

/// The smallest expected count of a cell.
const LEAST_EXPECTED: f64 = 5.0;

/// χ² with its degrees of freedom and the probability of a larger one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outcome {
    pub statistic: f64,
    pub df: f64,
    pub p: f64,
}

/// Compares counts of the same cells; `None` where fewer than two cells are left.
pub fn homogeneity(measured: &[f64], grown: &[f64]) -> Option<Outcome> {
    let (all, of_all) = (measured.iter().sum::<f64>(), grown.iter().sum::<f64>());
    let total = all + of_all;
    if all <= 0.0 || of_all <= 0.0 {
        return None;
    }
    let cells = pooled(measured, grown, LEAST_EXPECTED * total / all);
    let off = |count: f64, row: f64, cell: f64| {
        let expected = row * cell / total;
        (count - expected) * (count - expected) / expected
    };
    let statistic = cells.iter().map(|(m, g)| off(*m, all, m + g) + off(*g, of_all, m + g)).sum();
    let df = cells.len().checked_sub(1).filter(|df| *df > 0)? as f64;
    Some(Outcome { statistic, df, p: chi2_above(statistic, df).ok()? })
}

/// Cells in which at least so many of both rows together stand; what is left at the end joins the last.
fn pooled(measured: &[f64], grown: &[f64], least: f64) -> Vec<(f64, f64)> {
    let at = |row: &[f64], cell: usize| row.get(cell).copied().unwrap_or(0.0);
    let (mut cells, mut open) = (Vec::new(), (0.0, 0.0));
    for cell in 0..measured.len().max(grown.len()) {
        open = (open.0 + at(measured, cell), open.1 + at(grown, cell));
        if open.0 + open.1 >= least {
            cells.push(std::mem::take(&mut open));
        }
    }
    match cells.last_mut() {
        Some(last) => *last = (last.0 + open.0, last.1 + open.1),
        None => cells.push(open),
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two rows of two cells by hand: 30 and 10 beside 20 and 40 make χ² 16.667 with one degree of freedom.
    #[test]
    fn a_table_of_two_by_two_by_hand() {
        let found = homogeneity(&[30.0, 10.0], &[20.0, 40.0]).unwrap();
        assert!((found.statistic - 50.0 / 3.0).abs() < 1e-12 && found.df == 1.0, "{found:?}");
        assert!((found.p - 4.456e-5).abs() < 1e-7, "{found:?}");
    }

    #[test]
    fn cells_of_few_are_pooled_and_one_cell_is_no_test() {
        let found = homogeneity(&[1.0, 2.0, 3.0, 30.0, 1.0], &[10.0, 20.0, 30.0, 300.0, 10.0]).unwrap();
        assert!(found.df == 1.0 && found.statistic < 1e-9 && found.p > 0.99, "{found:?}");
        assert_eq!(homogeneity(&[4.0], &[4.0]), None);
        assert_eq!(homogeneity(&[], &[4.0]), None);
    }
}
