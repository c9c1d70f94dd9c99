//! The χ² test: whether simulated counts are as the measured ones, and the tail of the χ² distribution.
//!
//! Two rows of counts are compared cell by cell (Pearson's test of homogeneity); neighbouring cells are pooled until 5
//! of the measured counts are expected in each. The parameters that were fitted to the measured counts cost a degree of
//! freedom each. The tail is the regularised incomplete gamma function Q(df/2, χ²/2), by its series or its continued
//! fraction (Abramowitz & Stegun 1964, 6.5.29 and 6.5.31).

use phytomer_sim::math;

/// The smallest expected count of a cell.
const LEAST_EXPECTED: f64 = 5.0;

/// The level of the test: a law fits if a difference of this size occurs in more than one sample of a hundred.
const LEVEL: f64 = 0.01;

/// The result of a test.
#[derive(Debug, Clone, Copy)]
pub struct Outcome {
    pub statistic: f64,
    pub df: usize,
    pub p: f64,
}

/// The probability that χ² with `df` degrees of freedom exceeds `x`.
pub fn tail(x: f64, df: usize) -> f64 {
    if x <= 0.0 { 1.0 } else { upper_gamma(df as f64 / 2.0, x / 2.0) }
}

/// Q(a, x) = Γ(a, x) / Γ(a), for a and x above 0.
fn upper_gamma(a: f64, x: f64) -> f64 {
    let scale = math::exp(a * math::log(x) - x - math::lgamma(a));
    if x < a + 1.0 { 1.0 - scale * series(a, x) } else { scale * fraction(a, x) }
}

/// Σ xⁿ / (a (a + 1) … (a + n)).
fn series(a: f64, x: f64) -> f64 {
    let (mut term, mut sum, mut n) = (1.0 / a, 1.0 / a, a);
    while term > sum * 1e-16 {
        n += 1.0;
        term *= x / n;
        sum += term;
    }
    sum
}

/// 1 / (x + 1 − a − 1 (1 − a) / (x + 3 − a − 2 (2 − a) / (x + 5 − a − …))), from far inside outwards.
fn fraction(a: f64, x: f64) -> f64 {
    let inner = (1..=2000).rev().map(f64::from).fold(0.0, |below, n| n * (n - a) / (x + 2.0 * n + 1.0 - a - below));
    1.0 / (x + 1.0 - a - inner)
}

/// Compares measured with simulated counts of the same cells, in their order; `fitted` parameters were estimated from
/// the measured counts.
pub fn homogeneity(measured: &[f64], simulated: &[f64], fitted: usize) -> Outcome {
    let cells = pooled(measured, simulated);
    let sums = cells.iter().fold((0.0, 0.0), |(m, s), cell| (m + cell.0, s + cell.1));
    let total = sums.0 + sums.1;
    let off = |count: f64, row: f64, cell: f64| {
        let expected = row * cell / total;
        (count - expected) * (count - expected) / expected
    };
    let both = |&(m, s): &(f64, f64)| off(m, sums.0, m + s) + off(s, sums.1, m + s);
    let statistic = cells.iter().map(both).sum();
    let df = cells.len().saturating_sub(1 + fitted);
    assert!(df > 0, "{} cells for {fitted} parameters", cells.len());
    Outcome { statistic, df, p: tail(statistic, df) }
}

/// Joins neighbouring cells until enough of the measured counts are expected in each; the remaining cells join the
/// last.
fn pooled(measured: &[f64], simulated: &[f64]) -> Vec<(f64, f64)> {
    let longest = measured.len().max(simulated.len());
    let at = |row: &[f64], cell: usize| row.get(cell).copied().unwrap_or(0.0);
    let share = measured.iter().sum::<f64>() / (measured.iter().sum::<f64>() + simulated.iter().sum::<f64>());
    let (mut cells, mut open) = (Vec::new(), (0.0, 0.0));
    for cell in 0..longest {
        open = (open.0 + at(measured, cell), open.1 + at(simulated, cell));
        if (open.0 + open.1) * share >= LEAST_EXPECTED {
            cells.push(std::mem::take(&mut open));
        }
    }
    if let Some(last) = cells.last_mut() {
        *last = (last.0 + open.0, last.1 + open.1);
    }
    cells
}

impl Outcome {
    /// Prints the row of `docs/fitted-laws.md`, and fails where the law does not reproduce its data.
    #[track_caller]
    pub fn assert_fits(self, what: &str) {
        self.tell(what);
        assert!(self.p >= LEVEL, "{what}: {self:?}");
    }

    /// Prints the row, and fails where the law reproduces its data: then the misfit that the document shows is gone.
    #[track_caller]
    pub fn assert_misfit(self, what: &str) {
        self.tell(what);
        assert!(self.p < LEVEL, "{what} fits: {self:?}");
    }

    fn tell(self, what: &str) {
        println!("| {what} | {:.2} | {} | {:.2e} |", self.statistic, self.df, self.p);
    }
}

/// Abramowitz & Stegun 1964, table 26.8: percentage points of χ².
#[test]
fn the_tail_is_that_of_the_tables() {
    let points = [
        (1, 3.84146, 0.05),
        (1, 10.8276, 0.001),
        (2, 0.010025, 0.995),
        (5, 11.0705, 0.05),
        (10, 18.3070, 0.05),
        (10, 2.55821, 0.99),
        (20, 45.3147, 0.001),
        (30, 43.7729, 0.05),
        (100, 124.342, 0.05),
        (100, 67.3276, 0.995),
    ];
    for (df, x, p) in points {
        assert!((tail(x, df) - p).abs() < 2e-5 * f64::max(1.0, 10.0 * p), "{df} {x}: {}", tail(x, df));
    }
    // Two degrees of freedom have a closed form, on both sides of the change of method.
    for x in [0.1, 2.0, 3.9, 4.1, 30.0, 200.0] {
        let closed = math::exp(-x / 2.0);
        assert!((tail(x, 2) / closed - 1.0).abs() < 1e-12, "{x}");
    }
}

#[test]
fn cells_are_pooled_and_equal_rows_do_not_differ() {
    let measured = [1.0, 2.0, 3.0, 10.0, 1.0];
    assert_eq!(pooled(&measured, &measured), [(6.0, 6.0), (11.0, 11.0)]);
    let outcome = homogeneity(&measured, &measured.map(|count| 7.0 * count), 0);
    assert!(outcome.statistic < 1e-12 && outcome.df == 1 && (outcome.p - 1.0).abs() < 1e-5, "{outcome:?}");
    // By hand: rows (10, 20) and (20, 10): each expected 15, χ² = 4 · 25 / 15.
    let outcome = homogeneity(&[10.0, 20.0], &[20.0, 10.0], 0);
    assert!((outcome.statistic - 100.0 / 15.0).abs() < 1e-12, "{outcome:?}");
}
