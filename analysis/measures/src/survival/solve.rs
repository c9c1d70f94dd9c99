//! A small symmetric system, for the tests that compare several groups.
//!
//! Gaussian elimination with the largest pivot; a pivot that is next to nothing beside the largest entry means that the
//! groups cannot be told apart. Absent: large matrices.

/// The least pivot, relative to the largest entry.
const LEAST: f64 = 1e-10;

/// u' V⁻¹ u; `None` where the matrix has no inverse.
pub fn quadratic_form(matrix: &[Vec<f64>], u: &[f64]) -> Option<f64> {
    let n = u.len();
    let mut rows: Vec<Vec<f64>> = matrix.iter().zip(u).map(|(row, u)| [&row[..], &[*u]].concat()).collect();
    let largest = matrix.iter().flatten().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    for column in 0..n {
        let pivot = (column..n).max_by(|a, b| rows[*a][column].abs().total_cmp(&rows[*b][column].abs()))?;
        rows.swap(column, pivot);
        let (above, below) = rows.split_at_mut(column + 1);
        let chosen = &above[column];
        if chosen[column].abs() <= LEAST * largest {
            return None;
        }
        for row in below {
            let factor = row[column] / chosen[column];
            row.iter_mut().zip(chosen).skip(column).for_each(|(value, pivot)| *value -= factor * pivot);
        }
    }
    let mut solved = vec![0.0; n];
    for row in (0..n).rev() {
        let known: f64 = (row + 1..n).map(|column| rows[row][column] * solved[column]).sum();
        solved[row] = (rows[row][n] - known) / rows[row][row];
    }
    let form = u.iter().zip(&solved).map(|(u, x)| u * x).sum::<f64>();
    form.is_finite().then_some(form)
}
