//! Straight least squares with one or two terms, and intervals of Student's t.
//!
//! A measure of branchings, such as their left angle, is a sum of one or two terms times known numbers. Its variance is
//! its own. Absent: what the numbers are (`rule`).

use crate::special::beta_quantile;

/// Numbers that each branching multiplies the terms by; the second is 0 where there is one term alone.
pub type Row = [f64; 2];

/// A fitted measure.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// The terms; a second one that the data do not set is 0.
    pub terms: [f64; 2],
    /// The inverse of the matrix of the normal equations; 0 for a term that is not there.
    pub inverse: [[f64; 2]; 2],
    /// How many terms the data set.
    pub set: usize,
    /// The number of values.
    pub n: usize,
    /// The sum of squares of what is left.
    pub left: f64,
}

/// The terms of a measure; `None` of nothing.
pub fn line(rows: &[Row], values: &[f64]) -> Option<Line> {
    let n = rows.len();
    let (mut a, mut b, mut c, mut x, mut y) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for ([p, q], value) in rows.iter().zip(values) {
        a += p * p;
        b += p * q;
        c += q * q;
        x += p * value;
        y += q * value;
    }
    if n == 0 || a <= 0.0 {
        return None;
    }
    let determinant = a * c - b * b;
    let (set, inverse) = if determinant > 1e-9 * a * c && c > 0.0 {
        (2, [[c / determinant, -b / determinant], [-b / determinant, a / determinant]])
    } else {
        (1, [[1.0 / a, 0.0], [0.0, 0.0]])
    };
    let mut terms = [0, 1].map(|k| inverse[k][0] * x + inverse[k][1] * y);
    let off = |terms: [f64; 2]| {
        rows.iter().zip(values).map(move |(row, value)| value - terms[0] * row[0] - terms[1] * row[1])
    };
    // Once more on what is left, so that exact data have exact terms.
    let (mut x, mut y) = (0.0, 0.0);
    for ([p, q], rest) in rows.iter().zip(off(terms)) {
        x += p * rest;
        y += q * rest;
    }
    (0..2).for_each(|k| terms[k] += inverse[k][0] * x + inverse[k][1] * y);
    let left = off(terms).map(|rest| rest * rest).sum();
    Some(Line { terms, inverse, set, n, left })
}

impl Line {
    /// What is expected of a branching.
    pub fn at(&self, row: Row) -> f64 {
        self.terms[0] * row[0] + self.terms[1] * row[1]
    }

    /// The degrees of freedom that are left.
    pub fn free(&self) -> f64 {
        self.n as f64 - self.set as f64
    }

    /// The variance of what is left, without bias; `None` where nothing is left free.
    pub fn variance(&self) -> Option<f64> {
        (self.free() > 0.0).then(|| self.left / self.free())
    }
}

/// The number that Student's t with `df` degrees of freedom exceeds in size with the probability 1 − `confidence`.
pub fn student_quantile(df: f64, confidence: f64) -> f64 {
    // P(|T| > t) = I(df / (df + t²); df/2, 1/2).
    let x = beta_quantile(df / 2.0, 0.5, 1.0 - confidence);
    (df * (1.0 / x - 1.0)).max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tables of Student's t, as every handbook has them.
    #[test]
    fn quantiles_of_student() {
        for (df, confidence, expected) in
            [(1.0, 0.95, 12.706_205), (4.0, 0.8, 1.533_206), (10.0, 0.95, 2.228_139), (30.0, 0.99, 2.749_996)]
        {
            assert!((student_quantile(df, confidence) - expected).abs() < 1e-5, "{df} {confidence}");
        }
    }

    #[test]
    fn a_line_through_points() {
        let rows: Vec<Row> = (0..5).map(|k| [1.0, f64::from(k)]).collect();
        let found = line(&rows, &[1.0, 3.5, 5.0, 7.5, 9.0]).expect("a line");
        // By hand: the slope is 2.0, the mean 5.2.
        assert!((found.terms[1] - 2.0).abs() < 1e-12 && (found.terms[0] - 1.2).abs() < 1e-12, "{found:?}");
        let alone = line(&[[1.0, 0.0]; 3], &[1.0, 2.0, 6.0]).expect("a mean");
        assert!((alone.terms[0] - 3.0).abs() < 1e-12 && alone.set == 1 && (alone.left - 14.0).abs() < 1e-12);
        assert_eq!(line(&[], &[]), None);
    }
}
