//! Small dense matrices: solving, inverting.
//!
//! Gauss-Jordan elimination with row pivots, for the handful of parameters that a law has. Absent: anything large.

/// A square matrix, row by row.
pub type Matrix = Vec<Vec<f64>>;

/// The inverse; `None` where a pivot is not above 10⁻¹³ of the largest entry, or an entry is not finite.
pub fn inverse(matrix: &Matrix) -> Option<Matrix> {
    let n = matrix.len();
    let largest = matrix.iter().flatten().fold(0.0_f64, |most, entry| most.max(entry.abs()));
    if !largest.is_finite() || matrix.iter().flatten().any(|entry| !entry.is_finite()) {
        return None;
    }
    let mut rows: Matrix = matrix.clone();
    for (place, row) in rows.iter_mut().enumerate() {
        row.extend((0..n).map(|column| f64::from(u8::from(column == place))));
    }
    for column in 0..n {
        let by_size = |a: &usize, b: &usize| rows[*a][column].abs().total_cmp(&rows[*b][column].abs());
        let pivot = (column..n).max_by(by_size)?;
        if rows[pivot][column].abs() <= 1e-13 * largest {
            return None;
        }
        rows.swap(column, pivot);
        let scale = rows[column][column];
        rows[column].iter_mut().for_each(|entry| *entry /= scale);
        let pivot_row = rows[column].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(place, _)| *place != column) {
            let factor = row[column];
            row.iter_mut().zip(&pivot_row).for_each(|(entry, of_pivot)| *entry -= factor * of_pivot);
        }
    }
    Some(rows.into_iter().map(|row| row[n..].to_vec()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_inverse_times_its_matrix_is_one() {
        let matrix = vec![vec![0.0, 2.0, 1.0], vec![3.0, 1.0, -4.0], vec![1.0, 0.5, 7.0]];
        let inverted = inverse(&matrix).unwrap();
        let product = |row: &[f64], column: usize| (0..3).map(|k| row[k] * inverted[k][column]).sum::<f64>();
        for (place, row) in matrix.iter().enumerate() {
            (0..3).for_each(|c| assert!((product(row, c) - f64::from(u8::from(place == c))).abs() < 1e-14));
        }
        assert_eq!(inverse(&vec![vec![1.0, 2.0], vec![2.0, 4.0]]), None);
        assert_eq!(inverse(&vec![vec![f64::NAN]]), None);
    }
}
